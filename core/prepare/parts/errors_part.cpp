#include "core/prepare/parts/errors_part.h"

#include "core/prepare/parts/part_state.h"
#include "core/prepare/parts/stored_tiles.h"
#include "core/prepare/tile_counts.h"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace marsview {
namespace {

constexpr std::size_t kTileNodes = kTileSide / DetailErrors::kNodeCells;

// The rows of nodes of a level that touch the part; neighbors may share one.
std::pair<std::size_t, std::size_t>
nodeRows(const PartRows& part, std::size_t level, std::size_t rows)
{
    const std::size_t first = std::min((part.first * kTileNodes) >> level, rows);
    const std::size_t end =
        part.isEmpty() ? first : std::min(((part.end * kTileNodes - 1) >> level) + 1, rows);
    return {first, end};
}

// The part of LevelErrors::fills_m; a row of tiles has its own blocks.
std::span<float>
fillsOf(LargeVector<float>& fills_m, const TileLayout& layout, const PartRows& part)
{
    if (fills_m.empty()) {
        return {};
    }
    const std::size_t columns = 2 * RawRanges::blocksAlong(layout.columns);
    const std::size_t rows = RawRanges::blocksAlong(layout.rows);
    const std::size_t first = std::min(part.first * kTileRanges, rows);
    const std::size_t end = std::min(part.end * kTileRanges, rows);
    return std::span(fills_m).subspan(first * columns, (end - first) * columns);
}

// The tiles listed by TileParts::index(). False if one of them is not of the part.
template <typename PlaceOf>
bool listTiles(const std::vector<std::uint64_t>& index,
               TileParts& to,
               PlaceOf&& place_of,
               std::vector<StoredTile>& tiles)
{
    const std::size_t count = index.size() / 4;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint64_t number = index[i];
        const std::optional<OrderedTiles::Place> place = place_of(number);
        if (!place) {
            return false;
        }
        tiles.push_back({*place,
                         {.offset = index[count + i],
                          .bytes = index[2 * count + i],
                          .checksum = static_cast<std::uint32_t>(index[3 * count + i])},
                         [&to, number](const FilePart& part) { to.add(number, part); }});
    }
    return index.size() % 4 == 0;
}

} // namespace

void saveErrors(CheckpointWriter& to,
                LevelErrorPass& pass,
                const TileLayout& layout,
                const PartRows& part)
{
    const LevelErrorPass::State state = pass.state();
    for (std::size_t level = 1; level < state.errors.size(); ++level) {
        const DetailErrors::NodeLevel& nodes = state.errors[level];
        const auto [first, end] = nodeRows(part, level, nodes.rows);
        to.putArray(std::span(nodes.errors_m)
                        .subspan(first * nodes.columns, (end - first) * nodes.columns));
    }
    to.putArray(fillsOf(state.fills_m, layout, part));
    to.putArray(state.tile_fill_parts.index());
    to.putArray(state.coarse_fill_parts.index());
    state.coarse_fills.save(to);
}

Status mergeErrors(CheckpointReader& from,
                   LevelErrorPass& pass,
                   const TileLayout& layout,
                   const PartRows& part,
                   const FileBytes& fills)
{
    const LevelErrorPass::State state = pass.state();
    for (std::size_t level = 1; level < state.errors.size(); ++level) {
        DetailErrors::NodeLevel& nodes = state.errors[level];
        const auto [first, end] = nodeRows(part, level, nodes.rows);
        std::vector<float> errors((end - first) * nodes.columns);
        if (!from.getArray(errors)) {
            return notOfThisPart();
        }
        float* to = nodes.errors_m.data() + first * nodes.columns;
        for (std::size_t i = 0; i < errors.size(); ++i) {
            to[i] = std::max(to[i], errors[i]);
        }
    }
    std::vector<std::uint64_t> tile_fills;
    std::vector<std::uint64_t> coarse_fills;
    if (!from.getArray(fillsOf(state.fills_m, layout, part)) || !from.getAny(tile_fills) ||
        !from.getAny(coarse_fills)) {
        return notOfThisPart();
    }
    const std::size_t tile_columns = layout.tileColumns(TileKind::Samples, 0);
    const auto place_of_tile = [&](std::uint64_t number) -> std::optional<OrderedTiles::Place> {
        const std::size_t row = number / tile_columns;
        return part.has(row)
                   ? std::optional(OrderedTiles::Place{row, 0, row, number % tile_columns})
                   : std::nullopt;
    };
    std::map<std::uint64_t, OrderedTiles::Place> places;
    forEachKeptTile(layout, part, [&](const TileId& id, std::size_t last_row) {
        places[keptTileNumber(layout, id)] = {last_row, id.level, id.row, id.column};
    });
    const auto place_of_coarse = [&](std::uint64_t number) -> std::optional<OrderedTiles::Place> {
        const auto at = places.find(number);
        return at != places.end() ? std::optional(at->second) : std::nullopt;
    };
    std::vector<StoredTile> stored;
    if (!listTiles(tile_fills, state.tile_fill_parts, place_of_tile, stored) ||
        !listTiles(coarse_fills, state.coarse_fill_parts, place_of_coarse, stored)) {
        return notOfThisPart();
    }
    const auto bands = state.coarse_fills.merge(from, part.first, part.end);
    if (!bands) {
        return notOfThisPart();
    }
    for (const LevelBand& band : *bands) {
        if (Status kept = pass.keepCoarseFills(band); !kept) {
            return kept;
        }
    }
    return storeAgain(std::move(stored), &fills, part, state.ordered);
}

} // namespace marsview
