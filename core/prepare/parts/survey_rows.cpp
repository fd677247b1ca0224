#include "core/prepare/parts/survey_rows.h"

#include "core/prepare/tile_counts.h"
#include "core/terrain/detail_measure.h"

#include <cstring>

namespace marsview {

SurveyRows rangeRows(const PartRows& part, const RawRanges& ranges)
{
    SurveyRows rows = surveyRows(part, kTileRanges, ranges.rows());
    rows.first = std::min(part.first * kTileRanges - (part.first > 0 ? 1 : 0), ranges.rows());
    return rows;
}

SurveyRows blockRows(const LevelSurvey& found, const PartRows& part)
{
    return surveyRows(part, kTileSide / found.kept.block_samples, found.blocks.rows);
}

SurveyRows firstRows(const PartRows& part)
{
    const std::size_t first = part.first > 0 ? part.first - 1 : 0;
    return {first, part.isEmpty() ? first : std::max(first, part.end - 1)};
}

SurveyRows sparseRows(const TileLayout& layout, const PartRows& part)
{
    constexpr std::size_t kLevel = DetailMeasure::kSparseLevel;
    const std::size_t rows = layout.rowsAt(TileKind::Samples, kLevel);
    SurveyRows of = surveyRows(part, kTileSide >> kLevel, rows);
    // The last row of the map has an extra row, possibly after those of the last tiles.
    if (!part.isEmpty() && part.end == layout.tileRows(TileKind::Samples, 0)) {
        of.end = rows;
    }
    return of;
}

SampleGrid gridOfRows(const SampleGrid& samples, const SurveyRows& rows)
{
    SampleGrid few = SampleGrid::create(samples.type(), samples.columns(),
                                        std::max<std::size_t>(1, rows.count()))
                         .value();
    const std::size_t row_bytes = samples.columns() * sampleBytes(samples.type());
    std::memset(few.rowData(0), 0, row_bytes);
    for (std::size_t row = rows.first; row < rows.end; ++row) {
        samples.visit([&](auto values) {
            std::memcpy(few.rowData(row - rows.first), values.row(row).data(), row_bytes);
        });
        for (std::size_t column = 0; samples.hasVoids() && column < samples.columns(); ++column) {
            if (samples.isVoid(column, row)) {
                few.markVoid(column, row - rows.first);
            }
        }
    }
    return few;
}

void putRows(const SampleGrid& few, const SurveyRows& rows, SampleGrid& samples)
{
    for (std::size_t row = rows.first; row < rows.end; ++row) {
        few.visit([&](auto values) {
            std::memcpy(samples.rowData(row), values.row(row - rows.first).data(),
                        samples.columns() * sampleBytes(samples.type()));
        });
        for (std::size_t column = 0; few.hasVoids() && column < samples.columns(); ++column) {
            if (few.isVoid(column, row - rows.first)) {
                samples.markVoid(column, row);
            }
        }
    }
}

} // namespace marsview
