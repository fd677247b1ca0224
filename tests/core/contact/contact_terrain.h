// Terrain for contact tests, and the true contact computed independently of every model.
#pragma once

#include "app/bench/reference/local_minimum.h"
#include "core/contact/heightfield_surface.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace marsview::test {

std::shared_ptr<const FilledHeightfield> filledTerrain(std::size_t columns,
                                                       const std::vector<float>& heights);

std::shared_ptr<const FilledHeightfield> filledTerrain(const Heightfield& heightfield);

/// Cells of 1 m, row 0 in the north, the origin in the middle.
SceneFrame unitFrame(const FilledHeightfield& terrain);

/// A heightfield in that frame.
HeightfieldSurface surfaceOver(const std::shared_ptr<const FilledHeightfield>& terrain,
                               double exaggeration = 1.0);

/// A frame of cells of any size and shape, turned, sheared, and mirrored if so asked.
struct ShearedFrame {
    SceneFrame frame;
    double cell_m = 0.0; // along a row
};
ShearedFrame shearedFrame(const FilledHeightfield& terrain, Random& random, bool is_mirrored);

/// In meters.
inline double distance(const ScenePoint& a, const ScenePoint& b)
{
    return length(a - b);
}

struct NamedTerrain {
    std::string name;
    std::shared_ptr<const FilledHeightfield> terrain;
};

/// Planes, ridges, valleys, peaks, checkerboards, ties, steps, fractals, maps of 2 × 2 samples.
std::vector<NamedTerrain> syntheticTerrains();

struct NamedMap {
    std::string name;
    std::shared_ptr<const FilledHeightfield> terrain;
    SceneFrame frame;
};

/// Throws if the map cannot be read.
NamedMap bundledMap(const std::string& file);
/// One of Mars in longitude and latitude, one of the Earth in meters.
std::vector<NamedMap> bundledMaps();

/// Scene height of the surface in meters, from the plane through three samples, in long double.
double bruteHeight(const HeightfieldSurface& surface, GridPoint grid);

using marsview::clampedGoal;
using marsview::steepestCosine;

/// A goal near the surface, mostly below it. Some goals jump anywhere, also beyond the border; many
/// are on whole and half samples, where ties occur.
ScenePoint wanderingGoal(Random& random,
                         const HeightfieldSurface& surface,
                         const ScenePoint& last,
                         double step_cells);

/// Checks `updates` of the model with such goals; every tenth goal twice.
template <typename Judge, typename Model>
void judgeWandering(Judge& judge,
                    Model& model,
                    const HeightfieldSurface& surface,
                    Random& random,
                    int updates,
                    double step_cells)
{
    ScenePoint goal{};
    for (int i = 0; i < updates && !testing::Test::HasFatalFailure(); ++i) {
        goal = wanderingGoal(random, surface, goal, step_cells);
        judge.check(model, goal);
        if (i % 10 == 9) {
            judge.check(model, goal); // does not move
        }
    }
}

} // namespace marsview::test
