#include "core/body/body_grid.h"
#include "tests/core/contact/body_maps.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace marsview {
namespace {

std::shared_ptr<const BodyGrid> gridOf(const test::BodyMap& map)
{
    JobMonitor monitor;
    auto grid = BodyGrid::make(test::georeferenceOf(map), monitor);
    EXPECT_TRUE(grid) << grid.error().message;
    return std::move(grid).value();
}

test::BodyMap mapNamed(const std::string& name)
{
    const auto all = test::bodyMaps();
    return *std::find_if(all.begin(), all.end(), [&](const auto& map) { return map.name == name; });
}

TEST(BodyGrid, TheLastColumnLiesWhereTheFirstOneDoesOnAMapAroundTheBody)
{
    for (const char* name : {"WholeMars", "WholeMarsOdd", "Westward", "Registered", "Belt"}) {
        const test::BodyMap map = mapNamed(name);
        const auto grid = gridOf(map);
        EXPECT_TRUE(grid->closes()) << name;
        // One more than the raster has, unless it repeats the first itself.
        const bool repeats = std::string(name) == "Registered";
        EXPECT_EQ(grid->columns(), map.columns + (repeats ? 0U : 1U)) << name;
        EXPECT_EQ(grid->rasterColumn(grid->columns() - 1), repeats ? map.columns - 1 : 0U);
        for (std::size_t row = 0; row < grid->rows(); ++row) {
            EXPECT_EQ(grid->at(grid->columns() - 1, row, 1234.5), grid->at(0, row, 1234.5));
        }
    }
    const auto part = gridOf(mapNamed("Part"));
    EXPECT_FALSE(part->closes());
    EXPECT_EQ(part->columns(), 30U);
}

// A node of the quadtree has room for 32 cells: a last node that is full ends the map itself.
TEST(BodyGrid, AMapWhoseLastNodeIsFullClosesInsteadOfItsLastColumn)
{
    const auto grid = gridOf(test::wholeMars(65, 32));
    EXPECT_TRUE(grid->closes());
    EXPECT_EQ(grid->columns(), 65U);
    EXPECT_EQ(grid->rasterColumn(64), 0U);
    EXPECT_EQ(grid->rasterColumn(63), 63U);
    EXPECT_EQ(grid->at(64, 3, 10.0), grid->at(0, 3, 10.0));
}

TEST(BodyGrid, PolesAreClosedByTrianglesOrByTheirOwnRow)
{
    const auto whole = gridOf(mapNamed("WholeMars"));
    EXPECT_EQ(whole->poleAtFirstRow(), BodyGrid::Pole::North);
    EXPECT_EQ(whole->poleAtLastRow(), BodyGrid::Pole::South);
    EXPECT_FALSE(whole->isPole(0));
    EXPECT_FALSE(whole->isPole(whole->rows() - 1));
    const auto registered = gridOf(mapNamed("Registered"));
    EXPECT_TRUE(registered->isPole(0));
    EXPECT_TRUE(registered->isPole(registered->rows() - 1));
    const double polar_m = registered->ellipsoid().polar_m;
    for (std::size_t column = 0; column < registered->columns(); ++column) {
        EXPECT_EQ(registered->at(column, 0, 100.0), (Vec3{0.0, 0.0, polar_m + 100.0}));
        EXPECT_EQ(registered->at(column, registered->rows() - 1, 100.0),
                  (Vec3{0.0, 0.0, -polar_m - 100.0}));
    }
    EXPECT_EQ(gridOf(mapNamed("Northward"))->poleAtFirstRow(), BodyGrid::Pole::South);
    EXPECT_EQ(gridOf(mapNamed("Belt"))->poleAtFirstRow(), BodyGrid::Pole::None);
    EXPECT_EQ(gridOf(mapNamed("Cap"))->poleAtLastRow(), BodyGrid::Pole::None);
}

// On a sphere, steps along meridians and parallels have known lengths.
TEST(BodyGrid, StepsHaveTheLengthsOfArcs)
{
    const auto grid = gridOf({"Sphere", "IAU_2015:30100", 360, 180, {0, 1, 0, 90, 0, -1}, 1.0});
    const double radius_m = grid->ellipsoid().equatorial_m;
    const double degree = std::numbers::pi / 180.0;
    test::Random random(5);
    for (int i = 0; i < 200; ++i) {
        const auto column = static_cast<std::size_t>(random.uniform(0.0, 360.999));
        const auto row = static_cast<std::size_t>(random.uniform(1.0, 178.999));
        const double latitude = (89.5 - static_cast<double>(row)) * degree;
        const BodyGrid::Steps steps = grid->steps(column, row);
        const double chord = std::sin(degree); // over two cells, halved
        EXPECT_NEAR(length(steps.column), radius_m * chord * std::cos(latitude), 1e-6);
        EXPECT_NEAR(length(steps.row), radius_m * chord, 1e-6);
        EXPECT_LE(length(steps.column), grid->stepMaxM());
        EXPECT_LE(length(steps.row), grid->stepMaxM());
    }
}

// Every sample of a triangle's area against its plane: brute force.
TEST(BodyGrid, TrianglesAreNoFurtherFromTheSurfaceThanTheSagSays)
{
    test::Random random(6);
    for (const test::BodyMap& map : test::bodyMaps()) {
        const auto grid = gridOf(map);
        for (int i = 0; i < 300; ++i) {
            const std::size_t most =
                std::min({grid->columns() - 1, grid->rows() - 1, std::size_t{8}});
            const auto cells =
                static_cast<std::size_t>(random.uniform(1.0, static_cast<double>(most) + 0.999));
            const auto corner = [&](std::size_t count) {
                return static_cast<std::size_t>(
                    random.uniform(0.0, static_cast<double>(count - cells) - 1e-9));
            };
            const std::size_t c = corner(grid->columns());
            const std::size_t r = corner(grid->rows());
            if (grid->isPole(r) || grid->isPole(r + cells)) {
                continue;
            }
            const Vec3 a = grid->at(c, r, 0.0);
            const Vec3 b = grid->at(c + cells, r, 0.0);
            const Vec3 d = grid->at(c + cells, r + cells, 0.0);
            for (std::size_t u = 0; u <= cells; ++u) {
                for (std::size_t v = 0; v <= u; ++v) {
                    const double x = static_cast<double>(u) / static_cast<double>(cells);
                    const double y = static_cast<double>(v) / static_cast<double>(cells);
                    const Vec3 flat = a * (1.0 - x) + b * (x - y) + d * y;
                    EXPECT_LE(length(grid->at(c + u, r + v, 0.0) - flat),
                              grid->sagM(static_cast<double>(cells)) + 1e-6)
                        << map.name << ' ' << cells << " cells at " << c << ", " << r;
                }
            }
        }
    }
}

} // namespace
} // namespace marsview
