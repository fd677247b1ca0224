// What is to be said of a recording that a loop replays.
#pragma once

#include "app/cli/loop_map.h"
#include "core/base/result.h"
#include "haptics/terrain/ground_record.h"

#include <string>
#include <string_view>

namespace marsview {

/// Of a recording whose last line has no end, without a begin and an end.
inline constexpr std::string_view kCutShortText =
    "was cut short in its last line, which is left out";

/// That a recording was made on another map, without a begin and an end.
std::string otherMapText(const GroundPart& recorded);

/// Of "replay:FILE" where it was not recorded on such a map, or touched it in another way; empty
/// where all is the same, and for any other device. Invalid where every goal lies beside the map.
Result<std::string> replayNotice(const std::string& uri, const LoopMap& map);

} // namespace marsview
