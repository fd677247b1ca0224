#include "ui/globe/globe_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace marsview {
namespace {

using std::chrono::milliseconds;

// As in the flat map.
constexpr double kPanShare = 0.12; // of the distance, a key press
constexpr double kKeyZoomFactor = 0.75;
constexpr Angle kKeyTurn = Angle::degrees(10.0);
constexpr Angle kKeyTilt = Angle::degrees(5.0);
constexpr milliseconds kKeyDuration{180};
constexpr double kFlyFactor = 0.3; // of the distance, when flying nearer

constexpr milliseconds kFlyDuration{1200};

// Between the lowest and the highest place.
double middleHeight(std::span<const ScenePoint> places, const Ellipsoid& ellipsoid)
{
    double lowest_m = std::numeric_limits<double>::infinity();
    double highest_m = -lowest_m;
    for (const ScenePoint& place : places) {
        const double height_m = placeOf(place, ellipsoid).height_m;
        lowest_m = std::min(lowest_m, height_m);
        highest_m = std::max(highest_m, height_m);
    }
    return 0.5 * (lowest_m + highest_m);
}

} // namespace

GlobeCamera::GlobeCamera(const GlobeGround& ground, std::function<Viewport()> viewport)
    : ground_(ground)
    , viewport_(std::move(viewport))
    , motion_([this](const BodyCamera& camera) { return bounded(camera); })
{
    connect(&motion_, &GlobeMotion::cameraChanged, this, &GlobeCamera::cameraChanged);
}

Ray GlobeCamera::rayThrough(PixelPoint pixel) const
{
    return pickRay(pose(), viewport_(), pixel);
}

void GlobeCamera::followTerrain(double factor)
{
    BodyCamera camera = motion_.goal();
    camera.height_m *= factor;
    motion_.jumpTo(camera);
}

// All layers.
BodyCamera GlobeCamera::homeView() const
{
    return homeCamera(ground_.limits(), ground_.places(), viewport_());
}

BodyCamera GlobeCamera::bounded(const BodyCamera& camera) const
{
    if (ground_.isEmpty()) {
        return camera;
    }
    return constrained(camera, ground_.limits(),
                       [this](const GeographicPoint& place) { return ground_.height(place); });
}

// The same picture, its target on the terrain in the middle of it.
BodyCamera GlobeCamera::onGround(const BodyCamera& camera) const
{
    const Ellipsoid& ellipsoid = ground_.ellipsoid();
    const CameraPose pose = poseOf(camera, ellipsoid);
    const Ray ray{pose.eye, pose.axes.forward};
    const auto ground = ground_.cast(ray);
    const BodyLimits bounds = ground_.limits();
    if (!ground || ground->hit.distance_m < bounds.distance_min_m ||
        ground->hit.distance_m > bounds.distance_max_m) {
        return camera;
    }
    const BodyPlace place = placeOf(ray.at(ground->hit.distance_m), ellipsoid);
    const LocalAxes local = localAxes(ellipsoid, place.foot);
    BodyCamera result = camera;
    result.target = place.foot;
    result.height_m = place.height_m;
    result.distance_m = ground->hit.distance_m;
    const double down = std::clamp(-dot(ray.direction, local.up), -1.0, 1.0);
    result.tilt = Angle::radians(std::acos(down));
    // Straight down the picture's upper edge has the heading.
    const Vec3 ahead = std::abs(down) > 1.0 - 1e-9 ? pose.axes.up : ray.direction;
    result.azimuth = Angle::radians(std::atan2(dot(ahead, local.east), dot(ahead, local.north)));
    return result;
}

void GlobeCamera::fly(const BodyCamera& goal, milliseconds duration)
{
    is_zooming_ = false;
    motion_.follow([from = motion_.camera(), to = bounded(goal), ellipsoid = ground_.ellipsoid()](
                       double share) { return flown(from, to, ellipsoid, share); },
                   duration);
}

void GlobeCamera::step(NavigationStep step)
{
    if (ground_.isEmpty()) {
        return;
    }
    const Ellipsoid& ellipsoid = ground_.ellipsoid();
    BodyCamera camera = onGround(motion_.goal());
    switch (step) {
    case NavigationStep::PanLeft:
        camera = panned(camera, -kPanShare, 0.0, ellipsoid);
        break;
    case NavigationStep::PanRight:
        camera = panned(camera, kPanShare, 0.0, ellipsoid);
        break;
    case NavigationStep::PanAway:
        camera = panned(camera, 0.0, kPanShare, ellipsoid);
        break;
    case NavigationStep::PanNearer:
        camera = panned(camera, 0.0, -kPanShare, ellipsoid);
        break;
    case NavigationStep::ZoomIn:
        camera.distance_m *= kKeyZoomFactor;
        break;
    case NavigationStep::ZoomOut:
        camera = motion_.goal();
        camera.distance_m /= kKeyZoomFactor;
        break;
    case NavigationStep::TurnLeft:
        camera = orbited(camera, -kKeyTurn, {});
        break;
    case NavigationStep::TurnRight:
        camera = orbited(camera, kKeyTurn, {});
        break;
    case NavigationStep::TiltUp:
        camera = orbited(camera, {}, kKeyTilt);
        break;
    case NavigationStep::TiltDown:
        camera = orbited(camera, {}, -kKeyTilt);
        break;
    }
    fly(camera, kKeyDuration);
}

// Speed and pivot are found when a push begins, as on the flat map: found again in each frame, they
// would jump from ridge to ridge.
void GlobeCamera::steer(const CapRates& rates, double seconds)
{
    if (ground_.isEmpty() || !doesSteer(rates)) {
        cap_ = {};
        return;
    }
    const double rise = capSpeed(rates.push.z);
    const bool begins = !doesSteer(cap_) || (doesTurn(rates) && !doesTurn(cap_));
    BodyCamera camera = motion_.camera();
    if (rise < 0.0 || (begins && rise == 0.0)) {
        camera = onGround(camera);
    }
    camera = bounded(steered(camera, rates, seconds, ground_.limits()));
    if (isMoving() || !(camera == motion_.camera())) {
        cap_ = rates;
        motion_.jumpTo(camera);
    }
}

void GlobeCamera::goHome()
{
    if (!ground_.isEmpty()) {
        fly(homeView(), kFlyDuration);
    }
}

void GlobeCamera::turnNorthUp()
{
    if (!ground_.isEmpty()) {
        BodyCamera camera = onGround(motion_.goal());
        camera.azimuth = {};
        fly(camera, kFlyDuration);
    }
}

void GlobeCamera::flyTo(const BodyCamera& camera)
{
    if (!ground_.isEmpty()) {
        fly(camera, kFlyDuration);
    }
}

void GlobeCamera::flyTo(const GeographicPoint& place, double distance_m)
{
    if (ground_.isEmpty()) {
        return;
    }
    BodyCamera camera = onGround(motion_.goal());
    camera.target = place;
    camera.height_m = ground_.heightOrZero(place);
    if (distance_m > 0.0) {
        camera.distance_m = distance_m;
    }
    fly(camera, kFlyDuration);
}

void GlobeCamera::flyNearer(const GeographicPoint& place)
{
    if (!ground_.isEmpty()) {
        flyTo(place, onGround(motion_.goal()).distance_m * kFlyFactor);
    }
}

void GlobeCamera::flyTo(const BodyTerrain& map)
{
    const BodyLimits bounds = ground_.limitsOf(map);
    const std::vector<ScenePoint> places = ground_.placesOf(map);
    BodyCamera camera = homeCamera(bounds, places, viewport_());
    if (!isBall(bounds.area)) {
        const BodyCamera now = onGround(motion_.goal());
        camera.azimuth = now.azimuth;
        camera.tilt = now.tilt;
        camera.height_m =
            middleHeight(places, bounds.ellipsoid); // exaggerated, it may be far below 0
        camera = withGroundAhead(framed(camera, places, viewport_(), bounds.ellipsoid),
                                 bounds.ellipsoid);
    }
    fly(camera, kFlyDuration);
}

void GlobeCamera::lookAt(const GeographicPoint& place, std::optional<Angle> azimuth)
{
    if (ground_.isEmpty()) {
        return;
    }
    BodyCamera camera = motion_.camera();
    camera.target = place;
    camera.height_m = ground_.heightOrZero(place);
    camera.azimuth = azimuth.value_or(camera.azimuth);
    motion_.jumpTo(camera);
}

HeldPoint GlobeCamera::hold(PixelPoint pixel) const
{
    const Ray ray = rayThrough(pixel);
    const auto ground = ground_.cast(ray);
    const Ellipsoid& ellipsoid = ground_.ellipsoid();
    return {.point = ground ? ray.at(ground->hit.distance_m)
                            : pointOnBody(ray, ellipsoid, targetOf(motion_.camera(), ellipsoid)),
            .pixel = pixel};
}

void GlobeCamera::pull(const HeldPoint& held)
{
    motion_.jumpTo(heldAt(motion_.camera(), ground_.ellipsoid(), viewport_(), held));
}

void GlobeCamera::orbit(Angle turn, Angle tilt)
{
    motion_.jumpTo(orbited(motion_.camera(), turn, tilt));
}

void GlobeCamera::zoom(double factor, const HeldPoint& held, milliseconds duration)
{
    if (is_zooming_ && motion_.isMoving()) {
        factor *= std::pow(zoom_left_, 1.0 - motion_.share());
    }
    const BodyCamera from =
        factor < 1.0 && !motion_.isMoving() ? onGround(motion_.camera()) : motion_.camera();
    is_zooming_ = true;
    zoom_left_ = factor;
    motion_.follow(
        [from, factor, held, bounds = ground_.limits(), size = viewport_()](double share) {
            return zoomed(from, std::pow(factor, share), size, held, bounds);
        },
        duration);
}

void GlobeCamera::zoomAtOnce(double factor, const ScenePoint& held)
{
    const BodyCamera from = factor < 1.0 ? onGround(motion_.camera()) : motion_.camera();
    if (const auto pixel = project(poseOf(from, ground_.ellipsoid()), viewport_(), held)) {
        motion_.jumpTo(zoomed(from, factor, viewport_(), {held, *pixel}, ground_.limits()));
    }
}

} // namespace marsview
