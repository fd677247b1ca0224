#include "core/view/feature_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace marsview {
namespace {

constexpr int kDirections = 8;

// Points that are further than this beyond the radius are on another turn of longitude, or so near
// a pole that the projection has no scale there.
constexpr double kStretchMax = 8.0;

// On a sphere: what is lost on an ellipsoid does not matter for a picture.
GeographicPoint pointAround(const GeographicPoint& center, Angle radius, double azimuth)
{
    const double lat = center.latitude.radians();
    const double r = radius.radians();
    const double sin_lat =
        std::sin(lat) * std::cos(r) + std::cos(lat) * std::sin(r) * std::cos(azimuth);
    const double east = std::atan2(std::sin(azimuth) * std::sin(r) * std::cos(lat),
                                   std::cos(r) - std::sin(lat) * sin_lat);
    return {Angle::radians(center.longitude.radians() + east),
            Angle::radians(std::asin(std::clamp(sin_lat, -1.0, 1.0)))};
}

} // namespace

std::optional<FeatureExtent>
featureExtent(const Georeference& map, const GeographicPoint& center, double diameter_m)
{
    if (!map.crs() || !map.crs()->ellipsoid()) {
        return std::nullopt;
    }
    const auto grid = map.toGrid(center);
    constexpr double kHalfPixel = 0.5 + 1e-9;
    if (!grid || !(grid->column >= -kHalfPixel) || !(grid->row >= -kHalfPixel) ||
        !(grid->column <= static_cast<double>(map.columns()) - 1.0 + kHalfPixel) ||
        !(grid->row <= static_cast<double>(map.rows()) - 1.0 + kHalfPixel)) {
        return std::nullopt;
    }
    FeatureExtent extent{.center = *grid, .across_m = diameter_m};
    const double radius_m = 0.5 * diameter_m;
    const Angle radius = Angle::radians(
        std::min(radius_m / map.crs()->ellipsoid()->equatorial_m, 0.5 * std::numbers::pi));
    const ScenePoint middle = map.sceneFrame().toScene(*grid, 0.0);
    for (int i = 0; i < kDirections; ++i) {
        const double azimuth = 2.0 * std::numbers::pi * i / kDirections;
        if (const auto there = map.toGrid(pointAround(center, radius, azimuth))) {
            const ScenePoint place = map.sceneFrame().toScene(*there, 0.0);
            const double distance_m = std::hypot(place.x - middle.x, place.y - middle.y);
            if (distance_m <= kStretchMax * radius_m) {
                extent.across_m = std::max(extent.across_m, 2.0 * distance_m);
            }
        }
    }
    return extent;
}

double distanceShowing(double across_m, double share, Angle field_of_view, const Viewport& viewport)
{
    const double shorter =
        static_cast<double>(std::min(viewport.width, viewport.height)) / viewport.height;
    return across_m / (2.0 * share * shorter * std::tan(0.5 * field_of_view.radians()));
}

} // namespace marsview
