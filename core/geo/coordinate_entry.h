// Coordinates as people type them.
#pragma once

#include "core/base/angle.h"
#include "core/base/result.h"
#include "core/geo/frames.h"

#include <string_view>

namespace marsview {

/// A typed position. The caller decides whether the latitude is planetocentric or planetographic.
struct WrittenPlace {
    Angle latitude;  // in [-90°, 90°]
    Angle longitude; // east-positive, in [-360°, 360°]
};

/// The direction of a longitude that has no letter.
enum class BareLongitude { East, West };

/// Latitude and longitude in decimal degrees, degrees and minutes, or degrees, minutes and seconds:
/// "18.65 N 226.2 E", "226.2°E, 18.65°N", "18°39′00″N 133°48′W", "18 39 00 N 133 48 00 W", "-18.65,
/// 226.2", "18:39, 226:12". With hemisphere letters the order is free; without them the latitude
/// comes first. Signs may be true minus signs; invisible direction marks are ignored. Decimal
/// commas are accepted where they cannot be separators: with letters, if a semicolon separates
/// ("18,65; 226,2"), and if both numbers have one ("18,65 226,2", "18,65, 226,2"). Errors: Invalid
/// for other text, OutOfRange for parts that are too large. Messages are shown to the user.
Result<WrittenPlace> placeFrom(std::string_view text, BareLongitude bare = BareLongitude::East);

/// Two plain numbers, x then y: "562345.5 5117890", "562345.5, 5117890", "562345,5; 5117890",
/// "562345,5 5117890,2".
Result<MapPoint> mapPointFrom(std::string_view text);

} // namespace marsview
