// Finds those of a million points that a picture has room for, without looking at all of them.
#pragma once

#include "core/globe/horizon.h"
#include "core/view/camera.h"

#include <QPointF>
#include <QRectF>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace marsview {

class HandleGrid;

/// Where places of the scene are on the screen, in points. A value, made once for a picture.
class DotSight {
public:
    /// Of an area of the screen. Places are given without the exaggeration. The horizon, on a
    /// body, hides what is behind it.
    DotSight(const CameraPose& camera,
             const Viewport& viewport,
             double pixels_per_point,
             double exaggeration,
             const QRectF& area,
             std::optional<Horizon> horizon = std::nullopt);

    const QRectF& area() const noexcept { return area_; }
    /// Nothing behind the eye or the horizon.
    std::optional<QPointF> at(const ScenePoint& place) const;
    /// Encloses all that is in a box; nothing where a part of it is behind the eye.
    std::optional<QRectF> enclosing(const ScenePoint& low, const ScenePoint& high) const;
    bool isBehind(const ScenePoint& low, const ScenePoint& high) const;
    /// By the horizon.
    bool isHidden(const ScenePoint& low, const ScenePoint& high) const;

private:
    ScenePoint raised(const ScenePoint& place) const
    {
        return {place.x, place.y, place.z * exaggeration_};
    }
    std::optional<QPointF> projected(const ScenePoint& raised) const;

    ScenePoint eye_;
    CameraAxes axes_; // right and up are as long as makes the quotient with the depth points
    QPointF center_;
    double exaggeration_;
    QRectF area_;
    std::optional<Horizon> horizon_;
};

/// Points of the scene in a tree of boxes. A lookup takes about as long as what it finds, whatever
/// the number of points.
class DotIndex {
public:
    struct Dot {
        std::uint32_t id = 0;
        ScenePoint place{}; // without exaggeration

        bool operator==(const Dot&) const = default;
    };
    DotIndex() = default;
    explicit DotIndex(std::vector<Dot> dots);

    std::size_t size() const noexcept { return dots_.size(); }
    /// In an order of its own; also those that were removed.
    const std::vector<Dot>& dots() const noexcept { return dots_; }
    /// Leaves out the dot that is dots()[place] from now on.
    void remove(std::size_t place);
    /// How many are left out.
    std::size_t removed() const noexcept { return removed_; }

    /// Calls `take` with dots that are in the area of the sight: one for each square of `grid` that
    /// is free, and takes the square.
    void thinned(const DotSight& sight,
                 HandleGrid& grid,
                 const std::function<void(const Dot&, QPointF)>& take) const;

    struct Near {
        Dot dot;
        QPointF place; // on the screen
        double away = 0.0;
    };
    /// The dot that is nearest to a position on the screen, at most `reach` points away.
    std::optional<Near> nearest(const DotSight& sight, QPointF position, double reach) const;

private:
    struct Node {
        ScenePoint low{};
        ScenePoint high{};
        std::uint32_t begin = 0; // of its dots
        std::uint32_t end = 0;
        std::uint32_t further = 0; // second half; the first half follows its node. 0: a leaf
    };

    std::uint32_t build(std::uint32_t begin, std::uint32_t end);
    template <typename Look, typename See>
    void visit(std::uint32_t node, const Look& look, const See& see) const;

    std::vector<Dot> dots_;        // in the order of the leaves
    std::vector<bool> is_removed_; // of them; empty before the first
    std::size_t removed_ = 0;
    std::vector<Node> nodes_;
};

} // namespace marsview
