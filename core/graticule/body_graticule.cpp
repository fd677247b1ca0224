#include "core/graticule/body_graticule.h"

#include "core/globe/body_motion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

namespace marsview {
namespace {

constexpr int kProbes = 24;            // a side, for the longitudes and latitudes in the picture
constexpr double kPiecePixels = 6.0;   // between two points on the terrain
constexpr double kCrowdedPoints = 6.0; // to the next line, where lines end
constexpr int kDepthMax = 24;          // divisions of a piece
constexpr double kPieceDeg = 10.0;     // of a line before it is divided
constexpr double kMuchDeg = 12.0;      // of a great circle, from the middle: much of the body
constexpr double kPoleStepDeg = 30.0;  // between meridians that reach a pole
constexpr double kOnTerrain = 0.01;  // of the distance: the target of the camera is on the terrain
constexpr double kFirstStep = 0.02;  // of the distance, along the line of sight
constexpr double kStepGrowth = 1.05; // of the distance from the eye
constexpr int kHalvings = 30;        // of the last step
constexpr double kMoreHeight = 1.01; // scaled ellipsoids are higher in some places than in others
constexpr double kRadians = std::numbers::pi / 180.0; // in a degree

struct DegreeSpan {
    double low = 0.0; // degrees
    double high = 0.0;

    void include(double value)
    {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    double length() const { return high - low; }
};

// The longitudes, around that of the middle, and the planetocentric latitudes that are seen.
struct SeenDegrees {
    DegreeSpan longitudes;
    DegreeSpan latitudes;
    bool has_pole = false;
};

// Where the terrain is that the middle of the picture shows. The target of the camera can be far
// above or below it.
struct Middle {
    GeographicPoint place{};
    ScenePoint point{};
    double distance_m = 0.0; // from the eye
};

class BodyGraticuleMaker {
public:
    BodyGraticuleMaker(const BodyCamera& camera,
                       const BodyView& view,
                       const BodyGround& ground,
                       const BodyGraticuleOptions& options)
        : camera_(camera)
        , view_(view)
        , ground_(ground)
        , options_(options)
        , body_(view.ellipsoid())
        , pixel_share_(metersPerPixel(view.pose(), view.viewport()) / view.pose().distance_m)
        , middle_(middleOf(camera))
    {}

    BodyGraticule run()
    {
        const SeenDegrees seen = coverage();
        const double pixel_m = pixel_share_ * middle_.distance_m;
        const double spacing_deg = kGraticuleSpacing * options_.pixels_per_point * pixel_m /
                                   (body_.equatorial_m * kRadians);
        const auto step = [&](double least_deg, const DegreeSpan& span) {
            return graticuleStep(
                options_.notation,
                Angle::degrees(std::max({least_deg, span.length() / kGraticuleLinesMax, 1e-9})));
        };
        result_.latitude_step = step(spacing_deg, seen.latitudes);
        // Where they are widest apart in what is seen, they still are not too close elsewhere.
        const double latitude =
            std::clamp(std::abs(middle_.place.latitude.degrees()), 0.0, is_much_ ? 60.0 : 89.9);
        result_.longitude_step = step(spacing_deg / std::cos(latitude * kRadians), seen.longitudes);
        if (seen.has_pole && (!is_much_ || latitude >= 60.0)) {
            result_.longitude_step = Angle::degrees(kPoleStepDeg);
        }
        if (result_.longitude_step.degrees() > 90.0) {
            result_.longitude_step = Angle::degrees(90.0);
        }
        const SeenDegrees reach = is_much_ ? seen : between(seen);
        addMeridians(reach);
        addParallels(reach);
        is_much_ ? labelAlongLines(seen) : labelEnds();
        return std::move(result_);
    }

private:
    double reachM() const { return kGraticuleReach * middle_.distance_m; }

    Middle middleOf(const BodyCamera& camera) const
    {
        const Vec3& eye = view_.pose().eye;
        const auto at = [&](const GeographicPoint& place, const ScenePoint& point) {
            return Middle{place, point, length(point - eye)};
        };
        const ScenePoint below = onGround(camera.target);
        const ScenePoint target = targetOf(camera, body_);
        if (length(below - target) <= kOnTerrain * view_.pose().distance_m) {
            return at(camera.target, target);
        }
        const Ray ray{eye, (target - eye) * (1.0 / length(target - eye))};
        const auto point = meetGround(ray);
        return point ? at(placeOf(*point, body_).foot, *point) : at(camera.target, below);
    }

    bool isUnderground(const ScenePoint& point) const
    {
        const ScenePoint ground = onGround(placeOf(point, body_).foot);
        return dot(point, point) < dot(ground, ground);
    }

    // The terrain on the line of sight, by steps that grow with the distance.
    std::optional<ScenePoint> meetGround(const Ray& ray) const
    {
        const double end_m =
            length(pointOnBody(ray, body_, atElevation(lowestM())) - ray.origin) * kStepGrowth;
        double before_m = 0.0;
        for (double away_m = kFirstStep * view_.pose().distance_m; before_m < end_m;
             away_m *= kStepGrowth) {
            if (isUnderground(ray.at(away_m))) {
                for (int i = 0; i < kHalvings; ++i) {
                    const double half_m = 0.5 * (before_m + away_m);
                    (isUnderground(ray.at(half_m)) ? away_m : before_m) = half_m;
                }
                return ray.at(away_m);
            }
            before_m = away_m;
        }
        return std::nullopt;
    }

    // The limits of what onGround() can be, in exaggerated meters.
    double lowestM() const
    {
        return std::min(view_.relief().lowest_m * view_.relief().exaggeration, 0.0);
    }
    double highestM() const
    {
        return std::max(view_.relief().highest_m * view_.relief().exaggeration, 0.0);
    }
    ScenePoint atElevation(double height_m) const
    {
        return targetOf({.target = camera_.target, .height_m = height_m}, body_);
    }

    SeenDegrees coverage()
    {
        const double middle_longitude = middle_.place.longitude.degrees();
        const double middle_latitude = middle_.place.latitude.degrees();
        SeenDegrees seen{.longitudes = {middle_longitude, middle_longitude},
                         .latitudes = {middle_latitude, middle_latitude}};
        const double away_deg = probe(seen);
        is_much_ = away_deg > kMuchDeg;
        if (is_much_) {
            // All around the middle that is as near: rays leave out much between them.
            const double reach_deg = std::min(away_deg * (1.0 + 1.0 / kProbes), 180.0);
            seen.latitudes = {middle_latitude - reach_deg, middle_latitude + reach_deg};
            seen.has_pole = seen.latitudes.low < -90.0 || seen.latitudes.high > 90.0;
            const double ratio = std::sin(std::min(reach_deg, 90.0) * kRadians) /
                                 std::max(std::cos(middle_latitude * kRadians), 1e-9);
            const double half_deg =
                seen.has_pole || ratio >= 1.0 ? 180.0 : std::asin(ratio) / kRadians;
            seen.longitudes = {middle_longitude - half_deg, middle_longitude + half_deg};
        }
        limit(seen, middle_longitude);
        return seen;
    }

    // Calls use(ray) for rays all over the picture.
    template <typename Use>
    void forRays(const Use& use) const
    {
        const Viewport& size = view_.viewport();
        for (int i = 0; i <= kProbes; ++i) {
            for (int k = 0; k <= kProbes; ++k) {
                use(pickRay(
                    view_.pose(), size,
                    {size.width * (i / double{kProbes}), size.height * (k / double{kProbes})}));
            }
        }
    }

    void include(const ScenePoint& point, SeenDegrees& seen) const
    {
        const double middle_longitude = middle_.place.longitude.degrees();
        const GeographicPoint foot = placeOf(point, body_).foot;
        seen.latitudes.include(foot.latitude.degrees());
        seen.longitudes.include(middle_longitude +
                                std::remainder(foot.longitude.degrees() - middle_longitude, 360.0));
    }

    // Between rays.
    static void widen(SeenDegrees& seen)
    {
        for (DegreeSpan* span : {&seen.latitudes, &seen.longitudes}) {
            const double more = span->length() / kProbes;
            span->low -= more;
            span->high += more;
        }
    }

    static void limit(SeenDegrees& seen, double middle_longitude)
    {
        seen.latitudes.low = std::max(seen.latitudes.low, -90.0);
        seen.latitudes.high = std::min(seen.latitudes.high, 90.0);
        if (seen.has_pole || seen.longitudes.length() > 350.0) {
            seen.longitudes = {middle_longitude - 180.0, middle_longitude + 180.0};
        }
    }

    // Where the terrain of the picture can be, as far as lines reach: each ray meets it between the
    // lowest and the highest elevation of the body.
    SeenDegrees between(SeenDegrees seen) const
    {
        const Vec3& eye = view_.pose().eye;
        const ScenePoint lowest = atElevation(kMoreHeight * lowestM());
        const ScenePoint highest = atElevation(kMoreHeight * highestM());
        forRays([&](const Ray& ray) {
            for (const ScenePoint& level : {lowest, highest}) {
                const ScenePoint point = pointOnBody(ray, body_, level);
                // An eye below the highest terrain can be inside of it.
                const bool is_ahead = dot(point - eye, ray.direction) > 0.0;
                include(is_ahead ? withinReach(ray, point) : eye, seen);
            }
        });
        widen(seen);
        limit(seen, middle_.place.longitude.degrees());
        return seen;
    }

    // By rays through the picture, on the ellipsoid raised to the middle. How far from the middle
    // they meet it, in degrees of a great circle.
    double probe(SeenDegrees& seen) const
    {
        double away_deg = 0.0;
        forRays([&](const Ray& ray) {
            const ScenePoint point = withinReach(ray, pointOnBody(ray, body_, middle_.point));
            include(point, seen);
            const double cosine =
                dot(point, middle_.point) / (length(point) * length(middle_.point));
            away_deg = std::max(away_deg, std::acos(std::clamp(cosine, -1.0, 1.0)) / kRadians);
        });
        widen(seen);
        const Viewport& size = view_.viewport();
        for (const double pole : {-90.0, 90.0}) {
            const ScenePoint at = onGround({.longitude = {}, .latitude = Angle::degrees(pole)});
            const auto pixel = project(view_.pose(), size, at);
            if (pixel && pixel->x >= 0.0 && pixel->x <= size.width && pixel->y >= 0.0 &&
                pixel->y <= size.height && !view_.isBehindHorizon(at) &&
                length(at - middle_.point) <= reachM()) {
                seen.has_pole = true;
                seen.latitudes.include(pole);
            }
        }
        return away_deg;
    }

    // A point on a ray, or where the ray is as far from the middle as the lines reach.
    ScenePoint withinReach(const Ray& ray, const ScenePoint& point) const
    {
        if (length(point - middle_.point) <= reachM()) {
            return point;
        }
        const Vec3 from = ray.origin - middle_.point;
        const double half = dot(from, ray.direction);
        const double root = half * half - dot(from, from) + reachM() * reachM();
        return ray.at(-half + std::sqrt(std::max(root, 0.0)));
    }

    double planetocentric(double latitude_deg) const
    {
        return options_.latitudes == LatitudeKind::Planetographic
                   ? body_.planetocentric(Angle::degrees(latitude_deg)).degrees()
                   : latitude_deg;
    }
    double shown(double planetocentric_deg) const
    {
        return options_.latitudes == LatitudeKind::Planetographic
                   ? body_.planetographic(Angle::degrees(planetocentric_deg)).degrees()
                   : planetocentric_deg;
    }
    static GeographicPoint place(double longitude_deg, double latitude_deg)
    {
        return {.longitude = Angle::degrees(longitude_deg),
                .latitude = Angle::degrees(latitude_deg)};
    }
    // The exaggerated terrain, or the ellipsoid.
    ScenePoint onGround(const GeographicPoint& at) const
    {
        const double height_m = ground_(at);
        return targetOf({.target = at, .height_m = std::isfinite(height_m) ? height_m : 0.0},
                        body_);
    }

    // The numbers k of the lines k × step.
    static std::pair<double, double> numbers(const DegreeSpan& span, double step)
    {
        return {std::ceil(span.low / step - 1e-9), std::floor(span.high / step + 1e-9)};
    }

    void addMeridians(const SeenDegrees& seen)
    {
        const double step = result_.longitude_step.degrees();
        auto [first, last] = numbers(seen.longitudes, step);
        if (seen.longitudes.length() > 350.0) {
            last = std::min(last, first + std::round(360.0 / step) - 1.0);
        }
        const double end = 90.0 - result_.latitude_step.degrees();
        // As far apart as near the middle: towards a pole they may be closer.
        const double apart_m = step * kRadians * body_.equatorial_m *
                               std::max(std::cos(middle_.place.latitude.radians()), 1e-3);
        for (double k = first; k <= last; k += 1.0) {
            const double longitude = k * step;
            next_m_ = apart_m * rank(k);
            DegreeSpan reach = seen.latitudes;
            if (std::abs(std::remainder(longitude, kPoleStepDeg)) > 1e-9 * kPoleStepDeg) {
                reach = {std::max(reach.low, -end), std::min(reach.high, end)};
            }
            addLine(GraticuleAxis::Meridian, Angle::degrees(longitude), reach,
                    [&](double latitude) { return place(longitude, latitude); });
        }
    }

    void addParallels(const SeenDegrees& seen)
    {
        const double step = result_.latitude_step.degrees();
        const auto [first, last] =
            numbers({shown(seen.latitudes.low), shown(seen.latitudes.high)}, step);
        for (double k = first; k <= last; k += 1.0) {
            if (std::abs(k * step) > 90.0 - 1e-9) {
                continue; // a pole is a point, not a line
            }
            const double latitude = planetocentric(k * step);
            next_m_ = step * kRadians * body_.polar_m * rank(k);
            addLine(GraticuleAxis::Parallel, Angle::degrees(k * step), seen.longitudes,
                    [&](double longitude) { return place(longitude, latitude); });
        }
    }

    struct Mark {
        double at = 0.0; // degrees along the line
        ScenePoint point{};
    };

    template <typename Curve>
    void addLine(GraticuleAxis axis, Angle value, const DegreeSpan& span, const Curve& curve)
    {
        if (!(span.length() > 0.0)) {
            return;
        }
        line_ = {.axis = axis, .value = value, .points = {}};
        const auto mark_at = [&](double at) { return Mark{at, onGround(curve(at))}; };
        const int pieces = std::max(static_cast<int>(std::ceil(span.length() / kPieceDeg)), 8);
        Mark from = mark_at(span.low);
        add(from);
        for (int i = 1; i <= pieces; ++i) {
            const Mark to = mark_at(std::lerp(span.low, span.high, i / double(pieces)));
            addBetween(mark_at, from, to, 0);
            from = to;
        }
        endLine();
    }

    // Divided until pieces are short on the screen.
    template <typename MarkAt>
    void addBetween(const MarkAt& mark_at, const Mark& from, const Mark& to, int depth)
    {
        const double chord_m = length(to.point - from.point);
        const Vec3 middle = (from.point + to.point) * 0.5;
        const double least_away_m = length(middle - middle_.point) - 0.55 * chord_m;
        if (view_.isOutOfSight(from.point, to.point, chord_m) || least_away_m > reachM()) {
            endLine();
            return;
        }
        if (depth < kDepthMax && chord_m > kPiecePixels * options_.pixels_per_point *
                                               pixelMetersNear(from.point, middle, to.point)) {
            const Mark between = mark_at(0.5 * (from.at + to.at));
            addBetween(mark_at, from, between, depth + 1);
            addBetween(mark_at, between, to, depth + 1);
            return;
        }
        if (isCrowded(middle)) {
            endLine();
            return;
        }
        if (line_.points.empty()) {
            add(from);
        }
        add(to);
    }

    // Of ten lines that run into the distance, one goes on furthest.
    double rank(double k) const
    {
        const auto divides = [k](double count) { return std::remainder(k, count) == 0.0; };
        return is_much_ ? 1.0 : divides(10.0) ? 10.0 : divides(5.0) ? 5.0 : 1.0;
    }

    // The next line is too near in the picture.
    bool isCrowded(const ScenePoint& point) const
    {
        const LocalAxes local = localAxes(body_, placeOf(point, body_).foot);
        const Vec3& across = line_.axis == GraticuleAxis::Meridian ? local.east : local.north;
        const auto here = project(view_.pose(), view_.viewport(), point);
        const auto next = project(view_.pose(), view_.viewport(), point + across * next_m_);
        return here && next &&
               std::hypot(next->x - here->x, next->y - here->y) <
                   kCrowdedPoints * options_.pixels_per_point;
    }

    double pixelMetersNear(const Vec3& a, const Vec3& b, const Vec3& c) const
    {
        const CameraPose& pose = view_.pose();
        double depth_m = 1e300;
        for (const Vec3& p : {a, b, c}) {
            depth_m = std::min(depth_m, dot(p - pose.eye, pose.axes.forward));
        }
        return pixel_share_ * std::max(depth_m, 0.02 * pose.distance_m);
    }

    void add(const Mark& mark)
    {
        if (view_.isBehindHorizon(mark.point)) {
            endLine();
        } else {
            line_.points.push_back(mark.point);
        }
    }

    void endLine()
    {
        if (line_.points.size() > 1) {
            result_.lines.push_back(line_);
        }
        line_.points.clear();
    }

    // Of each value the best place among the parts of its line.
    void labelEnds()
    {
        std::map<std::pair<GraticuleAxis, double>, std::vector<GraticuleLine>> lines;
        for (const GraticuleLine& line : result_.lines) {
            lines[{line.axis, line.value.degrees()}].push_back(line);
        }
        for (auto& [key, parts] : lines) {
            GraticuleLine whole = std::move(parts.front());
            for (std::size_t i = 1; i < parts.size(); ++i) {
                whole.points.insert(whole.points.end(), parts[i].points.begin(),
                                    parts[i].points.end());
            }
            if (const auto end = labelEnd(whole, view_.pose(), view_.viewport())) {
                result_.labels.push_back({.axis = whole.axis,
                                          .value = whole.value,
                                          .place = end->place,
                                          .pixel = end->pixel});
            }
        }
    }

    // Between two lines of the other kind, near the middle.
    void labelAlongLines(const SeenDegrees& seen)
    {
        const auto halfwayFrom = [](double value, double step) {
            return (std::floor(value / step) + 0.5) * step;
        };
        const double longitude_step = result_.longitude_step.degrees();
        const double latitude_step = result_.latitude_step.degrees();
        const double longitude = halfwayFrom(middle_.place.longitude.degrees(), longitude_step);
        const double latitude = planetocentric(
            std::clamp(halfwayFrom(shown(middle_.place.latitude.degrees()), latitude_step),
                       -90.0 + 1.5 * latitude_step, 90.0 - 1.5 * latitude_step));
        const auto add = [&](GraticuleAxis axis, double value, const GeographicPoint& at) {
            const ScenePoint point = onGround(at);
            const auto pixel = project(view_.pose(), view_.viewport(), point);
            if (pixel && !view_.isBehindHorizon(point) && pixel->x >= 0.0 &&
                pixel->x <= view_.viewport().width && pixel->y >= 0.0 &&
                pixel->y <= view_.viewport().height) {
                result_.labels.push_back({.axis = axis,
                                          .value = Angle::degrees(value),
                                          .place = point,
                                          .pixel = *pixel});
            }
        };
        auto [first, last] = numbers(seen.longitudes, longitude_step);
        if (seen.longitudes.length() > 350.0) {
            last = std::min(last, first + std::round(360.0 / longitude_step) - 1.0);
        }
        for (double k = first; k <= last; k += 1.0) {
            add(GraticuleAxis::Meridian, k * longitude_step, place(k * longitude_step, latitude));
        }
        const auto [lowest, highest] =
            numbers({shown(seen.latitudes.low), shown(seen.latitudes.high)}, latitude_step);
        for (double k = lowest; k <= highest; k += 1.0) {
            if (std::abs(k * latitude_step) < 90.0 - 1e-9) {
                add(GraticuleAxis::Parallel, k * latitude_step,
                    place(longitude, planetocentric(k * latitude_step)));
            }
        }
    }

    const BodyCamera& camera_;
    const BodyView& view_;
    const BodyGround& ground_;
    const BodyGraticuleOptions& options_;
    Ellipsoid body_;
    double pixel_share_; // of the distance: a pixel's side
    Middle middle_;
    bool is_much_ = false;
    BodyGraticule result_;
    GraticuleLine line_;  // the part that grows
    double next_m_ = 0.0; // from it to the next line
};

} // namespace

BodyGraticule bodyGraticule(const BodyCamera& camera,
                            const BodyView& view,
                            const BodyGround& ground,
                            const BodyGraticuleOptions& options)
{
    return BodyGraticuleMaker(camera, view, ground, options).run();
}

} // namespace marsview
