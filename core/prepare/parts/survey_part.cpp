#include "core/prepare/parts/survey_part.h"

#include "core/prepare/parts/part_state.h"
#include "core/prepare/parts/stored_tiles.h"
#include "core/prepare/parts/survey_rows.h"

#include <span>
#include <utility>
#include <vector>

namespace marsview {
namespace {

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

bool mergeRanges(CheckpointReader& from, RawRanges& ranges, const SurveyRows& rows)
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

void saveSurvey(CheckpointWriter& to,
                LevelSurveyPass& pass,
                const TileLayout& layout,
                const PartRows& part)
{
    const LevelSurveyPass::State state = pass.state();
    const LevelSurvey& found = state.found;
    const SurveyRows ranges = rangeRows(part, found.ranges);
    const std::size_t range_bytes = rangeRowBytes(found.ranges);
    to.putArray(
        found.ranges.bytes().subspan(ranges.first * range_bytes, ranges.count() * range_bytes));
    const SurveyRows blocks = blockRows(found, part);
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
    const SurveyRows sparse = sparseRows(layout, part);
    to.putRows(*found.sparse, sparse.first, sparse.end);
    const SurveyRows first_rows = firstRows(part);
    to.putRows(*found.first_rows, first_rows.first, first_rows.end);
    found.fine_means.saveChecksums(to);
}

Status mergeSurvey(CheckpointReader& from,
                   LevelSurveyPass& pass,
                   const TileLayout& layout,
                   const PartRows& part,
                   const FileBytes* tiles,
                   CheckpointReader* bands,
                   const std::string& means_path)
{
    const LevelSurveyPass::State state = pass.state();
    LevelSurvey& found = state.found;
    const SurveyRows blocks = blockRows(found, part);
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
    const SurveyRows sparse = sparseRows(layout, part);
    const SurveyRows first_rows = firstRows(part);
    if (!from.getRows(*found.sparse, sparse.first, sparse.end) ||
        !from.getRows(*found.first_rows, first_rows.first, first_rows.end)) {
        return notOfThisPart();
    }
    if (bands != nullptr) {
        const auto complete = state.nested.merge(*bands, part.first, part.end);
        if (!complete) {
            return notOfThisPart();
        }
        for (const LevelBand& band : *complete) {
            if (Status kept = pass.keepBand(band); !kept) {
                return kept;
            }
        }
    }
    if (!found.fine_means.add(from, means_path, {part.first, part.end})) {
        return notOfThisPart();
    }
    return storeAgain(std::move(stored), tiles, part, state.ordered);
}

} // namespace marsview
