#include "haptics/trace/replay_check.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

// Including the outer edges of the pixels.
bool isOn(const Georeference& georeference, const TracePoint& goal)
{
    constexpr double kHalf = 0.5;
    const auto columns = static_cast<double>(georeference.columns());
    const auto rows = static_cast<double>(georeference.rows());
    const GridPoint at = georeference.toGrid(MapPoint{goal.x, goal.y});
    return at.column >= -kHalf && at.column <= columns - kHalf && at.row >= -kHalf &&
           at.row <= rows - kHalf;
}

} // namespace

bool isRecordedOn(const GroundPart& part, const Georeference& map) noexcept
{
    const Ellipsoid ellipsoid = map.body() != nullptr ? map.body()->ellipsoid : Ellipsoid{};
    return part.columns == map.columns() && part.rows == map.rows() && part.ellipsoid == ellipsoid;
}

std::vector<std::size_t> mapsOf(const GoalPart& part,
                                std::span<const std::shared_ptr<const Georeference>> maps)
{
    std::vector<std::size_t> found;
    std::size_t next = 0;
    const auto find = [&](const GroundPart& recorded) {
        while (next < maps.size() && !isRecordedOn(recorded, *maps[next])) {
            ++next;
        }
        if (next < maps.size()) {
            found.push_back(next++);
        }
    };
    if (part.ground) {
        find(*part.ground);
        std::for_each(part.below.begin(), part.below.end(), find);
    }
    return part.ground && found.size() == 1 + part.below.size() ? found
                                                                : std::vector<std::size_t>();
}

const GoalPart* ReplayFit::otherThan(const TouchedGround& ground) const noexcept
{
    constexpr double kSame = 1e-6; // radii are computed from the map's cells in more than one way
    const auto other = std::find_if(parts.begin(), parts.end(), [&](const GoalPart& part) {
        const bool is_other_sphere = ground.kind == ContactModelKind::VirtualProxy &&
                                     std::abs(part.radius_m / ground.radius_m - 1.0) > kSame;
        return part.kind != ground.kind || part.exaggeration != ground.exaggeration ||
               is_other_sphere;
    });
    return other == parts.end() ? nullptr : &*other;
}

const GoalPart* ReplayFit::otherThan(std::size_t map_count) const noexcept
{
    const auto other = std::find_if(parts.begin(), parts.end(), [map_count](const GoalPart& part) {
        return part.ground && 1 + part.below.size() != map_count;
    });
    return other == parts.end() ? nullptr : &*other;
}

Result<ReplayFit> replayFit(const std::string& file,
                            std::span<const std::shared_ptr<const Georeference>> maps,
                            GoalColumns columns)
{
    const Result<std::string> text = readGoalText(file);
    if (!text) {
        return text.error();
    }
    Result<GoalRecording> recording = readGoalRecording(*text, file, columns);
    if (!recording) {
        return std::move(recording).error();
    }
    const auto beside = std::count_if(
        recording->goals.begin(), recording->goals.end(), [maps, columns](const TracePoint& goal) {
            return columns == GoalColumns::Map &&
                   std::none_of(maps.begin(), maps.end(),
                                [&goal](const auto& map) { return isOn(*map, goal); });
        });
    std::optional<GroundPart> other_map;
    const auto look_for = [&](const GroundPart& recorded) {
        if (!other_map && std::none_of(maps.begin(), maps.end(), [&recorded](const auto& map) {
                return isRecordedOn(recorded, *map);
            })) {
            other_map = recorded;
        }
    };
    for (const GoalPart& part : recording->parts) {
        if (part.ground) {
            look_for(*part.ground);
            std::for_each(part.below.begin(), part.below.end(), look_for);
        }
    }
    return ReplayFit{.goal_count = recording->goals.size(),
                     .beside_count = static_cast<std::size_t>(beside),
                     .parts = std::move(recording->parts),
                     .is_cut_short = recording->is_cut_short,
                     .other_map = other_map};
}

} // namespace marsview
