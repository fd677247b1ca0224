// The rows of a survey that a part has, and copies of them.
#pragma once

#include "core/prepare/level_survey.h"
#include "core/prepare/parts/part_rows.h"
#include "core/raster/sample_grid.h"
#include "core/terrain/raw_ranges.h"
#include "core/tiles/tile.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace marsview {

/// Rows [first, end) of an array.
struct SurveyRows {
    std::size_t first = 0;
    std::size_t end = 0;
    std::size_t count() const { return end - first; }
};

/// The part's rows of an array with `per_tile_row` rows in a row of tiles and `total` rows.
inline SurveyRows surveyRows(const PartRows& part, std::size_t per_tile_row, std::size_t total)
{
    return {std::min(part.first * per_tile_row, total), std::min(part.end * per_tile_row, total)};
}

/// Of LevelSurvey::ranges: blocks share the first row of samples of the row of tiles below.
SurveyRows rangeRows(const PartRows& part, const RawRanges& ranges);
/// Of LevelSurvey::blocks.
SurveyRows blockRows(const LevelSurvey& found, const PartRows& part);
/// Of LevelSurvey::first_rows.
SurveyRows firstRows(const PartRows& part);
/// Of LevelSurvey::sparse.
SurveyRows sparseRows(const TileLayout& layout, const PartRows& part);

template <typename Values>
auto rowsIn(Values& values, const SurveyRows& rows, std::size_t columns)
{
    return std::span(values).subspan(rows.first * columns, rows.count() * columns);
}

/// Copies of some rows; at least one row.
SampleGrid gridOfRows(const SampleGrid& samples, const SurveyRows& rows);
/// Copies them back.
void putRows(const SampleGrid& few, const SurveyRows& rows, SampleGrid& samples);

} // namespace marsview
