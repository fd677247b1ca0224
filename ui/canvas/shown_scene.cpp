#include "ui/canvas/shown_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace marsview {

void ShownScene::setLayers(const std::vector<ShownLayer>& top_first)
{
    layers_ = top_first;
    std::vector<std::shared_ptr<const Map>> maps;
    for (const ShownLayer& layer : top_first) {
        maps.push_back(layer.map);
    }
    ground_ = SceneSurface(maps);
}

const std::shared_ptr<const Map>& ShownScene::map() const noexcept
{
    static const std::shared_ptr<const Map> kNone;
    return layers_.empty() ? kNone : layers_.front().map;
}

const ColorRamp* ShownScene::ramp() const noexcept
{
    return layers_.empty() ? nullptr : layers_.front().ramp;
}

double ShownScene::groundHeight(double east_m, double north_m) const
{
    return ground_.height(east_m, north_m) * style.exaggeration;
}

std::optional<GroundPoint> ShownScene::groundBelow(const ScenePoint& place) const
{
    const auto index = ground_.mapAt(place.x, place.y);
    if (!index) {
        return std::nullopt;
    }
    return GroundPoint{.index = *index,
                       .grid = ground_.maps()[*index].frame.toGrid(place),
                       .height_m = ground_.height(place.x, place.y)};
}

std::optional<GroundPoint> ShownScene::cast(const Ray& ray) const
{
    return ground_.cast(ray, style.exaggeration);
}

double ShownScene::voidLevelM() const
{
    const HeightRange range =
        map() ? map()->heightfield().range().value_or(HeightRange{}) : HeightRange{};
    return std::clamp(0.0, range.minimum_m, range.maximum_m);
}

double ShownScene::sceneHeight(double height_m) const
{
    return (std::isnan(height_m) ? voidLevelM() : height_m) * style.exaggeration;
}

std::optional<GroundPoint> ShownScene::voidOn(const Ray& ray) const
{
    const double t =
        (sceneHeight(std::numeric_limits<double>::quiet_NaN()) - ray.origin.z) / ray.direction.z;
    if (!(t > 0.0)) {
        return std::nullopt;
    }
    const ScenePoint place = ray.at(t);
    for (std::size_t i = 0; i < ground_.maps().size(); ++i) {
        const SceneMap& shown = ground_.maps()[i];
        const GridPoint grid = shown.frame.toGrid(place);
        const Heightfield& heightfield = shown.map->heightfield();
        if (grid.column >= 0.0 && grid.column <= static_cast<double>(heightfield.columns() - 1) &&
            grid.row >= 0.0 && grid.row <= static_cast<double>(heightfield.rows() - 1) &&
            std::isnan(heightfield.heightNow(grid))) {
            return GroundPoint{.index = i,
                               .grid = grid,
                               .height_m = std::numeric_limits<double>::quiet_NaN(),
                               .distance_m = t};
        }
    }
    return std::nullopt;
}

ScenePoint ShownScene::placeOf(const GroundPoint& ground) const
{
    return ground_.maps()[ground.index].frame.toScene(ground.grid, sceneHeight(ground.height_m));
}

ScenePoint ShownScene::placeOf(GridPoint grid, double height_m) const
{
    return map()->georeference().sceneFrame().toScene(grid, sceneHeight(height_m));
}

RayHit ShownScene::onTopmost(const GroundPoint& ground) const
{
    const ScenePoint place = ground_.maps()[ground.index].frame.toScene(ground.grid, 0.0);
    return {.grid = ground.index == 0 ? ground.grid : ground_.maps().front().frame.toGrid(place),
            .height_m = ground.height_m,
            .t = ground.distance_m};
}

} // namespace marsview
