#include "core/graticule/flat_graticule.h"

#include "core/view/frustum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

namespace marsview {
namespace {

constexpr int kPictureProbes = 8;    // a side, for the longitudes and latitudes in the picture
constexpr double kCurvePixels = 0.2; // by which a chord may leave the true curve
constexpr double kDrapePixels = 6.0; // between two points on the terrain
constexpr int kLinePieces = 8;       // of a line before it is divided further
constexpr int kCurveDepthMax = 8;    // divisions of such a piece
constexpr int kDrapeDepthMax = 14;   // divisions of a straight piece
constexpr double kDegree = std::numbers::pi / 180.0;

// A rectangle in the plan of the scene.
struct PlanBox {
    double west_m = 0.0;
    double east_m = 0.0;
    double south_m = 0.0;
    double north_m = 0.0;
};

struct PlanPoint {
    double x = 0.0;
    double y = 0.0;
};

struct Span {
    double low = 0.0; // degrees
    double high = 0.0;
};

// The longitudes and latitudes of a box.
struct Coverage {
    Span longitudes;
    Span latitudes; // planetocentric
    bool has_pole = false;
};

class GraticuleMaker {
public:
    GraticuleMaker(const SceneSurface& ground,
                   const OrbitCamera& camera,
                   const GraticuleOptions& options)
        : ground_(ground)
        , map_(ground.maps().front().map->georeference())
        , camera_(camera)
        , options_(options)
        , frustum_(camera, options.viewport)
        , relief_(ground.box(options.exaggeration))
        , eye_(eyeOf(camera))
        , axes_(axesOf(camera))
        , pixels_at_unit_(0.5 * options.viewport.height /
                          std::tan(0.5 * camera.field_of_view.radians()))
    {}

    Graticule run()
    {
        const PlanBox box = visibleBox();
        const auto coverage =
            box.west_m < box.east_m && box.south_m < box.north_m ? coverageOf(box) : std::nullopt;
        if (!coverage) {
            return {};
        }
        const Ellipsoid& body = *map_.crs()->ellipsoid();
        const double pixel_m = metersPerPixel(camera_, options_.viewport);
        const double spacing_deg =
            kGraticuleSpacing * options_.pixels_per_point * pixel_m / (body.equatorial_m * kDegree);
        const double middle =
            coverage->has_pole
                ? 90.0
                : std::clamp(0.5 * (coverage->latitudes.low + coverage->latitudes.high), -89.0,
                             89.0);
        const double shrunk = std::max(std::cos(middle * kDegree), 1.0 / 90.0);
        const auto step = [&](double least_deg, const Span& span) {
            return graticuleStep(
                options_.notation,
                Angle::degrees(
                    std::max({least_deg, (span.high - span.low) / kGraticuleLinesMax, 1e-9})));
        };
        result_.latitude_step = step(spacing_deg, coverage->latitudes);
        result_.longitude_step =
            std::min(step(spacing_deg / shrunk, coverage->longitudes), Angle::degrees(90.0),
                     [](Angle a, Angle b) { return a.radians() < b.radians(); });
        if (coverage->has_pole) {
            result_.longitude_step = Angle::degrees(30.0);
        }
        addMeridians(*coverage);
        addParallels(*coverage);
        return std::move(result_);
    }

private:
    // Around what the camera sees, as far as the lines reach.
    PlanBox visibleBox() const
    {
        const double reach_m = kGraticuleReach * camera_.distance_m;
        PlanBox box{.west_m = std::max(relief_.minimum.x, camera_.target.x - reach_m),
                    .east_m = std::min(relief_.maximum.x, camera_.target.x + reach_m),
                    .south_m = std::max(relief_.minimum.y, camera_.target.y - reach_m),
                    .north_m = std::min(relief_.maximum.y, camera_.target.y + reach_m)};
        // Strips without anything in the picture are cut off at all sides.
        constexpr int kStrips = 32;
        const auto is_seen = [this](double west, double east, double south, double north) {
            return !frustum_.isOutside({.minimum = {west, south, relief_.minimum.z},
                                        .maximum = {east, north, relief_.maximum.z}});
        };
        const double width = (box.east_m - box.west_m) / kStrips;
        const double height = (box.north_m - box.south_m) / kStrips;
        PlanBox seen{.west_m = box.east_m,
                     .east_m = box.west_m,
                     .south_m = box.north_m,
                     .north_m = box.south_m};
        for (int column = 0; column < kStrips; ++column) {
            const double west = box.west_m + column * width;
            for (int row = 0; row < kStrips; ++row) {
                const double south = box.south_m + row * height;
                if (is_seen(west, west + width, south, south + height)) {
                    seen.west_m = std::min(seen.west_m, west);
                    seen.east_m = std::max(seen.east_m, west + width);
                    seen.south_m = std::min(seen.south_m, south);
                    seen.north_m = std::max(seen.north_m, south + height);
                }
            }
        }
        return seen;
    }

    std::optional<GeographicPoint> geographic(double x, double y) const
    {
        return map_.toGeographic(map_.sceneFrame().toGrid({x, y, 0.0}));
    }

    std::optional<PlanPoint> planOf(double longitude_deg, double latitude_deg) const
    {
        const auto grid = map_.toGrid(
            GeographicPoint{Angle::degrees(longitude_deg), Angle::degrees(latitude_deg)});
        if (!grid) {
            return std::nullopt;
        }
        const ScenePoint point = map_.sceneFrame().toScene(*grid, 0.0);
        return std::isfinite(point.x) && std::isfinite(point.y)
                   ? std::optional(PlanPoint{point.x, point.y})
                   : std::nullopt;
    }

    std::optional<Coverage> coverageOf(const PlanBox& box) const
    {
        std::vector<std::pair<double, double>> places;
        for (int i = 0; i <= kPictureProbes; ++i) {
            for (int k = 0; k <= kPictureProbes; ++k) {
                const double x = std::lerp(box.west_m, box.east_m, i / double{kPictureProbes});
                const double y = std::lerp(box.south_m, box.north_m, k / double{kPictureProbes});
                if (const auto place = geographic(x, y)) {
                    places.emplace_back(place->longitude.degrees(), place->latitude.degrees());
                }
            }
        }
        if (places.empty()) {
            return std::nullopt;
        }
        // Where longitudes do not continue across the map, they are taken around one of them.
        const bool is_continuous = map_.crs()->turn().has_value();
        const double around = places[places.size() / 2].first;
        Coverage coverage{.longitudes = {1e9, -1e9}, .latitudes = {90.0, -90.0}};
        for (auto [longitude, latitude] : places) {
            if (!is_continuous) {
                longitude -= 360.0 * std::round((longitude - around) / 360.0);
            }
            coverage.longitudes.low = std::min(coverage.longitudes.low, longitude);
            coverage.longitudes.high = std::max(coverage.longitudes.high, longitude);
            coverage.latitudes.low = std::min(coverage.latitudes.low, latitude);
            coverage.latitudes.high = std::max(coverage.latitudes.high, latitude);
        }
        // The places that were probed leave some out between them.
        const double more_longitude =
            (coverage.longitudes.high - coverage.longitudes.low) / kPictureProbes;
        const double more_latitude =
            (coverage.latitudes.high - coverage.latitudes.low) / kPictureProbes;
        if (!is_continuous) {
            coverage.longitudes.low -= more_longitude;
            coverage.longitudes.high += more_longitude;
            for (const double pole : {-90.0, 90.0}) {
                const auto at = planOf(0.0, pole);
                if (at && at->x >= box.west_m && at->x <= box.east_m && at->y >= box.south_m &&
                    at->y <= box.north_m) {
                    coverage.has_pole = true;
                    (pole > 0.0 ? coverage.latitudes.high : coverage.latitudes.low) = pole;
                }
            }
        }
        coverage.latitudes.low = std::max(-90.0, coverage.latitudes.low - more_latitude);
        coverage.latitudes.high = std::min(90.0, coverage.latitudes.high + more_latitude);
        if (coverage.has_pole || coverage.longitudes.high - coverage.longitudes.low > 360.0) {
            if (!is_continuous) {
                coverage.longitudes = {-180.0, 180.0};
            }
        }
        return coverage;
    }

    // From latitudes as they are shown to planetocentric ones, and back.
    double planetocentric(double latitude_deg) const
    {
        return options_.latitudes == LatitudeKind::Planetographic
                   ? map_.crs()->ellipsoid()->planetocentric(Angle::degrees(latitude_deg)).degrees()
                   : latitude_deg;
    }
    double shown(double planetocentric_deg) const
    {
        return options_.latitudes == LatitudeKind::Planetographic
                   ? map_.crs()
                         ->ellipsoid()
                         ->planetographic(Angle::degrees(planetocentric_deg))
                         .degrees()
                   : planetocentric_deg;
    }

    void addMeridians(const Coverage& coverage)
    {
        const double step = result_.longitude_step.degrees();
        const double turns = coverage.longitudes.high - coverage.longitudes.low;
        const double first = std::ceil(coverage.longitudes.low / step - 1e-9);
        double last = std::floor(coverage.longitudes.high / step + 1e-9);
        if (!map_.crs()->turn() && turns >= 360.0) {
            last = std::min(last, first + std::round(360.0 / step) - 1.0);
        }
        for (double k = first; k <= last; k += 1.0) {
            const double longitude = k * step;
            addLine(GraticuleAxis::Meridian, Angle::degrees(longitude),
                    [&](double share) -> std::optional<PlanPoint> {
                        return planOf(longitude, std::lerp(coverage.latitudes.low,
                                                           coverage.latitudes.high, share));
                    });
        }
    }

    void addParallels(const Coverage& coverage)
    {
        const double step = result_.latitude_step.degrees();
        const double first = std::ceil(shown(coverage.latitudes.low) / step - 1e-9);
        const double last = std::floor(shown(coverage.latitudes.high) / step + 1e-9);
        for (double k = first; k <= last; k += 1.0) {
            if (std::abs(k * step) > 90.0 - 1e-9) {
                continue; // a pole is a point, not a line
            }
            const double latitude = planetocentric(k * step);
            addLine(GraticuleAxis::Parallel, Angle::degrees(k * step),
                    [&](double share) -> std::optional<PlanPoint> {
                        return planOf(
                            std::lerp(coverage.longitudes.low, coverage.longitudes.high, share),
                            latitude);
                    });
        }
    }

    template <typename Curve>
    void addLine(GraticuleAxis axis, Angle value, const Curve& curve)
    {
        line_ = {.axis = axis, .value = value, .points = {}};
        auto from = curve(0.0);
        for (int i = 1; i <= kLinePieces; ++i) {
            const double begin = (i - 1.0) / kLinePieces;
            const double end = i / double{kLinePieces};
            const auto to = curve(end);
            if (from && to) {
                addCurve(curve, begin, *from, end, *to, 0);
            } else {
                endLine();
            }
            from = to;
        }
        endLine();
    }

    // Divides the curve until chords are close to it.
    template <typename Curve>
    void addCurve(const Curve& curve,
                  double begin,
                  const PlanPoint& from,
                  double end,
                  const PlanPoint& to,
                  int depth)
    {
        if (isOutside(from, to, std::hypot(to.x - from.x, to.y - from.y))) {
            endLine();
            return;
        }
        const auto middle = curve(0.5 * (begin + end));
        if (!middle) {
            endLine();
            return;
        }
        const double away_m =
            std::hypot(middle->x - 0.5 * (from.x + to.x), middle->y - 0.5 * (from.y + to.y));
        if (depth < kCurveDepthMax && away_m > kCurvePixels * pixelMetersNear(from, *middle, to)) {
            addCurve(curve, begin, from, 0.5 * (begin + end), *middle, depth + 1);
            addCurve(curve, 0.5 * (begin + end), *middle, end, to, depth + 1);
            return;
        }
        // On the other side of the seam.
        const double chord_m = std::hypot(to.x - from.x, to.y - from.y);
        if (chord_m > 0.6 * (relief_.maximum.x - relief_.minimum.x) && away_m > 0.25 * chord_m) {
            endLine();
            return;
        }
        drape(from, *middle, 0);
        drape(*middle, to, 0);
    }

    // Meters in a pixel at the nearest of three places.
    double pixelMetersNear(const PlanPoint& a, const PlanPoint& b, const PlanPoint& c) const
    {
        double least_m = 1e300;
        for (const PlanPoint& p : {a, b, c}) {
            const ScenePoint point{p.x, p.y, camera_.target.z};
            const double depth_m =
                std::max(dot(point - eye_, axes_.forward), 0.05 * camera_.distance_m);
            least_m = std::min(least_m, depth_m / pixels_at_unit_);
        }
        return least_m;
    }

    bool isOutside(const PlanPoint& a, const PlanPoint& b, double margin_m) const
    {
        return frustum_.isOutside({.minimum = {std::min(a.x, b.x) - margin_m,
                                               std::min(a.y, b.y) - margin_m, relief_.minimum.z},
                                   .maximum = {std::max(a.x, b.x) + margin_m,
                                               std::max(a.y, b.y) + margin_m, relief_.maximum.z}});
    }

    ScenePoint onTerrain(const PlanPoint& p) const
    {
        return {p.x, p.y, ground_.height(p.x, p.y) * options_.exaggeration};
    }

    // Adds the terrain along a straight piece, in the detail that the picture shows.
    void drape(const PlanPoint& from, const PlanPoint& to, int depth)
    {
        if (isOutside(from, to, 0.0)) {
            endLine();
            return;
        }
        const double length_m = std::hypot(to.x - from.x, to.y - from.y);
        const PlanPoint middle{0.5 * (from.x + to.x), 0.5 * (from.y + to.y)};
        if (depth < kDrapeDepthMax && length_m > kDrapePixels * pixelMetersNear(from, middle, to)) {
            drape(from, middle, depth + 1);
            drape(middle, to, depth + 1);
            return;
        }
        if (line_.points.empty()) {
            addPoint(from);
        }
        addPoint(to);
    }

    void addPoint(const PlanPoint& p)
    {
        const ScenePoint point = onTerrain(p);
        if (std::isfinite(point.z)) {
            line_.points.push_back(point);
        } else {
            endLine();
        }
    }

    void endLine()
    {
        if (line_.points.size() > 1) {
            result_.lines.push_back(line_);
        }
        line_.points.clear();
    }

    const SceneSurface& ground_;
    const Georeference& map_;
    const OrbitCamera& camera_;
    const GraticuleOptions& options_;
    Frustum frustum_;
    SceneBox relief_; // of all the terrain
    ScenePoint eye_;
    CameraAxes axes_;
    double pixels_at_unit_;
    Graticule result_;
    GraticuleLine line_; // the part that grows
};

} // namespace

Graticule
graticuleOf(const SceneSurface& ground, const OrbitCamera& camera, const GraticuleOptions& options)
{
    if (ground.isEmpty()) {
        return {};
    }
    const auto& crs = ground.maps().front().map->georeference().crs();
    return crs && crs->ellipsoid() ? GraticuleMaker(ground, camera, options).run() : Graticule{};
}

} // namespace marsview
