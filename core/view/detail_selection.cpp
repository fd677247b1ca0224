#include "core/view/detail_selection.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/view/flat_nodes.h"
#include "core/view/frustum.h"

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

// Range of nonexistent levels: beyond every distance. Finite, because it is multiplied by 0.
constexpr float kNever = 1e30F;

// The graphics driver recomputes distances as floats.
constexpr double kRounding = 1.0001;

// Cells along a side of a quadrant.
constexpr std::size_t kHalf = DetailErrors::kNodeCells / 2;

// Rows of nodes that a thread takes at once.
constexpr std::size_t kRangeRows = 64;

DetailNode ancestor(const DetailNode& node, std::size_t level)
{
    const std::size_t up = level - node.level;
    return {level, node.column >> up, node.row >> up};
}

// A value for each node of a level, row by row.
struct NodeValues {
    NodeValues() = default;
    NodeValues(std::size_t column_count, std::size_t row_count)
        : columns(column_count)
        , rows(row_count)
        , values(column_count * row_count)
    {}

    std::size_t columns = 0;
    std::size_t rows = 0;
    LargeVector<float> values;
};

// Of the next level: the largest of each node's children. Empty for an empty input.
NodeValues largestOfFour(const NodeValues& finer)
{
    NodeValues coarser((finer.columns + 1) / 2, (finer.rows + 1) / 2);
    std::fill(coarser.values.begin(), coarser.values.end(), 0.0F);
    for (std::size_t row = 0; row < finer.rows; ++row) {
        const float* from = finer.values.data() + row * finer.columns;
        float* to = coarser.values.data() + row / 2 * coarser.columns;
        for (std::size_t column = 0; column < finer.columns; ++column) {
            to[column / 2] = std::max(to[column / 2], from[column]);
        }
    }
    return coarser;
}

} // namespace

// The constants of one selection.
struct DetailSelector::Pass {
    ScenePoint eye;
    Frustum frustum;
    DetailTarget target;
    double pixels = 1.0;          // width of a meter across the view at a distance of one meter
    double range_per_error = 1.0; // meters per meter
    double range_per_sag = 1.0;   // likewise, of errors that exaggeration does not raise
    const SizeRanges& size_ranges_m;
    DetailSelection selection;
};

DetailSelector::DetailSelector(std::shared_ptr<const SurfaceAnalysis> analysis,
                               std::size_t columns,
                               std::size_t rows,
                               const SceneFrame& frame)
    : DetailSelector(analysis, std::make_unique<FlatNodes>(analysis, columns, rows, frame))
{}

DetailSelector::DetailSelector(std::shared_ptr<const SurfaceAnalysis> analysis,
                               std::unique_ptr<NodeSpace> space)
    : analysis_(std::move(analysis))
    , space_(std::move(space))
{}

DetailSelection DetailSelector::select(const DetailView& view, const DetailTarget& target)
{
    MARSVIEW_CHECK(target.error_px > 0.0 && target.texel_px > 0.0 && view.exaggeration > 0.0);
    if (view.exaggeration != exaggeration_) {
        exaggeration_ = view.exaggeration;
        space_->setExaggeration(exaggeration_);
        at_rest_m_.clear();
        moving_m_.clear();
    }
    const CameraPose pose = view.pose ? *view.pose : CameraPose(view.camera);
    const double pixels =
        view.viewport.height / (2.0 * std::tan(pose.field_of_view.radians() / 2.0));
    Pass pass{.eye = pose.eye,
              .frustum = view.part ? Frustum(pose, view.viewport, *view.part)
                                   : Frustum(pose, view.viewport),
              .target = target,
              .pixels = pixels,
              .range_per_error = pixels * view.exaggeration / target.error_px,
              .range_per_sag = pixels / target.error_px,
              .size_ranges_m = sizeRangesFor(target),
              .selection = {}};
    const std::size_t top = analysis_->errors.levelCount() - 1;
    SelectedNode selected;
    visit({top, 0, 0}, {}, selected, pass);
    std::sort(
        pass.selection.nodes.begin(), pass.selection.nodes.end(),
        [](const SelectedNode& a, const SelectedNode& b) { return a.distance_m < b.distance_m; });
    return std::move(pass.selection);
}

// `selected` has the relief found so far on the way down.
void DetailSelector::visit(const DetailNode& node,
                           Above above,
                           SelectedNode& selected,
                           Pass& pass) const
{
    if (analysis_->bounds.bounds(node.level, node.column, node.row).isEmpty()) {
        return;
    }
    const NodeSpace::Sight sight = space_->sight(node, pass.frustum, pass.eye, above.is_inside);
    if (sight.is_outside) {
        return;
    }
    above.is_inside = sight.is_inside;
    const double distance_m = sight.distance_m;
    if (!above.has_relief) {
        const double side_m =
            space_->cellM() * static_cast<double>(DetailErrors::kNodeCells << node.level);
        const double texel_m = side_m / static_cast<double>(kReliefTexels);
        above.has_relief = node.level <= kReliefLevelMin ||
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
                visit({level, column, row}, above, selected, pass);
            }
        }
        return;
    }
    selected.node = node;
    selected.quadrants = quadrantsIn(pass, node, above.is_inside);
    if (selected.quadrants == 0) {
        return;
    }
    selected.distance_m = distance_m;
    selected.parent_ranges_m = {kNever, kNever, kNever, kNever};
    selected.grandparent_ranges_m = selected.parent_ranges_m;
    // The error of a level seen from `nearest_m` or farther.
    const auto seen_error = [&](const DetailNode& seen, double nearest_m) {
        const double error_m = static_cast<double>(analysis_->errors.nodeError(seen));
        const double sag_m = space_->sagM(seen.level);
        return (error_m > 0.0 ? pass.range_per_error * pass.target.error_px * error_m / nearest_m
                              : 0.0) +
               (sag_m > 0.0 ? pass.range_per_sag * pass.target.error_px * sag_m / nearest_m : 0.0);
    };
    double error_px = seen_error(node, distance_m);
    if (!pass.target.has_every_sample) {
        const double furthest_m = distance_m + sight.diagonal_m;
        // The ranges of a coarser level, if there is one, to which parts of the node may morph.
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
    selection.triangle_count += triangleCount(selected);
}

// Quadrants have the terrain of the nodes one level down: a quadrant is drawn from samples of
// these, even where its vertices have morphed to a coarser level.
std::uint8_t
DetailSelector::quadrantsIn(const Pass& pass, const DetailNode& node, bool is_inside) const
{
    if (node.level == 0) {
        return kAllQuadrants;
    }
    const std::size_t level = node.level - 1;
    unsigned quadrants = 0;
    for (std::size_t i = 0; i < kQuadrantCount; ++i) {
        const DetailNode below{level, 2 * node.column + i % 2, 2 * node.row + i / 2};
        const bool is_there = below.column < analysis_->errors.columns(level) &&
                              below.row < analysis_->errors.rows(level) &&
                              !analysis_->bounds.bounds(level, below.column, below.row).isEmpty() &&
                              !space_->isOutside(below, pass.frustum, pass.eye, is_inside);
        quadrants |= is_there ? 1U << i : 0U;
    }
    return static_cast<std::uint8_t>(quadrants);
}

// Counts cells with an area.
std::size_t DetailSelector::triangleCount(const SelectedNode& selected) const
{
    const std::size_t level = selected.node.level;
    const auto cells = [level](std::size_t samples, std::size_t index, std::size_t half) {
        const std::size_t first = (index * DetailErrors::kNodeCells + half * kHalf) << level;
        if (first >= samples - 1) {
            return std::size_t{0};
        }
        return std::min(kHalf, ((samples - 1 - first) + (std::size_t{1} << level) - 1) >> level);
    };
    std::size_t count = 0;
    for (std::size_t i = 0; i < kQuadrantCount; ++i) {
        if ((selected.quadrants >> i & 1U) != 0) {
            count += 2 * cells(space_->columns(), selected.node.column, i % 2) *
                     cells(space_->rows(), selected.node.row, i / 2);
        }
    }
    return count;
}

// Where a map closes around its body, both of its ends have the same ranges.
float DetailSelector::rangeAt(std::size_t level,
                              std::size_t column,
                              std::size_t row,
                              const Pass& pass) const
{
    const float own = ownRangeAt(level, column, row, pass);
    const std::size_t last = analysis_->errors.columns(level);
    return space_->closes() && (column == 0 || column == last)
               ? std::max(own, ownRangeAt(level, last - column, row, pass))
               : own;
}

float DetailSelector::ownRangeAt(std::size_t level,
                                 std::size_t column,
                                 std::size_t row,
                                 const Pass& pass) const
{
    const CornerGrid& sizes = pass.size_ranges_m[level];
    const float by_size = sizes.values[row * (sizes.columns + 1) + column];
    const double error_m = static_cast<double>(analysis_->errors.cornerError(level, column, row));
    const auto by_error = static_cast<float>(
        std::min(pass.range_per_error * error_m + pass.range_per_sag * space_->sagM(level),
                 static_cast<double>(kNever)));
    float by_relief = 0.0F;
    if (level > kReliefLevelMin) {
        const double texel_m = space_->cellM() *
                               static_cast<double>(DetailErrors::kNodeCells << level) /
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

// Computed on first use: for millions of nodes this takes part of the time to the first picture.
const DetailSelector::SizeRanges& DetailSelector::sizeRangesFor(const DetailTarget& target)
{
    const bool is_moving = target.error_px > kErrorPxAtRest;
    SizeRanges& ranges_m = is_moving ? moving_m_ : at_rest_m_;
    if (ranges_m.empty()) {
        ranges_m = sizeRanges(is_moving ? kRangePerSizeMoving : kRangePerSize);
    }
    return ranges_m;
}

// Ranges determined by the size of the nodes, including their heights.
DetailSelector::SizeRanges DetailSelector::sizeRanges(double range_per_size) const
{
    const DetailErrors& errors = analysis_->errors;
    SizeRanges ranges_m(errors.levelCount());
    NodeValues child_diagonals;      // the largest of a node's children, for the previous level
    NodeValues grandchild_diagonals; // and of its grandchildren
    for (std::size_t level = 1; level < errors.levelCount(); ++level) {
        NodeValues diagonals(errors.columns(level), errors.rows(level));
        NodeValues ranges(diagonals.columns, diagonals.rows);
        parallelRanges(ranges.rows, kRangeRows, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin * ranges.columns; i < end * ranges.columns; ++i) {
                const DetailNode node{level, i % ranges.columns, i / ranges.columns};
                const double diagonal = space_->diagonalM(node);
                diagonals.values[i] = static_cast<float>(diagonal);
                ranges.values[i] = static_cast<float>(range_per_size * diagonal);
                if (!grandchild_diagonals.values.empty()) {
                    const auto below = static_cast<double>(grandchild_diagonals.values[i]);
                    ranges.values[i] =
                        std::max(ranges.values[i], static_cast<float>(kRangeTwoBelow * below));
                }
            }
        });
        ranges_m[level] = largestAtCorners(ranges.columns, ranges.rows, ranges.values);
        if (level > 1) {
            growCorners(ranges_m[level - 1], ranges_m[level]);
        }
        grandchild_diagonals = largestOfFour(child_diagonals);
        child_diagonals = largestOfFour(diagonals);
    }
    return ranges_m;
}

} // namespace marsview
