// What the view shows and from where. Its pictures are in terrain_view_picture.cpp, the hands on it
// in terrain_view_hands.cpp.

#include "ui/canvas/terrain_view.h"

#include "core/view/exaggeration.h"

#include <QLabel>
#include <QOpenGLContext>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

using std::chrono::milliseconds;

constexpr double kPanShare = 0.12; // of the distance, a key press
constexpr double kKeyZoomFactor = 0.75;
constexpr Angle kKeyTurn = Angle::degrees(10.0);
constexpr Angle kKeyTilt = Angle::degrees(5.0);
constexpr milliseconds kKeyDuration{180};

constexpr milliseconds kFlyDuration{700};

// How often finer ground is looked for below a stylus that presses.
constexpr milliseconds kTouchInterval{33};

// Whether two pictures of one file, a preview maybe, have their outer corners in the same places of
// the scene.
bool isSameGround(const Map& a, const Map& b)
{
    const auto corner = [](const Map& map, double side) {
        const Georeference& georeference = map.georeference();
        const auto end = [side](std::size_t count) {
            return -0.5 + side * static_cast<double>(count);
        };
        return georeference.sceneFrame().toScene(
            {end(georeference.columns()), end(georeference.rows())}, 0.0);
    };
    constexpr double kTolerance = 1e-6;
    const double tolerance_m = kTolerance * length(corner(a, 1.0) - corner(a, 0.0));
    return a.spec().path == b.spec().path &&
           length(corner(a, 0.0) - corner(b, 0.0)) <= tolerance_m &&
           length(corner(a, 1.0) - corner(b, 1.0)) <= tolerance_m;
}

// Nothing moves on screen from one to the other.
bool isSamePicture(const OrbitCamera& a, const OrbitCamera& b)
{
    constexpr double kShare = 1e-9; // of the distance, and in radians
    return length(eyeOf(a) - eyeOf(b)) <= kShare * std::min(a.distance_m, b.distance_m) &&
           std::abs((a.azimuth - b.azimuth).radians()) <= kShare &&
           std::abs((a.tilt - b.tilt).radians()) <= kShare;
}

// Whether some map took the place of its preview.
bool isCompletionOf(const SceneSurface& before, const SceneSurface& now)
{
    return std::any_of(before.maps().begin(), before.maps().end(), [&now](const SceneMap& then) {
        return std::any_of(now.maps().begin(), now.maps().end(), [&then](const SceneMap& map) {
            return then.map != map.map && isOfSameMap(*then.map, *map.map);
        });
    });
}

} // namespace

TerrainView::TerrainView(QWidget* parent)
    : QOpenGLWidget(parent)
    , navigator_([this](const OrbitCamera& camera) { return bounded(camera); })
    , empty_hint_(new QLabel(this))
{
    setAccessibleName(tr("Map"));
    setAccessibleDescription(
        tr("The terrain in perspective; the status bar shows the position and elevation under the "
           "pointer or the stylus, or at the crosshair in the middle while the keyboard is used"));
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setMinimumSize(160, 120);
    setHint({});
    empty_hint_->setObjectName(QStringLiteral("emptyHint"));
    empty_hint_->setAlignment(Qt::AlignCenter);
    empty_hint_->setAttribute(Qt::WA_TransparentForMouseEvents);
    // Over the sky, which is dark in every palette.
    QPalette palette = empty_hint_->palette();
    palette.setColor(QPalette::WindowText, QColor(200, 205, 214));
    empty_hint_->setPalette(palette);
    QFont font = empty_hint_->font();
    font.setPointSizeF(font.pointSizeF() * 1.4);
    empty_hint_->setFont(font);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(empty_hint_);
    pointer_timer_.setSingleShot(true);
    connect(&pointer_timer_, &QTimer::timeout, this, &TerrainView::readUnderPointer);
    lead_timer_.setSingleShot(true);
    connect(&lead_timer_, &QTimer::timeout, this, &TerrainView::reportPointer);
    touch_timer_.setInterval(kTouchInterval);
    connect(&touch_timer_, &QTimer::timeout, this, &TerrainView::refreshTouch);
    still_timer_.setSingleShot(true);
    connect(&still_timer_, &QTimer::timeout, this, &TerrainView::refineWhenStill);
    connect(&navigator_, &Navigator::cameraChanged, this, [this] {
        has_hand_moved_ = true; // over the ground
        redrawTerrain();
        moveStylus();
        reportPointer();
        Q_EMIT sightChanged();
    });
}

TerrainView::~TerrainView()
{
    if (context() != nullptr) {
        // The base class destroys the context after this class's members are gone.
        disconnect(context(), nullptr, this, nullptr);
    }
    releaseGraphics();
}

void TerrainView::setLayers(const std::vector<ShownLayer>& top_first,
                            std::optional<double> exaggeration)
{
    shown_ = top_first;
    std::vector<std::shared_ptr<const Map>> maps;
    for (const ShownLayer& layer : top_first) {
        maps.push_back(layer.map);
    }
    const std::shared_ptr<const Map> map = maps.empty() ? nullptr : maps.front();
    const bool is_completed = map_ && map && isOfSameMap(*map_, *map);
    const bool is_same_place =
        map_ && map &&
        (map_->georeference().sceneFrame() == map->georeference().sceneFrame() ||
         isSameGround(*map_, *map));
    const bool is_other_map = map != map_;
    if (map_ && is_other_map) {
        rememberSight();
    }
    // A map that replaces its preview keeps the preview's view, even if another would suit it.
    const bool is_suited =
        map_ && !is_completed && style_.exaggeration == suitableExaggeration(*map_);
    const double exaggeration_before = style_.exaggeration;
    const SceneSurface before = ground_;
    map_ = map;
    ramp_ = top_first.empty() ? nullptr : top_first.front().ramp;
    ground_ = SceneSurface(maps);
    layers_.clear();
    for (std::size_t i = 0; i < maps.size(); ++i) {
        layers_.push_back(terrainLayer(maps[i], ground_.maps()[i].frame, *top_first[i].ramp));
        layers_.back().tint_range = colorRangeOf(top_first[i]);
        layers_.back().slope_range = slopeRangeOf(top_first[i]);
    }
    are_layers_sent_ = false;
    empty_hint_->setVisible(!map_);
    const bool is_other_place = map_ && !is_same_place;
    std::optional<Sight> sight;
    if (is_other_place) {
        sight = sightToGoOnWith(before);
    } else if (map_ && is_suited) {
        // The heights may have changed, as when the user sets the nodata value.
        const double suitable = suitableExaggeration(*map_);
        sight = Sight{.map = map_,
                      .camera = reexaggerated(navigator_.goal(), style_.exaggeration, suitable),
                      .exaggeration = suitable};
    }
    if (sight) {
        style_.exaggeration = sight->exaggeration;
    } else if (is_other_place) {
        style_.exaggeration = suitableExaggeration(*map_);
    }
    if (map_ && exaggeration && *exaggeration != style_.exaggeration) {
        if (sight || !is_other_place) { // otherwise the opening view follows
            const OrbitCamera camera = sight ? sight->camera : navigator_.goal();
            sight = Sight{.map = map_,
                          .camera = reexaggerated(camera, style_.exaggeration, *exaggeration),
                          .exaggeration = *exaggeration};
        }
        style_.exaggeration = *exaggeration;
    }
    if (isCompletionOf(before, ground_)) {
        releaseTouch(); // its surface is gone
    }
    // Before the camera moves, which aims the stylus.
    stylus_.setGround(ground_, style_.exaggeration);
    if (sight && sight->camera != navigator_.goal()) {
        setCamera(sight->camera);
    } else if (is_other_place && !sight) {
        goToOpeningView();
    }
    redrawTerrain();
    moveStylus();
    Q_EMIT layersChanged();
    if (!is_other_map && style_.exaggeration != exaggeration_before) {
        Q_EMIT exaggerationChanged(style_.exaggeration);
    }
    if (is_other_map) {
        QMetaObject::invokeMethod(
            this,
            [this] {
                Q_EMIT mapShown(map_);
                Q_EMIT exaggerationChanged(style_.exaggeration);
                reportPointer();
            },
            Qt::QueuedConnection);
    }
}

void TerrainView::replacePreview(const std::shared_ptr<const Map>& preview,
                                 const std::shared_ptr<const Map>& map)
{
    for (Sight& sight : sights_) {
        if (sight.map.lock() == preview) {
            sight.map = map;
        }
    }
}

void TerrainView::rememberSight()
{
    std::erase_if(sights_, [this](const Sight& sight) {
        const auto map = sight.map.lock();
        return !map || map == map_;
    });
    sights_.push_back(
        {.map = map_, .camera = navigator_.goal(), .exaggeration = style_.exaggeration});
}

// Where one of the maps was in the picture before, the same piece of it stays in sight. Otherwise a
// map that was shown once is seen again as it was left.
std::optional<TerrainView::Sight> TerrainView::sightToGoOnWith(const SceneSurface& before) const
{
    for (const SceneMap& now : ground_.maps()) {
        for (const SceneMap& then : before.maps()) {
            if (now.map == then.map) {
                OrbitCamera camera = navigator_.goal();
                camera.target =
                    now.frame.toScene(then.frame.toGrid(camera.target), camera.target.z);
                return Sight{.map = map_, .camera = camera, .exaggeration = style_.exaggeration};
            }
        }
    }
    const auto known = std::find_if(sights_.begin(), sights_.end(), [this](const Sight& sight) {
        return sight.map.lock() == map_;
    });
    return known != sights_.end() ? std::optional(*known) : std::nullopt;
}

void TerrainView::setHint(const QString& hint)
{
    //: Shown in the middle of the window while no map is open. DEM = digital elevation model.
    empty_hint_->setText(hint.isEmpty() ? tr("Drop a DEM here or press Ctrl+O") : hint);
}

void TerrainView::setLook(const TerrainLook& look)
{
    style_.look = look;
    redrawTerrain();
    Q_EMIT lookChanged();
}

void TerrainView::setAntialiasing(bool is_wanted)
{
    if (is_wanted != has_antialiasing_) {
        has_antialiasing_ = is_wanted;
        redrawTerrain();
    }
}

void TerrainView::setFrameTarget(milliseconds target)
{
    frame_target_ = target;
    if (picture_) {
        picture_->setTarget(target);
    }
}

void TerrainView::setCamera(const OrbitCamera& camera)
{
    is_at_opening_view_ = false;
    navigator_.jumpTo(camera);
}

void TerrainView::setExaggeration(double exaggeration)
{
    if (exaggeration == style_.exaggeration) {
        return;
    }
    const double before = style_.exaggeration;
    // A motion in progress keeps its end.
    const OrbitCamera goal = ground_.isEmpty() ? navigator_.goal() : onGround(navigator_.goal());
    style_.exaggeration = exaggeration;
    stylus_.setGround(ground_, exaggeration);
    navigator_.jumpTo(reexaggerated(goal, before, exaggeration));
    Q_EMIT exaggerationChanged(exaggeration);
}

void TerrainView::step(NavigationStep step)
{
    if (ground_.isEmpty()) {
        return;
    }
    setKeyboardUsed(hasFocus());
    is_at_opening_view_ = false;
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
    navigator_.moveTo(camera, kKeyDuration);
}

// The reference point is found where a motion or a turn begins, and while the camera approaches. In
// a grazing view the center of the picture jumps from ridge to ridge: a speed and a pivot found
// again in each frame would jump, too.
void TerrainView::steer(const CapRates& rates, double seconds)
{
    if (ground_.isEmpty() || !doesSteer(rates)) {
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
        setCamera(camera);
    }
}

void TerrainView::goHome()
{
    if (!ground_.isEmpty()) {
        setKeyboardUsed(hasFocus());
        navigator_.moveTo(homeCamera(ground_.box(style_.exaggeration), viewport()), kFlyDuration);
    }
}

void TerrainView::turnNorthUp()
{
    if (!ground_.isEmpty()) {
        setKeyboardUsed(hasFocus());
        OrbitCamera camera = onGround(navigator_.goal());
        camera.azimuth = {};
        navigator_.moveTo(camera, kFlyDuration);
    }
}

void TerrainView::flyTo(GridPoint grid, double distance_m)
{
    if (ground_.isEmpty()) {
        return;
    }
    OrbitCamera goal =
        lookingAt(map_->georeference().sceneFrame().toScene(grid, 0.0), navigator_.goal());
    if (distance_m > 0.0) {
        goal.distance_m = distance_m;
    }
    is_at_opening_view_ = false;
    navigator_.moveTo(goal, kFlyDuration);
}

void TerrainView::goTo(GridPoint grid)
{
    if (ground_.isEmpty()) {
        return;
    }
    setFocus(Qt::OtherFocusReason);
    flyTo(grid, 0.0);
    typed_place_ = {.place = map_->georeference().sceneFrame().toScene(grid, 0.0),
                    .goal = navigator_.goal()};
    setKeyboardUsed(true);
    reportPointer();
}

void TerrainView::flyToPlace(const ScenePoint& place)
{
    if (ground_.isEmpty()) {
        return;
    }
    is_at_opening_view_ = false;
    navigator_.moveTo(lookingAt(place, navigator_.goal()), kFlyDuration);
}

void TerrainView::flyTo(const OrbitCamera& camera)
{
    if (!ground_.isEmpty()) {
        is_at_opening_view_ = false;
        navigator_.moveTo(camera, kFlyDuration);
    }
}

void TerrainView::lookAt(const ScenePoint& place)
{
    if (ground_.isEmpty()) {
        return;
    }
    setCamera(lookingAt(place, navigator_.camera()));
}

// The camera with the ground at a place in the middle of its picture.
OrbitCamera TerrainView::lookingAt(const ScenePoint& place, const OrbitCamera& camera) const
{
    OrbitCamera result = onGround(camera);
    const double z_m = groundAt(place.x, place.y);
    result.target = {place.x, place.y, std::isfinite(z_m) ? z_m : result.target.z};
    return result;
}

bool TerrainView::isInPicture(const ScenePoint& place) const
{
    const auto position = positionOfPlace(place);
    return position && QRectF(rect()).contains(*position);
}

std::optional<RayHit> TerrainView::surfaceAt(QPointF position) const
{
    const std::optional<GroundPoint> ground = groundUnder(position);
    return ground ? std::optional(onTopmost(*ground)) : std::nullopt;
}

RayHit TerrainView::onTopmost(const GroundPoint& ground) const
{
    const ScenePoint place = ground_.maps()[ground.index].frame.toScene(ground.grid, 0.0);
    return {.grid = ground.index == 0 ? ground.grid : ground_.maps().front().frame.toGrid(place),
            .height_m = ground.height_m,
            .t = ground.distance_m};
}

std::optional<QPointF> TerrainView::positionOf(GridPoint grid) const
{
    if (!map_) {
        return std::nullopt;
    }
    const double height_m = map_->heightfield().heightNow(grid);
    return positionOfPlace(
        map_->georeference().sceneFrame().toScene(grid, height_m * style_.exaggeration));
}

std::optional<QPointF> TerrainView::positionOfPlace(const ScenePoint& place) const
{
    const auto pixel = project(navigator_.camera(), viewport(), place);
    if (!pixel || !std::isfinite(pixel->x)) {
        return std::nullopt;
    }
    return QPointF(pixel->x, pixel->y) / devicePixelRatioF();
}

void TerrainView::goToOpeningView()
{
    is_at_opening_view_ = true;
    navigator_.jumpTo(openingCamera(map_->georeference())
                          .value_or(homeCamera(ground_.box(style_.exaggeration), viewport())));
}

void TerrainView::resizeEvent(QResizeEvent* event)
{
    redrawTerrain(); // before the base class, which paints
    QOpenGLWidget::resizeEvent(event);
    if (is_at_opening_view_ && !ground_.isEmpty()) {
        goToOpeningView();
    }
    Q_EMIT sightChanged();
}

// In pixels of the frame buffer.
Viewport TerrainView::viewport() const
{
    const double scale = devicePixelRatioF();
    return {.width = std::max(1, qRound(width() * scale)),
            .height = std::max(1, qRound(height() * scale))};
}

PixelPoint TerrainView::pixelAt(QPointF position) const
{
    const QPointF pixel = position * devicePixelRatioF();
    return {pixel.x(), pixel.y()};
}

std::optional<GroundPoint> TerrainView::groundUnder(QPointF position) const
{
    return ground_.cast(pickRay(navigator_.camera(), viewport(), pixelAt(position)),
                        style_.exaggeration);
}

double TerrainView::groundAt(double east_m, double north_m) const
{
    return ground_.height(east_m, north_m) * style_.exaggeration;
}

NavigationLimits TerrainView::limits() const
{
    return navigationLimits(ground_.box(style_.exaggeration), ground_.pixelMeters());
}

OrbitCamera TerrainView::bounded(const OrbitCamera& camera) const
{
    if (ground_.isEmpty()) {
        return camera;
    }
    return constrained(camera, limits(),
                       [this](double east_m, double north_m) { return groundAt(east_m, north_m); });
}

// The same picture, its target on the ground in the middle of it.
OrbitCamera TerrainView::onGround(const OrbitCamera& camera) const
{
    const auto hit = ground_.cast({.origin = eyeOf(camera), .direction = axesOf(camera).forward},
                                  style_.exaggeration);
    const NavigationLimits bounds = limits();
    if (!hit || hit->distance_m < bounds.distance_min_m ||
        hit->distance_m > bounds.distance_max_m) {
        return camera;
    }
    return retargeted(camera, hit->distance_m);
}

// Zooming in goes by the distance to the ground in the middle of the picture. Zooming out goes by
// the distance there is: it has to grow each time, also where the eye backs into a ridge and has
// another ground in front of it then.
OrbitCamera TerrainView::beforeZoom(double factor) const
{
    return factor < 1.0 ? onGround(navigator_.goal()) : navigator_.goal();
}

} // namespace marsview
