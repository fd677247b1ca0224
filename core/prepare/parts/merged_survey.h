// What a first pass over a map in parts found, for a second pass.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/prepare/level_survey.h"
#include "core/prepare/parts/part_state.h"
#include "core/prepare/tile_row_writer.h"
#include "core/prepare/tile_rows.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace marsview {

/// Begins `pass`, over the rows of a part, and adds the part's survey, without its tiles of nested
/// levels, and what the second pass over it needs of the other parts.
Status restoreSurvey(const PartedMap& map,
                     std::size_t part,
                     const TileLayout& layout,
                     LevelSurveyPass& pass);

/// The number of a row of tiles of means, as in LevelSurveyPass::surveyMeanRow().
std::size_t meanRowNumber(const TileLayout& layout, std::size_t level, std::size_t row);

/// Surveys these rows of means, on all cores.
Status surveyMeans(LevelSurveyPass& pass,
                   TileReaders& readers,
                   const std::vector<std::size_t>& rows,
                   const JobMonitor& monitor);

/// Calls `function(page, tile)` for the tiles of a row of a level, then for its masks.
template <typename Function>
void forEachTileOfRow(const TileRowWriter& writer,
                      std::size_t level,
                      std::size_t row,
                      Function&& function)
{
    const std::size_t pages[] = {writer.page(level),
                                 writer.hasMasks() ? writer.maskPage(level) : writer.page(level)};
    for (std::size_t i = 0; i < (writer.hasMasks() ? 2U : 1U); ++i) {
        const std::size_t columns = writer.tiles().pages()[pages[i]].tile_columns;
        for (std::size_t column = 0; column < columns; ++column) {
            function(pages[i], row * columns + column);
        }
    }
}

} // namespace marsview
