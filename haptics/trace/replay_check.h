// Whether a recording belongs to the map that it is replayed on.
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

/// Whether a recording can have been made on that map: it has as many samples, and the same body.
bool isRecordedOn(const GroundPart& part, const Georeference& map) noexcept;

/// What there is to be known of a recording before it is replayed.
struct ReplayFit {
    std::size_t goal_count = 0;
    std::size_t beside_count = 0; // goals beside every map: the loop puts them to an edge
    std::vector<GoalPart> parts;  // what they were aimed at with; none where the file does not say
    bool is_cut_short = false;    // GoalRecording's
    std::optional<GroundPart> other_map{}; // the first part's that was recorded on none of the maps

    /// Nothing of it can be felt.
    bool isElsewhere() const noexcept { return goal_count > 0 && beside_count == goal_count; }
    /// The first part that was not touched as `ground` is now, so that the proxy goes another way;
    /// null where all was. Points into `parts`.
    const GoalPart* otherThan(const TouchedGround& ground) const noexcept;
};

/// Reads the file: not for the servo thread. What the file cannot be read for.
Result<ReplayFit> replayFit(const std::string& file,
                            std::span<const std::shared_ptr<const Georeference>> maps);

} // namespace marsview
