#include "ui/canvas/camera_controller.h"

#include "core/raster/open_raster.h"
#include "core/view/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace marsview {
namespace {

using std::chrono::milliseconds;

constexpr double kPanShare = 0.12; // of the distance, a key press
constexpr double kKeyZoomFactor = 0.75;
constexpr Angle kKeyTurn = Angle::degrees(10.0);
constexpr Angle kKeyTilt = Angle::degrees(5.0);
constexpr milliseconds kKeyDuration{180};

constexpr milliseconds kFlyDuration{700};
constexpr double kFlyFactor = 0.3; // of the distance, when flying nearer

// Nothing moves on screen from one to the other.
bool isSamePicture(const OrbitCamera& a, const OrbitCamera& b)
{
    constexpr double kShare = 1e-9; // of the distance, and in radians
    return length(eyeOf(a) - eyeOf(b)) <= kShare * std::min(a.distance_m, b.distance_m) &&
           std::abs((a.azimuth - b.azimuth).radians()) <= kShare &&
           std::abs((a.tilt - b.tilt).radians()) <= kShare;
}

} // namespace

CameraController::CameraController(const ShownScene& scene, std::function<Viewport()> viewport)
    : scene_(scene)
    , viewport_(std::move(viewport))
    , navigator_([this](const OrbitCamera& camera) { return bounded(camera); })
{
    connect(&navigator_, &Navigator::cameraChanged, this, &CameraController::cameraChanged);
}

NavigationLimits CameraController::limits() const
{
    return navigationLimits(scene_.box(), scene_.ground().pixelMeters());
}

void CameraController::jumpTo(const OrbitCamera& camera)
{
    is_at_opening_view_ = false;
    navigator_.jumpTo(camera);
}

void CameraController::moveTo(const OrbitCamera& goal, milliseconds duration)
{
    is_at_opening_view_ = false;
    navigator_.moveTo(goal, duration);
}

void CameraController::step(NavigationStep step)
{
    if (scene_.isEmpty()) {
        return;
    }
    OrbitCamera camera = onGround(navigator_.goal());
    switch (step) {
    case NavigationStep::PanLeft:
        camera = panned(camera, -kPanShare, 0.0);
        break;
    case NavigationStep::PanRight:
        camera = panned(camera, kPanShare, 0.0);
        break;
    case NavigationStep::PanAway:
        camera = panned(camera, 0.0, kPanShare);
        break;
    case NavigationStep::PanNearer:
        camera = panned(camera, 0.0, -kPanShare);
        break;
    case NavigationStep::ZoomIn:
        camera = zoomed(camera, kKeyZoomFactor, camera.target, limits());
        break;
    case NavigationStep::ZoomOut:
        camera = beforeZoom(1.0 / kKeyZoomFactor);
        camera = zoomed(camera, 1.0 / kKeyZoomFactor, camera.target, limits());
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
    moveTo(camera, kKeyDuration);
}

// The reference point is found where a motion or a turn begins, and while the camera approaches. In
// a grazing view the center of the picture jumps from ridge to ridge: a speed and a pivot found
// again in each frame would jump, too.
void CameraController::steer(const CapRates& rates, double seconds)
{
    if (scene_.isEmpty() || !doesSteer(rates)) {
        cap_ = {};
        return;
    }
    const double rise = capSpeed(rates.push.z);
    const bool begins = !doesSteer(cap_) || (doesTurn(rates) && !doesTurn(cap_));
    OrbitCamera camera = navigator_.camera();
    if (rise < 0.0 || (begins && rise == 0.0)) { // further: see beforeZoom()
        camera = onGround(camera);
    }
    camera = bounded(steered(camera, rates, seconds, limits()));
    if (isMoving() || !isSamePicture(camera, navigator_.camera())) {
        cap_ = rates;
        jumpTo(camera);
    }
}

void CameraController::goHome()
{
    if (!scene_.isEmpty()) {
        moveTo(wholeView(), kFlyDuration);
    }
}

void CameraController::turnNorthUp()
{
    if (!scene_.isEmpty()) {
        OrbitCamera camera = onGround(navigator_.goal());
        camera.azimuth = {};
        moveTo(camera, kFlyDuration);
    }
}

void CameraController::flyTo(const OrbitCamera& camera)
{
    if (!scene_.isEmpty()) {
        moveTo(camera, kFlyDuration);
    }
}

void CameraController::flyTo(GridPoint grid, double distance_m)
{
    if (scene_.isEmpty()) {
        return;
    }
    OrbitCamera goal = lookingAt(scene_.placeOf(grid, 0.0), navigator_.goal());
    if (distance_m > 0.0) {
        goal.distance_m = distance_m;
    }
    moveTo(goal, kFlyDuration);
}

void CameraController::flyToPlace(const ScenePoint& place)
{
    if (!scene_.isEmpty()) {
        moveTo(lookingAt(place, navigator_.goal()), kFlyDuration);
    }
}

void CameraController::flyNearer(GridPoint grid, double pixels_per_point)
{
    if (scene_.isEmpty()) {
        return;
    }
    constexpr double kSamplePoints = 8.0; // nearer, the picture shows no more
    double sample_m = std::numeric_limits<double>::infinity();
    for (const ShownLayer& layer : scene_.layers()) {
        const Georeference samples = georeferenceOf(layer.map->info()); // not those of a preview
        sample_m = std::min({sample_m, samples.pixelWidthMeters(), samples.pixelHeightMeters()});
    }
    const OrbitCamera from = onGround(navigator_.goal());
    const double factor_min =
        sample_m / (kSamplePoints * pixels_per_point * metersPerPixel(from, viewport_()));
    flyTo(grid, from.distance_m * std::clamp(factor_min, kFlyFactor, 1.0));
}

void CameraController::lookAt(const ScenePoint& place)
{
    if (!scene_.isEmpty()) {
        jumpTo(lookingAt(place, navigator_.camera()));
    }
}

// The camera with the terrain at a place in the middle of its picture.
OrbitCamera CameraController::lookingAt(const ScenePoint& place, const OrbitCamera& camera) const
{
    OrbitCamera result = onGround(camera);
    const double z_m = scene_.groundHeight(place.x, place.y);
    result.target = {place.x, place.y, std::isfinite(z_m) ? z_m : result.target.z};
    return result;
}

void CameraController::goToOpeningView()
{
    is_at_opening_view_ = true;
    navigator_.jumpTo(openingCamera(scene_.map()->georeference()).value_or(wholeView()));
}

OrbitCamera CameraController::wholeView() const
{
    const std::vector<SceneBox> parts = scene_.ground().partBoxes(scene_.style.exaggeration);
    return parts.empty() ? homeCamera(scene_.box(), viewport()) : fillingCamera(parts, viewport());
}

void CameraController::resize()
{
    if (is_at_opening_view_ && !scene_.isEmpty()) {
        goToOpeningView();
    }
}

OrbitCamera CameraController::goalOnGround() const
{
    return scene_.isEmpty() ? navigator_.goal() : onGround(navigator_.goal());
}

OrbitCamera CameraController::bounded(const OrbitCamera& camera) const
{
    if (scene_.isEmpty()) {
        return camera;
    }
    return constrained(camera, limits(), [this](double east_m, double north_m) {
        return scene_.groundHeight(east_m, north_m);
    });
}

OrbitCamera CameraController::onGround(const OrbitCamera& camera) const
{
    const auto hit = scene_.cast({.origin = eyeOf(camera), .direction = axesOf(camera).forward});
    const NavigationLimits bounds = limits();
    if (!hit || hit->distance_m < bounds.distance_min_m ||
        hit->distance_m > bounds.distance_max_m) {
        return camera;
    }
    return retargeted(camera, hit->distance_m);
}

// Zooming in goes by the distance to the terrain in the middle of the picture. Zooming out goes by
// the camera's distance: it has to grow each time, also where the eye backs into a ridge and has
// other terrain in front of it then.
OrbitCamera CameraController::beforeZoom(double factor) const
{
    return factor < 1.0 ? onGround(navigator_.goal()) : navigator_.goal();
}

} // namespace marsview
