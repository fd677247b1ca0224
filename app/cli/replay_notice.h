// Messages about a recording that a loop replays.
#pragma once

#include "app/cli/loop_map.h"
#include "core/base/result.h"
#include "haptics/terrain/ground_record.h"

#include <string>
#include <string_view>

namespace marsview {

/// The message about an incomplete last line, without the file name and the final period.
inline constexpr std::string_view kCutShortText = "has an incomplete last line, which is skipped";

/// The message that a recording was made on another map, without the file name and the final
/// period.
std::string otherMapText(const GroundPart& recorded);

/// The notice for "replay:FILE" if it was recorded on another map or with other contact settings;
/// empty if they match, and for any other device. Invalid if all goals are outside the map.
Result<std::string> replayNotice(const std::string& uri, const LoopMap& map);

} // namespace marsview
