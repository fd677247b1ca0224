// Statistics of poles and the equal-area net against closed forms.
#include "core/measure/statistics/orientations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace marsview {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// n poles evenly around a vertical axis, each `tilt_deg` from it.
std::vector<PlaneOrientation> ring(int n, double tilt_deg)
{
    std::vector<PlaneOrientation> planes;
    for (int i = 0; i < n; ++i) {
        planes.push_back({.strike_deg = 360.0 * i / n, .dip_deg = tilt_deg});
    }
    return planes;
}

TEST(OrientationStatistics, OfARingOfPolesAreThoseOfItsResultant)
{
    const int n = 8;
    const double tilt_deg = 20.0;
    const auto statistics = orientationStatistics(ring(n, tilt_deg));
    const double resultant = n * std::cos(tilt_deg * kDegree);
    EXPECT_EQ(statistics.count, 8U);
    EXPECT_NEAR(statistics.plunge_deg, 90.0, 1e-6);
    EXPECT_NEAR(statistics.mean.dip_deg, 0.0, 1e-6);
    EXPECT_NEAR(statistics.kappa, (n - 1.0) / (n - resultant), 1e-9);
    const double cosine = 1.0 - (n - resultant) / resultant * (std::pow(20.0, 1.0 / (n - 1.0)) - 1);
    EXPECT_NEAR(std::cos(statistics.confidence_deg * kDegree), cosine, 1e-12);
}

// The same ring around the pole of a steep plane: half of the poles are measured on the other side.
TEST(OrientationStatistics, PolesOfSteepPlanesAreAxes)
{
    const std::vector<PlaneOrientation> planes{
        {.strike_deg = 30.0, .dip_deg = 85.0},
        {.strike_deg = 210.0, .dip_deg = 85.0},
        {.strike_deg = 25.0, .dip_deg = 90.0},
        {.strike_deg = 215.0, .dip_deg = 90.0},
    };
    const auto statistics = orientationStatistics(planes);
    EXPECT_NEAR(std::fmod(statistics.mean.strike_deg, 180.0), 30.0, 1e-9);
    EXPECT_NEAR(statistics.mean.dip_deg, 90.0, 1e-9);
    const double resultant = 2.0 * std::cos(5.0 * kDegree) + 2.0 * std::cos(5.0 * kDegree);
    EXPECT_NEAR(statistics.kappa, 3.0 / (4.0 - resultant), 1e-9);
}

TEST(OrientationStatistics, OnePlaneHasNoSpreadAndEqualOnesHaveNone)
{
    const PlaneOrientation plane{.strike_deg = 350.0, .dip_deg = 35.0};
    const auto one = orientationStatistics(std::vector{plane});
    EXPECT_NEAR(one.mean.strike_deg, 350.0, 1e-9);
    EXPECT_NEAR(one.mean.dip_deg, 35.0, 1e-9);
    EXPECT_NEAR(one.trend_deg, 260.0, 1e-9);
    EXPECT_NEAR(one.plunge_deg, 55.0, 1e-9);
    EXPECT_TRUE(std::isnan(one.kappa));
    const auto equal = orientationStatistics(std::vector{plane, plane, plane});
    EXPECT_TRUE(std::isinf(equal.kappa));
    EXPECT_EQ(equal.confidence_deg, 0.0);
}

TEST(Stereonet, IsLambertsEqualAreaProjectionOfTheLowerHemisphere)
{
    const NetPoint nadir = netPoint({0.0, 0.0, -1.0});
    EXPECT_EQ(nadir.right, 0.0);
    EXPECT_EQ(nadir.up, 0.0);
    const NetPoint east = netPoint({1.0, 0.0, 0.0});
    EXPECT_NEAR(east.right, 1.0, 1e-15);
    const double sine = std::sin(45.0 * kDegree);
    const NetPoint north45 = netPoint({0.0, sine, -sine});
    EXPECT_NEAR(north45.up, std::sqrt(2.0) * std::sin(22.5 * kDegree), 1e-15);
    const NetPoint above = netPoint({0.0, -sine, sine}); // its opposite
    EXPECT_NEAR(above.up, north45.up, 1e-15);
}

TEST(Stereonet, AGreatCircleIsAllThatIsSquareToThePole)
{
    for (const double strike_deg : {0.0, 37.0, 200.0, 351.0}) {
        for (const double dip_deg : {0.0, 12.0, 60.0, 90.0}) {
            const PlaneOrientation plane{.strike_deg = strike_deg, .dip_deg = dip_deg};
            const Vec3 pole = poleOf(plane);
            const auto line = greatCircle(plane);
            for (const NetPoint& point : line) {
                // The projection backward.
                const double r2 = point.right * point.right + point.up * point.up;
                const double flat = std::sqrt(2.0 - r2);
                const Vec3 at{point.right * flat, point.up * flat, r2 - 1.0};
                EXPECT_NEAR(length(at), 1.0, 1e-12);
                EXPECT_NEAR(dot(at, pole), 0.0, 1e-12);
            }
            // It begins where the plane strikes.
            EXPECT_NEAR(line.front().right, std::sin(strike_deg * kDegree), 1e-12);
            EXPECT_NEAR(line.front().up, std::cos(strike_deg * kDegree), 1e-12);
        }
    }
}

// A dip to the east of 30°: its pole plunges 60° to the west.
TEST(Stereonet, ThePoleOfAPlaneIsOppositeToItsDip)
{
    const Vec3 pole = poleOf({.strike_deg = 0.0, .dip_deg = 30.0});
    EXPECT_NEAR(pole.x, -std::sin(30.0 * kDegree), 1e-15);
    EXPECT_NEAR(pole.y, 0.0, 1e-15);
    EXPECT_NEAR(pole.z, -std::cos(30.0 * kDegree), 1e-15);
}

TEST(Stereonet, TheEllipseHasTheAnglesOfItsAxesAroundThePole)
{
    Attitude attitude;
    attitude.normal = {0.0, 0.0, 1.0};
    attitude.uncertainty.axes = {PoleAxis{.half_angle_deg = 10.0, .trend_deg = 90.0},
                                 PoleAxis{.half_angle_deg = 4.0, .trend_deg = 0.0}};
    const auto pieces = poleEllipse(attitude);
    ASSERT_EQ(pieces.size(), 1U);
    double right = 0.0;
    double up = 0.0;
    for (const NetPoint& point : pieces.front()) {
        right = std::max(right, std::abs(point.right));
        up = std::max(up, std::abs(point.up));
    }
    EXPECT_NEAR(right, std::sqrt(2.0) * std::sin(5.0 * kDegree), 1e-12);
    EXPECT_NEAR(up, std::sqrt(2.0) * std::sin(2.0 * kDegree), 1e-12);
    // Around a pole at the rim it continues on the other side.
    attitude.normal = {1.0, 0.0, 0.0};
    attitude.uncertainty.axes = {PoleAxis{.half_angle_deg = 10.0, .plunge_deg = 90.0},
                                 PoleAxis{.half_angle_deg = 4.0, .trend_deg = 0.0}};
    EXPECT_GE(poleEllipse(attitude).size(), 2U);
}

TEST(StrikeRose, CountsEveryStrikeInBothDirections)
{
    const std::vector<PlaneOrientation> planes{{.strike_deg = 5.0, .dip_deg = 10.0},
                                               {.strike_deg = 185.0, .dip_deg = 80.0},
                                               {.strike_deg = 359.9, .dip_deg = 80.0},
                                               {.strike_deg = 95.0, .dip_deg = 20.0},
                                               {.strike_deg = 0.0, .dip_deg = 0.0}};
    const std::vector<double> rose = strikeRose(planes, 36);
    ASSERT_EQ(rose.size(), 36U);
    EXPECT_EQ(rose[0], 0.5);
    EXPECT_EQ(rose[18], 0.5);
    EXPECT_EQ(rose[9], 0.25);
    EXPECT_EQ(rose[17], 0.25);
    EXPECT_EQ(rose[35], 0.25);
}

} // namespace
} // namespace marsview
