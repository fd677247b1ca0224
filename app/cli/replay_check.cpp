#include "app/cli/replay_check.h"

#include "haptics/trace/goal_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace marsview {

Result<std::string> replayNotice(const std::string& uri, const Georeference& georeference)
{
    constexpr std::string_view kScheme = "replay:";
    constexpr std::string_view kLoop = "#loop";
    if (!uri.starts_with(kScheme)) {
        return std::string();
    }
    std::string path = uri.substr(kScheme.size());
    if (path.ends_with(kLoop)) {
        path.resize(path.size() - kLoop.size());
    }
    const Result<std::string> text = readGoalText(path);
    if (!text) {
        return text.error();
    }
    const Result<std::vector<TracePoint>> goals = readGoals(*text, path);
    if (!goals) {
        return goals.error();
    }
    // To the outer edges of the pixels.
    constexpr double kHalf = 0.5;
    const auto columns = static_cast<double>(georeference.columns());
    const auto rows = static_cast<double>(georeference.rows());
    const auto beside = std::count_if(goals->begin(), goals->end(), [&](const TracePoint& goal) {
        const GridPoint at = georeference.toGrid(MapPoint{goal.x, goal.y});
        return !(at.column >= -kHalf && at.column <= columns - kHalf && at.row >= -kHalf &&
                 at.row <= rows - kHalf);
    });
    if (beside == 0) {
        return std::string();
    }
    const std::string count =
        fmt::format("{}: {} of {} goals lie beside the map", uri, beside, goals->size());
    if (static_cast<std::size_t>(beside) == goals->size()) {
        return Error{ErrorCode::Invalid, count + "; give the map that they were recorded on"};
    }
    return count + " and are put to its edge; was it another one that they were recorded on?";
}

} // namespace marsview
