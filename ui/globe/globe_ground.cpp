#include "ui/globe/globe_ground.h"

#include "core/globe/body_motion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace marsview {

double GlobeGround::heightOrZero(const GeographicPoint& place) const
{
    const double height_m = height(place);
    return std::isfinite(height_m) ? height_m : 0.0;
}

std::optional<BodyScenePoint> GlobeGround::below(const ScenePoint& place,
                                                 const ScenePoint& eye) const
{
    if (isEmpty()) {
        return std::nullopt;
    }
    const GeographicPoint foot = placeOf(place, ellipsoid()).foot;
    const auto index = scene.mapAt(foot);
    const auto grid = index ? scene.maps()[*index].gridAt(foot) : std::nullopt;
    if (!grid) {
        return std::nullopt;
    }
    return BodyScenePoint{.index = *index,
                          .hit = {.grid = *grid,
                                  .height_m = scene.maps()[*index].heightOnGrid(*grid),
                                  .distance_m = length(place - eye)}};
}

std::optional<BodyScenePoint> GlobeGround::voidOn(const Ray& ray) const
{
    const HeightRange range = scene.range();
    const double level_m = std::clamp(0.0, range.minimum_m, range.maximum_m) * style.exaggeration;
    const ScenePoint point =
        pointOnBody(ray, ellipsoid(), ScenePoint{ellipsoid().equatorial_m + level_m, 0.0, 0.0});
    const double distance_m = dot(point - ray.origin, ray.direction);
    constexpr double kOnRay = 1e-6; // of the body's radius: otherwise the ray passes the body
    if (length(ray.at(distance_m) - point) > kOnRay * ellipsoid().equatorial_m) {
        return std::nullopt;
    }
    const GeographicPoint foot = placeOf(point, ellipsoid()).foot;
    for (std::size_t i = 0; i < scene.maps().size(); ++i) {
        const auto grid = scene.maps()[i].gridAt(foot);
        if (grid && std::isnan(scene.maps()[i].heightOnGrid(*grid))) {
            return BodyScenePoint{.index = i,
                                  .hit = {.grid = *grid,
                                          .height_m = std::numeric_limits<double>::quiet_NaN(),
                                          .distance_m = distance_m}};
        }
    }
    return std::nullopt;
}

BodyLimits GlobeGround::limitsOf(const BodyTerrain& map) const
{
    const HeightRange range = scene.range();
    return bodyLimits(*map.grid(), range.minimum_m * style.exaggeration,
                      range.maximum_m * style.exaggeration);
}

BodyLimits GlobeGround::limits() const
{
    BodyLimits all = limitsOf(scene.maps().front());
    for (std::size_t i = 1; i < scene.maps().size(); ++i) {
        all = united(all, limitsOf(scene.maps()[i]));
    }
    return all;
}

std::vector<ScenePoint> GlobeGround::placesOf(const BodyTerrain& map) const
{
    const HeightRange range = map.shown()->heightfield().range().value_or(HeightRange{});
    return placesOver(*map.grid(), range.minimum_m * style.exaggeration,
                      range.maximum_m * style.exaggeration);
}

std::vector<ScenePoint> GlobeGround::places() const
{
    std::vector<ScenePoint> places;
    for (const BodyTerrain& map : scene.maps()) {
        const std::vector<ScenePoint> more = placesOf(map);
        places.insert(places.end(), more.begin(), more.end());
    }
    return places;
}

} // namespace marsview
