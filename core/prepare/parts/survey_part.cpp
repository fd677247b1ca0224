#include "core/prepare/parts/survey_part.h"

#include "core/prepare/parts/stored_tiles.h"
#include "core/prepare/tile_counts.h"
#include "core/terrain/detail_measure.h"

#include <cstring>
#include <span>
#include <utility>
#include <vector>

namespace marsview {
namespace {

// Rows [first, end) of an array with `total` rows.
struct Rows {
    std::size_t first = 0;
    std::size_t end = 0;
    std::size_t count() const { return end - first; }
};

Rows rowsOf(const PartRows& part, std::size_t per_tile_row, std::size_t total)
{
    return {std::min(part.first * per_tile_row, total), std::min(part.end * per_tile_row, total)};
}

// Blocks of ranges share the first row of samples of the row of tiles below.
Rows rangeRows(const PartRows& part, const RawRanges& ranges)
{
    Rows rows = rowsOf(part, kTileRanges, ranges.rows());
    rows.first = std::min(part.first * kTileRanges - (part.first > 0 ? 1 : 0), ranges.rows());
    return rows;
}

std::size_t rangeRowBytes(const RawRanges& ranges)
{
    return ranges.columns() * 2 * sampleBytes(ranges.type());
}

// Calls `function` with the tiles that have a checksum and lie in the part.
template <typename Function>
void forEachChecksum(const TileLayout& layout, const PartRows& part, Function&& function)
{
    const auto row_of = [&](TileKind kind, std::size_t level, std::size_t row) {
        for (std::size_t column = 0; column < layout.tileColumns(kind, level); ++column) {
            function(TileId{.kind = kind,
                            .level = static_cast<std::uint8_t>(level),
                            .column = static_cast<std::uint32_t>(column),
                            .row = static_cast<std::uint32_t>(row)});
        }
    };
    for (std::size_t row = part.first; row < part.end; ++row) {
        row_of(TileKind::Samples, 0, row);
    }
    const std::size_t tile_rows = layout.tileRows(TileKind::Samples, 0);
    for (std::size_t level = 1; level <= layout.mean_levels; ++level) {
        for (std::size_t row = 0; row < layout.tileRows(TileKind::Means, level); ++row) {
            if (part.hasMeans(level, row, tile_rows)) {
                row_of(TileKind::Means, level, row);
            }
        }
    }
}

// Rows of the sparse level whose band is complete within the part; of the others, the bands that
// are not complete have the samples.
template <typename Function>
void forEachSparseRow(const TileLayout& layout, const PartRows& part, Function&& function)
{
    constexpr std::size_t kLevel = DetailMeasure::kSparseLevel;
    for (std::size_t row = 0; row < layout.rowsAt(TileKind::Samples, kLevel); ++row) {
        if (part.hasSamples(layout, kLevel, row / kTileSide)) {
            function(row);
        }
    }
}

// The first rows of the part's rows of tiles, by their number in LevelSurvey::first_rows.
Rows firstRows(const PartRows& part)
{
    const std::size_t first = part.first > 0 ? part.first - 1 : 0;
    return {first, part.isEmpty() ? first : std::max(first, part.end - 1)};
}

SampleGrid gridOfRows(const SampleGrid& samples, const std::vector<std::size_t>& rows)
{
    SampleGrid few =
        SampleGrid::create(samples.type(), samples.columns(), std::max<std::size_t>(1, rows.size()))
            .value();
    std::memset(few.rowData(0), 0, samples.columns() * sampleBytes(samples.type()));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        samples.visit([&](auto values) {
            std::memcpy(few.rowData(i), values.row(rows[i]).data(),
                        samples.columns() * sampleBytes(samples.type()));
        });
        for (std::size_t column = 0; samples.hasVoids() && column < samples.columns(); ++column) {
            if (samples.isVoid(column, rows[i])) {
                few.markVoid(column, i);
            }
        }
    }
    return few;
}

void putRows(const SampleGrid& few, const std::vector<std::size_t>& rows, SampleGrid& samples)
{
    for (std::size_t i = 0; i < rows.size(); ++i) {
        few.visit([&](auto values) {
            std::memcpy(samples.rowData(rows[i]), values.row(i).data(),
                        samples.columns() * sampleBytes(samples.type()));
        });
        for (std::size_t column = 0; few.hasVoids() && column < samples.columns(); ++column) {
            if (few.isVoid(column, i)) {
                samples.markVoid(column, rows[i]);
            }
        }
    }
}

std::vector<std::size_t> numbersOf(const Rows& rows)
{
    std::vector<std::size_t> numbers;
    for (std::size_t row = rows.first; row < rows.end; ++row) {
        numbers.push_back(row);
    }
    return numbers;
}

std::vector<std::size_t> sparseRows(const TileLayout& layout, const PartRows& part)
{
    std::vector<std::size_t> rows;
    forEachSparseRow(layout, part, [&rows](std::size_t row) { rows.push_back(row); });
    return rows;
}

template <typename Values>
auto rowsIn(Values& values, const Rows& rows, std::size_t columns)
{
    return std::span(values).subspan(rows.first * columns, rows.count() * columns);
}

Rows blockRows(const LevelSurvey& found, const PartRows& part)
{
    return rowsOf(part, kTileSide / found.kept.block_samples, found.blocks.rows);
}

Status saveFineMeans(CheckpointWriter& to, const FineMeans& means, const PartRows& part)
{
    for (std::size_t level = 0; level < means.levelCount(); ++level) {
        const BlockExtent& extent = means.extent(level);
        const Rows rows = rowsOf(part, kTileBlocks >> level, extent.blockRows());
        BlockRows read{.columns = extent.blockColumns(),
                       .level_rows = extent.blockRows(),
                       .first_row = rows.first,
                       .heights_m = {}};
        read.heights_m.resize(read.columns * rows.count());
        if (rows.count() > 0) {
            if (Status done = means.read(level, read); !done) {
                return done;
            }
        }
        to.putArray(read.heights_m);
    }
    return Done{};
}

Status mergeFineMeans(CheckpointReader& from, FineMeans& means, const PartRows& part)
{
    for (std::size_t level = 0; level < means.levelCount(); ++level) {
        const BlockExtent& extent = means.extent(level);
        const Rows rows = rowsOf(part, kTileBlocks >> level, extent.blockRows());
        BlockRows read{.columns = extent.blockColumns(),
                       .level_rows = extent.blockRows(),
                       .first_row = rows.first,
                       .heights_m = {}};
        if (!from.getAny(read.heights_m) || read.heights_m.size() != read.columns * rows.count()) {
            return notOfThisPart();
        }
        if (rows.count() > 0) {
            if (Status done = means.write(level, read); !done) {
                return done;
            }
        }
    }
    return Done{};
}

bool mergeRanges(CheckpointReader& from, RawRanges& ranges, const Rows& rows)
{
    RawArray<std::byte> read(rows.count() * rangeRowBytes(ranges));
    if (!from.getArray(std::span(read.data(), read.size()))) {
        return false;
    }
    ranges.visit([&](auto blocks) {
        using R = std::remove_cvref_t<decltype(blocks(0, 0))>;
        const auto* added = reinterpret_cast<const R*>(read.data());
        for (std::size_t row = rows.first; row < rows.end; ++row) {
            for (std::size_t column = 0; column < ranges.columns(); ++column) {
                blocks(column, row).include(*added++);
            }
        }
    });
    return true;
}

} // namespace

Status saveSurvey(CheckpointWriter& to,
                  LevelSurveyPass& pass,
                  const TileLayout& layout,
                  const PartRows& part)
{
    const LevelSurveyPass::State state = pass.state();
    const LevelSurvey& found = state.found;
    const Rows ranges = rangeRows(part, found.ranges);
    const std::size_t range_bytes = rangeRowBytes(found.ranges);
    to.putArray(
        found.ranges.bytes().subspan(ranges.first * range_bytes, ranges.count() * range_bytes));
    const Rows blocks = blockRows(found, part);
    to.putArray(rowsIn(found.blocks.means_m, blocks, found.blocks.columns));
    if (!found.blocks.shares.empty()) {
        to.putArray(rowsIn(found.blocks.shares, blocks, found.blocks.columns));
    }
    to.putArray(
        rowsIn(found.has_voids, {part.first, part.end}, layout.tileColumns(TileKind::Samples, 0)));
    std::vector<std::uint32_t> checksums;
    forEachChecksum(layout, part,
                    [&](const TileId& id) { checksums.push_back(found.checksums->of(id)); });
    to.putArray(checksums);
    forEachKeptTile(layout, part, [&](const TileId& id, std::size_t) {
        const FilePart& stored = found.samples_index[keptTileNumber(layout, id)];
        to.put(stored.offset);
        to.put(stored.bytes);
        to.put(stored.checksum);
    });
    to.put(state.void_count.load());
    to.putGrid(gridOfRows(*found.sparse, sparseRows(layout, part)));
    to.putGrid(gridOfRows(*found.first_rows, numbersOf(firstRows(part))));
    state.nested.save(to);
    return saveFineMeans(to, found.fine_means, part);
}

Status mergeSurvey(CheckpointReader& from,
                   LevelSurveyPass& pass,
                   const TileLayout& layout,
                   const PartRows& part,
                   const FileBytes* tiles)
{
    const LevelSurveyPass::State state = pass.state();
    LevelSurvey& found = state.found;
    const Rows blocks = blockRows(found, part);
    bool is_good = mergeRanges(from, found.ranges, rangeRows(part, found.ranges)) &&
                   from.getArray(rowsIn(found.blocks.means_m, blocks, found.blocks.columns)) &&
                   (found.blocks.shares.empty() ||
                    from.getArray(rowsIn(found.blocks.shares, blocks, found.blocks.columns))) &&
                   from.getArray(rowsIn(found.has_voids, {part.first, part.end},
                                        layout.tileColumns(TileKind::Samples, 0)));
    std::vector<std::uint32_t> checksums;
    std::size_t at = 0;
    is_good = is_good && from.getAny(checksums);
    forEachChecksum(layout, part, [&](const TileId& id) {
        if (at < checksums.size()) {
            found.checksums->set(id, checksums[at]);
        }
        ++at;
    });
    if (!is_good || at != checksums.size()) {
        return notOfThisPart();
    }
    std::vector<StoredTile> stored;
    forEachKeptTile(layout, part, [&](const TileId& id, std::size_t last_row) {
        FilePart at_part;
        is_good = is_good && from.get(at_part.offset) && from.get(at_part.bytes) &&
                  from.get(at_part.checksum);
        if (is_good && at_part.bytes > 0) {
            stored.push_back({{last_row, id.level, id.row, id.column},
                              at_part,
                              [to = &found.samples_index[keptTileNumber(layout, id)]](
                                  const FilePart& placed) { *to = placed; }});
        }
    });
    std::uint64_t void_count = 0;
    if (!is_good || !from.get(void_count)) {
        return notOfThisPart();
    }
    state.void_count += void_count;
    const std::vector<std::size_t> sparse = sparseRows(layout, part);
    const std::vector<std::size_t> first_rows = numbersOf(firstRows(part));
    const auto sparse_grid =
        from.getGrid(layout.type, found.sparse->columns(), std::max<std::size_t>(1, sparse.size()));
    const auto first_grid =
        from.getGrid(layout.type, layout.columns, std::max<std::size_t>(1, first_rows.size()));
    if (!sparse_grid || !first_grid) {
        return notOfThisPart();
    }
    putRows(*sparse_grid, sparse, *found.sparse);
    putRows(*first_grid, first_rows, *found.first_rows);
    const auto bands = state.nested.merge(from, part.first, part.end);
    if (!bands) {
        return notOfThisPart();
    }
    for (const LevelBand& band : *bands) {
        if (Status kept = pass.keepBand(band); !kept) {
            return kept;
        }
    }
    if (Status merged = mergeFineMeans(from, found.fine_means, part); !merged) {
        return merged;
    }
    return storeAgain(std::move(stored), tiles, part, state.ordered);
}

} // namespace marsview
