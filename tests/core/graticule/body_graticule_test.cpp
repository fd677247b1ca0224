#include "core/graticule/body_graticule.h"

#include <GeographicLib/Geocentric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

namespace marsview {
namespace {

const Ellipsoid kMars{3396190.0, 3376200.0};
constexpr Viewport kPicture{.width = 1200, .height = 800};
constexpr double kDegree = std::numbers::pi / 180.0;

// Hills of some kilometers.
double terrain(const GeographicPoint& place)
{
    return 4000.0 * std::sin(7.0 * place.longitude.radians()) *
           std::cos(5.0 * place.latitude.radians());
}

struct Seen {
    BodyCamera camera;
    CameraPose pose;
    BodyGraticule graticule;
};

Seen graticuleFrom(double longitude,
                   double latitude,
                   double distance_m,
                   double tilt = 0.0,
                   const BodyGraticuleOptions& options = {},
                   const BodyGround& ground = terrain)
{
    const GeographicPoint target{.longitude = Angle::degrees(longitude),
                                 .latitude = Angle::degrees(latitude)};
    const double height_m = ground(target);
    const BodyCamera camera{.target = target,
                            .height_m = std::isfinite(height_m) ? height_m : 0.0,
                            .distance_m = distance_m,
                            .azimuth = Angle::degrees(20.0),
                            .tilt = Angle::degrees(tilt)};
    const BodyView view(poseOf(camera, kMars), kPicture, kMars,
                        {.lowest_m = -4000.0, .highest_m = 4000.0});
    return {camera, view.pose(), bodyGraticule(camera, view, ground, options)};
}

// By GeographicLib: longitude, planetographic latitude and height of a point.
struct Place {
    double longitude = 0.0;
    double latitude = 0.0;
    double height_m = 0.0;
};
Place placeAt(const ScenePoint& point)
{
    static const GeographicLib::Geocentric frame(kMars.equatorial_m, kMars.flattening());
    Place place;
    frame.Reverse(point.x, point.y, point.z, place.latitude, place.longitude, place.height_m);
    return place;
}
double planetocentric(double planetographic_deg)
{
    const double ratio = kMars.polar_m / kMars.equatorial_m;
    return std::atan(ratio * ratio * std::tan(planetographic_deg * kDegree)) / kDegree;
}

void expectOnTheirLines(const Seen& seen, LatitudeKind kind)
{
    // A millimeter on the ground.
    const double near_deg = 1e-3 / (kMars.polar_m * kDegree);
    for (const GraticuleLine& line : seen.graticule.lines) {
        for (const ScenePoint& point : line.points) {
            const Place place = placeAt(point);
            const double shrunk = std::cos(place.latitude * kDegree);
            if (line.axis == GraticuleAxis::Meridian) {
                EXPECT_NEAR(std::remainder(place.longitude - line.value.degrees(), 360.0) * shrunk,
                            0.0, near_deg);
            } else {
                const double latitude = kind == LatitudeKind::Planetographic
                                            ? place.latitude
                                            : planetocentric(place.latitude);
                EXPECT_NEAR(latitude, line.value.degrees(), near_deg);
            }
            EXPECT_NEAR(place.height_m,
                        terrain({.longitude = Angle::degrees(place.longitude),
                                 .latitude = Angle::degrees(planetocentric(place.latitude))}),
                        0.01);
        }
    }
}

std::size_t linesAlong(const BodyGraticule& graticule, GraticuleAxis axis)
{
    std::set<double> values;
    for (const GraticuleLine& line : graticule.lines) {
        if (line.axis == axis) {
            values.insert(line.value.degrees());
        }
    }
    return values.size();
}

TEST(BodyGraticule, LiesOnTheTerrainFromSpaceToTheGround)
{
    struct Case {
        double longitude;
        double latitude;
        double distance_m;
        double tilt;
    };
    for (const Case& at :
         {Case{10.0, 20.0, 2e7, 0.0}, Case{179.9, -40.0, 3e5, 50.0}, Case{-180.0, 0.0, 1e4, 70.0},
          Case{123.4, 89.9, 1e5, 30.0}, Case{77.0, -18.0, 3.0, 80.0}}) {
        SCOPED_TRACE(at.distance_m);
        for (const LatitudeKind kind :
             {LatitudeKind::Planetocentric, LatitudeKind::Planetographic}) {
            const Seen seen = graticuleFrom(at.longitude, at.latitude, at.distance_m, at.tilt,
                                            {.latitudes = kind});
            EXPECT_GE(linesAlong(seen.graticule, GraticuleAxis::Meridian), 2U);
            EXPECT_GE(linesAlong(seen.graticule, GraticuleAxis::Parallel), 2U);
            EXPECT_FALSE(seen.graticule.labels.empty());
            expectOnTheirLines(seen, kind);
        }
    }
}

// On a body without relief, the steps and what is seen have closed forms.
TEST(BodyGraticule, NeighborsAreOneToThreeSpacingsApartWhereTheCameraLooks)
{
    const auto level = [](const GeographicPoint&) { return 0.0; };
    for (const double latitude : {0.0, 52.0, -71.0}) {
        for (double distance_m = 5.0; distance_m < 2e7; distance_m *= 3.7) {
            SCOPED_TRACE(distance_m);
            const Seen seen = graticuleFrom(-30.0, latitude, distance_m, 0.0, {}, level);
            const double pixel_m = metersPerPixel(seen.pose, kPicture);
            const double degree_px = kMars.equatorial_m * kDegree / pixel_m;
            const double parallels_px = seen.graticule.latitude_step.degrees() * degree_px;
            const double meridians_px =
                seen.graticule.longitude_step.degrees() * degree_px * std::cos(latitude * kDegree);
            EXPECT_GE(parallels_px, 0.99 * kGraticuleSpacing);
            EXPECT_LE(parallels_px, 3.0 * kGraticuleSpacing);
            if (distance_m < 5e6) { // from further away, they are for more than the middle
                EXPECT_GE(meridians_px, 0.99 * kGraticuleSpacing);
                EXPECT_LE(meridians_px, 3.0 * kGraticuleSpacing);
            }
        }
    }
}

TEST(BodyGraticule, PiecesAreShortInThePictureAndBeforeTheHorizon)
{
    for (const double distance_m : {2e7, 2e5, 50.0}) {
        const Seen seen = graticuleFrom(100.0, 35.0, distance_m, 60.0);
        const Horizon horizon(kMars, -4000.0);
        std::size_t in_picture = 0;
        for (const GraticuleLine& line : seen.graticule.lines) {
            for (std::size_t i = 0; i < line.points.size(); ++i) {
                EXPECT_FALSE(horizon.hides(line.points[i], seen.pose.eye));
                const auto to = project(seen.pose, kPicture, line.points[i]);
                const auto from =
                    i > 0 ? project(seen.pose, kPicture, line.points[i - 1]) : std::nullopt;
                const auto is_in = [](const auto& pixel) {
                    return pixel && pixel->x > 0.0 && pixel->y > 0.0 && pixel->x < kPicture.width &&
                           pixel->y < kPicture.height;
                };
                if (is_in(from) && is_in(to)) {
                    EXPECT_LE(std::hypot(to->x - from->x, to->y - from->y), 7.0);
                    ++in_picture;
                }
            }
        }
        EXPECT_GT(in_picture, 100U);
    }
}

TEST(BodyGraticule, AtAPoleMeridiansOfEvery30DegreesMeet)
{
    const Seen seen = graticuleFrom(45.0, 90.0, 1e5);
    EXPECT_DOUBLE_EQ(seen.graticule.longitude_step.degrees(), 30.0);
    EXPECT_EQ(linesAlong(seen.graticule, GraticuleAxis::Meridian), 12U);
    const auto reaches_pole = [](const GraticuleLine& line) {
        return std::any_of(line.points.begin(), line.points.end(), [](const ScenePoint& point) {
            return placeAt(point).latitude > 90.0 - 1e-6;
        });
    };
    for (const GraticuleLine& line : seen.graticule.lines) {
        EXPECT_EQ(reaches_pole(line), line.axis == GraticuleAxis::Meridian);
    }
    // From space, too, where there are more of them elsewhere.
    const Seen all = graticuleFrom(0.0, 50.0, 9e6);
    ASSERT_LT(all.graticule.longitude_step.degrees(), 30.0);
    for (const GraticuleLine& line : all.graticule.lines) {
        if (line.axis == GraticuleAxis::Meridian &&
            std::abs(std::remainder(line.value.degrees(), 30.0)) > 1e-9) {
            EXPECT_FALSE(reaches_pole(line)) << line.value.degrees();
        }
    }
}

TEST(BodyGraticule, LinesOnTheEllipsoidReplaceMissingTerrain)
{
    const Seen seen = graticuleFrom(5.0, 5.0, 1e6, 0.0, {}, [](const GeographicPoint&) {
        return std::numeric_limits<double>::quiet_NaN();
    });
    ASSERT_FALSE(seen.graticule.lines.empty());
    for (const GraticuleLine& line : seen.graticule.lines) {
        for (const ScenePoint& point : line.points) {
            EXPECT_NEAR(placeAt(point).height_m, 0.0, 1e-6);
        }
    }
}

TEST(BodyGraticule, LabelsLieOnTheirLinesInThePicture)
{
    for (const double distance_m : {2e7, 1e6, 1e3}) {
        const Seen seen = graticuleFrom(-179.5, 0.4, distance_m, 40.0);
        std::set<std::pair<GraticuleAxis, double>> named;
        for (const GraticuleLabel& label : seen.graticule.labels) {
            EXPECT_TRUE(named.emplace(label.axis, label.value.degrees()).second);
            EXPECT_GE(label.pixel.x, 0.0);
            EXPECT_LE(label.pixel.x, kPicture.width);
            EXPECT_GE(label.pixel.y, 0.0);
            EXPECT_LE(label.pixel.y, kPicture.height);
            const Place place = placeAt(label.place);
            if (label.axis == GraticuleAxis::Meridian) {
                EXPECT_NEAR(std::remainder(place.longitude - label.value.degrees(), 360.0), 0.0,
                            1e-9);
            } else {
                EXPECT_NEAR(planetocentric(place.latitude), label.value.degrees(), 1e-9);
            }
        }
        EXPECT_GE(named.size(), 4U);
    }
}

// Where rays through the picture meet a terrain, by small steps: the first point below it.
std::optional<Place> marched(const Ray& ray, const BodyGround& ground, double step_m, double end_m)
{
    double before_m = 0.0;
    const auto is_below = [&](double away_m) {
        const Place place = placeAt(ray.at(away_m));
        return place.height_m <
               ground({.longitude = Angle::degrees(place.longitude),
                       .latitude = Angle::degrees(planetocentric(place.latitude))});
    };
    for (double away_m = 0.0; away_m < end_m; away_m += step_m) {
        if (is_below(away_m)) {
            for (int i = 0; i < 30; ++i) {
                const double half_m = 0.5 * (before_m + away_m);
                (is_below(half_m) ? away_m : before_m) = half_m;
            }
            return placeAt(ray.at(away_m));
        }
        before_m = away_m;
    }
    return std::nullopt;
}

double fromSegment(const PixelPoint& point, const PixelPoint& a, const PixelPoint& b)
{
    const double x = b.x - a.x;
    const double y = b.y - a.y;
    const double square = std::max(x * x + y * y, 1e-12);
    const double t = std::clamp(((point.x - a.x) * x + (point.y - a.y) * y) / square, 0.0, 1.0);
    return std::hypot(a.x + t * x - point.x, a.y + t * y - point.y);
}

// How far a pixel is from the nearest part of a line.
double fromLine(const PixelPoint& pixel, GraticuleAxis axis, double value_deg, const Seen& seen)
{
    double nearest_px = 1e300;
    for (const GraticuleLine& line : seen.graticule.lines) {
        if (line.axis != axis ||
            std::abs(std::remainder(line.value.degrees() - value_deg, 360.0)) > 1e-9) {
            continue;
        }
        for (std::size_t i = 1; i < line.points.size(); ++i) {
            const auto from = project(seen.pose, kPicture, line.points[i - 1]);
            const auto to = project(seen.pose, kPicture, line.points[i]);
            if (from && to) {
                nearest_px = std::min(nearest_px, fromSegment(pixel, *from, *to));
            }
        }
    }
    return nearest_px;
}

// The target of a camera stays where it is while terrain that is nested in other terrain, lower or
// more exaggerated moves into its picture.
TEST(BodyGraticule, CoversThePictureWhereverTheTargetIsAboveOrBelowTheTerrain)
{
    struct Case {
        double ground_m; // the middle of the terrain
        double distance_m;
        double tilt;
        double waves_m = 0.0;
    };
    constexpr int kGrid = 20; // pixels
    for (const Case& at :
         {Case{-4100.0, 3e3, 45.0}, Case{-4100.0, 4e3, 50.0}, Case{-4100.0, 1.2e4, 55.0},
          Case{-4100.0, 4e4, 55.0}, Case{-4100.0, 400.0, 15.0}, Case{-37000.0, 3e3, 10.0},
          Case{-4100.0, 4e3, 40.0, 300.0}, Case{1500.0, 8e3, 50.0}, Case{0.0, 5e3, 55.0}}) {
        SCOPED_TRACE(testing::Message() << at.ground_m << " m, distance " << at.distance_m
                                        << " m, tilt " << at.tilt << " deg");
        const BodyGround ground = [&](const GeographicPoint& place) {
            return at.ground_m + at.waves_m * std::sin(place.longitude.degrees() * 60.0) *
                                     std::cos(place.latitude.degrees() * 50.0);
        };
        const BodyCamera camera{
            .target = {.longitude = Angle::degrees(137.44), .latitude = Angle::degrees(-4.6)},
            .distance_m = at.distance_m,
            .azimuth = Angle::degrees(10.0),
            .tilt = Angle::degrees(at.tilt)};
        const BodyView view(poseOf(camera, kMars), kPicture, kMars,
                            {.lowest_m = -40000.0, .highest_m = 21000.0});
        const Seen seen{camera, view.pose(), bodyGraticule(camera, view, ground, {})};
        const double eye_m = placeAt(seen.pose.eye).height_m - at.ground_m;
        const double longitude_step = seen.graticule.longitude_step.degrees();
        const double latitude_step = seen.graticule.latitude_step.degrees();
        std::map<std::pair<int, int>, Place> places;
        for (int x = 0; x <= kPicture.width; x += kGrid) {
            for (int y = 0; y <= kPicture.height; y += kGrid) {
                const Ray ray = pickRay(seen.pose, kPicture, {double(x), double(y)});
                if (const auto place = marched(ray, ground, 0.02 * eye_m, 12.0 * eye_m)) {
                    places[{x, y}] = *place;
                }
            }
        }
        ASSERT_EQ(places.size(), std::size_t{61 * 41});
        int crossings = 0;
        int missing = 0;
        const auto check = [&](const std::pair<int, int>& a, const std::pair<int, int>& b,
                               GraticuleAxis axis, double from, double to, double step) {
            const double k = std::max(std::floor(from / step), std::floor(to / step));
            // One line between them.
            if (std::floor(from / step) == std::floor(to / step) || std::abs(from - to) > step) {
                return;
            }
            const double share = (k * step - from) / (to - from);
            ++crossings;
            missing +=
                fromLine({std::lerp(a.first, b.first, share), std::lerp(a.second, b.second, share)},
                         axis, k * step, seen) > 4.0;
        };
        for (const auto& [pixel, place] : places) {
            for (const auto& next : {std::pair{pixel.first + kGrid, pixel.second},
                                     std::pair{pixel.first, pixel.second + kGrid}}) {
                const auto there = places.find(next);
                if (there == places.end()) {
                    continue;
                }
                check(pixel, next, GraticuleAxis::Meridian, place.longitude,
                      there->second.longitude, longitude_step);
                check(pixel, next, GraticuleAxis::Parallel, planetocentric(place.latitude),
                      planetocentric(there->second.latitude), latitude_step);
            }
        }
        EXPECT_GT(crossings, 300);
        EXPECT_EQ(missing, 0) << "of " << crossings;
        EXPECT_LT(linesAlong(seen.graticule, GraticuleAxis::Meridian), 60U);
    }
}

} // namespace
} // namespace marsview
