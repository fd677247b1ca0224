#include "core/body/tiled_body_mesh.h"

#include "core/base/check.h"

#include <utility>
#include <vector>

namespace marsview {

TiledBodyMesh::TiledBodyMesh(std::shared_ptr<const BodyGrid> grid,
                             const std::shared_ptr<const TileHeights>& heights,
                             double exaggeration,
                             std::size_t leaves_max)
    : grid_(std::move(grid))
    , locator_(std::make_shared<const BodyLocator>(grid_))
    , shape_({grid_, &grid_->positions()}, heights->scale(), exaggeration)
{
    shape_.nodes_ =
        std::make_shared<const TiledBodyNodes>(grid_, heights, exaggeration, leaves_max);
    shape_.highest_m_ = shape_.nodes_->highest();
    shape_.cell_leaves_ = shape_.nodes_->leafCount();
    shape_.tile_type_ = heights->layout().type;
}

Result<std::shared_ptr<const TiledBodyMesh>>
TiledBodyMesh::build(std::shared_ptr<const BodyGrid> grid,
                     std::shared_ptr<const TileHeights> heights,
                     double exaggeration,
                     JobMonitor& monitor,
                     std::size_t leaves_max)
{
    std::shared_ptr<TiledBodyMesh> mesh(
        new TiledBodyMesh(std::move(grid), heights, exaggeration, leaves_max));
    if (Status built = mesh->buildTree(monitor); !built) {
        return std::move(built).error();
    }
    return std::shared_ptr<const TiledBodyMesh>(std::move(mesh));
}

Status TiledBodyMesh::buildTree(JobMonitor& monitor)
{
    const TiledBodyNodes& nodes = *shape_.nodes_;
    const auto cap_faces = static_cast<std::uint32_t>(shape_.face_count_ - shape_.firstCapFace());
    const std::uint32_t cap_leaves = (cap_faces + BodyMesh::kCapFaces - 1) / BodyMesh::kCapFaces;
    std::vector<TriangleTree::Bounds> bounds(nodes.leafCount() + cap_leaves);
    for (std::uint32_t leaf = 0; leaf < bounds.size(); ++leaf) {
        constexpr std::uint32_t kLeavesPerReport = 1024;
        if (leaf % kLeavesPerReport == 0) {
            monitor.report(static_cast<double>(leaf) / static_cast<double>(bounds.size()));
            if (monitor.isCanceled()) {
                return Error{ErrorCode::Canceled, "laying the map on its body was canceled"};
            }
        }
        bounds[leaf] = leaf < nodes.leafCount() ? nodes.bounds(leaf) : shape_.capBounds(leaf);
    }
    shape_.tree_ = std::make_shared<const TriangleTree>(bounds);
    return Done{};
}

std::shared_ptr<const BodyMesh> TiledBodyMesh::over(std::shared_ptr<const TiledTerrain> terrain,
                                                    std::shared_ptr<const PinnedSamples> pins) const
{
    MARSVIEW_CHECK(terrain && terrain->heights().layout().columns ==
                                  shape_.nodes_->heights().layout().columns);
    auto mesh = std::make_shared<BodyMesh>(shape_);
    mesh->terrain_ = std::move(terrain);
    mesh->pins_ = std::move(pins);
    return mesh;
}

} // namespace marsview
