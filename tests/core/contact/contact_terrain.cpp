#include "tests/core/contact/contact_terrain.h"

#include "core/session/map.h"
#include "tests/support/fractal_terrain.h"
#include "tests/support/reference_surface.h"
#include "tests/support/shared_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace marsview::test {
namespace {

using Shape = double (*)(int column, int row);

std::vector<float> shaped(int columns, int rows, Shape shape)
{
    std::vector<float> heights;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            heights.push_back(static_cast<float>(shape(column, row)));
        }
    }
    return heights;
}

} // namespace

std::shared_ptr<const FilledHeightfield> filledTerrain(const Heightfield& heightfield)
{
    JobMonitor monitor;
    return std::make_shared<const FilledHeightfield>(
        FilledHeightfield::build(heightfield, *analyze(heightfield, monitor), monitor).value());
}

std::shared_ptr<const FilledHeightfield> filledTerrain(std::size_t columns,
                                                       const std::vector<float>& heights)
{
    const std::size_t rows = heights.size() / columns;
    SampleGrid grid = SampleGrid::create(SampleType::Float32, columns, rows).value();
    for (std::size_t row = 0; row < rows; ++row) {
        std::memcpy(grid.rowData(row), heights.data() + row * columns, columns * sizeof(float));
    }
    const SampleStatistics statistics = grid.applyRule({}, 0, rows);
    return filledTerrain(
        Heightfield(std::make_shared<const SampleGrid>(std::move(grid)), statistics, {}));
}

SceneFrame unitFrame(const FilledHeightfield& terrain)
{
    return {.origin = {static_cast<double>(terrain.columns() - 1) / 2.0,
                       static_cast<double>(terrain.rows() - 1) / 2.0}};
}

HeightfieldSurface surfaceOver(const std::shared_ptr<const FilledHeightfield>& terrain,
                               double exaggeration)
{
    return {terrain, unitFrame(*terrain), exaggeration};
}

std::vector<NamedTerrain> syntheticTerrains()
{
    const auto make = [](int columns, int rows, Shape shape) {
        return filledTerrain(static_cast<std::size_t>(columns), shaped(columns, rows, shape));
    };
    std::vector<NamedTerrain> terrains{
        {"flat", make(40, 40, [](int, int) { return 5.0; })},
        {"plane", make(40, 37, [](int c, int r) { return 0.5 * c - 0.25 * r; })},
        {"ridge along columns", make(41, 41, [](int c, int) { return -std::abs(c - 20.0); })},
        {"valley along columns", make(41, 41, [](int c, int) { return std::abs(c - 20.0); })},
        {"valley along the diagonals",
         make(41, 41, [](int c, int r) { return std::abs(c - r) * 1.0; })},
        {"valley across the diagonals",
         make(41, 41, [](int c, int r) { return std::abs(c + r - 40.0); })},
        {"pyramid",
         make(41, 41,
              [](int c, int r) { return -std::max(std::abs(c - 20.0), std::abs(r - 20.0)); })},
        {"pit",
         make(41, 41,
              [](int c, int r) { return std::max(std::abs(c - 20.0), std::abs(r - 20.0)); })},
        {"checkerboard",
         make(40, 40, [](int c, int r) { return (c + r) % 2 == 0 ? 20.0 : -20.0; })},
        {"stairs of ties",
         make(40, 40, [](int c, int r) { return std::floor((c + 2 * r) / 7.0); })},
        {"terraces", make(40, 40,
                          [](int c, int r) {
                              return std::round(3.0 * std::sin(c * 0.4) * std::cos(r * 0.3));
                          })},
        {"cliff", make(40, 40, [](int c, int) { return c < 20 ? 0.0 : 30000.0; })},
        {"needles",
         make(40, 40, [](int c, int r) { return c % 5 == 2 && r % 5 == 2 ? 50.0 : 0.0; })},
        {"holes",
         make(40, 40, [](int c, int r) { return c % 5 == 2 && r % 5 == 2 ? -50.0 : 0.0; })},
        {"2 × 2, saddle", make(2, 2, [](int c, int r) { return c == r ? 1.0 : 0.0; })},
        {"2 × 2, flat", make(2, 2, [](int, int) { return 0.0; })},
        {"2 × 30", make(2, 30, [](int c, int r) { return std::sin(r * 1.0) + c; })},
        {"voids", make(70, 50,
                       [](int c, int r) {
                           const bool is_void =
                               (c - 30) * (c - 30) + (r - 20) * (r - 20) < 150 || (c * r) % 11 == 7;
                           return is_void ? std::numeric_limits<double>::quiet_NaN()
                                          : 2.0 * std::sin(c * 0.3) + r * 0.2;
                       })},
    };
    for (const double scale : {0.1, 1.0, 5.0, 20.0}) {
        std::vector<float> heights = fractalHeights(130, 97, 4);
        for (float& height : heights) {
            height *= static_cast<float>(scale);
        }
        terrains.push_back({"fractal × " + std::to_string(scale), filledTerrain(130, heights)});
        for (float& height : heights) {
            height = std::round(height);
        }
        terrains.push_back(
            {"whole fractal × " + std::to_string(scale), filledTerrain(130, heights)});
    }
    return terrains;
}

double bruteHeight(const HeightfieldSurface& surface, GridPoint grid)
{
    const FilledHeightfield& terrain = *surface.terrain();
    const auto cell = [](double position, std::size_t samples) {
        const double last = static_cast<double>(samples) - 2.0;
        return static_cast<std::size_t>(std::clamp(std::floor(position), 0.0, last));
    };
    const std::size_t c = cell(grid.column, terrain.columns());
    const std::size_t r = cell(grid.row, terrain.rows());
    const auto sample = [&](std::size_t column, std::size_t row) {
        return static_cast<long double>(terrain.sample(column, row));
    };
    const long double height =
        planeHeight({sample(c, r), sample(c + 1, r), sample(c, r + 1), sample(c + 1, r + 1)},
                    static_cast<long double>(grid.column) - static_cast<long double>(c),
                    static_cast<long double>(grid.row) - static_cast<long double>(r));
    return static_cast<double>(height * static_cast<long double>(surface.exaggeration()));
}

ScenePoint wanderingGoal(Random& random,
                         const HeightfieldSurface& surface,
                         const ScenePoint& last,
                         double step_cells)
{
    const FilledHeightfield& terrain = *surface.terrain();
    const double columns = static_cast<double>(terrain.columns());
    const double rows = static_cast<double>(terrain.rows());
    GridPoint grid = surface.frame().toGrid(last);
    if (random.chance(0.02)) {
        grid = {random.uniform(-0.2, 1.2) * columns, random.uniform(-0.2, 1.2) * rows};
    } else {
        grid.column += random.uniform(-step_cells, step_cells);
        grid.row += random.uniform(-step_cells, step_cells);
    }
    if (random.chance(0.2)) {
        grid = {std::round(grid.column * 2.0) / 2.0, std::round(grid.row * 2.0) / 2.0};
    }
    grid.column = std::clamp(grid.column, -0.3 * columns, 1.3 * columns);
    grid.row = std::clamp(grid.row, -0.3 * rows, 1.3 * rows);
    const double cell_m =
        std::hypot(surface.frame().east_per_column, surface.frame().north_per_column);
    double z = bruteHeight(surface, {std::clamp(grid.column, 0.0, columns - 1.0),
                                     std::clamp(grid.row, 0.0, rows - 1.0)});
    z += random.chance(0.1)   ? 0.0
         : random.chance(0.2) ? random.uniform(0.0, 3.0) * cell_m
                              : -random.uniform(0.0, 6.0) * cell_m;
    return surface.frame().toScene(grid, z);
}

ShearedFrame shearedFrame(const FilledHeightfield& terrain, Random& random, bool is_mirrored)
{
    SceneFrame frame = unitFrame(terrain);
    const double angle = random.uniform(0.0, 6.3);
    const double cell_m = std::pow(10.0, random.uniform(-2.0, 5.0));
    const double aspect = random.uniform(0.4, 2.5);
    const double shear = random.uniform(-0.7, 0.7);
    const double mirror = is_mirrored ? -1.0 : 1.0;
    frame.east_per_column = cell_m * std::cos(angle);
    frame.north_per_column = cell_m * std::sin(angle);
    frame.east_per_row = mirror * cell_m * aspect * std::cos(angle + 1.57 + shear);
    frame.north_per_row = mirror * cell_m * aspect * std::sin(angle + 1.57 + shear);
    return {frame, cell_m};
}

NamedMap bundledMap(const std::string& file)
{
    JobMonitor monitor;
    const auto map =
        readMap(RasterSpec{(bundledSamples() / file).string()}, monitor, std::size_t{1} << 30U);
    if (!map) {
        throw std::runtime_error(map.error().message);
    }
    return {file, filledTerrain((*map)->heightfield()), (*map)->georeference().sceneFrame()};
}

std::vector<NamedMap> bundledMaps()
{
    return {bundledMap("mars_mola_4ppd.tif"), bundledMap("mount_st_helens_30m.tif")};
}

} // namespace marsview::test
