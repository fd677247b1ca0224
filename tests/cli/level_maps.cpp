#include "tests/cli/level_maps.h"

#include "tests/support/make_raster.h"

#include <vector>

namespace marsview::test {

std::string writeLevelMars(const TempFolder& folder,
                           const std::string& name,
                           std::size_t side,
                           const std::array<double, 3>& west_north_cell,
                           float height_m)
{
    const auto [west_deg, north_deg, cell_deg] = west_north_cell;
    RasterRecipe recipe = recipeFor(side, std::vector<float>(side * side, height_m));
    recipe.transform = {west_deg, cell_deg, 0.0, north_deg, 0.0, -cell_deg};
    recipe.srs = "IAU_2015:49900";
    return writeVrt(folder, name, recipe);
}

} // namespace marsview::test
