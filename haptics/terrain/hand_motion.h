// How the hand moves over a map, as the servo thread tells it.
#pragma once

#include "core/geo/frames.h"

#include <cstdint>

namespace marsview {

/// Trivially copyable, for a SeqLock.
struct HandMotion {
    GridPoint at;               // of the proxy
    double columns_per_s = 0.0; // samples
    double rows_per_s = 0.0;
    std::int64_t time_ns = 0; // of the tick that tells it; steady clock
    bool is_active = false;   // false: there is no hand over the map
};

} // namespace marsview
