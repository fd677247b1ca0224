// Views that the user saved: where the camera is, independent of the map that is on top.
#pragma once

#include "core/geo/georeference.h"
#include "core/view/camera.h"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace marsview {

enum class LayerId : std::uint32_t;

/// Identifies a saved view in a session and in all sessions derived from it. Never reused.
enum class ViewId : std::uint32_t { None = 0 };

/// A camera by what it looks at: on a body, or in the map coordinates of a map without one. Every
/// map of that body has the same picture from it.
struct ViewCamera {
    std::variant<GeographicPoint, MapPoint> target{};
    double elevation_m = 0.0; // of the target, without exaggeration
    double distance_m = 1.0;  // > 0
    /// Heading of the view, clockwise from true north at the target, or from the map's if the body
    /// is unknown.
    Angle azimuth{};
    Angle tilt{}; // 0 looks straight down, 90° along the horizon
    Angle field_of_view = Angle::degrees(40.0);

    bool operator==(const ViewCamera&) const = default;
};

struct SavedView {
    ViewId id = ViewId::None;
    std::string name{};
    ViewCamera camera{};
    double exaggeration = 1.0; // > 0
    LayerId layer{};           // the topmost one in the picture; it may have been removed since
    std::string body{};        // a name of bodies(); empty if unknown
    bool is_on_globe = false;  // saved there, and shown there again

    bool operator==(const SavedView&) const = default;
};

/// The camera of a scene whose topmost map has this georeference. Angles are rounded to millionths
/// of a degree, positions on a body to 1e-10 degrees. Empty if the target is outside the
/// projection.
std::optional<ViewCamera>
viewCamera(const Georeference& georeference, const OrbitCamera& camera, double exaggeration);

/// The inverse. Empty if the target is outside the projection, or on a body while the map is not on
/// a known one, or the reverse.
std::optional<OrbitCamera>
orbitCamera(const Georeference& georeference, const ViewCamera& camera, double exaggeration);

} // namespace marsview
