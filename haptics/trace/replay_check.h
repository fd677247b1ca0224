// Whether a recording belongs to the map that it is replayed on.
#pragma once

#include "core/base/result.h"
#include "haptics/loop/servo_map.h"

#include <string>
#include <string_view>

namespace marsview {

/// Whether a device is a recording that is played back.
bool isReplay(std::string_view uri) noexcept;

/// Of "replay:FILE": says where goals lie beside the map, which the loop clamps to its edge, and
/// where they were recorded with another contact model or exaggeration than those of `map`, so that
/// what is touched is another place. Empty where all is the same, and for any other device; Invalid
/// where every goal lies beside the map. A sentence that begins with the file. Reads it: any thread
/// but the servo's. Of `map` only what is constant is looked at.
Result<std::string> replayNotice(const std::string& uri, const ServoMap& map);

} // namespace marsview
