#include "core/measure/ground.h"
#include "tests/core/measure/measured_map.h"
#include "tests/support/random.h"
#include "tests/support/run_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <sstream>
#include <string>
#include <vector>

namespace marsview::test {
namespace {

struct ReferenceBody {
    const char* name;
    Ellipsoid ellipsoid;
    bool is_exact; // GeographicLib's programs need -E beyond a flattening of 0.01
};

const ReferenceBody kBodies[] = {
    {"Earth", {6378137.0, 6356752.314245179}, false},
    {"Mars", {3396190.0, 3376200.0}, false},
    {"Moon", {1737400.0, 1737400.0}, false},
    {"strongly flattened", {11300.0, 5500.0}, true},
};

std::vector<std::string> withBody(std::vector<std::string> program, const ReferenceBody& body)
{
    program.insert(program.end(),
                   {"-e", fmt::format("{:.17g}", body.ellipsoid.equatorial_m),
                    fmt::format("{:.17g}", body.ellipsoid.flattening()), "-p", "10"});
    if (body.is_exact) {
        program.emplace_back("-E");
    }
    return program;
}

std::vector<std::vector<double>> rowsOf(const std::string& text)
{
    std::vector<std::vector<double>> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        rows.emplace_back();
        for (double value = 0.0; words >> value;) {
            rows.back().push_back(value);
        }
    }
    return rows;
}

} // namespace

TEST(Ground, DistancesAndAzimuthsAreThoseOfGeodSolve)
{
    Random random;
    for (const ReferenceBody& body : kBodies) {
        SCOPED_TRACE(body.name);
        const Ground ground = Ground::onEllipsoid(body.ellipsoid);
        std::vector<std::pair<GroundPosition, GroundPosition>> pairs;
        std::string input;
        for (int i = 0; i < 10'000; ++i) {
            const GroundPosition a{random.uniform(-360.0, 720.0), random.uniform(-90.0, 90.0)};
            // A third of the pairs lies within a degree, a third nearly opposite.
            const GroundPosition b =
                i % 3 == 0
                    ? GroundPosition{a.x + random.uniform(-1.0, 1.0),
                                     std::clamp(a.y + random.uniform(-1.0, 1.0), -90.0, 90.0)}
                : i % 3 == 1
                    ? GroundPosition{random.uniform(-360.0, 720.0), random.uniform(-90.0, 90.0)}
                    : GroundPosition{a.x + 180.0 + random.uniform(-2.0, 2.0),
                                     std::clamp(-a.y + random.uniform(-2.0, 2.0), -90.0, 90.0)};
            pairs.emplace_back(a, b);
            input += fmt::format("{:.15f} {:.15f} {:.15f} {:.15f}\n", a.y, a.x, b.y, b.x);
        }
        const auto rows = rowsOf(runTool(withBody({"GeodSolve", "-i"}, body), input));
        ASSERT_EQ(rows.size(), pairs.size());
        double worst = 0.0;
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            const auto& [a, b] = pairs[i];
            const GroundLine line = ground.line(a, b);
            const double truth_m = rows[i][2];
            worst = std::max(worst, std::abs(line.lengthM() / truth_m - 1.0));
            ASSERT_NEAR(line.lengthM(), truth_m, 1e-9 * truth_m) << i;
            ASSERT_NEAR(ground.distanceM(a, b), truth_m, 1e-9 * truth_m) << i;
            // Opposite positions have two shortest lines.
            const bool has_one_line = i % 3 != 2;
            if (has_one_line) {
                ASSERT_LT(angleBetween(line.azimuthDeg(), rows[i][0]), 1e-7) << i;
                ASSERT_LT(ground.distanceM(line.at(truth_m), b), 1e-6) << i;
            }
        }
        std::printf("%s: largest relative error of a distance %.2g\n", body.name, worst);
    }
}

TEST(Ground, AreasAndPerimetersAreThoseOfPlanimeter)
{
    Random random;
    for (const ReferenceBody& body : kBodies) {
        SCOPED_TRACE(body.name);
        const Ground ground = Ground::onEllipsoid(body.ellipsoid);
        std::vector<std::vector<GroundPosition>> polygons;
        std::string input;
        for (int i = 0; i < 2'500; ++i) {
            std::vector<GroundPosition> polygon;
            const std::size_t count = 3 + random.below(8);
            if (i % 5 == 0) { // 360° long: a zigzag along a parallel, back along another one
                for (int k = 0; k <= 6; ++k) {
                    polygon.push_back({60.0 * k - 180.0, random.uniform(20.0, 60.0)});
                }
                for (int k = 6; k >= 0; --k) {
                    polygon.push_back({60.0 * k - 180.0, random.uniform(-10.0, 10.0)});
                }
                polygon[6].y = polygon[0].y;
                polygon[7].y = polygon[13].y;
            } else {
                // Around a pole, around a place on the date line, or anywhere.
                const GroundPosition center =
                    i % 5 == 1   ? GroundPosition{0.0, random.chance(0.5) ? 89.0 : -89.0}
                    : i % 5 == 2 ? GroundPosition{180.0, random.uniform(-60.0, 60.0)}
                                 : GroundPosition{random.uniform(-180.0, 360.0),
                                                  random.uniform(-80.0, 80.0)};
                const double reach_m = random.uniform(0.001, 0.5) * body.ellipsoid.polar_m;
                for (std::size_t k = 0; k < count; ++k) {
                    const double azimuth =
                        360.0 * static_cast<double>(k) / static_cast<double>(count);
                    polygon.push_back(
                        ground.ray(center, azimuth).at(reach_m * random.uniform(0.3, 1.0)));
                }
            }
            for (const GroundPosition& vertex : polygon) {
                input += fmt::format("{:.15f} {:.15f}\n", vertex.y, vertex.x);
            }
            input += "\n";
            polygons.push_back(polygon);
        }
        const auto rows = rowsOf(runTool(withBody({"Planimeter"}, body), input));
        ASSERT_EQ(rows.size(), polygons.size());
        double worst = 0.0;
        for (std::size_t i = 0; i < polygons.size(); ++i) {
            const GroundPolygon polygon = ground.polygon(polygons[i]);
            if (std::abs(rows[i][2]) > 1e5) {
                worst = std::max(worst, std::abs(polygon.area_m2 / rows[i][2] - 1.0));
            }
            ASSERT_NEAR(polygon.perimeter_m, rows[i][1], 1e-9 * rows[i][1]) << i;
            // Planimeter prints five digits after the point.
            ASSERT_NEAR(polygon.area_m2, rows[i][2], 1e-9 * std::abs(rows[i][2]) + 1e-5) << i;
        }
        std::printf("%s: largest relative error of an area %.2g\n", body.name, worst);
    }
}

TEST(Ground, PlanesAreMeasuredByPythagoras)
{
    const Ground ground = Ground::onPlane();
    const std::vector<GroundPosition> triangle{
        {1000.0, 2000.0}, {1003.0, 2004.0}, {1000.0, 2004.0}};
    const GroundPolygon polygon = ground.polygon(triangle);
    EXPECT_DOUBLE_EQ(polygon.area_m2, 6.0);
    EXPECT_DOUBLE_EQ(polygon.perimeter_m, 12.0);
    const GroundLine line = ground.line(triangle[0], triangle[1]);
    EXPECT_DOUBLE_EQ(line.lengthM(), 5.0);
    EXPECT_NEAR(line.azimuthDeg(), 36.86989764584402, 1e-12);
    EXPECT_EQ(line.at(2.5), (GroundPosition{1001.5, 2002.0}));
}

TEST(Ground, FramesPointEastNorthAndUp)
{
    Random random;
    for (const ReferenceBody& body : kBodies) {
        const Ground ground = Ground::onEllipsoid(body.ellipsoid);
        for (int i = 0; i < 100; ++i) {
            const GroundPosition here{random.uniform(-180.0, 180.0), random.uniform(-89.0, 89.0)};
            const LocalFrame frame = ground.frameAt(here);
            constexpr double kStepM = 0.01;
            const Vec3 east =
                frame.toLocal(ground.cartesian(ground.ray(here, 90.0).at(kStepM), 0.0));
            const Vec3 north =
                frame.toLocal(ground.cartesian(ground.ray(here, 0.0).at(kStepM), 0.0));
            const Vec3 up = frame.toLocal(ground.cartesian(here, kStepM));
            EXPECT_NEAR(east.x, kStepM, 1e-6);
            EXPECT_NEAR(north.y, kStepM, 1e-6);
            EXPECT_NEAR(up.z, kStepM, 1e-6);
            EXPECT_LT(std::hypot(east.y, east.z, north.x) + std::hypot(north.z, up.x, up.y), 1e-5);
            const GroundPosition back = ground.positionOf(ground.cartesian(here, 0.0));
            EXPECT_NEAR(back.x, here.x, 1e-9);
            EXPECT_NEAR(back.y, here.y, 1e-9);
        }
    }
}

} // namespace marsview::test
