// Scripted flights over a map, for measurements: the same cameras every time, on any machine.
#pragma once

#include "core/globe/body_navigation.h"
#include "core/view/camera.h"
#include "core/view/navigation.h"

#include <array>
#include <string_view>

namespace marsview {

enum class Flight {
    Orbit, // the whole map, once around
    Dive,  // from the whole map down to single samples in its center, and halfway back
    Sweep, // low over the center of the map
};

inline constexpr std::array kFlights{Flight::Orbit, Flight::Dive, Flight::Sweep};

/// "orbit", "dive", "sweep".
std::string_view flightName(Flight flight);

/// A map to fly over.
struct FlightGround {
    SceneBox box;
    double pixel_m = 1.0; // side of a sample; > 0
    GroundQuery height;   // in scene meters
};

/// The camera at a time of a flight, t in [0, 1]; continuous in t. Not yet within the limits of
/// navigation, see constrained().
OrbitCamera cameraOn(Flight flight, double t, const FlightGround& ground, const Viewport& viewport);

/// A map on its body to fly over.
struct BodyFlightGround {
    BodyLimits limits;
    double pixel_m = 1.0; // side of a sample; > 0
    BodyGround height;    // exaggerated
};

/// The same flights over a body: around the middle of the area at the distance and, at least, the
/// tilt of home; down to that middle; and low over it along a great circle. Not yet within the
/// limits, see constrained().
BodyCamera
bodyCameraOn(Flight flight, double t, const BodyFlightGround& ground, const Viewport& viewport);

} // namespace marsview
