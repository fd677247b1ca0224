#include "core/measure/hypsometry.h"
#include "core/measure/terrain_area.h"
#include "tests/core/measure/measured_map.h"
#include "tests/support/map_maker.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <vector>

namespace marsview::test {
namespace {

// Around the origin of a map in meters: 801 × 801 samples of 5 m.
TerrainArea areaOf(const std::function<double(double, double)>& z,
                   const std::vector<GroundPosition>& polygon,
                   std::optional<double> step_m = {})
{
    constexpr std::size_t kSide = 801;
    constexpr double kStepM = 5.0;
    MapMaker maker;
    const auto map = maker.make({.columns = kSide,
                                 .rows = kSide,
                                 .transform = {-2002.5, kStepM, 0.0, 2002.5, 0.0, -kStepM},
                                 .srs = ""},
                                [&](std::size_t c, std::size_t r) {
                                    return z(kStepM * (static_cast<double>(c) - 400.0),
                                             kStepM * (400.0 - static_cast<double>(r)));
                                });
    MeasuredTerrain terrain = terrainOf(*map);
    JobMonitor monitor;
    auto area = measureArea(terrain, polygon, {.hypsometry_step_m = step_m}, monitor);
    EXPECT_TRUE(area) << (area ? "" : area.error().message);
    return std::move(area).value();
}

std::vector<GroundPosition> square(double side_m)
{
    const double a = 0.5 * side_m;
    return {{-a, -a}, {a, -a}, {a, a}, {-a, a}};
}

// Of a triangle, by many points.
double areaAbove(const std::array<double, 3>& z, double level)
{
    constexpr int kSteps = 1000;
    int above = 0;
    for (int i = 0; i < kSteps; ++i) {
        for (int k = 0; k < kSteps - i; ++k) {
            const double u = (i + 1.0 / 3.0) / kSteps;
            const double v = (k + 1.0 / 3.0) / kSteps;
            above += z[0] + u * (z[1] - z[0]) + v * (z[2] - z[0]) > level ? 1 : 0;
        }
    }
    return above / (0.5 * kSteps * (kSteps + 1.0));
}

} // namespace

TEST(Hypsometry, OfAConeIsThatOfTheClosedForm)
{
    // Above h lies the disk of the radius R (1 − h/H).
    constexpr double kRadiusM = 1500.0;
    constexpr double kHeightM = 300.0;
    const TerrainArea area =
        areaOf([](double x, double y) { return kHeightM * (1.0 - std::hypot(x, y) / kRadiusM); },
               square(3800.0));
    const double total_m2 = 3800.0 * 3800.0;
    EXPECT_NEAR(area.hypsometry.totalM2(), total_m2, 1e-6 * total_m2);
    EXPECT_NEAR(area.hypsometry.totalM2(), area.covered_m2, 1e-9 * total_m2);
    double worst = 0.0;
    for (double h = 0.0; h <= 299.0; h += 0.25) { // the disk lies in the square
        const double radius_m = kRadiusM * (1.0 - h / kHeightM);
        const double truth_m2 = std::numbers::pi * radius_m * radius_m;
        worst = std::max(worst, std::abs(area.hypsometry.areaAboveM2(h) - truth_m2) / total_m2);
    }
    std::printf("cone: %.2g of the area off, in %zu classes of %g m\n", worst,
                area.hypsometry.area_m2.size(), area.hypsometry.step_m);
    EXPECT_LT(worst, 1e-5); // samples every 5 m
    EXPECT_DOUBLE_EQ(area.hypsometry.areaAboveM2(1e4), 0.0);
    EXPECT_NEAR(area.hypsometry.areaAboveM2(-1e4), total_m2, 1e-6 * total_m2);
}

TEST(Hypsometry, OfAWedgeIsEvenAndExact)
{
    // z = x / 10 from −100 to 100 m: triangles follow it exactly.
    const TerrainArea area = areaOf([](double x, double) { return 0.1 * x; }, square(2000.0), 25.0);
    ASSERT_EQ(area.hypsometry.area_m2.size(), 8U + 1U); // 100 m begins the last, empty one
    EXPECT_EQ(area.hypsometry.boundM(0), -100.0);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_NEAR(area.hypsometry.area_m2[i], 2000.0 * 250.0, 1e-3) << i;
    }
    EXPECT_NEAR(area.hypsometry.area_m2[8], 0.0, 1e-3);
}

TEST(Hypsometry, OfRoughTerrainIsThatOfManyPoints)
{
    Random random(20261124);
    const std::vector<GroundPosition> polygon{{-1800, -700}, {-300, -1750}, {1650, -900},
                                              {900, 300},    {1400, 1600},  {-900, 1200}};
    const auto z = [](double x, double y) {
        return 400.0 * std::sin(0.004 * x) * std::cos(0.003 * y) + 0.1 * x;
    };
    const TerrainArea area = areaOf(z, polygon, 50.0);
    // Smooth between samples: the triangles are off by less than 0.02 m.
    constexpr int kSide = 2000; // points of 2 m
    std::vector<double> counted(area.hypsometry.area_m2.size());
    for (int i = 0; i < kSide; ++i) {
        for (int k = 0; k < kSide; ++k) {
            const double x = 2.0 * (i + random.uniform(0.0, 1.0)) - kSide;
            const double y = 2.0 * (k + random.uniform(0.0, 1.0)) - kSide;
            if (isInside(polygon, x, y)) {
                const auto at = static_cast<std::int64_t>(std::floor(z(x, y) / 50.0)) -
                                area.hypsometry.first_class;
                ASSERT_GE(at, 0);
                ASSERT_LT(at, static_cast<std::int64_t>(counted.size()));
                counted[static_cast<std::size_t>(at)] += 4.0;
            }
        }
    }
    double worst_m2 = 0.0;
    for (std::size_t i = 0; i < counted.size(); ++i) {
        worst_m2 = std::max(worst_m2, std::abs(counted[i] - area.hypsometry.area_m2[i]));
    }
    std::printf("rough terrain: %.2g of the area off in any of %zu classes\n",
                worst_m2 / area.covered_m2, counted.size());
    EXPECT_LT(worst_m2, 2e-4 * area.covered_m2);
}

TEST(Hypsometry, MeanAndBoundsAreThoseOfTheArea)
{
    const TerrainArea area =
        areaOf([](double x, double y) { return 120.0 + 0.05 * x + 40.0 * std::sin(0.01 * y); },
               square(3000.0));
    double sum = 0.0;
    for (std::size_t i = 0; i < area.hypsometry.area_m2.size(); ++i) {
        sum +=
            area.hypsometry.area_m2[i] * (area.hypsometry.boundM(i) + 0.5 * area.hypsometry.step_m);
    }
    EXPECT_NEAR(sum / area.hypsometry.totalM2(), area.mean_m, 0.1 * area.hypsometry.step_m);
    EXPECT_LE(area.hypsometry.boundM(0), area.min_m);
    EXPECT_GT(area.hypsometry.boundM(1), area.min_m);
    const std::size_t last = area.hypsometry.area_m2.size() - 1;
    EXPECT_LE(area.hypsometry.boundM(last), area.max_m);
    EXPECT_GT(area.hypsometry.boundM(last + 1), area.max_m);
}

TEST(Hypsometry, OfVoidsIsEmpty)
{
    const TerrainArea area = areaOf(
        [](double x, double y) {
            return std::hypot(x, y) < 1000.0 ? std::numeric_limits<double>::quiet_NaN() : 7.0;
        },
        square(1000.0));
    EXPECT_TRUE(area.hypsometry.isEmpty());
    EXPECT_EQ(area.hypsometry.areaAboveM2(0.0), 0.0);
}

TEST(Hypsometry, RefusesTooManyClasses)
{
    MapMaker maker;
    const auto map = maker.make({.columns = 11, .rows = 11, .srs = ""},
                                [](std::size_t c, std::size_t) { return 1000.0 * double(c); });
    MeasuredTerrain terrain = terrainOf(*map);
    const GroundPosition a = *terrain.fromGrid({2.0, 2.0});
    const GroundPosition b = *terrain.fromGrid({8.0, 2.0});
    const GroundPosition c = *terrain.fromGrid({8.0, 8.0});
    JobMonitor monitor;
    const auto area =
        measureArea(terrain, std::vector{a, b, c}, {.hypsometry_step_m = 1e-3}, monitor);
    ASSERT_FALSE(area);
    EXPECT_EQ(area.error().code, ErrorCode::OutOfRange);
    EXPECT_EQ(area.error().message.find("elevation classes of 0.001 m are too many"), 0U)
        << area.error().message;
}

TEST(HypsometrySum, OfATriangleIsThatOfItsPoints)
{
    Random random(7);
    for (int i = 0; i < 20; ++i) {
        const std::array z{random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0),
                           i < 5 ? 20.0 : random.uniform(-50.0, 50.0)};
        HypsometrySum sum(10.0);
        sum.add(z, 1.0);
        const auto [low, high] = std::minmax_element(z.begin(), z.end());
        const Hypsometry result = sum.result(*low, *high);
        for (double level = -50.0; level <= 50.0; level += 10.0) {
            EXPECT_NEAR(result.areaAboveM2(level), areaAbove(z, level), 3e-3) << level;
        }
    }
}

TEST(HypsometrySum, LevelTrianglesBelongToTheClassThatBeginsThere)
{
    HypsometrySum sum(0.1);
    for (int i = -30; i <= 30; ++i) {
        sum.add({0.1 * i, 0.1 * i, 0.1 * i}, 1.0);
    }
    const Hypsometry result = sum.result(-3.0, 3.0);
    double most = 0.0;
    for (const double area : result.area_m2) {
        most = std::max(most, area);
    }
    EXPECT_DOUBLE_EQ(result.totalM2(), 61.0);
    EXPECT_LE(most, 2.0) << "0.1 · i is rounded";
    HypsometrySum whole(0.1);
    for (int i = -30; i <= 30; ++i) {
        whole.add({i / 10.0, i / 10.0, i / 10.0}, 1.0);
    }
    for (const double area : whole.result(-3.0, 3.0).area_m2) {
        EXPECT_DOUBLE_EQ(area, 1.0);
    }
}

TEST(HypsometrySum, TheSumDoesNotDependOnTheOrder)
{
    Random random(3);
    std::vector<std::array<double, 3>> triangles;
    for (int i = 0; i < 2000; ++i) {
        const double z = random.uniform(-8000.0, 21000.0);
        triangles.push_back({z, z + random.uniform(-30.0, 30.0), z + random.uniform(-30.0, 30.0)});
    }
    const auto summed = [](const std::vector<std::array<double, 3>>& all) {
        HypsometrySum sum;
        for (const auto& z : all) {
            sum.add(z, 1.0);
        }
        return sum.result(-8030.0, 21030.0);
    };
    const Hypsometry forward = summed(triangles);
    EXPECT_EQ(forward.step_m, 100.0); // of a span of 29 km
    std::reverse(triangles.begin(), triangles.end());
    const Hypsometry backward = summed(triangles);
    ASSERT_EQ(forward.area_m2.size(), backward.area_m2.size());
    EXPECT_EQ(forward.first_class, backward.first_class);
    for (std::size_t i = 0; i < forward.area_m2.size(); ++i) {
        EXPECT_NEAR(forward.area_m2[i], backward.area_m2[i], 1e-9);
    }
}

TEST(Hypsometry, FewerClassesHaveRoundWidthsAndTheSameCurve)
{
    HypsometrySum sum;
    Random random(5);
    for (int i = 0; i < 5000; ++i) {
        const double z = random.uniform(-3000.0, 2000.0);
        sum.add({z, z + 10.0, z + 20.0}, 1.0);
    }
    const Hypsometry fine = sum.result(-3000.0, 2020.0);
    const Hypsometry coarse = withFewerClasses(fine, 40);
    EXPECT_EQ(coarse.step_m, 200.0);
    EXPECT_LE(coarse.area_m2.size(), 40U);
    for (std::size_t i = 0; i <= coarse.area_m2.size(); ++i) {
        EXPECT_NEAR(coarse.areaAboveM2(coarse.boundM(i)), fine.areaAboveM2(coarse.boundM(i)), 1e-8);
    }
    EXPECT_EQ(withFewerClasses(fine, 5000).step_m, fine.step_m);
}

} // namespace marsview::test
