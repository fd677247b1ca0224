#include "app/cli/replay_notice.h"

#include "core/geo/body.h"
#include "haptics/drivers/replay_driver.h"
#include "haptics/trace/replay_check.h"

#include <fmt/format.h>
#include <memory>
#include <vector>

namespace marsview {
namespace {

std::string asText(ContactModelKind kind, double radius_m, double exaggeration)
{
    const std::string radius = kind == ContactModelKind::VirtualProxy
                                   ? fmt::format(" of radius {:.6g} m", radius_m)
                                   : std::string();
    return fmt::format("{}{} at exaggeration {:.6g}", contactModelName(kind), radius, exaggeration);
}

} // namespace

std::string otherMapText(const GroundPart& recorded)
{
    const Body* body = bodyOfRadius(recorded.ellipsoid.equatorial_m);
    return fmt::format("was recorded on another map, one of {} × {} samples of {}",
                       recorded.columns, recorded.rows,
                       body != nullptr ? body->name : "an unknown body");
}

Result<std::string> replayNotice(const std::string& uri, const LoopMap& map)
{
    if (!isReplay(uri)) {
        return std::string();
    }
    const std::string file = replayedFile(uri);
    const std::shared_ptr<const Georeference> georeference(map.opened, &map.opened->georeference());
    const Result<ReplayFit> fit =
        replayFit(file, {&georeference, 1}, map.mesh ? GoalColumns::Geographic : GoalColumns::Map);
    if (!fit) {
        return fit.error();
    }
    const std::string count =
        fmt::format("{} of {} goals are outside the map", fit->beside_count, fit->goal_count);
    if (fit->isElsewhere()) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: {}; use the map of the recording", file, count)};
    }
    std::vector<std::string> remarks;
    if (fit->beside_count > 0) {
        remarks.push_back(count + " and are clamped to its edge");
    }
    if (fit->is_cut_short) {
        remarks.emplace_back(kCutShortText);
    }
    if (fit->other_map) {
        remarks.push_back(otherMapText(*fit->other_map));
    }
    const ServoMap& touched = *map.map;
    if (const GoalPart* other = fit->otherThan(1 + touched.below.size())) {
        remarks.push_back(
            fmt::format("was recorded on {} maps on top of each other", 1 + other->below.size()));
    }
    const double exaggeration = touched.frame.exaggeration();
    if (const GoalPart* other = fit->otherThan(
            {.kind = touched.kind, .radius_m = touched.radius_m, .exaggeration = exaggeration})) {
        remarks.push_back(fmt::format("was recorded with {}, but the contact model is now {}",
                                      asText(other->kind, other->radius_m, other->exaggeration),
                                      asText(touched.kind, touched.radius_m, exaggeration)));
    }
    return remarks.empty() ? std::string()
                           : fmt::format("{}: {}", file, fmt::join(remarks, "; it "));
}

} // namespace marsview
