#include "core/prepare/parts/merged_survey.h"

#include "core/prepare/parts/survey_part.h"

#include <fmt/format.h>
#include <utility>

namespace marsview {

Status mergeSurveys(const PartedMap& map, const TileLayout& layout, LevelSurveyPass& pass)
{
    if (Status begun = pass.begin(); !begun) {
        return begun;
    }
    for (std::size_t part = 1; part <= map.parts; ++part) {
        Result<CheckpointReader> state = openPartState(map, part, kPartSurvey);
        if (!state) {
            return std::move(state).error();
        }
        PartTiles tiles(map);
        Status merged = tiles.restore(*state)
                            ? mergeSurvey(*state, pass, layout, map.rowsOf(part), nullptr)
                            : Status(Error{ErrorCode::Damaged, "is damaged"});
        if (!merged) {
            return Error{merged.error().code,
                         fmt::format("{}: {}; prepare part {} again", map.file(part, kPartSurvey),
                                     merged.error().message, part)};
        }
    }
    return Done{};
}

std::size_t meanRowNumber(const TileLayout& layout, std::size_t level, std::size_t row)
{
    for (std::size_t finer = 1; finer < level; ++finer) {
        row += layout.tileRows(TileKind::Means, finer);
    }
    return row;
}

Status surveyMeans(LevelSurveyPass& pass,
                   TileReaders& readers,
                   const std::vector<std::size_t>& rows,
                   const JobMonitor& monitor)
{
    const auto survey_row = [&pass, &rows](TileReader& reader, std::size_t i) {
        return pass.surveyMeanRow(reader, rows[i]);
    };
    const auto done = readers.eachRow({.first = 0, .end = rows.size()}, survey_row, monitor);
    return done ? Status(Done{}) : Status(done.error());
}

} // namespace marsview
