#include "core/session/suits_globe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace marsview {
namespace {

constexpr int kPlaces = 4096;

// The i-th of places evenly spread over a sphere: a Fibonacci lattice. The flattening of planets
// does not matter here.
GeographicPoint placeAt(int i)
{
    const double sine = 1.0 - (2.0 * i + 1.0) / kPlaces;
    const double turns = i / std::numbers::phi;
    return {.longitude = Angle::degrees(360.0 * (turns - std::floor(turns)) - 180.0),
            .latitude = Angle::radians(std::asin(sine))};
}

bool covers(const Map& map, const GeographicPoint& place)
{
    const Georeference& georeference = map.georeference();
    const auto grid = georeference.toGrid(place);
    return grid && grid->column >= -0.5 && grid->row >= -0.5 &&
           grid->column <= static_cast<double>(georeference.columns()) - 0.5 &&
           grid->row <= static_cast<double>(georeference.rows()) - 0.5;
}

} // namespace

bool suitsGlobe(const Session& session)
{
    const std::vector<const Layer*> layers = layersOnBody(session);
    const std::vector<LayerState> states = placement(session);
    const auto top = std::ranges::find_if(session.layers, &Layer::is_visible);
    if (layers.empty() || top->map->info().body == nullptr) {
        return false;
    }
    if (std::ranges::find(states, LayerState::OtherCrs) != states.end()) {
        return true;
    }
    int covered = 0;
    for (int i = 0; i < kPlaces; ++i) {
        const GeographicPoint place = placeAt(i);
        covered += std::ranges::any_of(
                       layers, [&](const Layer* layer) { return covers(*layer->map, place); })
                       ? 1
                       : 0;
    }
    return covered >= kGlobeShare * kPlaces;
}

} // namespace marsview
