// Finds out whether boxes on the screen are free of others, without a look at all of them.
#pragma once

#include <QRectF>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace marsview {

/// Boxes in squares of an area. They may reach beyond it.
class BoxGrid {
public:
    explicit BoxGrid(const QRectF& area)
        : corner_(area.topLeft())
        , columns_(countFor(area.width()))
        , rows_(countFor(area.height()))
        , heads_(columns_ * rows_, kNone)
    {}

    void add(const QRectF& box)
    {
        boxes_.push_back(box);
        forEachSquare(box, [this](std::size_t square) {
            entries_.push_back({.box = boxes_.size() - 1, .next = heads_[square]});
            heads_[square] = entries_.size() - 1;
            return true;
        });
    }
    /// None that was added overlaps the box.
    bool isClear(const QRectF& box) const
    {
        return forEachSquare(box, [this, &box](std::size_t square) {
            for (std::size_t at = heads_[square]; at != kNone; at = entries_[at].next) {
                if (box.intersects(boxes_[entries_[at].box])) {
                    return false;
                }
            }
            return true;
        });
    }

private:
    static constexpr double kSide = 48.0;
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

    struct Entry {
        std::size_t box = 0;
        std::size_t next = kNone; // in the same square
    };

    static std::size_t countFor(double length)
    {
        return static_cast<std::size_t>(std::ceil(std::fmax(length, 1.0) / kSide));
    }
    // Beyond the area, the nearest one: boxes that overlap share a square there, too.
    static std::size_t squareOf(double from_edge, std::size_t count)
    {
        const double square = std::floor(from_edge / kSide);
        return static_cast<std::size_t>(std::clamp(square, 0.0, static_cast<double>(count - 1)));
    }
    // False as soon as `look` is.
    template <typename Look>
    bool forEachSquare(const QRectF& box, const Look& look) const
    {
        const std::size_t left = squareOf(box.left() - corner_.x(), columns_);
        const std::size_t right = squareOf(box.right() - corner_.x(), columns_);
        const std::size_t bottom = squareOf(box.bottom() - corner_.y(), rows_);
        for (std::size_t row = squareOf(box.top() - corner_.y(), rows_); row <= bottom; ++row) {
            for (std::size_t column = left; column <= right; ++column) {
                if (!look(row * columns_ + column)) {
                    return false;
                }
            }
        }
        return true;
    }

    QPointF corner_;
    std::size_t columns_;
    std::size_t rows_;
    std::vector<std::size_t> heads_; // by square: the last of its entries
    std::vector<Entry> entries_;
    std::vector<QRectF> boxes_;
};

} // namespace marsview
