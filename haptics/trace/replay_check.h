// Checks whether a recording matches the map it is replayed on.
#pragma once

#include "core/base/result.h"
#include "core/geo/georeference.h"
#include "haptics/loop/loop_state.h"
#include "haptics/trace/goal_file.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace marsview {

/// Where the maps of a part are among `maps`, the uppermost first, each below the one before it;
/// empty if one is missing, or if the recording does not name its maps.
std::vector<std::size_t> mapsOf(const GoalPart& part,
                                std::span<const std::shared_ptr<const Georeference>> maps);

/// Whether a recording may have been made on that map: same number of samples and same body.
bool isRecordedOn(const GroundPart& part, const Georeference& map) noexcept;

/// Properties of a recording, determined before its replay.
struct ReplayFit {
    std::size_t goal_count = 0;
    std::size_t beside_count = 0; // in the plane, goals outside all maps: clamped to an edge
    std::vector<GoalPart> parts;  // maps and contact models; none if not stored
    bool is_cut_short = false;    // GoalRecording's
    std::optional<GroundPart>
        other_map{}; // the first map of the recording that is none of the maps

    /// All goals are outside the map.
    bool isElsewhere() const noexcept { return goal_count > 0 && beside_count == goal_count; }
    /// The first part whose contact settings differ from `ground`, so that the proxy would move
    /// differently; null if none differ. Points into `parts`.
    const GoalPart* otherThan(const TouchedGround& ground) const noexcept;
    /// The first part that was recorded on another number of maps, joined to one surface; likewise.
    const GoalPart* otherThan(std::size_t map_count) const noexcept;
};

/// Reads the file, so not for the servo thread. Returns the error of reading it.
Result<ReplayFit> replayFit(const std::string& file,
                            std::span<const std::shared_ptr<const Georeference>> maps,
                            GoalColumns columns = GoalColumns::Map);

} // namespace marsview
