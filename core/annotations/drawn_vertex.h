// Positions that people place on a map.
#pragma once

#include "core/geo/frames.h"

#include <chrono>
#include <variant>

namespace marsview {

/// On a body, or in the map coordinates of a map without one.
using DrawnVertex = std::variant<GeographicPoint, MapPoint>;

/// A time in UTC, to the millisecond.
using DrawnTime = std::chrono::sys_time<std::chrono::milliseconds>;

} // namespace marsview
