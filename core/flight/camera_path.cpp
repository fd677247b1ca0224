#include "core/flight/camera_path.h"

#include "core/base/check.h"
#include "core/base/rotation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace marsview {
namespace {

// The trade-off between panning and zooming that people preferred in the study of van Wijk and
// Nuij.
constexpr double kRho = std::numbers::sqrt2;
constexpr double kTurnWeight = 0.7; // a radian, against a pan by the camera's distance

constexpr double kPointsPerLength = 8.0;

// Steps of the clock from knot to knot.
constexpr std::size_t kTicksPerKnot = 8;
// At a cusp, where the motion reverses, the camera has to stand still for a moment: the clock runs
// on at this share of its usual speed.
constexpr double kClockFloor = 0.1;

// An eye this far above the terrain is not moved by constrained(), which wants a fiftieth.
constexpr double kLiftClearance = 1.0 / 40.0;
constexpr std::size_t kLiftSteps = 1024;
constexpr std::size_t kLiftProbes = 4; // in each step
constexpr std::size_t kLiftReach = 24; // steps over which the camera rises and sinks

constexpr std::size_t kLinePointsMax = 4000;
constexpr double kLineStep = 0.125; // of the distance
constexpr int kLineSmoothings = 2;

double withinHalfTurn(double angle)
{
    return std::remainder(angle, 2.0 * std::numbers::pi);
}

// The slope at a point between two chords that keeps the curve between its points (Fritsch and
// Butland).
double slopeBetween(double before_width, double before, double after_width, double after)
{
    if (!(before * after > 0.0)) {
        return 0.0;
    }
    const double w1 = 2.0 * after_width + before_width;
    const double w2 = after_width + 2.0 * before_width;
    return (w1 + w2) / (w1 / before + w2 / after);
}

struct ValueAndSlope {
    double value;
    double slope;
};

// Hermite's cubic at `t` in [0, 1] of an interval of that width.
ValueAndSlope hermite(double t, double width, ValueAndSlope from, ValueAndSlope to)
{
    const double rise = to.value - from.value;
    const double a = width * from.slope - rise;
    const double b = rise - width * to.slope;
    const double r = 1.0 - t;
    return {.value = r * from.value + t * to.value + t * r * (r * a + t * b),
            .slope = (rise + (1.0 - 2.0 * t) * (r * a + t * b) + t * r * (b - a)) / width};
}

std::vector<double> runningMaxima(const std::vector<double>& values, std::size_t reach)
{
    std::vector<double> result(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t from = i > reach ? i - reach : 0;
        const std::size_t to = std::min(values.size(), i + reach + 1);
        result[i] = *std::max_element(values.begin() + static_cast<std::ptrdiff_t>(from),
                                      values.begin() + static_cast<std::ptrdiff_t>(to));
    }
    return result;
}

// Means over `reach` neighbors on either side, the ends repeated.
std::vector<double> runningMeans(const std::vector<double>& values, std::size_t reach)
{
    const auto last = static_cast<std::ptrdiff_t>(values.size()) - 1;
    const auto side = static_cast<std::ptrdiff_t>(reach);
    std::vector<double> result(values.size());
    for (std::ptrdiff_t i = 0; i <= last; ++i) {
        double sum = 0.0;
        for (std::ptrdiff_t k = -side; k <= side; ++k) {
            sum += values[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i + k, 0, last))];
        }
        result[static_cast<std::size_t>(i)] = sum / static_cast<double>(2 * side + 1);
    }
    return result;
}

// A place of a line: x, y, z, and the height on a body.
using LinePoint = std::array<double, 4>;

double between(const LinePoint& a, const LinePoint& b, bool is_on_body)
{
    return is_on_body ? std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2])
                      : std::hypot(b[0] - a[0], b[1] - a[1]);
}

double lengthOf(const std::vector<LinePoint>& line, bool is_on_body)
{
    double length_m = 0.0;
    for (std::size_t i = 1; i < line.size(); ++i) {
        length_m += between(line[i - 1], line[i], is_on_body);
    }
    return length_m;
}

// Points at equal steps along a line.
std::vector<LinePoint>
equallySpaced(const std::vector<LinePoint>& line, std::size_t count, bool is_on_body)
{
    std::vector<double> along{0.0};
    for (std::size_t i = 1; i < line.size(); ++i) {
        along.push_back(along.back() + between(line[i - 1], line[i], is_on_body));
    }
    std::vector<LinePoint> points;
    std::size_t leg = 1;
    for (std::size_t i = 0; i < count; ++i) {
        const double at = along.back() * static_cast<double>(i) / static_cast<double>(count - 1);
        while (leg + 1 < line.size() && along[leg] < at) {
            ++leg;
        }
        const double width = along[leg] - along[leg - 1];
        const double t = width > 0.0 ? std::clamp((at - along[leg - 1]) / width, 0.0, 1.0) : 0.0;
        LinePoint point{};
        for (std::size_t k = 0; k < point.size(); ++k) {
            point[k] = line[leg - 1][k] + (line[leg][k] - line[leg - 1][k]) * t;
        }
        points.push_back(point);
    }
    return points;
}

// Means over `reach` points on either side, fewer at the ends, which stay.
std::vector<LinePoint> meansAlong(const std::vector<LinePoint>& points, std::size_t reach)
{
    std::vector<LinePoint> result;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t side = std::min({reach, i, points.size() - 1 - i});
        LinePoint mean{};
        for (std::size_t k = 0; k < mean.size(); ++k) {
            double sum = 0.0;
            for (std::size_t n = i - side; n <= i + side; ++n) {
                sum += points[n][k];
            }
            mean[k] = sum * (1.0 / static_cast<double>(2 * side + 1));
        }
        result.push_back(mean);
    }
    return result;
}

double smoothStep(double t)
{
    return t * t * (3.0 - 2.0 * t);
}

} // namespace

CameraPath::Parts CameraPath::partsOf(const OrbitCamera& camera)
{
    return {camera.target.x,
            camera.target.y,
            camera.target.z,
            std::log(camera.distance_m),
            camera.azimuth.radians(),
            camera.tilt.radians(),
            camera.field_of_view.radians(),
            0.0};
}

CameraPath::Parts CameraPath::partsOf(const BodyCamera& camera, const Ellipsoid& body)
{
    const double across_m = body.equatorial_m * std::cos(camera.target.latitude.radians());
    return {across_m * std::cos(camera.target.longitude.radians()),
            across_m * std::sin(camera.target.longitude.radians()),
            body.equatorial_m * std::sin(camera.target.latitude.radians()),
            std::log(camera.distance_m),
            camera.azimuth.radians(),
            camera.tilt.radians(),
            camera.field_of_view.radians(),
            camera.height_m};
}

BodyCamera CameraPath::bodyCameraOf(const Parts& parts)
{
    return {.target = {.longitude = Angle::radians(std::atan2(parts[1], parts[0])),
                       .latitude =
                           Angle::radians(std::atan2(parts[2], std::hypot(parts[0], parts[1])))},
            .height_m = parts[7],
            .distance_m = std::exp(parts[3]),
            .azimuth = Angle::radians(withinHalfTurn(parts[4])),
            .tilt = Angle::radians(parts[5]),
            .field_of_view = Angle::radians(parts[6])};
}

OrbitCamera CameraPath::cameraOf(const Parts& parts)
{
    return {.target = {parts[0], parts[1], parts[2]},
            .distance_m = std::exp(parts[3]),
            .azimuth = Angle::radians(withinHalfTurn(parts[4])),
            .tilt = Angle::radians(parts[5]),
            .field_of_view = Angle::radians(parts[6])};
}

double CameraPath::lengthBetween(const Parts& from, const Parts& to, const Weights& weights)
{
    const double distance_m = std::exp((from[3] + to[3]) / 2.0);
    const double pan =
        std::hypot(std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]), to[7] - from[7]) /
        distance_m * weights.pan;
    const double zoom = (to[3] - from[3]) * weights.zoom;
    const double turn =
        std::hypot(to[4] - from[4], to[5] - from[5], to[6] - from[6]) * weights.turn;
    return std::hypot(pan, zoom, turn);
}

// The points of the optimal path after `from` up to `to`. Notation of the paper: u along the
// straight line or the great circle between the targets, w the width of the view, here the
// distance.
void CameraPath::addFlight(std::vector<Parts>& points, const Parts& from, const Parts& to) const
{
    const Vec3 start{from[0], from[1], from[2]};
    const Vec3 end{to[0], to[1], to[2]};
    const Vec3 normal = body_ ? cross(start, end) : Vec3{};
    const double angle = body_ ? std::atan2(marsview::length(normal), dot(start, end)) : 0.0;
    const double u1 = body_ ? angle * body_->equatorial_m : marsview::length(end - start);
    const double w0 = std::exp(from[3]);
    const double w1 = std::exp(to[3]);
    constexpr double kRho2 = kRho * kRho;
    const bool is_zoom = u1 < 1e-6 * std::max(w0, w1);
    double r0 = 0.0;
    double way = std::abs(to[3] - from[3]) / kRho;
    if (!is_zoom) {
        const double rise = w1 * w1 - w0 * w0;
        const double climb = kRho2 * kRho2 * u1 * u1;
        r0 = -std::asinh((rise + climb) / (2.0 * w0 * kRho2 * u1));
        const double r1 = -std::asinh((rise - climb) / (2.0 * w1 * kRho2 * u1));
        way = (r1 - r0) / kRho;
    }
    // Opposite places have any great circle between them: over the pole.
    const bool is_opposite = marsview::length(normal) <= 1e-12 * dot(start, start);
    const Vec3 axis = is_opposite ? normalized(Vec3{start.y, -start.x, 0.0}) : normalized(normal);
    const double turn = std::hypot(to[4] - from[4], to[5] - from[5]);
    constexpr double kStepMax = 0.02; // radians of a great circle from point to point
    const double steps = std::clamp(
        std::max(std::ceil(kPointsPerLength * std::max(way, kTurnWeight * turn)), angle / kStepMax),
        8.0, 512.0);
    for (double step = 1.0; step < steps; step += 1.0) {
        const double t = step / steps;
        double share = t;
        double log_distance = from[3] + (to[3] - from[3]) * t;
        if (!is_zoom) {
            const double r = kRho * way * t + r0;
            share = w0 / kRho2 * (std::cosh(r0) * std::tanh(r) - std::sinh(r0)) / u1;
            log_distance = from[3] + std::log(std::cosh(r0) / std::cosh(r));
        }
        share = std::clamp(share, 0.0, 1.0);
        Parts point;
        for (std::size_t i = 0; i < kParts; ++i) {
            const bool is_of_target = i < 3 || i == 7;
            point[i] = from[i] + (to[i] - from[i]) * (is_of_target ? share : t);
        }
        if (body_ && !is_zoom && isFinite(axis)) {
            const Vec3 target = Rotation::by(axis * (share * angle)) * start;
            point[0] = target.x;
            point[1] = target.y;
            point[2] = target.z;
        }
        point[3] = log_distance;
        points.push_back(point);
    }
    points.push_back(to);
}

CameraPath CameraPath::throughCameras(const std::vector<OrbitCamera>& cameras, FlightPace pace)
{
    std::vector<Parts> parts;
    for (const OrbitCamera& camera : cameras) {
        parts.push_back(partsOf(camera));
    }
    CameraPath path;
    path.flyThrough(parts, pace);
    return path;
}

CameraPath CameraPath::throughCameras(const std::vector<BodyCamera>& cameras,
                                      FlightPace pace,
                                      const Ellipsoid& body)
{
    std::vector<Parts> parts;
    for (const BodyCamera& camera : cameras) {
        parts.push_back(partsOf(camera, body));
    }
    CameraPath path;
    path.body_ = body;
    path.flyThrough(parts, pace);
    return path;
}

void CameraPath::flyThrough(const std::vector<Parts>& cameras, FlightPace pace)
{
    MARSVIEW_CHECK(!cameras.empty());
    constexpr Weights kWeights{.pan = kRho, .zoom = 1.0 / kRho, .turn = kTurnWeight};
    std::vector<Parts> points{cameras.front()};
    std::vector<std::size_t> at{0};
    for (std::size_t i = 1; i < cameras.size(); ++i) {
        const Parts from = points.back();
        Parts to = cameras[i];
        to[4] = from[4] + withinHalfTurn(to[4] - from[4]);
        if (lengthBetween(from, to, kWeights) > 1e-6) {
            addFlight(points, from, to);
        }
        at.push_back(points.size() - 1);
    }
    setKnots(points, kWeights);
    setClock(kWeights);
    pace_ = pace;
    for (const std::size_t knot : at) {
        stops_.push_back(length_ > 0.0 ? clock_[knot * kTicksPerKnot].time / length_ : 0.0);
    }
}

CameraPath CameraPath::alongLine(const std::vector<ScenePoint>& line, const LineFlight& flight)
{
    std::vector<Parts> points;
    for (const ScenePoint& point : line) {
        points.push_back(partsOf(OrbitCamera{.target = point}));
    }
    CameraPath path;
    path.followLine(points, flight);
    return path;
}

CameraPath CameraPath::alongLine(const std::vector<ScenePoint>& line,
                                 const LineFlight& flight,
                                 const Ellipsoid& body)
{
    std::vector<Parts> points;
    for (const ScenePoint& point : line) {
        const BodyPlace place = placeOf(point, body);
        points.push_back(
            partsOf(BodyCamera{.target = place.foot, .height_m = place.height_m}, body));
    }
    CameraPath path;
    path.body_ = body;
    path.followLine(points, flight);
    return path;
}

// Clockwise from the map's or the body's north; NaN where the line stands still.
double CameraPath::headingAlong(const Parts& behind, const Parts& at, const Parts& ahead) const
{
    const Vec3 step{ahead[0] - behind[0], ahead[1] - behind[1], ahead[2] - behind[2]};
    double east = step.x;
    double north = step.y;
    if (body_) {
        const LocalAxes axes = localAxes(*body_, bodyCameraOf(at).target);
        east = dot(step, axes.east);
        north = dot(step, axes.north);
    }
    return std::hypot(east, north) > 0.0 ? std::atan2(east, north)
                                         : std::numeric_limits<double>::quiet_NaN();
}

void CameraPath::followLine(const std::vector<Parts>& line, const LineFlight& flight)
{
    MARSVIEW_CHECK(line.size() >= 2 && flight.distance_m > 0.0);
    std::vector<LinePoint> points;
    for (const Parts& part : line) {
        points.push_back({part[0], part[1], part[2], part[7]});
    }
    const double length_m = lengthOf(points, isOnBody());
    MARSVIEW_CHECK(length_m > 0.0);
    const auto count = static_cast<std::size_t>(
        std::clamp(std::ceil(length_m / (kLineStep * flight.distance_m)) + 1.0, 33.0,
                   static_cast<double>(kLinePointsMax)));
    const double step_m = length_m / static_cast<double>(count - 1);
    const auto reach = static_cast<std::size_t>(std::clamp(
        std::round(flight.distance_m / (4.0 * step_m)), 1.0, static_cast<double>(count) / 8.0));
    points = equallySpaced(points, count, isOnBody());
    for (int i = 0; i < kLineSmoothings; ++i) {
        points = meansAlong(points, reach);
    }
    std::vector<Parts> parts;
    for (const LinePoint& point : points) {
        parts.push_back({point[0], point[1], point[2], std::log(flight.distance_m), 0.0,
                         flight.tilt.radians(), flight.field_of_view.radians(), point[3]});
    }
    for (std::size_t i = 0; i < count; ++i) {
        const double heading =
            headingAlong(parts[i > 0 ? i - 1 : 0], parts[i], parts[std::min(i + 1, count - 1)]);
        const double before = i > 0 ? parts[i - 1][4] : 0.0;
        parts[i][4] = std::isnan(heading) ? before : before + withinHalfTurn(heading - before);
    }
    constexpr Weights kWeights{.pan = 1.0, .zoom = 0.0, .turn = 0.0};
    setKnots(parts, kWeights);
    setClock(kWeights);
    stops_ = {0.0, 1.0};
}

void CameraPath::setKnots(const std::vector<Parts>& points, const Weights& weights)
{
    for (const Parts& point : points) {
        if (knots_.empty()) {
            knots_.push_back({.s = 0.0, .value = point});
            continue;
        }
        const double step = lengthBetween(knots_.back().value, point, weights);
        knots_.push_back({.s = knots_.back().s + std::max(step, 1e-9), .value = point});
    }
    const std::size_t count = knots_.size();
    for (std::size_t part = 0; part < kParts; ++part) {
        const auto width = [&](std::size_t i) { return knots_[i + 1].s - knots_[i].s; };
        const auto chord = [&](std::size_t i) {
            return (knots_[i + 1].value[part] - knots_[i].value[part]) / width(i);
        };
        for (std::size_t i = 1; i + 1 < count; ++i) {
            knots_[i].slope[part] = slopeBetween(width(i - 1), chord(i - 1), width(i), chord(i));
        }
        if (count > 1) {
            knots_.front().slope[part] = chord(0);
            knots_.back().slope[part] = chord(count - 2);
        }
    }
}

double CameraPath::clockSpeed(double s, const Weights& weights) const
{
    const Knot knot = knotAt(s);
    const Parts& value = knot.value;
    const Parts& slope = knot.slope;
    const double pan = std::hypot(std::hypot(slope[0], slope[1], slope[2]), slope[7]) /
                       std::exp(value[3]) * weights.pan;
    const double turn = std::hypot(slope[4], slope[5], slope[6]) * weights.turn;
    return std::hypot(std::hypot(pan, slope[3] * weights.zoom, turn), kClockFloor);
}

// The knots are an eighth of a unit apart, the ticks an eighth of that: Simpson's rule is exact to
// a millionth. Every knot is a tick, so that the cameras of the path are met exactly.
void CameraPath::setClock(const Weights& weights)
{
    clock_.assign(1, {});
    length_ = 0.0;
    if (knots_.size() < 2) {
        return;
    }
    clock_.front().speed = clockSpeed(0.0, weights);
    for (std::size_t knot = 1; knot < knots_.size(); ++knot) {
        const double from = knots_[knot - 1].s;
        const double width = (knots_[knot].s - from) / static_cast<double>(kTicksPerKnot);
        for (std::size_t i = 1; i <= kTicksPerKnot; ++i) {
            const double s =
                i == kTicksPerKnot ? knots_[knot].s : from + width * static_cast<double>(i);
            const double speed = clockSpeed(s, weights);
            const double middle = clockSpeed(s - width / 2.0, weights);
            const Tick& last = clock_.back();
            clock_.push_back({.s = s,
                              .time = last.time + width / 6.0 * (last.speed + 4.0 * middle + speed),
                              .speed = speed});
        }
    }
    length_ = clock_.back().time;
}

double CameraPath::parameterAt(double time) const
{
    const auto after =
        std::upper_bound(clock_.begin() + 1, clock_.end() - 1, time,
                         [](double value, const Tick& tick) { return value < tick.time; });
    const Tick& to = *after;
    const Tick& from = *(after - 1);
    const double duration = to.time - from.time;
    return hermite((time - from.time) / duration, duration, {from.s, 1.0 / from.speed},
                   {to.s, 1.0 / to.speed})
        .value;
}

CameraPath::Knot CameraPath::knotAt(double s) const
{
    const auto after =
        std::upper_bound(knots_.begin() + 1, knots_.end() - 1, s,
                         [](double value, const Knot& knot) { return value < knot.s; });
    const Knot& to = *after;
    const Knot& from = *(after - 1);
    const double width = to.s - from.s;
    Knot knot{.s = s};
    for (std::size_t i = 0; i < kParts; ++i) {
        const ValueAndSlope part =
            hermite((s - from.s) / width, width, {from.value[i], from.slope[i]},
                    {to.value[i], to.slope[i]});
        knot.value[i] = part.value;
        knot.slope[i] = part.slope;
    }
    return knot;
}

// The share of the length that is behind the camera.
double CameraPath::paced(double share) const
{
    if (pace_ == FlightPace::Constant) {
        return share;
    }
    const auto after = std::upper_bound(stops_.begin() + 1, stops_.end() - 1, share);
    const double from = *(after - 1);
    const double width = *after - from;
    return width > 0.0 ? from + width * smoothStep((share - from) / width) : share;
}

CameraPath::Parts CameraPath::partsAt(double share) const
{
    return length_ > 0.0 ? knotAt(parameterAt(paced(share) * length_)).value : knots_.front().value;
}

OrbitCamera CameraPath::at(double share) const
{
    const double bounded = std::clamp(share, 0.0, 1.0);
    OrbitCamera camera = cameraOf(partsAt(bounded));
    camera.target.z += liftAt(bounded);
    return camera;
}

BodyCamera CameraPath::bodyCameraAt(double share) const
{
    const double bounded = std::clamp(share, 0.0, 1.0);
    BodyCamera camera = bodyCameraOf(partsAt(bounded));
    camera.height_m += liftAt(bounded);
    return camera;
}

double CameraPath::liftAt(double share) const
{
    if (lift_m_.empty()) {
        return 0.0;
    }
    const double x = share * static_cast<double>(kLiftSteps);
    const auto step = std::min(static_cast<std::size_t>(x), kLiftSteps - 1);
    return hermite(x - static_cast<double>(step), 1.0, {lift_m_[step], lift_slope_[step]},
                   {lift_m_[step + 1], lift_slope_[step + 1]})
        .value;
}

CameraPath CameraPath::above(const GroundQuery& ground) const
{
    CameraPath result = *this;
    result.lift_m_.clear();
    result.lift([&](double share) {
        const OrbitCamera camera = result.at(share);
        const ScenePoint eye = eyeOf(camera);
        return ground(eye.x, eye.y) + kLiftClearance * camera.distance_m - eye.z;
    });
    return result;
}

// An eye that is near enough to the terrain to be raised has nearly the target's vertical.
CameraPath CameraPath::above(const BodyGround& ground) const
{
    CameraPath result = *this;
    result.lift_m_.clear();
    result.lift([&](double share) {
        const BodyCamera camera = result.bodyCameraAt(share);
        const BodyPlace eye = placeOf(poseOf(camera, *body_).eye, *body_);
        return ground(eye.foot) + kLiftClearance * camera.distance_m - eye.height_m;
    });
    return result;
}

// By the highest that is missing within reach, smoothed over half of that: at each place at least
// what is missing there.
void CameraPath::lift(const std::function<double(double share)>& missing_m)
{
    std::vector<double> missing(kLiftSteps + 1, 0.0);
    for (std::size_t i = 0; i <= kLiftSteps * kLiftProbes; ++i) {
        const double lift =
            missing_m(static_cast<double>(i) / static_cast<double>(kLiftSteps * kLiftProbes));
        if (std::isfinite(lift)) {
            double& here = missing[(i + kLiftProbes / 2) / kLiftProbes];
            here = std::max(here, lift);
        }
    }
    if (*std::max_element(missing.begin(), missing.end()) <= 0.0) {
        return;
    }
    constexpr std::size_t kBlur = kLiftReach / 2 - 1;
    lift_m_ = runningMeans(runningMeans(runningMaxima(missing, kLiftReach), kBlur), kBlur);
    lift_slope_.assign(kLiftSteps + 1, 0.0);
    for (std::size_t i = 1; i < kLiftSteps; ++i) {
        const double before = lift_m_[i] - lift_m_[i - 1];
        const double after = lift_m_[i + 1] - lift_m_[i];
        lift_slope_[i] = slopeBetween(1.0, before, 1.0, after);
    }
}

} // namespace marsview
