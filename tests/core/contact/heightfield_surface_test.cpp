#include "core/contact/heightfield_surface.h"
#include "core/terrain/ray_cast.h"
#include "tests/core/contact/contact_terrain.h"
#include "tests/support/fractal_terrain.h"
#include "tests/support/make_terrain.h"
#include "tests/support/nan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace marsview {
namespace {

// On z = x + 2 y, in numbers without rounding: a path that ends on the surface touches it there, in
// the middle of either face, on edges and at samples; one that ends above does not.
TEST(HeightfieldSurface, APathThatEndsOnTheSurfaceTouchesItThere)
{
    constexpr std::size_t kSide = 9; // around the origin
    const auto terrain = test::filledTerrain(
        test::floatTerrain(kSide, kSide, [](std::size_t column, std::size_t row) {
            return static_cast<double>(column) - 2.0 * static_cast<double>(row);
        }));
    const HeightfieldSurface surface = test::surfaceOver(terrain);
    for (const GridPoint end : {GridPoint{2.25, 3.5}, GridPoint{2.5, 3.25}, GridPoint{2.5, 3.5},
                                GridPoint{2.0, 3.5}, GridPoint{2.5, 3.0}, GridPoint{2.0, 3.0}}) {
        for (const GridPoint begin : {end, GridPoint{6.5, 1.75}, GridPoint{0.0, 0.0}}) {
            const auto goal = [&](const GridPoint& at, double above_m) {
                return *surface.goal(
                    surface.frame().toScene(at, at.column - 2.0 * at.row + above_m));
            };
            const auto cast = surface.castFree(goal(begin, 1.0), goal(end, 0.0));
            ASSERT_TRUE(cast.contact);
            EXPECT_EQ(surface.gridPoint(*cast.contact), end);
            EXPECT_FALSE(surface.castFree(goal(begin, 1.0), goal(end, 0x1p-20)).contact);
        }
    }
}

TEST(HeightfieldSurface, EdgesOfTheBorderHaveOneFace)
{
    constexpr std::int32_t kSide = 4;
    const auto terrain = test::filledTerrain(kSide, std::vector<float>(kSide * kSide, 0.0F));
    for (const double east : {1.0, -1.0}) { // mirrored
        SceneFrame frame = test::unitFrame(*terrain);
        frame.east_per_column = east;
        const HeightfieldSurface surface(terrain, frame, 1.0);
        for (std::int32_t row = 0; row < kSide; ++row) {
            for (std::int32_t column = 0; column < kSide; ++column) {
                const auto has_two = [&](std::int32_t columns, std::int32_t rows) {
                    return surface
                        .edgeFacets(
                            surface.edgeBetween({column, row}, {column + columns, row + rows}))
                        .has_right;
                };
                if (column + 1 < kSide) {
                    EXPECT_EQ(has_two(1, 0), row > 0 && row + 1 < kSide);
                }
                if (row + 1 < kSide) {
                    EXPECT_EQ(has_two(0, 1), column > 0 && column + 1 < kSide);
                }
                if (column + 1 < kSide && row + 1 < kSide) {
                    EXPECT_TRUE(has_two(1, 1));
                }
            }
        }
    }
}

// Samples read as they are stored: their elevation times the exaggeration, and in voids that of the
// filled terrain.
TEST(HeightfieldSurface, PlainHeightsAreExaggeratedInVoidsToo)
{
    constexpr std::size_t kSide = 20;
    constexpr double kExaggeration = 3.0;
    const auto height = [](std::size_t column, std::size_t row) {
        const bool is_void = column % 7 == 3 && row % 5 > 2;
        return is_void ? kNan : 8.0 * static_cast<double>(column) - 0.5 * static_cast<double>(row);
    };
    const auto expectHeights = [&](const auto& heights, const FilledHeightfield& terrain) {
        int voids = 0;
        for (std::size_t row = 0; row < kSide; ++row) {
            for (std::size_t column = 0; column < kSide; ++column) {
                const bool is_void = std::isnan(height(column, row));
                voids += is_void ? 1 : 0;
                EXPECT_EQ(
                    heights.at(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row)),
                    kExaggeration * (is_void ? terrain.sample(column, row) : height(column, row)));
            }
        }
        EXPECT_GT(voids, 20);
    };
    const auto whole = test::filledTerrain(test::int16Terrain(kSide, kSide, {0.5, 100.0}, height));
    expectHeights(PlainHeights<std::int16_t>(*whole, kExaggeration), *whole);
    expectHeights(FilledHeights(*whole, kExaggeration), *whole);
    const auto floats = test::filledTerrain(test::floatTerrain(kSide, kSide, height));
    expectHeights(PlainHeights<float>(*floats, kExaggeration), *floats);
    expectHeights(FilledHeights(*floats, kExaggeration), *floats);
}

TEST(HeightfieldSurface, CastsMatchRays)
{
    test::Random random;
    for (const double scale : {0.1, 1.0, 20.0}) {
        const auto terrain = test::filledTerrain(230, test::fractalHeights(230, 170, 9));
        SceneFrame frame = test::unitFrame(*terrain);
        frame.east_per_row = 0.3;
        const HeightfieldSurface surface(terrain, frame, scale);
        JobMonitor monitor;
        const Heightfield& heightfield = terrain->heightfield();
        const MinMaxPyramid pyramid = MinMaxPyramid::build(heightfield, monitor).value();
        long hits = 0;
        for (int i = 0; i < 20000; ++i) {
            const auto place = [&](double above) {
                GridPoint grid{random.uniform(0.0, 229.0), random.uniform(0.0, 169.0)};
                if (random.chance(0.3)) {
                    grid = {std::round(grid.column), std::round(grid.row)};
                }
                return frame.toScene(grid, surface.height(grid) + above);
            };
            const ScenePoint from = place(random.uniform(0.01, 8.0) * scale);
            ScenePoint to = place(random.uniform(-8.0, 8.0) * scale);
            if (random.chance(0.5)) {
                to = from + (to - from) * 0.02;
            }
            const auto start = surface.goal(from);
            const auto goal = surface.goal(to);
            ASSERT_TRUE(start && goal);
            const auto cast = surface.castFree(*start, *goal);
            // The reference cast of core/terrain works differently: from the root down through all
            // overlapping nodes.
            auto expected = castRay(heightfield, pyramid, gridRay(from, to - from, frame, scale));
            if (expected && expected->t > 1.0) {
                expected.reset();
            }
            ASSERT_EQ(cast.contact.has_value(), expected.has_value()) << i;
            if (expected) {
                ++hits;
                const GridPoint at = surface.gridPoint(*cast.contact);
                EXPECT_NEAR(at.column, expected->grid.column, 1e-7);
                EXPECT_NEAR(at.row, expected->grid.row, 1e-7);
            }
        }
        EXPECT_GT(hits, 4000);
        EXPECT_LT(hits, 18000);
    }
}

TEST(HeightfieldSurface, CastsPassThroughNoEdgeAndNoVertex)
{
    test::Random random;
    const auto terrain = test::filledTerrain(90, test::fractalHeights(90, 70, 2));
    const HeightfieldSurface surface(terrain, test::unitFrame(*terrain), 1.0);
    for (int i = 0; i < 20000; ++i) {
        // Through a point on a vertex or an edge, steeper than any slope, to just below that point.
        GridPoint on{std::floor(random.uniform(1.0, 88.0)), std::floor(random.uniform(1.0, 68.0))};
        const double along = random.unit();
        const std::size_t kind = random.below(4);
        on.column += kind == 1 || kind == 3 ? along : 0.0;
        on.row += kind == 2 || kind == 3 ? along : 0.0;
        const double height = surface.height(on);
        const Vec3 down{random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), -1.0};
        const ScenePoint point = surface.frame().toScene(on, height);
        const auto from = surface.goal(point - down * 9.0);
        const auto to = surface.goal(point + down * 1e-6);
        ASSERT_TRUE(surface.isAbove(*from));
        ASSERT_FALSE(surface.isAbove(*to));
        const auto cast = surface.castFree(*from, *to);
        ASSERT_TRUE(cast.contact) << i;
        const GridPoint at = surface.gridPoint(*cast.contact);
        EXPECT_NEAR(at.column, on.column, 1e-6);
        EXPECT_NEAR(at.row, on.row, 1e-6);
    }
}

// Level casts across a ridge, at the height of its crest: they only touch it. A nanometer lower
// they end there.
TEST(HeightfieldSurface, ACastThatTouchesARidgePassesOn)
{
    std::vector<float> heights;
    for (int i = 0; i < 41 * 41; ++i) {
        heights.push_back(static_cast<float>(-std::abs(i % 41 - 20)));
    }
    const HeightfieldSurface surface = test::surfaceOver(test::filledTerrain(41, heights));
    for (const double side : {-1.0, 1.0}) {
        for (const double y : {0.0, 0.25, 0.5}) {       // over samples and beside them
            for (const double turn : {0.0, 0.5, 1.0}) { // also along diagonals of cells
                const auto cast = [&](double z) {
                    const double far_m = 5.0 * side;
                    return surface.castFree(*surface.goal({-far_m, y - turn * far_m, z}),
                                            *surface.goal({far_m, y + turn * far_m, z}));
                };
                EXPECT_FALSE(cast(0.0).contact) << side << ' ' << y << ' ' << turn;
                const auto below = cast(-1e-9);
                ASSERT_TRUE(below.contact);
                EXPECT_NEAR(test::distance(surface.point(*below.contact), {0.0, y, 0.0}), 0.0,
                            3e-9);
            }
        }
    }
}

TEST(HeightfieldSurface, CastsThroughFreeSpaceVisitNoCells)
{
    const auto terrain = test::filledTerrain(1500, test::fractalHeights(1500, 1100, 2));
    const HeightfieldSurface surface(terrain, test::unitFrame(*terrain), 1.0);
    const auto from = surface.goal({-740.0, 500.0, 400.0});
    const auto to = surface.goal({740.0, -520.0, 401.0});
    const auto cast = surface.castFree(*from, *to);
    EXPECT_FALSE(cast.contact);
    EXPECT_EQ(cast.cells, 0U);
}

TEST(HeightfieldSurface, HeightIsThatOfTheTriangles)
{
    test::Random random;
    const auto terrain = test::filledTerrain(40, test::fractalHeights(40, 30, 2));
    const HeightfieldSurface surface(terrain, test::unitFrame(*terrain), 2.5);
    for (int i = 0; i < 5000; ++i) {
        const GridPoint grid{random.uniform(0.0, 39.0), random.uniform(0.0, 29.0)};
        EXPECT_NEAR(surface.height(grid), test::bruteHeight(surface, grid), 1e-12);
    }
    EXPECT_EQ(surface.height({-3.0, 90.0}), 2.5 * terrain->sample(0, 29));
}

// A point that moves straight, into the map, out of it or past a corner: where it is clamped, the
// goal moves along the legs and along nothing else.
TEST(HeightfieldSurface, ClampedGoalsMoveAlongTheLegs)
{
    test::Random random;
    const auto terrain = test::filledTerrain(20, test::fractalHeights(20, 12, 3));
    SceneFrame frame = test::unitFrame(*terrain);
    frame.east_per_row = 0.3;
    const HeightfieldSurface surface(terrain, frame, 1.0);
    std::size_t most = 0;
    for (int i = 0; i < 500; ++i) {
        const auto anywhere = [&] {
            GridPoint grid{random.uniform(-20.0, 40.0), random.uniform(-15.0, 30.0)};
            if (i % 4 == 0) { // also along the border and through corners
                grid = {19.0 * std::round(grid.column / 19.0), 11.0 * std::round(grid.row / 11.0)};
            }
            return frame.toScene(grid, random.uniform(-5.0, 5.0));
        };
        const ScenePoint from = anywhere();
        const ScenePoint to = anywhere();
        const auto goal_at = [&](double share) {
            return surface.goalPoint(*surface.goal(from + (to - from) * share));
        };
        const auto legs = surface.legs(from, to);
        ASSERT_GE(legs.count, 1U);
        most = std::max(most, legs.count);
        EXPECT_EQ(surface.goalPoint(legs.ends[legs.count - 1]),
                  surface.goalPoint(*surface.goal(to)));
        std::size_t leg = 0;
        ScenePoint begin = goal_at(0.0);
        for (int k = 0; k <= 200; ++k) {
            const ScenePoint at = goal_at(k / 200.0);
            // On this leg or a later one.
            const auto off_m = [&] {
                const ScenePoint end = surface.goalPoint(legs.ends[leg]);
                return length(at - begin) + length(end - at) - length(end - begin);
            };
            while (off_m() > 1e-9 && leg + 1 < legs.count) {
                begin = surface.goalPoint(legs.ends[leg++]);
            }
            ASSERT_LE(off_m(), 1e-9) << "pair " << i << " at " << k;
        }
        EXPECT_EQ(leg + 1, legs.count) << "pair " << i;
    }
    EXPECT_EQ(most, 5U);
}

TEST(HeightfieldSurface, ReportsFilledVoids)
{
    std::vector<float> heights(std::size_t{20} * 20, 1.0F);
    heights[5 * 20 + 5] = kNanFloat;
    heights[10 * 20 + 18] = kNanFloat;
    const auto terrain = test::filledTerrain(20, heights);
    const SceneFrame frame = test::unitFrame(*terrain);
    const HeightfieldSurface surface(terrain, frame, 1.0);
    const auto is_over_void = [&](double column, double row) {
        return surface.isOverVoid(frame.toScene({column, row}, 1.0));
    };
    EXPECT_TRUE(is_over_void(5.0, 5.0));
    EXPECT_TRUE(is_over_void(5.5, 5.25));
    EXPECT_TRUE(is_over_void(4.75, 4.5));
    EXPECT_FALSE(is_over_void(6.0, 5.5)) << "on the opposite edge";
    EXPECT_FALSE(is_over_void(5.75, 4.125)) << "the other triangle of the cell";
    EXPECT_FALSE(is_over_void(10.0, 10.0));
    // The last column belongs to the last cell, and needs nothing of the one before it.
    EXPECT_TRUE(is_over_void(18.5, 10.0));
    EXPECT_FALSE(is_over_void(19.0, 10.0));
}

TEST(HeightfieldSurfaceDeathTest, RefusesFlatAndInfiniteFrames)
{
    const auto terrain = test::filledTerrain(3, std::vector<float>(9, 1.0F));
    const double infinity = std::numeric_limits<double>::infinity();
    const SceneFrame frame = test::unitFrame(*terrain);
    for (const double exaggeration : {0.0, -1.0, kNan, infinity}) {
        EXPECT_DEATH(HeightfieldSurface(terrain, frame, exaggeration), "check failed");
    }
    SceneFrame line = frame; // a row and a column in the same direction
    line.north_per_column = line.north_per_row;
    line.east_per_column = line.east_per_row;
    EXPECT_DEATH(HeightfieldSurface(terrain, line, 1.0), "check failed");
    SceneFrame endless = frame;
    endless.east_per_column = infinity;
    EXPECT_DEATH(HeightfieldSurface(terrain, endless, 1.0), "check failed");
}

} // namespace
} // namespace marsview
