#include "app/console/map_pile.h"

#include "app/console/number_checks.h"
#include "core/feather/feathered_map.h"
#include "core/session/open_map.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <utility>

namespace marsview {
namespace {

Error namedError(const Map& map, const Error& error)
{
    return {error.code, fmt::format("{}: {}", map.spec().path, error.message)};
}

Result<std::vector<std::shared_ptr<const Map>>> openPile(const std::shared_ptr<const Map>& map,
                                                         const std::vector<std::string>& below,
                                                         JobMonitor& monitor)
{
    std::vector<std::shared_ptr<const Map>> maps{map};
    const MapResources resources = defaultMapResources();
    for (const std::string& path : below) {
        auto opened = openMap({.path = path}, resources, monitor);
        if (!opened) {
            return std::move(opened).error();
        }
        if ((*opened)->info().body != map->info().body) {
            const auto name = [](const Map& of) {
                return of.info().body != nullptr ? of.info().body->name : "an unknown body";
            };
            return Error{ErrorCode::Invalid,
                         fmt::format("{}: is a map of {}, {} of {}; maps on top of each other "
                                     "need one body",
                                     path, name(**opened), map->spec().path, name(*map))};
        }
        maps.push_back(std::move(opened).value());
    }
    return maps;
}

} // namespace

void PileOptions::addTo(CLI::App& command)
{
    // Without a check of its values, one each time: the next word is the map.
    command
        .add_option("--below", below,
                    "another map of the body, below this one; repeated, for maps further below; "
                    "with --scene body")
        ->type_name("FILE");
    command
        .add_option("--feather", feather_cells,
                    "cells of a map over which its edges are blended into the maps below it")
        ->capture_default_str()
        ->check(wholeNumberFrom(0, static_cast<int>(kFeatherCellsMax)));
}

std::vector<std::string> PileOptions::withPath(const std::string& top) const
{
    std::vector<std::string> paths{top};
    paths.insert(paths.end(), below.begin(), below.end());
    return paths;
}

void PileOptions::check(SceneKind scene)
{
    for (std::string& path : below) {
        if (const std::string problem = fileName()(path); !problem.empty()) {
            throw CLI::ValidationError("--below", problem);
        }
    }
    if (!below.empty() && scene != SceneKind::Body) {
        throw CLI::ValidationError("--below",
                                   "maps lie on top of each other on a body; add --scene body");
    }
    if (feather_cells > 0 && below.empty()) {
        throw CLI::ValidationError("--feather", "nothing lies below the map; add --below");
    }
}

Result<std::vector<BodyTerrain>>
pileOnBody(const std::shared_ptr<const Map>& map, const PileOptions& options, JobMonitor& monitor)
{
    auto maps = openPile(map, options.below, monitor);
    if (!maps) {
        return std::move(maps).error();
    }
    const auto& crs = maps->back()->georeference().crs();
    const std::optional<Ellipsoid> ellipsoid = crs ? crs->ellipsoid() : std::nullopt;
    std::vector<BodyTerrain> pile; // the lowest first
    for (auto own = maps->rbegin(); own != maps->rend(); ++own) {
        auto grid = BodyGrid::make((*own)->georeference(), monitor, ellipsoid);
        if (!grid) {
            return namedError(**own, grid.error());
        }
        const BodyTerrain plain(*own, std::move(grid).value());
        const std::vector<BodyTerrain> below(pile.rbegin(), pile.rend());
        auto shown = featheredMap(plain, below, options.feather_cells, monitor);
        if (!shown) {
            return std::move(shown).error();
        }
        pile.emplace_back(*own, plain.grid(), std::move(shown).value());
    }
    std::reverse(pile.begin(), pile.end());
    return pile;
}

} // namespace marsview
