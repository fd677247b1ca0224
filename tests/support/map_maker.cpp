#include "tests/support/map_maker.h"

#include <stdexcept>
#include <vector>

namespace marsview::test {

std::shared_ptr<const Map> loadedMap(const std::string& path)
{
    JobMonitor monitor;
    auto map = readMap(RasterSpec{path, 1, {}}, monitor, std::size_t{1} << 30);
    if (!map) {
        throw std::runtime_error(map.error().message);
    }
    return std::move(map).value();
}

Result<std::shared_ptr<const Map>> overridden(const Map& map, const RasterOverrides& overrides)
{
    JobMonitor monitor;
    return withOverrides(map, overrides, monitor);
}

std::shared_ptr<const Map> MapMaker::make(const Place& place, const Height& height)
{
    std::vector<double> samples;
    for (std::size_t row = 0; row < place.rows; ++row) {
        for (std::size_t column = 0; column < place.columns; ++column) {
            samples.push_back(height(column, row));
        }
    }
    RasterRecipe recipe = recipeFor(place.columns, samples);
    recipe.transform = place.transform;
    recipe.srs = place.srs;
    return loadedMap(writeVrt(folder_, "made" + std::to_string(count_++), recipe));
}

} // namespace marsview::test
