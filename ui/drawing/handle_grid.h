// Thins marks out where they would lie over each other.
#pragma once

#include <QPointF>
#include <QRectF>

#include <cmath>
#include <cstddef>
#include <vector>

namespace marsview {

/// A grid of squares over the view. Each has room for one mark: of a million marks, a picture shows
/// as many as there are squares.
class HandleGrid {
public:
    /// `gap` > 0 is the side of a square.
    HandleGrid(const QRectF& area, double gap)
        : corner_(area.topLeft())
        , gap_(gap)
        , columns_(static_cast<std::size_t>(std::ceil(area.width() / gap)) + 1)
        , rows_(static_cast<std::size_t>(std::ceil(area.height() / gap)) + 1)
        , is_taken_(columns_ * rows_, false)
    {}

    /// Takes the square at a place inside the area; false if it is taken.
    bool take(QPointF place)
    {
        const auto column = static_cast<std::size_t>((place.x() - corner_.x()) / gap_);
        const auto row = static_cast<std::size_t>((place.y() - corner_.y()) / gap_);
        if (column >= columns_ || row >= rows_ || is_taken_[row * columns_ + column]) {
            return false;
        }
        is_taken_[row * columns_ + column] = true;
        return true;
    }

private:
    QPointF corner_;
    double gap_;
    std::size_t columns_;
    std::size_t rows_;
    std::vector<bool> is_taken_;
};

} // namespace marsview
