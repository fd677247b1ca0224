#include "core/terrain/node_heights.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace marsview {
namespace {

// The indices of a node's samples along one axis.
std::array<std::size_t, kNodeSide> placesOf(std::size_t level, std::size_t node, std::size_t count)
{
    std::array<std::size_t, kNodeSide> places{};
    for (std::size_t i = 0; i < kNodeSide; ++i) {
        places[i] = std::min((node * DetailErrors::kNodeCells + i) << level, count - 1);
    }
    return places;
}

// The tiles of the node's samples at its own level and all coarser ones, coarser ones first.
void addTiles(const TiledRaster& raster, const DetailNode& node, std::vector<TileId>& missing)
{
    const TileLayout& layout = raster.layout();
    const std::size_t size = DetailErrors::kNodeCells << node.level;
    const auto tile_of = [](std::size_t place, std::size_t level, std::size_t count) {
        const std::size_t step = std::size_t{1} << level;
        return std::min((place + step - 1) / step,
                        TileLayout::samplesAlong(TileKind::Samples, level, count) - 1) /
               kTileSide;
    };
    const std::size_t right = std::min((node.column + 1) * size, layout.columns - 1);
    const std::size_t lower = std::min((node.row + 1) * size, layout.rows - 1);
    for (std::size_t level = layout.topLevel(); level-- > node.level;) {
        const std::size_t first_column = (node.column * size >> level) / kTileSide;
        const std::size_t first_row = (node.row * size >> level) / kTileSide;
        for (std::size_t row = first_row; row <= tile_of(lower, level, layout.rows); ++row) {
            for (std::size_t column = first_column; column <= tile_of(right, level, layout.columns);
                 ++column) {
                const TileId id{.kind = TileKind::Samples,
                                .level = static_cast<std::uint8_t>(level),
                                .column = static_cast<std::uint32_t>(column),
                                .row = static_cast<std::uint32_t>(row)};
                // Marks resident tiles as used: finer tiles must not outlive the coarser ones
                // around them.
                if (raster.find(id) == nullptr &&
                    std::find(missing.begin(), missing.end(), id) == missing.end()) {
                    missing.push_back(id);
                }
            }
        }
    }
}

} // namespace

NodeState readNode(const DrawnSurface& surface,
                   const DetailNode& node,
                   std::span<float, kNodeSide * kNodeSide> heights,
                   std::vector<TileId>& missing)
{
    const Heightfield& heightfield = surface.heightfield();
    const auto columns = placesOf(node.level, node.column, heightfield.columns());
    const auto rows = placesOf(node.level, node.row, heightfield.rows());
    if (!heightfield.isTiled()) {
        for (std::size_t j = 0; j < kNodeSide; ++j) {
            for (std::size_t i = 0; i < kNodeSide; ++i) {
                heights[j * kNodeSide + i] = surface.height(columns[i], rows[j]);
            }
        }
        return NodeState::Complete;
    }
    const TiledSamples& tiles = *heightfield.tiles();
    const std::size_t level = std::min(node.level, tiles.layout().topLevel());
    addTiles(tiles.raster(), {level, node.column >> (node.level - level), node.row}, missing);
    TileCursor cursor(tiles, heightfield.scale(), TileAccess::Resident);
    for (std::size_t j = 0; j < kNodeSide; ++j) {
        for (std::size_t i = 0; i < kNodeSide; ++i) {
            const double height_m = cursor.vertex(level, columns[i], rows[j]);
            heights[j * kNodeSide + i] = std::isnan(height_m)
                                             ? surface.filled(columns[i], rows[j])
                                             : static_cast<float>(height_m - surface.baseMeters());
        }
    }
    return cursor.isExact() ? NodeState::Complete : NodeState::Coarser;
}

} // namespace marsview
