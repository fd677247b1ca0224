#include "core/globe/body_nodes.h"

#include "core/globe/map_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace marsview {
namespace {

// Samples of a node along a side, from which its box is measured.
constexpr std::size_t kHullSide = 5;
// Between them the surface may lie outside their hull by an eighth of its second derivatives,
// which are estimated from differences: those are up to a quarter smaller.
constexpr double kBeyond = 1.5 / 8.0;

constexpr std::size_t kBoxesMax = 65536;

using Hull = std::array<std::array<ScenePoint, kHullSide>, kHullSide>;

// How far the surface may lie beyond the samples' hull.
double beyond(const Hull& hull)
{
    double across = 0.0;
    double down = 0.0;
    for (std::size_t i = 0; i < kHullSide; ++i) {
        for (std::size_t j = 1; j + 1 < kHullSide; ++j) {
            const auto second = [](const Vec3& a, const Vec3& b, const Vec3& c) {
                return length(a + c - b * 2.0);
            };
            across = std::max(across, second(hull[i][j - 1], hull[i][j], hull[i][j + 1]));
            down = std::max(down, second(hull[j - 1][i], hull[j][i], hull[j + 1][i]));
        }
    }
    return kBeyond * (across + down);
}

Vec3 squareTo(const Vec3& up)
{
    const Vec3 other = std::abs(up.x) < 0.5 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
    return normalized(cross(up, other));
}

} // namespace

BodyNodes::BodyNodes(std::shared_ptr<const SurfaceAnalysis> analysis,
                     std::shared_ptr<const BodyGrid> grid)
    : analysis_(std::move(analysis))
    , grid_(std::move(grid))
{
    const MinMaxPyramid& bounds = analysis_->bounds;
    lowest_m_ = static_cast<double>(bounds.bounds(bounds.levelCount() - 1, 0, 0).minimum_m);
    setExaggeration(1.0);
}

std::size_t BodyNodes::NodeHash::operator()(const DetailNode& node) const noexcept
{
    const std::uint64_t key = (static_cast<std::uint64_t>(node.level) << 58U) ^
                              (static_cast<std::uint64_t>(node.column) << 29U) ^ node.row;
    return static_cast<std::size_t>((key ^ (key >> 31U)) * 0x9E3779B97F4A7C15ULL);
}

void BodyNodes::setExaggeration(double exaggeration)
{
    exaggeration_ = exaggeration;
    boxes_.clear();
    boxes_with_walls_.clear();
    const MinMaxPyramid& bounds = analysis_->bounds;
    const auto all = bounds.bounds(bounds.levelCount() - 1, 0, 0);
    const double radius_m = std::min(grid_->ellipsoid().polar_m, grid_->ellipsoid().equatorial_m);
    growth_ = 1.0 + std::max(exaggeration * static_cast<double>(all.maximum_m), 0.0) / radius_m;
}

NodeSpace::Sight BodyNodes::sight(const DetailNode& node,
                                  const Frustum& frustum,
                                  const ScenePoint& eye,
                                  bool is_inside) const
{
    Sight sight{.is_outside = isOutside(node, frustum, eye, is_inside), .is_inside = is_inside};
    if (sight.is_outside) {
        return sight;
    }
    const OrientedBox& box = keptBoxOf(node);
    sight.is_inside = is_inside || frustum.isInside(box);
    sight.distance_m = box.distanceFrom(eye);
    sight.diagonal_m = box.diagonal_m();
    return sight;
}

bool BodyNodes::isOutside(const DetailNode& node,
                          const Frustum& frustum,
                          const ScenePoint& eye,
                          bool is_inside) const
{
    const OrientedBox& all = boxWithWalls(node);
    return (!is_inside && frustum.isOutside(all)) ||
           Horizon(grid_->ellipsoid(), exaggeration_ * lowest_m_).hides(all, eye);
}

double BodyNodes::diagonalM(const DetailNode& node) const
{
    const MinMaxPyramid::Bounds bounds = heightsOf(node);
    if (bounds.isEmpty()) {
        return 0.0;
    }
    const std::size_t side = DetailErrors::kNodeCells << node.level;
    const auto cells = [side](std::size_t index, std::size_t samples) {
        return static_cast<double>(std::min((index + 1) * side, samples - 1) - index * side);
    };
    const double ground_m = growth_ * grid_->diagonalMaxM(cells(node.column, grid_->columns()),
                                                          cells(node.row, grid_->rows()));
    const double height_m = exaggeration_ * (static_cast<double>(bounds.maximum_m) -
                                             static_cast<double>(bounds.minimum_m));
    return std::hypot(ground_m, height_m);
}

double BodyNodes::sagM(std::size_t level) const
{
    return level == 0 ? 0.0 : growth_ * grid_->sagM(static_cast<double>(std::size_t{1} << level));
}

// The last column may have the heights of the first one.
MinMaxPyramid::Bounds BodyNodes::heightsOf(const DetailNode& node) const
{
    const MinMaxPyramid& pyramid = analysis_->bounds;
    MinMaxPyramid::Bounds bounds = pyramid.bounds(node.level, node.column, node.row);
    if (grid_->closes() && node.column + 1 == pyramid.columns(node.level) && !bounds.isEmpty()) {
        const MinMaxPyramid::Bounds first = pyramid.bounds(node.level, 0, node.row);
        bounds.minimum_m = std::min(bounds.minimum_m, first.minimum_m);
        bounds.maximum_m = std::max(bounds.maximum_m, first.maximum_m);
    }
    return bounds;
}

const OrientedBox& BodyNodes::keptBoxOf(const DetailNode& node) const
{
    const auto known = boxes_.find(node);
    if (known != boxes_.end()) {
        return known->second;
    }
    if (boxes_.size() >= kBoxesMax) {
        boxes_.clear();
    }
    return boxes_.emplace(node, boxOf(node)).first->second;
}

const OrientedBox& BodyNodes::boxWithWalls(const DetailNode& node) const
{
    if (!walls_) {
        return keptBoxOf(node);
    }
    const auto known = boxes_with_walls_.find(node);
    if (known != boxes_with_walls_.end()) {
        return known->second;
    }
    if (boxes_with_walls_.size() >= kBoxesMax) {
        boxes_with_walls_.clear();
    }
    MinMaxPyramid::Bounds bounds = heightsOf(node);
    if (mayEnd(*grid_, analysis_->means, node)) {
        bounds.minimum_m = std::min(bounds.minimum_m, static_cast<float>(walls_->minimum_m));
        bounds.maximum_m = std::max(bounds.maximum_m, static_cast<float>(walls_->maximum_m));
    }
    return boxes_with_walls_.emplace(node, boxOf(node, bounds)).first->second;
}

OrientedBox BodyNodes::boxOf(const DetailNode& node) const
{
    return boxOf(node, heightsOf(node));
}

OrientedBox BodyNodes::boxOf(const DetailNode& node, const MinMaxPyramid::Bounds& bounds) const
{
    const std::array<double, 2> heights_m{static_cast<double>(bounds.minimum_m) * exaggeration_,
                                          static_cast<double>(bounds.maximum_m) * exaggeration_};
    const std::size_t side = DetailErrors::kNodeCells << node.level;
    const auto places = [side](std::size_t index, std::size_t samples) {
        const std::size_t first = index * side;
        const std::size_t last = std::min(first + side, samples - 1);
        std::array<std::size_t, kHullSide> all{};
        for (std::size_t i = 0; i < kHullSide; ++i) {
            all[i] = first + i * (last - first) / (kHullSide - 1);
        }
        return all;
    };
    const auto columns = places(node.column, grid_->columns());
    const auto rows = places(node.row, grid_->rows());
    const Vec3 up = grid_->normal(columns[kHullSide / 2], rows[kHullSide / 2]);
    const Vec3 across = grid_->at(columns.back(), rows[kHullSide / 2], 0.0) -
                        grid_->at(columns.front(), rows[kHullSide / 2], 0.0);
    const Vec3 level = across - up * dot(across, up);
    const double across_m = length(level);
    const Vec3 aside = across_m > 1e-6 * length(across) && across_m > 0.0 ? level * (1.0 / across_m)
                                                                          : squareTo(up);
    OrientedBox box{.center = grid_->at(columns[kHullSide / 2], rows[kHullSide / 2], heights_m[0]),
                    .axes = {aside, cross(up, aside), up}};
    std::array<double, 3> low{};
    std::array<double, 3> high{};
    const auto take = [&](const ScenePoint& p, double margin_m) {
        for (std::size_t axis = 0; axis < low.size(); ++axis) {
            const double along = dot(p - box.center, box.axes[axis]);
            low[axis] = std::min(low[axis], along - margin_m);
            high[axis] = std::max(high[axis], along + margin_m);
        }
    };
    for (const double height_m : heights_m) {
        Hull hull{};
        for (std::size_t j = 0; j < kHullSide; ++j) {
            for (std::size_t i = 0; i < kHullSide; ++i) {
                hull[j][i] = grid_->at(columns[i], rows[j], height_m);
            }
        }
        const double margin_m = beyond(hull);
        for (const auto& line : hull) {
            for (const ScenePoint& p : line) {
                take(p, margin_m);
            }
        }
    }
    // A pole has the mean height of a row, which other nodes contain too.
    const MinMaxPyramid& pyramid = analysis_->bounds;
    const auto all = pyramid.bounds(pyramid.levelCount() - 1, 0, 0);
    const auto take_pole = [&](BodyGrid::Pole pole) {
        if (pole != BodyGrid::Pole::None) {
            take(grid_->atPole(pole, exaggeration_ * static_cast<double>(all.minimum_m)), 0.0);
            take(grid_->atPole(pole, exaggeration_ * static_cast<double>(all.maximum_m)), 0.0);
        }
    };
    if (node.row == 0) {
        take_pole(grid_->poleAtFirstRow());
    }
    if (node.row + 1 == analysis_->errors.rows(node.level)) {
        take_pole(grid_->poleAtLastRow());
    }
    Vec3 middle{};
    for (std::size_t axis = 0; axis < low.size(); ++axis) {
        middle = middle + box.axes[axis] * (0.5 * (low[axis] + high[axis]));
        box.half_m[axis] = 0.5 * (high[axis] - low[axis]);
    }
    box.center = box.center + middle;
    return box;
}

} // namespace marsview
