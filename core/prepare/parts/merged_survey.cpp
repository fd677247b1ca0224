#include "core/prepare/parts/merged_survey.h"

#include "core/prepare/parts/part_border.h"
#include "core/prepare/parts/survey_part.h"

#include <fmt/format.h>
#include <utility>

namespace marsview {

Status restoreSurvey(const PartedMap& map,
                     std::size_t part,
                     const TileLayout& layout,
                     LevelSurveyPass& pass)
{
    if (Status begun = pass.begin(); !begun) {
        return begun;
    }
    const auto merge = [&](std::size_t from, const char* ending, auto&& add) -> Status {
        Result<CheckpointReader> state = openPartState(map, from, ending);
        if (!state) {
            return std::move(state).error();
        }
        Status merged = add(*state);
        return merged
                   ? merged
                   : Status(Error{merged.error().code, fmt::format("{}: {}; prepare part {} again",
                                                                   map.file(from, ending),
                                                                   merged.error().message, from)});
    };
    const PartRows rows = map.rowsOf(part);
    Status done = merge(part, kPartSurvey, [&](CheckpointReader& state) -> Status {
        PartFiles files;
        return files.restore(state) ? mergeSurvey(state, pass, layout, rows, nullptr, nullptr,
                                                  map.file(part, kPartMeans))
                                    : Status(Error{ErrorCode::Damaged, "is damaged"});
    });
    for (std::size_t other = 1; done && other <= map.parts; ++other) {
        if (other == part) {
            continue;
        }
        done = merge(other, kPartBorder, [&](CheckpointReader& state) {
            return mergeBorder(state, pass, layout, map.rowsOf(other), rows,
                               map.file(other, kPartMeans));
        });
    }
    return done;
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
