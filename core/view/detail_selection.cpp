#include "core/view/detail_selection.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/view/frustum.h"

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

// For levels that there are not: nothing is ever that far away. Finite, as it is multiplied by 0.
constexpr float kNever = 1e30F;

// Distances are taken again in the graphics driver, as floats.
constexpr double kRounding = 1.0001;

// Rows of nodes that a thread takes at once.
constexpr std::size_t kRangeRows = 64;

double distance(const ScenePoint& eye, const SceneBox& box)
{
    const auto outside = [](double p, double low, double high) {
        return std::max({low - p, p - high, 0.0});
    };
    return length({outside(eye.x, box.minimum.x, box.maximum.x),
                   outside(eye.y, box.minimum.y, box.maximum.y),
                   outside(eye.z, box.minimum.z, box.maximum.z)});
}

DetailNode ancestor(const DetailNode& node, std::size_t level)
{
    const std::size_t up = level - node.level;
    return {level, node.column >> up, node.row >> up};
}

} // namespace

// What stays the same during one selection.
struct DetailSelector::Pass {
    ScenePoint eye;
    Frustum frustum;
    DetailTarget target;
    double pixels = 1.0;          // that a metre across the view is wide at one metre's distance
    double range_per_error = 1.0; // metres a metre
    DetailSelection selection;
};

DetailSelector::DetailSelector(std::shared_ptr<const SurfaceAnalysis> analysis,
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

DetailSelection DetailSelector::select(const DetailView& view, const DetailTarget& target)
{
    MARSVIEW_CHECK(target.error_px > 0.0 && target.texel_px > 0.0 && view.exaggeration > 0.0);
    if (view.exaggeration != exaggeration_) {
        setExaggeration(view.exaggeration);
    }
    const double pixels =
        view.viewport.height / (2.0 * std::tan(view.camera.field_of_view.radians() / 2.0));
    Pass pass{.eye = eyeOf(view.camera),
              .frustum = {view.camera, view.viewport},
              .target = target,
              .pixels = pixels,
              .range_per_error = pixels * view.exaggeration / target.error_px,
              .selection = {}};
    const std::size_t top = analysis_->errors.levelCount() - 1;
    SelectedNode selected;
    visit({top, 0, 0}, false, selected, pass);
    std::sort(
        pass.selection.nodes.begin(), pass.selection.nodes.end(),
        [](const SelectedNode& a, const SelectedNode& b) { return a.distance_m < b.distance_m; });
    return std::move(pass.selection);
}

// `selected` carries the relief that was found on the way down.
void DetailSelector::visit(const DetailNode& node,
                           bool has_relief,
                           SelectedNode& selected,
                           Pass& pass) const
{
    if (analysis_->bounds.bounds(node.level, node.column, node.row).isEmpty()) {
        return;
    }
    const SceneBox box = boxOf(node);
    if (pass.frustum.isOutside(box)) {
        return;
    }
    const double distance_m = distance(pass.eye, box);
    if (!has_relief) {
        const double side_m = cell_m_ * static_cast<double>(DetailErrors::kNodeCells << node.level);
        const double texel_m = side_m / static_cast<double>(kReliefTexels);
        has_relief = node.level <= kReliefLevelMin ||
                     pass.pixels * texel_m <= pass.target.texel_px * distance_m;
        selected.relief = node.level >= kReliefLevelMin ? node : ancestor(node, kReliefLevelMin);
    }
    bool is_drawn = node.level == 0;
    if (!is_drawn && !pass.target.has_every_sample) {
        const CornerRanges ranges = rangesOf(node, pass);
        const auto furthest = static_cast<double>(*std::max_element(ranges.begin(), ranges.end()));
        is_drawn = distance_m >= kMorphEnd * kRounding * furthest;
    }
    if (!is_drawn) {
        const std::size_t level = node.level - 1;
        for (std::size_t row = 2 * node.row;
             row < std::min(2 * node.row + 2, analysis_->errors.rows(level)); ++row) {
            for (std::size_t column = 2 * node.column;
                 column < std::min(2 * node.column + 2, analysis_->errors.columns(level));
                 ++column) {
                visit({level, column, row}, has_relief, selected, pass);
            }
        }
        return;
    }
    selected.node = node;
    selected.distance_m = distance_m;
    selected.parent_ranges_m = {kNever, kNever, kNever, kNever};
    selected.grandparent_ranges_m = selected.parent_ranges_m;
    // What a level is off by that is seen from `nearest_m` on.
    const auto seen_error = [&](const DetailNode& seen, double nearest_m) {
        const double error_m = static_cast<double>(analysis_->errors.nodeError(seen));
        return error_m > 0.0 ? pass.range_per_error * pass.target.error_px * error_m / nearest_m
                             : 0.0;
    };
    double error_px = seen_error(node, distance_m);
    if (!pass.target.has_every_sample) {
        const double furthest_m = distance_m + length(box.maximum - box.minimum);
        // The ranges of a level around, if there is one, to which parts of the node may give way.
        const auto give_way = [&](std::size_t level, CornerRanges& ranges_m) {
            if (level >= analysis_->errors.levelCount()) {
                return;
            }
            const DetailNode around = ancestor(node, level);
            ranges_m = rangesOf(around, pass);
            const auto nearest_m =
                static_cast<double>(*std::min_element(ranges_m.begin(), ranges_m.end()));
            if (furthest_m > nearest_m) {
                error_px = std::max(error_px, seen_error(around, std::max(nearest_m, distance_m)));
            }
        };
        give_way(node.level + 1, selected.parent_ranges_m);
        give_way(node.level + 2, selected.grandparent_ranges_m);
    }
    DetailSelection& selection = pass.selection;
    selection.nodes.push_back(selected);
    selection.error_px = std::max(selection.error_px, std::min(error_px, pass.target.error_px));
    const auto cells = [&](std::size_t samples, std::size_t index) {
        const std::size_t first = index * (DetailErrors::kNodeCells << node.level);
        const std::size_t left =
            ((samples - 1 - first) + (std::size_t{1} << node.level) - 1) >> node.level;
        return std::min(DetailErrors::kNodeCells, left);
    };
    selection.triangle_count += 2 * cells(columns_, node.column) * cells(rows_, node.row);
}

SceneBox DetailSelector::boxOf(const DetailNode& node) const
{
    const MinMaxPyramid::Bounds& bounds =
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

// Of boxOf(node), without making it: there are millions of nodes.
double DetailSelector::diagonalOf(const DetailNode& node) const
{
    const MinMaxPyramid::Bounds& bounds =
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

float DetailSelector::rangeAt(std::size_t level,
                              std::size_t column,
                              std::size_t row,
                              const Pass& pass) const
{
    const CornerGrid& sizes = size_ranges_m_[level];
    const float by_size = sizes.values[row * (sizes.columns + 1) + column];
    const double error_m = static_cast<double>(analysis_->errors.cornerError(level, column, row));
    const auto by_error =
        static_cast<float>(std::min(pass.range_per_error * error_m, static_cast<double>(kNever)));
    float by_relief = 0.0F;
    if (level > kReliefLevelMin) {
        const double texel_m = cell_m_ * static_cast<double>(DetailErrors::kNodeCells << level) /
                               static_cast<double>(kReliefTexels);
        by_relief = static_cast<float>(pass.pixels * texel_m / (pass.target.texel_px * kMorphEnd));
    }
    return std::max({by_size, by_error, by_relief});
}

CornerRanges DetailSelector::rangesOf(const DetailNode& node, const Pass& pass) const
{
    return {rangeAt(node.level, node.column, node.row, pass),
            rangeAt(node.level, node.column + 1, node.row, pass),
            rangeAt(node.level, node.column, node.row + 1, pass),
            rangeAt(node.level, node.column + 1, node.row + 1, pass)};
}

// Ranges that follow from the size of the nodes, heights included.
void DetailSelector::setExaggeration(double exaggeration)
{
    exaggeration_ = exaggeration;
    const DetailErrors& errors = analysis_->errors;
    size_ranges_m_.assign(errors.levelCount(), {});
    for (std::size_t level = 1; level < errors.levelCount(); ++level) {
        const std::size_t columns = errors.columns(level);
        const std::size_t rows = errors.rows(level);
        LargeVector<float> ranges_m(columns * rows);
        parallelRanges(rows, kRangeRows, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin * columns; i < end * columns; ++i) {
                const DetailNode node{level, i % columns, i / columns};
                ranges_m[i] = static_cast<float>(kRangePerSize * diagonalOf(node));
            }
        });
        size_ranges_m_[level] = largestAtCorners(columns, rows, ranges_m);
        if (level > 1) {
            growCorners(size_ranges_m_[level - 1], size_ranges_m_[level]);
        }
    }
}

} // namespace marsview
