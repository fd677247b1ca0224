#include "core/contact/goal_frame.h"

#include <cmath>
#include <utility>

namespace marsview {

GoalFrame::GoalFrame(std::shared_ptr<const Georeference> georeference, double exaggeration)
    : georeference_(std::move(georeference))
    , frame_(georeference_->sceneFrame())
    , exaggeration_(exaggeration)
{}

GoalFrame::GoalFrame(std::shared_ptr<const Georeference> georeference,
                     const SceneFrame& frame,
                     double exaggeration)
    : georeference_(std::move(georeference))
    , frame_(frame)
    , exaggeration_(exaggeration)
{}

ScenePoint GoalFrame::toScene(const TracePoint& goal) const noexcept
{
    return frame_.toScene(georeference_->toGrid(MapPoint{goal.x, goal.y}), goal.z * exaggeration_);
}

TracePoint GoalFrame::fromScene(const ScenePoint& point) const noexcept
{
    GridPoint grid = frame_.toGrid(point);
    // At a sample, use its exact position, without the rounding error of the conversion.
    const GridPoint sample{std::round(grid.column), std::round(grid.row)};
    constexpr double kRounding = 1e-9; // columns and rows
    if (std::abs(sample.column - grid.column) < kRounding &&
        std::abs(sample.row - grid.row) < kRounding) {
        grid = sample;
    }
    const MapPoint map = georeference_->toMap(grid);
    return {map.x, map.y, point.z / exaggeration_};
}

bool GoalFrame::isClamped(const TracePoint& goal) const noexcept
{
    const GridPoint grid = georeference_->toGrid(MapPoint{goal.x, goal.y});
    return !(grid.column >= 0.0 && grid.row >= 0.0 &&
             grid.column <= static_cast<double>(georeference_->columns() - 1) &&
             grid.row <= static_cast<double>(georeference_->rows() - 1));
}

} // namespace marsview
