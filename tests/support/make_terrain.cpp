#include "tests/support/make_terrain.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace marsview::test {
namespace {

template <typename T, typename Raw>
Heightfield terrain(SampleType type,
                    std::size_t columns,
                    std::size_t rows,
                    const ElevationScale& scale,
                    const VoidRule& rule,
                    const Raw& raw)
{
    SampleGrid grid = SampleGrid::create(type, columns, rows).value();
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            const T value = raw(column, row);
            std::memcpy(grid.rowData(row) + column * sizeof(T), &value, sizeof(T));
        }
    }
    const SampleStatistics statistics = grid.applyRule(rule, 0, rows);
    if (statistics.void_count == 0) {
        grid.clearVoids();
    }
    return {std::make_shared<const SampleGrid>(std::move(grid)), statistics, scale};
}

} // namespace

Heightfield floatTerrain(std::size_t columns, std::size_t rows, const HeightFunction& height_m)
{
    return terrain<float>(SampleType::Float32, columns, rows, {}, {},
                          [&](std::size_t column, std::size_t row) {
                              return static_cast<float>(height_m(column, row));
                          });
}

Heightfield int16Terrain(std::size_t columns,
                         std::size_t rows,
                         const ElevationScale& scale,
                         const HeightFunction& height_m)
{
    constexpr std::int16_t kVoid = std::numeric_limits<std::int16_t>::min();
    return terrain<std::int16_t>(SampleType::Int16, columns, rows, scale, {.nodata = kVoid},
                                 [&](std::size_t column, std::size_t row) {
                                     const double height = height_m(column, row);
                                     return std::isnan(height)
                                                ? kVoid
                                                : static_cast<std::int16_t>(std::lround(
                                                      (height - scale.offset_m) / scale.gain));
                                 });
}

std::vector<double> fractalHeights(
    Random& random, std::size_t columns, std::size_t rows, double relief_m, double roughness)
{
    std::vector<double> heights(columns * rows);
    double amplitude = 1.0;
    double sum = 0.0;
    std::size_t spacing = 1;
    while (spacing < std::max(columns, rows)) {
        spacing *= 2;
    }
    for (; spacing >= 1; spacing /= 2) {
        const std::size_t across = columns / spacing + 2;
        const std::size_t down = rows / spacing + 2;
        std::vector<double> lattice(across * down);
        for (double& value : lattice) {
            value = random.uniform(-1.0, 1.0);
        }
        const auto step = static_cast<double>(spacing);
        for (std::size_t row = 0; row < rows; ++row) {
            const double v = static_cast<double>(row % spacing) / step;
            for (std::size_t column = 0; column < columns; ++column) {
                const double u = static_cast<double>(column % spacing) / step;
                const double* at = &lattice[row / spacing * across + column / spacing];
                const double above = at[0] * (1.0 - u) + at[1] * u;
                const double below = at[across] * (1.0 - u) + at[across + 1] * u;
                heights[row * columns + column] += amplitude * (above * (1.0 - v) + below * v);
            }
        }
        sum += amplitude;
        amplitude *= roughness;
    }
    for (double& height : heights) {
        height *= relief_m / sum;
    }
    return heights;
}

HeightFunction heightsFrom(std::vector<double> heights, std::size_t columns)
{
    return [heights = std::move(heights), columns](std::size_t column, std::size_t row) {
        return heights[row * columns + column];
    };
}

std::shared_ptr<const SurfaceAnalysis> analyzed(const Heightfield& heightfield)
{
    JobMonitor monitor;
    return analyze(heightfield, monitor).value();
}

SceneFrame northUpFrame(std::size_t columns, std::size_t rows, double pixel_m)
{
    return {.origin = {static_cast<double>(columns - 1) / 2.0, static_cast<double>(rows - 1) / 2.0},
            .east_per_column = pixel_m,
            .east_per_row = 0.0,
            .north_per_column = 0.0,
            .north_per_row = -pixel_m};
}

} // namespace marsview::test
