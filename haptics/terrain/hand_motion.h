// The motion of the hand over a map, as the servo thread reports it.
#pragma once

#include "core/geo/frames.h"

#include <cstdint>

namespace marsview {

/// Trivially copyable, for a SeqLock.
struct HandMotion {
    GridPoint at;               // of the proxy
    double columns_per_s = 0.0; // samples
    double rows_per_s = 0.0;
    double column_share = 1.0; // of the way to the next row, that to the next column
    std::int64_t time_ns = 0;  // of the tick; steady clock
    bool is_active = false;    // false: no hand over the map
};

} // namespace marsview
