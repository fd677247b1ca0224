#include "core/prepare/parts/part_border.h"

#include "core/prepare/level_errors.h"
#include "core/prepare/parts/part_state.h"
#include "core/prepare/parts/survey_rows.h"
#include "core/terrain/detail_measure.h"

#include <algorithm>
#include <vector>

namespace marsview {
namespace {

constexpr std::size_t kSparseLevel = DetailMeasure::kSparseLevel;
// Of the sparse level's rows and columns, every kTallStep-th one and the last are of kTallLevel.
constexpr std::size_t kTallStep = std::size_t{1} << (kTallLevel - kSparseLevel);

bool isTall(std::size_t i, std::size_t count)
{
    return i % kTallStep == 0 || i + 1 == count;
}

std::vector<std::size_t> tallOf(std::size_t first, std::size_t end, std::size_t count)
{
    std::vector<std::size_t> tall;
    for (std::size_t i = first; i < end; ++i) {
        if (isTall(i, count)) {
            tall.push_back(i);
        }
    }
    return tall;
}

void copySample(const SampleGrid& from,
                std::size_t column,
                std::size_t row,
                SampleGrid& to,
                std::size_t to_column,
                std::size_t to_row)
{
    from.visit([&](auto values) {
        using T = std::remove_cvref_t<decltype(values(0, 0))>;
        reinterpret_cast<T*>(to.rowData(to_row))[to_column] = values(column, row);
    });
    if (from.isVoid(column, row)) {
        to.markVoid(to_column, to_row);
    }
}

// The samples of kTallLevel among some rows of the sparse level.
SampleGrid tallSamples(const SampleGrid& sparse, const SurveyRows& rows)
{
    const std::vector<std::size_t> columns = tallOf(0, sparse.columns(), sparse.columns());
    const std::vector<std::size_t> tall_rows = tallOf(rows.first, rows.end, sparse.rows());
    SampleGrid tall = SampleGrid::create(sparse.type(), columns.size(),
                                         std::max<std::size_t>(1, tall_rows.size()))
                          .value();
    std::fill_n(tall.rowData(0), columns.size() * sampleBytes(sparse.type()), std::byte{0});
    for (std::size_t row = 0; row < tall_rows.size(); ++row) {
        for (std::size_t column = 0; column < columns.size(); ++column) {
            copySample(sparse, columns[column], tall_rows[row], tall, column, row);
        }
    }
    return tall;
}

// The row of tiles that the part before this one needs of it.
SurveyRows firstTileRow(const PartRows& part)
{
    return {part.first, part.first + (part.isEmpty() ? 0 : 1)};
}

// The part's first row of samples, in LevelSurvey::first_rows.
SurveyRows firstSampleRow(const PartRows& part)
{
    const SurveyRows rows = firstRows(part);
    return {rows.first, rows.first + (part.first > 0 && !part.isEmpty() ? 1 : 0)};
}

// The lower side of the last row of tiles: the next part's first row of samples.
void putLowerSide(const SampleGrid& row, const PartRows& next, SampleGrid& sparse)
{
    const std::size_t to_row = next.first * (kTileSide >> kSparseLevel);
    for (std::size_t column = 0; column < sparse.columns(); ++column) {
        copySample(row, std::min(column << kSparseLevel, row.columns() - 1), 0, sparse, column,
                   to_row);
    }
}

} // namespace

bool saveBorder(CheckpointWriter& to,
                LevelSurveyPass& pass,
                const TileLayout& layout,
                const PartRows& part)
{
    const LevelSurveyPass::State state = pass.state();
    const LevelSurvey& found = state.found;
    const SurveyRows ranges = rangeRows(part, found.ranges);
    const SampleStatistics extremes = found.ranges.extremes(ranges.first, ranges.end);
    to.put(extremes.raw_minimum);
    to.put(extremes.raw_maximum);
    to.put(extremes.raw_next_minimum);
    to.put(extremes.raw_next_maximum);
    to.put(state.void_count.load());
    to.putArray(
        rowsIn(found.has_voids, firstTileRow(part), layout.tileColumns(TileKind::Samples, 0)));
    to.putGrid(gridOfRows(*found.first_rows, firstSampleRow(part)));
    to.putGrid(tallSamples(*found.sparse, sparseRows(layout, part)));
    if (layout.has_voids) {
        const SurveyRows blocks = blockRows(found, part);
        to.putArray(rowsIn(found.blocks.means_m, blocks, found.blocks.columns));
        to.putArray(rowsIn(found.blocks.shares, blocks, found.blocks.columns));
    }
    return found.fine_means.save(to);
}

Status mergeBorder(CheckpointReader& from,
                   LevelSurveyPass& pass,
                   const TileLayout& layout,
                   const PartRows& other,
                   const PartRows& part,
                   const std::string& means_path)
{
    const LevelSurveyPass::State state = pass.state();
    LevelSurvey& found = state.found;
    SampleGrid& sparse = *found.sparse;
    const bool is_next = !other.isEmpty() && other.first == part.end;
    SampleStatistics extremes;
    std::uint64_t void_count = 0;
    std::vector<std::uint8_t> has_voids;
    if (!from.get(extremes.raw_minimum) || !from.get(extremes.raw_maximum) ||
        !from.get(extremes.raw_next_minimum) || !from.get(extremes.raw_next_maximum) ||
        !from.get(void_count) || !from.getAny(has_voids)) {
        return notOfThisPart();
    }
    const std::vector<std::size_t> columns = tallOf(0, sparse.columns(), sparse.columns());
    const SurveyRows rows = sparseRows(layout, other);
    const std::vector<std::size_t> tall_rows = tallOf(rows.first, rows.end, sparse.rows());
    const auto first_row = from.getGrid(layout.type, layout.columns, 1);
    const auto tall =
        from.getGrid(layout.type, columns.size(), std::max<std::size_t>(1, tall_rows.size()));
    if (!first_row || !tall ||
        has_voids.size() !=
            firstTileRow(other).count() * layout.tileColumns(TileKind::Samples, 0)) {
        return notOfThisPart();
    }
    found.statistics.merge(extremes);
    state.void_count += void_count;
    for (const SparseRow& needed : sparseRowsFor(layout, {part.first, part.end})) {
        const auto at = std::find(tall_rows.begin(), tall_rows.end(), needed.row);
        for (std::size_t i = 0; at != tall_rows.end() && i < columns.size(); ++i) {
            copySample(*tall, i, static_cast<std::size_t>(at - tall_rows.begin()), sparse,
                       columns[i], needed.row);
        }
    }
    if (is_next) {
        std::copy(
            has_voids.begin(), has_voids.end(),
            rowsIn(found.has_voids, firstTileRow(other), layout.tileColumns(TileKind::Samples, 0))
                .begin());
        putRows(*first_row, firstSampleRow(other), *found.first_rows);
        putLowerSide(*first_row, other, sparse);
    }
    if (layout.has_voids) {
        const SurveyRows blocks = blockRows(found, other);
        if (!from.getArray(rowsIn(found.blocks.means_m, blocks, found.blocks.columns)) ||
            !from.getArray(rowsIn(found.blocks.shares, blocks, found.blocks.columns))) {
            return notOfThisPart();
        }
    }
    return found.fine_means.add(from, means_path, {other.first, other.end})
               ? Status(Done{})
               : Status(notOfThisPart());
}

} // namespace marsview
