// The nodes of a map that lies on its body.
#pragma once

#include "core/base/oriented_box.h"
#include "core/body/body_grid.h"
#include "core/globe/horizon.h"
#include "core/terrain/surface_analysis.h"
#include "core/view/node_space.h"

#include <memory>
#include <optional>
#include <unordered_map>

namespace marsview {

/// Boxes in the direction of the ground. For one thread at a time, except diagonalM().
class BodyNodes final : public NodeSpace {
public:
    BodyNodes(std::shared_ptr<const SurfaceAnalysis> analysis,
              std::shared_ptr<const BodyGrid> grid);

    /// The height, not exaggerated, of the lowest terrain in the scene: by default that of the map.
    void setLowest(double lowest_m) { lowest_m_ = lowest_m; }
    /// The elevations, not exaggerated, that walls at the map's edges may reach; see map_walls.h.
    void setWalls(const HeightRange& reach) { walls_ = reach; }
    void setExaggeration(double exaggeration) override;
    Sight sight(const DetailNode& node,
                const Frustum& frustum,
                const ScenePoint& eye,
                bool is_inside) const override;
    bool isOutside(const DetailNode& node,
                   const Frustum& frustum,
                   const ScenePoint& eye,
                   bool is_inside) const override;
    double diagonalM(const DetailNode& node) const override;
    double cellM() const override { return grid_->stepMaxM(); }
    double sagM(std::size_t level) const override;
    std::size_t columns() const override { return grid_->columns(); }
    std::size_t rows() const override { return grid_->rows(); }
    bool closes() const override { return grid_->closes(); }

    /// Around all that is drawn of a node, at every level of detail. Its heights are not empty.
    OrientedBox boxOf(const DetailNode& node) const;

private:
    struct NodeHash {
        std::size_t operator()(const DetailNode& node) const noexcept;
    };

    using Boxes = std::unordered_map<DetailNode, OrientedBox, NodeHash>;

    const OrientedBox& keptBoxOf(const DetailNode& node) const;
    const OrientedBox& boxWithWalls(const DetailNode& node) const;
    OrientedBox boxOf(const DetailNode& node, const MinMaxPyramid::Bounds& bounds) const;
    MinMaxPyramid::Bounds heightsOf(const DetailNode& node) const;

    std::shared_ptr<const SurfaceAnalysis> analysis_;
    std::shared_ptr<const BodyGrid> grid_;
    double exaggeration_ = 1.0;
    double lowest_m_ = 0.0;
    double growth_ = 1.0; // of horizontal lengths at the highest terrain
    std::optional<HeightRange> walls_;
    mutable Boxes boxes_;            // for exaggeration_
    mutable Boxes boxes_with_walls_; // likewise, of nodes in which the map may end
};

} // namespace marsview
