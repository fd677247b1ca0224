#include "core/terrain/ray_cast.h"
#include "tests/support/nan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <span>

namespace marsview {
namespace {

struct Terrain {
    Heightfield heightfield;
    MinMaxPyramid pyramid;

    std::optional<RayHit> cast(const GridRay& ray) const
    {
        return castRay(heightfield, pyramid, ray);
    }
};

Terrain terrainOf(std::span<const float> heights, std::size_t columns)
{
    const std::size_t rows = heights.size() / columns;
    SampleGrid grid = SampleGrid::create(SampleType::Float32, columns, rows).value();
    for (std::size_t row = 0; row < rows; ++row) {
        std::memcpy(grid.rowData(row), heights.data() + row * columns, columns * sizeof(float));
    }
    const SampleStatistics statistics = grid.applyRule({}, 0, rows);
    JobMonitor monitor;
    Heightfield heightfield(std::make_shared<const SampleGrid>(std::move(grid)), statistics, {});
    MinMaxPyramid pyramid = MinMaxPyramid::build(heightfield, monitor).value();
    return {std::move(heightfield), std::move(pyramid)};
}

Terrain
randomTerrain(std::mt19937_64& random, std::size_t columns, std::size_t rows, double void_share)
{
    std::uniform_real_distribution<double> share(0.0, 1.0);
    std::vector<float> heights(columns * rows);
    for (float& height : heights) {
        height = share(random) < void_share ? kNanFloat : static_cast<float>(share(random) * 10.0);
    }
    return terrainOf(heights, columns);
}

// The smallest t at which the ray meets the closed triangle of three grid corners.
std::optional<double> castAtTriangle(const GridRay& ray, const std::array<Vec3, 3>& p)
{
    const Vec3 origin{ray.origin.column, ray.origin.row, ray.origin_height_m};
    const Vec3 direction{ray.columns_per_t, ray.rows_per_t, ray.height_per_t_m};
    const Vec3 e1 = p[1] - p[0];
    const Vec3 e2 = p[2] - p[0];
    const Vec3 h = cross(direction, e2);
    const double determinant = dot(e1, h);
    if (determinant == 0.0 || !std::isfinite(determinant)) {
        return std::nullopt;
    }
    const Vec3 s = origin - p[0];
    const double u = dot(s, h) / determinant;
    const Vec3 q = cross(s, e1);
    const double v = dot(direction, q) / determinant;
    const double t = dot(e2, q) / determinant;
    constexpr double kSlack = 1e-11;
    if (u < -kSlack || v < -kSlack || u + v > 1.0 + kSlack || t < 0.0) {
        return std::nullopt;
    }
    return t;
}

std::optional<double> castAtAll(const Heightfield& heightfield, const GridRay& ray)
{
    std::optional<double> first;
    for (std::size_t row = 0; row + 1 < heightfield.rows(); ++row) {
        for (std::size_t column = 0; column + 1 < heightfield.columns(); ++column) {
            const auto corner = [&](std::size_t c, std::size_t r) {
                return Vec3{static_cast<double>(c), static_cast<double>(r),
                            heightfield.sample(c, r)};
            };
            const Vec3 upper_left = corner(column, row);
            const Vec3 lower_right = corner(column + 1, row + 1);
            for (const Vec3& third : {corner(column + 1, row), corner(column, row + 1)}) {
                const auto t = castAtTriangle(ray, {upper_left, third, lower_right});
                if (t && (!first || *t < *first)) {
                    first = t;
                }
            }
        }
    }
    return first;
}

GridRay rayBetween(const Vec3& from, const Vec3& to)
{
    return {.origin = {from.x, from.y},
            .origin_height_m = from.z,
            .columns_per_t = to.x - from.x,
            .rows_per_t = to.y - from.y,
            .height_per_t_m = to.z - from.z};
}

void expectSameAsAll(const Terrain& terrain, const GridRay& ray, const std::string& what)
{
    const auto expected = castAtAll(terrain.heightfield, ray);
    const auto hit = terrain.cast(ray);
    ASSERT_EQ(hit.has_value(), expected.has_value()) << what;
    if (hit) {
        EXPECT_NEAR(hit->t, *expected, 1e-9 * std::max(1.0, *expected)) << what;
        EXPECT_NEAR(hit->height_m, terrain.heightfield.height(hit->grid), 1e-9) << what;
        EXPECT_NEAR(hit->height_m, ray.origin_height_m + hit->t * ray.height_per_t_m, 1e-9) << what;
    }
}

TEST(CastRay, MatchesATestOfAllTriangles)
{
    constexpr unsigned kSeed = 20261121;
    std::mt19937_64 random(kSeed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (const double void_share : {0.0, 0.05, 0.4}) {
        for (const std::size_t columns : {2U, 33U, 70U}) {
            const std::size_t rows = columns == 2 ? 2 : columns / 2 + 3;
            const Terrain terrain = randomTerrain(random, columns, rows, void_share);
            const double width = static_cast<double>(columns);
            const double height = static_cast<double>(rows);
            for (int i = 0; i < 400; ++i) {
                // From above, from below, from the side and from within.
                const Vec3 from{(share(random) * 2.0 - 0.5) * width,
                                (share(random) * 2.0 - 0.5) * height, share(random) * 60.0 - 20.0};
                const Vec3 to{share(random) * width, share(random) * height,
                              share(random) * 12.0 - 1.0};
                expectSameAsAll(terrain, rayBetween(from, to),
                                "seed " + std::to_string(kSeed) + ", ray " + std::to_string(i) +
                                    ", columns " + std::to_string(columns));
            }
        }
    }
}

TEST(CastRay, FindsGrazingRaysAlongAxesAndDiagonals)
{
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const Terrain terrain = randomTerrain(random, 40, 36, 0.02);
    for (int i = 0; i < 200; ++i) {
        const double at = share(random) * 30.0 + 0.123;
        const double z = share(random) * 10.0;
        expectSameAsAll(terrain, rayBetween({-5.0, at, z}, {50.0, at, z}), "along a row");
        expectSameAsAll(terrain, rayBetween({at, 60.0, z}, {at, -5.0, z}), "along a column");
        expectSameAsAll(terrain, rayBetween({-9.0, at - 30.0, z}, {60.0, at + 39.0, z}),
                        "along the diagonals");
        expectSameAsAll(terrain, rayBetween({-9.0, at + 30.0, z}, {60.0, at - 39.0, z}),
                        "across the diagonals");
    }
}

TEST(CastRay, PassesThroughNeitherVerticesNorEdges)
{
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const Terrain terrain = randomTerrain(random, 70, 40, 0.0);
    for (std::size_t row = 0; row < 40; ++row) {
        for (std::size_t column = 0; column < 70; ++column) {
            const double c = static_cast<double>(column);
            const double r = static_cast<double>(row);
            const double z = terrain.heightfield.sample(column, row);
            // So steep that no terrain blocks the ray (slopes are below 10 per cell).
            const Vec3 from{c + share(random) - 0.5, r + share(random) - 0.5, z + 40.0};
            const auto at_vertex = terrain.cast(rayBetween(from, {c, r, z}));
            ASSERT_TRUE(at_vertex) << column << ", " << row;
            EXPECT_NEAR(at_vertex->grid.column, c, 1e-6);
            EXPECT_NEAR(at_vertex->grid.row, r, 1e-6);
            if (column + 1 < 70 && row + 1 < 40) {
                for (const GridPoint step : {GridPoint{1, 0}, GridPoint{0, 1}, GridPoint{1, 1}}) {
                    const double along = share(random);
                    const GridPoint p{c + along * step.column, r + along * step.row};
                    const double height = terrain.heightfield.height(p);
                    EXPECT_TRUE(terrain.cast(
                        rayBetween({p.column, p.row, height + 50.0}, {p.column, p.row, height})))
                        << "straight down on an edge";
                }
            }
        }
    }
}

TEST(CastRay, HitsStraightDownAndUp)
{
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const Terrain terrain = randomTerrain(random, 66, 34, 0.1);
    for (int i = 0; i < 2000; ++i) {
        const GridPoint p{share(random) * 65.0, share(random) * 33.0};
        const double expected = terrain.heightfield.height(p);
        const auto down =
            terrain.cast({.origin = p, .origin_height_m = 50.0, .height_per_t_m = -1});
        const auto up = terrain.cast({.origin = p, .origin_height_m = -50.0, .height_per_t_m = 1});
        ASSERT_EQ(down.has_value(), !std::isnan(expected));
        ASSERT_EQ(up.has_value(), !std::isnan(expected));
        if (down) {
            EXPECT_EQ(down->height_m, expected);
            EXPECT_EQ(up->height_m, expected);
            EXPECT_NEAR(down->t, 50.0 - expected, 1e-12);
        }
    }
}

TEST(CastRay, MissesTerrainBehindAndNextToTheRay)
{
    const std::vector<float> flat(std::size_t{40} * 40, 5.0F);
    const Terrain terrain = terrainOf(flat, 40);
    EXPECT_FALSE(terrain.cast({.origin = {10, 10}, .origin_height_m = 6, .height_per_t_m = 1}));
    EXPECT_FALSE(terrain.cast({.origin = {50, 10}, .origin_height_m = 6, .height_per_t_m = -1}));
    EXPECT_FALSE(terrain.cast({.origin = {10, 10}, .origin_height_m = 6, .columns_per_t = 1}));
    EXPECT_FALSE(terrain.cast({.origin = {10, 10}, .origin_height_m = 6})) << "no direction";
    EXPECT_FALSE(terrain.cast({.origin = {kNanFloat, 10}, .height_per_t_m = 1}));
}

TEST(CastRay, HitsAFlatMapFromAllSides)
{
    const std::vector<float> flat(std::size_t{70} * 50, 5.0F);
    const Terrain terrain = terrainOf(flat, 70);
    const auto hit = terrain.cast(rayBetween({-10.0, -10.0, 25.0}, {30.0, 20.0, 5.0}));
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->grid.column, 30.0, 1e-9);
    EXPECT_NEAR(hit->grid.row, 20.0, 1e-9);
    EXPECT_EQ(hit->height_m, 5.0);
    const auto level = terrain.cast({.origin = {-3, 10}, .origin_height_m = 5, .columns_per_t = 1});
    ASSERT_TRUE(level) << "within the surface";
    EXPECT_NEAR(level->t, 3.0, 1e-12);
}

TEST(GridRay, IsTheSameRayWithTheSameParameter)
{
    const SceneFrame frame{.origin = {100.0, 50.0},
                           .east_per_column = 26.0,
                           .east_per_row = 15.0,
                           .north_per_column = 15.0,
                           .north_per_row = -26.0};
    const ScenePoint origin{1000.0, -2000.0, 6000.0};
    const Vec3 direction = normalized({0.3, 0.5, -0.7});
    const GridRay ray = gridRay(origin, direction, frame, 4.0);
    for (const double t : {0.0, 10.0, 5000.0}) {
        const ScenePoint p = origin + direction * t;
        const GridPoint grid = frame.toGrid(p);
        EXPECT_NEAR(ray.origin.column + t * ray.columns_per_t, grid.column, 1e-9);
        EXPECT_NEAR(ray.origin.row + t * ray.rows_per_t, grid.row, 1e-9);
        EXPECT_NEAR(ray.origin_height_m + t * ray.height_per_t_m, p.z / 4.0, 1e-9);
    }
}

TEST(MinMaxPyramid, BoundsEverySampleOfEveryNode)
{
    std::mt19937_64 random(5);
    const Terrain terrain = randomTerrain(random, 100, 67, 0.3);
    const MinMaxPyramid& pyramid = terrain.pyramid;
    for (std::size_t level = 0; level < pyramid.levelCount(); ++level) {
        const std::size_t side = MinMaxPyramid::kBlock << level;
        for (std::size_t row = 0; row < 67; ++row) {
            for (std::size_t column = 0; column < 100; ++column) {
                const double height = terrain.heightfield.sample(column, row);
                const std::size_t i = std::min(column, std::size_t{98}) / side;
                const std::size_t j = std::min(row, std::size_t{65}) / side;
                const auto& bounds = pyramid.bounds(level, i, j);
                if (!std::isnan(height)) {
                    EXPECT_LE(static_cast<double>(bounds.minimum_m), height);
                    EXPECT_GE(static_cast<double>(bounds.maximum_m), height);
                }
            }
        }
    }
    EXPECT_EQ(pyramid.columns(pyramid.levelCount() - 1), 1U);
    EXPECT_EQ(pyramid.rows(pyramid.levelCount() - 1), 1U);
}

TEST(MinMaxPyramid, StopsWhenCanceled)
{
    const std::vector<float> flat(std::size_t{40} * 40, 5.0F);
    const Terrain terrain = terrainOf(flat, 40);
    JobMonitor monitor;
    monitor.cancel();
    const auto pyramid = MinMaxPyramid::build(terrain.heightfield, monitor);
    ASSERT_FALSE(pyramid);
    EXPECT_EQ(pyramid.error().code, ErrorCode::Canceled);
}

} // namespace
} // namespace marsview
