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
        if (isTaken(place)) {
            return false;
        }
        is_taken_[squareOf(place.y(), corner_.y(), rows_) * columns_ +
                  squareOf(place.x(), corner_.x(), columns_)] = true;
        return true;
    }
    bool isTaken(QPointF place) const
    {
        return is_taken_[squareOf(place.y(), corner_.y(), rows_) * columns_ +
                         squareOf(place.x(), corner_.x(), columns_)];
    }
    /// Whether no place in a box, as far as it is inside the area, has a free square.
    bool isTaken(const QRectF& box) const
    {
        const std::size_t left = squareOf(box.left(), corner_.x(), columns_);
        const std::size_t right = squareOf(box.right(), corner_.x(), columns_);
        const std::size_t top = squareOf(box.top(), corner_.y(), rows_);
        const std::size_t bottom = squareOf(box.bottom(), corner_.y(), rows_);
        for (std::size_t row = top; row <= bottom; ++row) {
            for (std::size_t column = left; column <= right; ++column) {
                if (!is_taken_[row * columns_ + column]) {
                    return false; // a large box has one soon
                }
            }
        }
        return true;
    }

private:
    // Beyond the area, the nearest one.
    std::size_t squareOf(double at, double from, std::size_t count) const
    {
        const double square = std::floor((at - from) / gap_);
        return square > 0.0
                   ? static_cast<std::size_t>(std::fmin(square, static_cast<double>(count - 1)))
                   : 0;
    }

    QPointF corner_;
    double gap_;
    std::size_t columns_;
    std::size_t rows_;
    std::vector<bool> is_taken_;
};

} // namespace marsview
