#include "ui/globe/globe_ground.h"

#include <cmath>

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
    const HeightRange range = map.map()->heightfield().range().value_or(HeightRange{});
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
