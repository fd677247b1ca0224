// Terrain for tests, from formulas and random numbers.
#pragma once

#include "core/geo/scene_frame.h"
#include "core/terrain/heightfield.h"
#include "core/terrain/surface_analysis.h"
#include "tests/support/random.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace marsview::test {

/// Elevation of a sample in meters; NaN for a void.
using HeightFunction = std::function<double(std::size_t column, std::size_t row)>;

/// Samples as floats.
Heightfield floatTerrain(std::size_t columns, std::size_t rows, const HeightFunction& height_m);

/// Samples as int16, rounded to `scale`; -32768 is void.
Heightfield int16Terrain(std::size_t columns,
                         std::size_t rows,
                         const ElevationScale& scale,
                         const HeightFunction& height_m);

/// Elevations like those of mountains: octaves of interpolated noise, each with half the wavelength
/// and `roughness` times the amplitude of the previous one; within ±`relief_m`. Row by row.
std::vector<double> fractalHeights(
    Random& random, std::size_t columns, std::size_t rows, double relief_m, double roughness);

/// `heights`, row by row, as a function.
HeightFunction heightsFrom(std::vector<double> heights, std::size_t columns);

/// The analysis of a heightfield, without cancellation.
std::shared_ptr<const SurfaceAnalysis> analyzed(const Heightfield& heightfield);

/// North up, around the middle of the grid.
SceneFrame northUpFrame(std::size_t columns, std::size_t rows, double pixel_m);

} // namespace marsview::test
