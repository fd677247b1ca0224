// Scripted flights over a map, for measuring: the same cameras every time, on any machine.
#pragma once

#include "core/view/camera.h"
#include "core/view/navigation.h"

#include <array>
#include <string_view>

namespace marsview {

enum class Flight {
    Orbit, // the whole map, once around
    Dive,  // from the whole map down to single samples in its middle, and half the way back
    Sweep, // low over the middle of the map
};

inline constexpr std::array kFlights{Flight::Orbit, Flight::Dive, Flight::Sweep};

/// "orbit", "dive", "sweep".
std::string_view flightName(Flight flight);

/// A map to fly over.
struct FlightGround {
    SceneBox box;
    double pixel_m = 1.0; // side of a sample; > 0
    GroundQuery height;   // in scene metres
};

/// The camera at a moment of a flight, t in [0, 1]; two moments that are near have cameras that
/// are. Not yet within the bounds of navigation, see constrained().
OrbitCamera cameraOn(Flight flight, double t, const FlightGround& ground, const Viewport& viewport);

} // namespace marsview
