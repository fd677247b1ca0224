#include "tests/support/map_maker.h"

#include <stdexcept>
#include <vector>

namespace marsview::test {

LoadedMap loadedMap(const std::string& path)
{
    JobMonitor monitor;
    auto dataset = loadDataset({path, 1, {}}, monitor, std::size_t{1} << 30);
    if (!dataset) {
        throw std::runtime_error(dataset.error().message);
    }
    return prepareMap(std::move(dataset).value(), monitor).value();
}

LoadedMap MapMaker::make(const Place& place, const Height& height)
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
