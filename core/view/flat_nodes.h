// The nodes of a map that is laid out in the plane.
#pragma once

#include "core/geo/scene_frame.h"
#include "core/terrain/surface_analysis.h"
#include "core/view/node_space.h"

#include <memory>

namespace marsview {

/// Boxes along the axes of the scene.
class FlatNodes final : public NodeSpace {
public:
    FlatNodes(std::shared_ptr<const SurfaceAnalysis> analysis,
              std::size_t columns,
              std::size_t rows,
              const SceneFrame& frame);

    void setExaggeration(double exaggeration) override { exaggeration_ = exaggeration; }
    Sight sight(const DetailNode& node,
                const Frustum& frustum,
                const ScenePoint& eye,
                bool is_inside) const override;
    bool isOutside(const DetailNode& node,
                   const Frustum& frustum,
                   const ScenePoint& eye,
                   bool is_inside) const override;
    double diagonalM(const DetailNode& node) const override;
    double cellM() const override { return cell_m_; }
    double sagM(std::size_t /*level*/) const override { return 0.0; }
    std::size_t columns() const override { return columns_; }
    std::size_t rows() const override { return rows_; }
    bool closes() const override { return false; }

private:
    SceneBox boxOf(const DetailNode& node) const;

    std::shared_ptr<const SurfaceAnalysis> analysis_;
    std::size_t columns_;
    std::size_t rows_;
    SceneFrame frame_;
    double cell_m_ = 1.0;
    double exaggeration_ = 1.0;
};

} // namespace marsview
