// Whether a recording belongs to the map that it is replayed on.
#pragma once

#include "core/base/result.h"
#include "core/geo/georeference.h"

#include <string>

namespace marsview {

/// Of "replay:FILE", counts the goals that lie beside the map, which the loop clamps to its edge.
/// A sentence to be shown where some do; Invalid where all do; empty where none does, and for any
/// other device. Reads the file.
Result<std::string> replayNotice(const std::string& uri, const Georeference& georeference);

} // namespace marsview
