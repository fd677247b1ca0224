#include "app/console/scene.h"

#include "app/console/long_job.h"
#include "core/session/open_map.h"
#include "core/view/color_ramp.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <string_view>
#include <system_error>
#include <utility>

namespace marsview {
namespace {

constexpr int kSideMax = 16384;

} // namespace

const ColorRamp& Scene::ramp() const
{
    const Body* body = map->info().body;
    return defaultColorRamp(body != nullptr ? body->name : std::string_view{});
}

SceneBox Scene::box(double with_exaggeration) const
{
    const Heightfield& heightfield = map->heightfield();
    return sceneBox(map->georeference().sceneFrame(), heightfield.columns(), heightfield.rows(),
                    heightfield.range().value_or(HeightRange{}), with_exaggeration);
}

double Scene::ground(double east_m, double north_m, double with_exaggeration, Ground which) const
{
    const GridPoint grid = map->georeference().sceneFrame().toGrid({east_m, north_m, 0.0});
    const Heightfield& heightfield = map->heightfield();
    const double height_m =
        which == Ground::Waiting ? heightfield.heightWaiting(grid) : heightfield.height(grid);
    return height_m * with_exaggeration;
}

OrbitCamera Scene::bounded(const OrbitCamera& camera, double with_exaggeration, Ground which) const
{
    const Georeference& georeference = map->georeference();
    return constrained(
        camera,
        navigationLimits(box(with_exaggeration), std::min(georeference.pixelWidthMeters(),
                                                          georeference.pixelHeightMeters())),
        [&](double east_m, double north_m) {
            return ground(east_m, north_m, with_exaggeration, which);
        });
}

Result<Scene> emptyScene(std::function<void()> notify)
{
    Result<std::unique_ptr<EglContext>> context = EglContext::create();
    if (!context) {
        return std::move(context).error();
    }
    Result<std::unique_ptr<TerrainRenderer>> renderer = TerrainRenderer::create(std::move(notify));
    if (!renderer) {
        return std::move(renderer).error();
    }
    return Scene{.context = std::move(context).value(),
                 .renderer = std::move(renderer).value(),
                 .map = {},
                 .exaggeration = 1.0};
}

void showIn(Scene& scene, std::shared_ptr<const Map> map, const ColorRamp* ramp)
{
    scene.map = std::move(map);
    scene.renderer->setLayers({terrainLayer(scene.map, scene.map->georeference().sceneFrame(),
                                            ramp != nullptr ? *ramp : scene.ramp())});
    scene.exaggeration = suitableExaggeration(*scene.map);
}

Status showOnBody(Scene& scene,
                  std::shared_ptr<const Map> map,
                  const ColorRamp* ramp,
                  const PileOptions& pile)
{
    LongJob job("placing");
    Result<std::vector<BodyTerrain>> maps = pileOnBody(map, pile, job.monitor());
    if (!maps) {
        return std::move(maps).error();
    }
    scene.map = std::move(map);
    scene.body_grid = maps->front().grid();
    const ColorRamp& colors = ramp != nullptr ? *ramp : scene.ramp();
    HeightRange range = scene.map->tintRange();
    for (const BodyTerrain& terrain : *maps) {
        const HeightRange& own = terrain.map()->tintRange();
        range = {std::min(range.minimum_m, own.minimum_m),
                 std::max(range.maximum_m, own.maximum_m)};
    }
    std::vector<TerrainLayer> layers;
    for (const BodyTerrain& terrain : *maps) {
        layers.push_back(
            terrainLayer(terrain.shown(), terrain.map()->georeference().sceneFrame(), colors));
        layers.back().body = terrain.grid();
        layers.back().tint_range = tintedRange(colors, range);
        layers.back().slope_range = scene.map->slopeRange();
    }
    scene.renderer->setLayers(std::move(layers));
    scene.on_body = BodyScene(std::move(maps).value());
    scene.exaggeration = suitableExaggeration(*scene.map);
    return Done{};
}

Result<Scene> openScene(const MapOptions& options,
                        const ColorRamp* ramp,
                        std::function<void()> notify,
                        SceneKind kind,
                        const PileOptions& pile)
{
    Result<Scene> scene = emptyScene(std::move(notify));
    if (!scene) {
        return scene;
    }
    LongJob job("reading");
    Result<std::shared_ptr<const Map>> map =
        openMap(options.spec(), defaultMapResources(), job.monitor());
    if (!map) {
        return std::move(map).error();
    }
    if (kind == SceneKind::Body) {
        if (Status shown = showOnBody(*scene, std::move(map).value(), ramp, pile); !shown) {
            return std::move(shown).error();
        }
        return scene;
    }
    showIn(*scene, std::move(map).value(), ramp);
    return scene;
}

Result<Viewport> viewportFrom(const std::string& text)
{
    Viewport size;
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.width);
    const bool has_cross = width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x';
    const auto height = has_cross ? std::from_chars(width.ptr + 1, end, size.height) : width;
    if (!has_cross || height.ec != std::errc{} || height.ptr != end) {
        return Error{ErrorCode::Invalid,
                     fmt::format("--size: \"{}\" is not a size; write it as 1280x800", text)};
    }
    if (size.width < 1 || size.height < 1 || size.width > kSideMax || size.height > kSideMax) {
        return Error{ErrorCode::OutOfRange, fmt::format("--size: {} is outside 1x1 to {}x{} pixels",
                                                        text, kSideMax, kSideMax)};
    }
    return size;
}

CLI::Validator pictureSize()
{
    return {[](std::string& text) {
                constexpr std::string_view kName = "--size: "; // the parser writes it too
                const Result<Viewport> size = viewportFrom(text);
                return size ? std::string() : size.error().message.substr(kName.size());
            },
            ""};
}

} // namespace marsview
