#include "core/body/tiled_body_nodes.h"

#include "core/base/check.h"

#include <cmath>
#include <utility>

namespace marsview {

TiledBodyNodes::TiledBodyNodes(std::shared_ptr<const BodyGrid> grid,
                               std::shared_ptr<const TileHeights> heights,
                               double exaggeration,
                               std::size_t leaves_max)
    : grid_(std::move(grid))
    , heights_(std::move(heights))
    , exaggeration_(exaggeration)
    , last_column_(static_cast<std::uint32_t>(grid_->positions().columns() - 1))
    , first_row_(static_cast<std::uint32_t>(grid_->positions().firstRow()))
    , last_row_(first_row_ + static_cast<std::uint32_t>(grid_->positions().rows() - 1))
{
    const TileLayout& layout = heights_->layout();
    MARSVIEW_CHECK(last_column_ < layout.columns && last_row_ < layout.rows);
    HeightRange range = heights_->range();
    const double highest_m = heights_->maximum(heights_->levelCount() - 1, 0, 0);
    constexpr double kKnownM = 1e12;
    if (highest_m < kKnownM) {
        range.maximum_m = highest_m;
    } else { // of an estimated analysis
        const double spread_m = range.maximum_m - range.minimum_m;
        range = {range.minimum_m - spread_m, range.maximum_m + spread_m};
    }
    low_m_ = exaggeration * range.minimum_m;
    high_m_ = exaggeration * range.maximum_m;
    // A patch of a smooth surface lies beyond the hull of its corners by at most an eighth of its
    // second derivatives, which grow with the height over the ellipsoid.
    constexpr double kMargin = 1.25;
    const Ellipsoid& body = grid_->ellipsoid();
    beyond_per_sag_ = kMargin * (1.0 + std::max(std::abs(low_m_), std::abs(high_m_)) /
                                           std::min(body.equatorial_m, body.polar_m));
    const auto count = [](std::uint32_t cells, std::uint32_t side) {
        return (cells + side - 1) / side;
    };
    const auto leaves = [&](unsigned scale) {
        return std::size_t{count(last_column_, sideOf(scale))} * count(last_row_, sideOf(scale));
    };
    while (leaves(leaf_scale_) > leaves_max) {
        ++leaf_scale_;
    }
    leaf_columns_ = count(last_column_, sideOf(leaf_scale_));
    node_leaves_ = static_cast<std::uint32_t>(leaves(leaf_scale_));
    strips_ = grid_->positions().wraps() ? count(last_row_, sideOf(kBoundedScale)) : 0;
}

TiledBodyNodes::Node TiledBodyNodes::leafNode(std::uint32_t leaf) const noexcept
{
    const std::uint32_t side = sideOf(leaf_scale_);
    return {leaf % leaf_columns_ * side, leaf / leaf_columns_ * side, leaf_scale_};
}

TiledBodyNodes::Cells TiledBodyNodes::stripOf(std::uint32_t leaf) const noexcept
{
    const std::uint32_t begin = (leaf - node_leaves_) * sideOf(kBoundedScale);
    const std::uint32_t end = std::min(begin + sideOf(kBoundedScale), last_row_);
    const std::uint32_t row = std::max(begin, first_row_);
    return {last_column_, row - first_row_, 1, end - row};
}

double
TiledBodyNodes::maximum(unsigned scale, std::uint32_t column, std::uint32_t row) const noexcept
{
    const unsigned shift = scale + 2;
    static_assert(kBlockCells == 1U << 2U);
    return std::min(exaggeration_ *
                        heights_->maximum(scale - kBoundedScale, column >> shift, row >> shift),
                    high_m_);
}

double TiledBodyNodes::stripMaximum(const Cells& strip) const noexcept
{
    const TileLayout& layout = heights_->layout();
    const auto last =
        static_cast<std::uint32_t>(std::min<std::size_t>(last_column_, layout.columns - 2));
    const std::uint32_t row = strip.row + first_row_;
    return std::max(maximum(kBoundedScale, last, row), maximum(kBoundedScale, 0, row));
}

TriangleTree::Bounds TiledBodyNodes::boundsOf(std::array<std::uint32_t, 2> columns,
                                              std::array<std::uint32_t, 2> rows,
                                              double high_m,
                                              std::uint32_t cells) const noexcept
{
    const double beyond = beyondHull(cells);
    const Vec3 around{beyond, beyond, beyond};
    TriangleTree::Bounds bounds;
    for (const std::uint32_t column : columns) {
        for (const std::uint32_t row : rows) {
            for (const double height_m : {low_m_, high_m}) {
                const ScenePoint point = pointAt(column, row, height_m);
                bounds.add(point - around);
                bounds.add(point + around);
            }
        }
    }
    return bounds;
}

TriangleTree::Bounds TiledBodyNodes::bounds(std::uint32_t leaf) const noexcept
{
    if (leaf >= node_leaves_) {
        const Cells strip = stripOf(leaf);
        const std::uint32_t row = strip.row + first_row_;
        return boundsOf({last_column_, 0}, {row, row + strip.rows}, stripMaximum(strip),
                        sideOf(kBoundedScale));
    }
    const Node node = leafNode(leaf);
    const std::uint32_t side = sideOf(node.scale);
    return boundsOf({node.column, std::min(node.column + side, last_column_)},
                    {std::max(node.row, first_row_), std::min(node.row + side, last_row_)},
                    maximum(node.scale, node.column, node.row), side);
}

} // namespace marsview
