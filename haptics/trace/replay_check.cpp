#include "haptics/trace/replay_check.h"

#include "haptics/trace/goal_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace marsview {
namespace {

constexpr std::string_view kScheme = "replay:";
constexpr std::string_view kLoop = "#loop";

std::string fileOf(const std::string& uri)
{
    std::string path = uri.substr(kScheme.size());
    if (path.ends_with(kLoop)) {
        path.resize(path.size() - kLoop.size());
    }
    return path;
}

// To the outer edges of the pixels.
bool isBeside(const TracePoint& goal, const Georeference& georeference)
{
    constexpr double kHalf = 0.5;
    const auto columns = static_cast<double>(georeference.columns());
    const auto rows = static_cast<double>(georeference.rows());
    const GridPoint at = georeference.toGrid(MapPoint{goal.x, goal.y});
    return !(at.column >= -kHalf && at.column <= columns - kHalf && at.row >= -kHalf &&
             at.row <= rows - kHalf);
}

std::string asText(ContactModelKind kind, double radius_m, double exaggeration)
{
    const std::string radius = kind == ContactModelKind::VirtualProxy
                                   ? fmt::format(" of radius {:.6g} m", radius_m)
                                   : std::string();
    return fmt::format("{}{} at exaggeration {:.6g}", contactModelName(kind), radius, exaggeration);
}

// What the map is touched with in another way than it was; empty where nothing is.
std::string otherTouch(const std::vector<GoalPart>& parts, const ServoMap& map)
{
    const double exaggeration = map.frame.exaggeration();
    const auto other = std::find_if(parts.begin(), parts.end(), [&](const GoalPart& part) {
        const bool is_other_sphere = map.kind == ContactModelKind::VirtualProxy &&
                                     std::abs(part.radius_m / map.radius_m - 1.0) > 1e-6;
        return part.kind != map.kind || part.exaggeration != exaggeration || is_other_sphere;
    });
    if (other == parts.end()) {
        return {};
    }
    return fmt::format("was recorded with {}, which is not what touches the map now ({})",
                       asText(other->kind, other->radius_m, other->exaggeration),
                       asText(map.kind, map.radius_m, exaggeration));
}

} // namespace

bool isReplay(std::string_view uri) noexcept
{
    return uri.starts_with(kScheme);
}

Result<std::string> replayNotice(const std::string& uri, const ServoMap& map)
{
    if (!isReplay(uri)) {
        return std::string();
    }
    const std::string path = fileOf(uri);
    const Result<std::string> text = readGoalText(path);
    if (!text) {
        return text.error();
    }
    const Result<GoalRecording> recording = readGoalRecording(*text, path);
    if (!recording) {
        return recording.error();
    }
    const auto all = static_cast<std::ptrdiff_t>(recording->goals.size());
    const auto beside = std::count_if(
        recording->goals.begin(), recording->goals.end(),
        [&](const TracePoint& goal) { return isBeside(goal, map.frame.georeference()); });
    const std::string count = fmt::format("{} of {} goals lie beside the map", beside, all);
    if (all > 0 && beside == all) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: {}; give the map that they were recorded on", path, count)};
    }
    std::vector<std::string> remarks;
    if (beside > 0) {
        remarks.push_back(count +
                          " and are put to its edge; was it another one that they were recorded "
                          "on?");
    }
    if (std::string other = otherTouch(recording->parts, map); !other.empty()) {
        remarks.push_back(std::move(other));
    }
    return remarks.empty() ? std::string()
                           : fmt::format("{}: {}", path, fmt::join(remarks, " It "));
}

} // namespace marsview
