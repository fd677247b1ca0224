#include "core/view/flat_nodes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

double distance(const ScenePoint& eye, const SceneBox& box)
{
    const auto outside = [](double p, double low, double high) {
        return std::max({low - p, p - high, 0.0});
    };
    return length({outside(eye.x, box.minimum.x, box.maximum.x),
                   outside(eye.y, box.minimum.y, box.maximum.y),
                   outside(eye.z, box.minimum.z, box.maximum.z)});
}

} // namespace

FlatNodes::FlatNodes(std::shared_ptr<const SurfaceAnalysis> analysis,
                     std::size_t columns,
                     std::size_t rows,
                     const SceneFrame& frame)
    : analysis_(std::move(analysis))
    , columns_(columns)
    , rows_(rows)
    , frame_(frame)
    , cell_m_(std::max(std::hypot(frame.east_per_column, frame.north_per_column),
                       std::hypot(frame.east_per_row, frame.north_per_row)))
{}

NodeSpace::Sight FlatNodes::sight(const DetailNode& node,
                                  const Frustum& frustum,
                                  const ScenePoint& eye,
                                  bool is_inside) const
{
    const SceneBox box = boxOf(node);
    Sight sight{.is_inside = is_inside};
    if (!is_inside) {
        sight.is_outside = frustum.isOutside(box);
        if (sight.is_outside) {
            return sight;
        }
        sight.is_inside = frustum.isInside(box);
    }
    sight.distance_m = distance(eye, box);
    sight.diagonal_m = length(box.maximum - box.minimum);
    return sight;
}

bool FlatNodes::isOutside(const DetailNode& node,
                          const Frustum& frustum,
                          const ScenePoint& /*eye*/,
                          bool is_inside) const
{
    return !is_inside && frustum.isOutside(boxOf(node));
}

SceneBox FlatNodes::boxOf(const DetailNode& node) const
{
    const MinMaxPyramid::Bounds bounds =
        analysis_->bounds.bounds(node.level, node.column, node.row);
    const double low = static_cast<double>(bounds.minimum_m) * exaggeration_;
    const double high = static_cast<double>(bounds.maximum_m) * exaggeration_;
    const std::size_t side = DetailErrors::kNodeCells << node.level;
    const GridPoint first{static_cast<double>(node.column * side),
                          static_cast<double>(node.row * side)};
    const GridPoint last{static_cast<double>(std::min((node.column + 1) * side, columns_ - 1)),
                         static_cast<double>(std::min((node.row + 1) * side, rows_ - 1))};
    SceneBox box{frame_.toScene(first, low), frame_.toScene(first, high)};
    for (const GridPoint corner :
         {last, GridPoint{first.column, last.row}, GridPoint{last.column, first.row}}) {
        const ScenePoint p = frame_.toScene(corner, low);
        box.minimum.x = std::min(box.minimum.x, p.x);
        box.minimum.y = std::min(box.minimum.y, p.y);
        box.maximum.x = std::max(box.maximum.x, p.x);
        box.maximum.y = std::max(box.maximum.y, p.y);
    }
    return box;
}

// The diagonal of boxOf(node), without constructing the box: there are millions of nodes.
double FlatNodes::diagonalM(const DetailNode& node) const
{
    const MinMaxPyramid::Bounds bounds =
        analysis_->bounds.bounds(node.level, node.column, node.row);
    if (bounds.isEmpty()) {
        return 0.0;
    }
    const std::size_t side = DetailErrors::kNodeCells << node.level;
    const auto width =
        static_cast<double>(std::min((node.column + 1) * side, columns_ - 1) - node.column * side);
    const auto height =
        static_cast<double>(std::min((node.row + 1) * side, rows_ - 1) - node.row * side);
    return length(
        {std::abs(frame_.east_per_column) * width + std::abs(frame_.east_per_row) * height,
         std::abs(frame_.north_per_column) * width + std::abs(frame_.north_per_row) * height,
         (static_cast<double>(bounds.maximum_m) - static_cast<double>(bounds.minimum_m)) *
             exaggeration_});
}

} // namespace marsview
