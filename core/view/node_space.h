// Where the nodes of a map's quadtree lie in its scene: what choosing detail needs to know of it.
#pragma once

#include "core/geo/frames.h"
#include "core/terrain/detail_errors.h"
#include "core/view/frustum.h"

#include <cstddef>

namespace marsview {

/// Distances and sizes in scene meters. Const functions may be called from several threads, those
/// of one object with the same exaggeration.
class NodeSpace {
public:
    /// A node, seen from the eye.
    struct Sight {
        bool is_outside = false; // all of it is outside the picture or behind the horizon
        bool is_inside = false;  // all of it is within the picture's sides
        double distance_m = 0.0; // of its nearest point
        double diagonal_m = 0.0;
    };

    NodeSpace() = default;
    virtual ~NodeSpace() = default;
    NodeSpace(const NodeSpace&) = delete;
    NodeSpace& operator=(const NodeSpace&) = delete;

    virtual void setExaggeration(double exaggeration) = 0;

    /// `is_inside`: it is known to be, as a node around it is.
    virtual Sight sight(const DetailNode& node,
                        const Frustum& frustum,
                        const ScenePoint& eye,
                        bool is_inside) const = 0;
    /// Sight::is_outside alone.
    virtual bool isOutside(const DetailNode& node,
                           const Frustum& frustum,
                           const ScenePoint& eye,
                           bool is_inside) const = 0;
    /// A bound of its size. Fast: there are millions of nodes.
    virtual double diagonalM(const DetailNode& node) const = 0;
    /// The longer side of a cell of level 0.
    virtual double cellM() const = 0;

    /// How far the surface drawn with the samples of a level is from the true one, beside the
    /// error of its heights.
    virtual double sagM(std::size_t level) const = 0;
    /// The samples that are drawn.
    virtual std::size_t columns() const = 0;
    virtual std::size_t rows() const = 0;
    /// Whether the last column lies where the first one does.
    virtual bool closes() const = 0;
};

} // namespace marsview
