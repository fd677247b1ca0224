// Parts of a map in tiles on its body, with bounds on where their triangles lie.
#pragma once

#include "core/body/body_grid.h"
#include "core/levels/tile_heights.h"
#include "core/mesh/triangle_tree.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace marsview {

/// The bounds hold whichever tiles are in memory (TiledTerrain): no height is below the lowest of
/// the map, and none above the maxima of the nodes of the analysis around its sample. So no sample
/// is read, and nodes are looked at as they are visited, from *leaves* on, of which there are at
/// most a hundred thousand. Immutable; any thread, the
/// servo thread included.
class TiledBodyNodes {
public:
    /// Cells of the positions, from a sample on.
    struct Cells {
        std::uint32_t column;
        std::uint32_t row;
        std::uint32_t columns;
        std::uint32_t rows;
    };
    static constexpr std::uint32_t kBlockCells = 4; // per side, at most
    static constexpr std::size_t kLeavesMax = std::size_t{1} << 16U;

    /// `heights` are those of the grid's raster.
    TiledBodyNodes(std::shared_ptr<const BodyGrid> grid,
                   std::shared_ptr<const TileHeights> heights,
                   double exaggeration,
                   std::size_t leaves_max);

    const BodyGrid& grid() const noexcept { return *grid_; }
    const TileHeights& heights() const noexcept { return *heights_; }
    /// Of the map, exaggerated. Where the maxima of the analysis are not known (estimateLevels),
    /// far beyond the estimated range: heights are cut off there.
    double lowest() const noexcept { return low_m_; }
    double highest() const noexcept { return high_m_; }

    /// All cells are in some leaf.
    std::uint32_t leafCount() const noexcept { return node_leaves_ + strips_; }
    TriangleTree::Bounds bounds(std::uint32_t leaf) const noexcept;
    /// Calls visit(cells) with blocks of cells of a leaf: all those whose boxes `filter` may meet.
    /// filter.mayMeetBox(corners, beyond) gets eight points, beyond whose hull by at most `beyond`
    /// the triangles of a node lie.
    template <typename Filter, typename F>
    void eachBlock(std::uint32_t leaf, const Filter& filter, F&& visit) const noexcept;

    using Corners = std::array<ScenePoint, 8>;

private:
    // A square of (kBlockCells << scale)² cells of the raster, from a sample on, or what of it is
    // on the body.
    struct Node {
        std::uint32_t column;
        std::uint32_t row;
        unsigned scale;
    };
    static constexpr unsigned kBoundedScale = 3; // of the smallest nodes of the analysis

    static std::uint32_t sideOf(unsigned scale) noexcept { return kBlockCells << scale; }
    Node leafNode(std::uint32_t leaf) const noexcept;
    Cells stripOf(std::uint32_t leaf) const noexcept;
    // Of a node of the analysis, exaggerated.
    double maximum(unsigned scale, std::uint32_t column, std::uint32_t row) const noexcept;
    double stripMaximum(const Cells& strip) const noexcept;
    double beyondHull(std::uint32_t cells) const noexcept
    {
        return beyond_per_sag_ * grid_->sagM(cells);
    }
    ScenePoint
    pointAt(std::uint32_t column, std::uint32_t raster_row, double height_m) const noexcept
    {
        return grid_->positions().at(column, raster_row - first_row_, height_m);
    }
    TriangleTree::Bounds boundsOf(std::array<std::uint32_t, 2> columns,
                                  std::array<std::uint32_t, 2> rows,
                                  double high_m,
                                  std::uint32_t cells) const noexcept;

    std::shared_ptr<const BodyGrid> grid_;
    std::shared_ptr<const TileHeights> heights_;
    double exaggeration_;
    double low_m_ = 0.0;
    double high_m_ = 0.0;
    double beyond_per_sag_ = 1.0;
    std::uint32_t last_column_; // of the positions
    std::uint32_t first_row_;   // of the raster
    std::uint32_t last_row_;
    unsigned leaf_scale_ = kBoundedScale;
    std::uint32_t leaf_columns_ = 0;
    std::uint32_t node_leaves_ = 0;
    std::uint32_t strips_ = 0; // of cells between the last column and the first
};

template <typename Filter, typename F>
void TiledBodyNodes::eachBlock(std::uint32_t leaf, const Filter& filter, F&& visit) const noexcept
{
    if (leaf >= node_leaves_) {
        Cells strip = stripOf(leaf);
        const std::uint32_t end = strip.row + strip.rows;
        for (; strip.row < end; strip.row += kBlockCells) {
            strip.rows = std::min(kBlockCells, end - strip.row);
            visit(strip);
        }
        return;
    }
    constexpr std::size_t kStack = 3 * 32 + 1; // a node is replaced by its four quarters
    std::array<Node, kStack> stack;
    std::size_t size = 0;
    stack[size++] = leafNode(leaf);
    while (size > 0) {
        const Node node = stack[--size];
        if (node.scale == 0) {
            const std::uint32_t row = std::max(node.row, first_row_);
            visit(Cells{node.column, row - first_row_,
                        std::min(node.column + kBlockCells, last_column_) - node.column,
                        std::min(node.row + kBlockCells, last_row_) - row});
            continue;
        }
        const unsigned scale = node.scale - 1;
        const std::uint32_t side = sideOf(scale);
        std::array<std::uint32_t, 3> columns;
        std::array<std::uint32_t, 3> rows;
        for (std::uint32_t i = 0; i < 3; ++i) {
            columns[i] = std::min(node.column + i * side, last_column_);
            rows[i] = std::clamp(node.row + i * side, first_row_, last_row_);
        }
        std::array<ScenePoint, 9> low;
        std::array<Vec3, 9> rise; // to the highest height of the map
        for (std::size_t i = 0; i < low.size(); ++i) {
            low[i] = pointAt(columns[i % 3], rows[i / 3], low_m_);
            rise[i] = pointAt(columns[i % 3], rows[i / 3], high_m_) - low[i];
        }
        const double per_m = high_m_ > low_m_ ? 1.0 / (high_m_ - low_m_) : 0.0;
        const double own_m =
            scale < kBoundedScale ? maximum(kBoundedScale, node.column, node.row) : 0.0;
        for (std::size_t j = 0; j < 2; ++j) {
            for (std::size_t i = 0; i < 2; ++i) {
                if (columns[i] == columns[i + 1] || rows[j] == rows[j + 1]) {
                    continue;
                }
                const Node part{node.column + static_cast<std::uint32_t>(i) * side,
                                node.row + static_cast<std::uint32_t>(j) * side, scale};
                const double high_m =
                    scale < kBoundedScale ? own_m : maximum(scale, part.column, part.row);
                const double share = (high_m - low_m_) * per_m;
                Corners corners;
                for (std::size_t k = 0; k < 4; ++k) {
                    const std::size_t at = (j + k / 2) * 3 + i + k % 2;
                    corners[2 * k] = low[at];
                    corners[2 * k + 1] = low[at] + rise[at] * share;
                }
                if (filter.mayMeetBox(corners, beyondHull(side))) {
                    stack[size++] = part;
                }
            }
        }
    }
}

} // namespace marsview
