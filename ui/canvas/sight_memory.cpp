#include "ui/canvas/sight_memory.h"

#include "core/view/exaggeration.h"

#include <algorithm>
#include <string>

namespace marsview {
namespace {

// Whether two maps have their outer corners in the same places of the scene.
bool haveSameCorners(const Map& a, const Map& b)
{
    const auto corner = [](const Map& map, double side) {
        const Georeference& georeference = map.georeference();
        const auto end = [side](std::size_t count) {
            return -0.5 + side * static_cast<double>(count);
        };
        return georeference.sceneFrame().toScene(
            {end(georeference.columns()), end(georeference.rows())}, 0.0);
    };
    constexpr double kTolerance = 1e-6;
    const double tolerance_m = kTolerance * length(corner(a, 1.0) - corner(a, 0.0));
    return length(corner(a, 0.0) - corner(b, 0.0)) <= tolerance_m &&
           length(corner(a, 1.0) - corner(b, 1.0)) <= tolerance_m;
}

// The same scene coordinates are the same places. The scene of a map has its origin in the map's
// center, so that this takes more than equal frames, except for one file, be it as a preview or
// with other overrides.
bool isSamePlace(const Map& a, const Map& b)
{
    const Georeference& there = a.georeference();
    const Georeference& here = b.georeference();
    if (a.spec().path == b.spec().path) {
        return there.sceneFrame() == here.sceneFrame() || haveSameCorners(a, b);
    }
    const auto wkt = [](const Georeference& georeference) {
        return georeference.crs() ? georeference.crs()->wkt() : std::string();
    };
    return there.sceneFrame() == here.sceneFrame() && there.transform() == here.transform() &&
           wkt(there) == wkt(here);
}

// Where one of the maps was in the picture before, the same piece of it stays in sight. Otherwise a
// map that was shown once is seen again as it was left.
std::optional<Sight> sightToGoOnWith(const ShownScene& before,
                                     const ShownScene& now,
                                     const OrbitCamera& goal,
                                     const SightMemory& memory)
{
    for (const SceneMap& shown : now.ground().maps()) {
        for (const SceneMap& then : before.ground().maps()) {
            if (shown.map == then.map) {
                OrbitCamera camera = goal;
                camera.target =
                    shown.frame.toScene(then.frame.toGrid(camera.target), camera.target.z);
                return Sight{.camera = camera, .exaggeration = before.style.exaggeration};
            }
        }
    }
    return memory.find(now.map());
}

} // namespace

void SightMemory::remember(const std::shared_ptr<const Map>& map, const Sight& sight)
{
    std::erase_if(entries_, [&map](const Entry& entry) {
        const auto known = entry.map.lock();
        return !known || known == map;
    });
    entries_.push_back({.map = map, .sight = sight});
}

void SightMemory::replacePreview(const std::shared_ptr<const Map>& preview,
                                 const std::shared_ptr<const Map>& map)
{
    for (Entry& entry : entries_) {
        if (entry.map.lock() == preview) {
            entry.map = map;
        }
    }
}

std::optional<Sight> SightMemory::find(const std::shared_ptr<const Map>& map) const
{
    const auto known = std::find_if(entries_.begin(), entries_.end(),
                                    [&map](const Entry& entry) { return entry.map.lock() == map; });
    return known != entries_.end() ? std::optional(known->sight) : std::nullopt;
}

NextSight nextSight(const ShownScene& before,
                    const ShownScene& now,
                    const OrbitCamera& goal,
                    const SightMemory& memory,
                    std::optional<double> exaggeration)
{
    const auto& left = before.map();
    const auto& map = now.map();
    const double present = before.style.exaggeration;
    if (!map) {
        return {.exaggeration = present, .camera = std::nullopt};
    }
    const bool is_other_place = !left || !isSamePlace(*left, *map);
    // A map that replaces its preview keeps the preview's view, even if another would suit it.
    const bool is_suited =
        left && !isOfSameMap(*left, *map) && present == suitableExaggeration(*left);
    std::optional<Sight> sight;
    if (is_other_place) {
        sight = sightToGoOnWith(before, now, goal, memory);
    } else if (is_suited) {
        // The heights may have changed, as when the user sets the nodata value.
        const double suitable = suitableExaggeration(*map);
        sight = Sight{.camera = reexaggerated(goal, present, suitable), .exaggeration = suitable};
    }
    const double chosen = sight            ? sight->exaggeration
                          : is_other_place ? suitableExaggeration(*map)
                                           : present;
    if (exaggeration && *exaggeration != chosen) {
        if (sight || !is_other_place) { // otherwise the opening view follows
            const OrbitCamera camera = sight ? sight->camera : goal;
            sight = Sight{.camera = reexaggerated(camera, chosen, *exaggeration),
                          .exaggeration = *exaggeration};
        }
    }
    return {.exaggeration = exaggeration.value_or(chosen),
            .camera = sight ? std::optional(sight->camera) : std::nullopt,
            .is_opening = is_other_place && !sight};
}

bool isCompletionOf(const ShownScene& before, const ShownScene& now)
{
    const auto& then = before.layers();
    return std::any_of(then.begin(), then.end(), [&now](const ShownLayer& old) {
        const auto& layers = now.layers();
        return std::any_of(layers.begin(), layers.end(), [&old](const ShownLayer& layer) {
            return old.map != layer.map && isOfSameMap(*old.map, *layer.map);
        });
    });
}

} // namespace marsview
