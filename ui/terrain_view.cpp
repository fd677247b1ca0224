#include "ui/terrain_view.h"

#include "core/view/exaggeration.h"

#include <QImage>
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QOpenGLContext>
#include <QVBoxLayout>
#include <QWheelEvent>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace marsview {
namespace {

using std::chrono::milliseconds;

// The shadow of the cursor: radius on screen, and how many sides it has.
constexpr double kShadowPoints = 9.0;
constexpr int kShadowSides = 24;

// No part of the cursor is further from its place and its shadow than this.
constexpr double kCursorReachPoints = 32.0;

// Grabbed in free space, so many points of the hand zoom by a factor of e.
constexpr double kGrabZoomPoints = 160.0;

constexpr double kDeeperPerNotch = 1.15; // of the stylus' depth

// Which drag does what: the first line that fits is taken.
struct DragBinding {
    Qt::MouseButton button;
    Qt::KeyboardModifiers modifiers; // that have to be down; others are ignored
    DragAction action;
};
constexpr std::array kDragBindings{
    DragBinding{Qt::LeftButton, Qt::ShiftModifier, DragAction::Pan},
    DragBinding{Qt::MiddleButton, Qt::ShiftModifier, DragAction::Pan},
    DragBinding{Qt::RightButton, Qt::ShiftModifier, DragAction::Pan},
    DragBinding{Qt::MiddleButton, Qt::NoModifier, DragAction::Orbit},
    DragBinding{Qt::RightButton, Qt::NoModifier, DragAction::Orbit},
    DragBinding{Qt::LeftButton, Qt::NoModifier, DragAction::Touch},
};

DragAction dragActionFor(const QMouseEvent& event)
{
    const auto* hit =
        std::find_if(kDragBindings.begin(), kDragBindings.end(), [&](const DragBinding& binding) {
            return binding.button == event.button() &&
                   (event.modifiers() & binding.modifiers) == binding.modifiers;
        });
    return hit != kDragBindings.end() ? hit->action : DragAction::None;
}

// A drag across 600 pixels turns the map by half a turn.
constexpr Angle kTurnPerPixel = Angle::degrees(0.3);

constexpr double kWheelNotch = 120.0; // Qt counts eighths of a degree, a notch has 15 degrees
constexpr double kWheelFactor = 0.8;  // of the distance, a notch towards the ground
constexpr double kWheelFactorFine = 0.96;
constexpr milliseconds kWheelDuration{140};

constexpr double kPanShare = 0.12; // of the distance, a key press
constexpr double kKeyZoomFactor = 0.75;
constexpr Angle kKeyTurn = Angle::degrees(10.0);
constexpr Angle kKeyTilt = Angle::degrees(5.0);
constexpr milliseconds kKeyDuration{180};

constexpr double kFlyFactor = 0.3; // of the distance, a double click
constexpr milliseconds kFlyDuration{700};

} // namespace

TerrainView::TerrainView(QWidget* parent)
    : QOpenGLWidget(parent)
    , navigator_([this](const OrbitCamera& camera) { return bounded(camera); })
    , empty_hint_(new QLabel(this))
{
    setAccessibleName(tr("Map"));
    setAccessibleDescription(
        tr("The terrain in perspective; the status bar tells the position and "
           "height under the pointer"));
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setMinimumSize(160, 120);
    //: Shown in the middle of the window while no map is open. DEM = digital elevation model.
    empty_hint_->setText(tr("Drop a DEM here or press Ctrl+O"));
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
    still_timer_.setSingleShot(true);
    connect(&still_timer_, &QTimer::timeout, this, &TerrainView::refineWhenStill);
    connect(&navigator_, &Navigator::cameraChanged, this, [this] {
        redrawTerrain();
        moveStylus();
        reportPointer();
        Q_EMIT sightChanged();
    });
}

TerrainView::~TerrainView()
{
    if (context() != nullptr) {
        // The base class destroys the context when nothing of this class is left to be told.
        disconnect(context(), nullptr, this, nullptr);
    }
    releaseGraphics();
}

void TerrainView::setLayers(const std::vector<ShownLayer>& top_first)
{
    std::vector<LoadedMap> maps;
    for (const ShownLayer& layer : top_first) {
        maps.push_back(layer.map);
    }
    const LoadedMap map = maps.empty() ? LoadedMap{} : maps.front();
    const bool is_same_place =
        map_ && map &&
        map_.dataset->georeference().sceneFrame() == map.dataset->georeference().sceneFrame();
    const bool is_other_map = map.dataset != map_.dataset;
    map_ = map;
    ramp_ = top_first.empty() ? nullptr : top_first.front().ramp;
    ground_ = SceneSurface(maps);
    layers_.clear();
    for (std::size_t i = 0; i < maps.size(); ++i) {
        layers_.push_back(terrainLayer(maps[i], ground_.maps()[i].frame, *top_first[i].ramp));
    }
    are_layers_sent_ = false;
    empty_hint_->setVisible(!map_);
    if (map_ && !is_same_place) {
        style_.exaggeration = suitableExaggeration(*map_.dataset);
    }
    // Before the camera moves, which aims the stylus.
    stylus_.setGround(ground_, style_.exaggeration);
    if (map_ && !is_same_place) {
        goToOpeningView();
    }
    redrawTerrain();
    moveStylus();
    Q_EMIT layersChanged();
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
    // A motion that is under way ends where it would have ended.
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

void TerrainView::goHome()
{
    if (!ground_.isEmpty()) {
        navigator_.moveTo(homeCamera(ground_.box(style_.exaggeration), viewport()), kFlyDuration);
    }
}

void TerrainView::turnNorthUp()
{
    if (!ground_.isEmpty()) {
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
    OrbitCamera goal = onGround(navigator_.goal());
    const SceneFrame& frame = map_.dataset->georeference().sceneFrame();
    const ScenePoint place = frame.toScene(grid, 0.0);
    const double z_m = groundAt(place.x, place.y);
    goal.target = {place.x, place.y, std::isfinite(z_m) ? z_m : goal.target.z};
    if (distance_m > 0.0) {
        goal.distance_m = distance_m;
    }
    is_at_opening_view_ = false;
    navigator_.moveTo(goal, kFlyDuration);
}

void TerrainView::lookAt(const ScenePoint& place)
{
    if (ground_.isEmpty()) {
        return;
    }
    OrbitCamera camera = onGround(navigator_.camera());
    const double z_m = groundAt(place.x, place.y);
    camera.target = {place.x, place.y, std::isfinite(z_m) ? z_m : camera.target.z};
    setCamera(camera);
}

std::optional<RayHit> TerrainView::surfaceAt(QPointF position) const
{
    const std::optional<GroundPoint> ground = groundUnder(position);
    if (!ground) {
        return std::nullopt;
    }
    const ScenePoint place = ground_.maps()[ground->index].frame.toScene(ground->grid, 0.0);
    return RayHit{.grid = ground->index == 0 ? ground->grid
                                             : ground_.maps().front().frame.toGrid(place),
                  .height_m = ground->height_m,
                  .t = ground->distance_m};
}

std::optional<QPointF> TerrainView::positionOf(GridPoint grid) const
{
    if (!map_) {
        return std::nullopt;
    }
    const double height_m = map_.dataset->heightfield().height(grid);
    return positionOfPlace(
        map_.dataset->georeference().sceneFrame().toScene(grid, height_m * style_.exaggeration));
}

std::optional<QPointF> TerrainView::positionOfPlace(const ScenePoint& place) const
{
    const auto pixel = project(navigator_.camera(), viewport(), place);
    if (!pixel || !std::isfinite(pixel->x)) {
        return std::nullopt;
    }
    return QPointF(pixel->x, pixel->y) / devicePixelRatioF();
}

bool TerrainView::isPictureComplete() const
{
    return is_completion_reported_ && is_terrain_current_ && !navigator_.isMoving();
}

QImage TerrainView::terrainPicture()
{
    is_cursor_shown_ = false;
    QImage picture = grabFramebuffer();
    is_cursor_shown_ = true;
    update(); // what was grabbed may come on screen
    return picture;
}

void TerrainView::initializeGL()
{
    connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &TerrainView::releaseGraphics);
    const auto refuse = [this](const Error& error) {
        renderer_.reset();
        reportUnavailable(QString::fromStdString(error.message));
    };
    auto renderer = TerrainRenderer::create([this] {
        QMetaObject::invokeMethod(this, &TerrainView::redrawWithNews, Qt::QueuedConnection);
    });
    if (!renderer) {
        refuse(renderer.error());
        return;
    }
    auto cursor = CursorRenderer::create();
    if (!cursor) {
        refuse(cursor.error());
        return;
    }
    renderer_ = std::move(renderer).value();
    cursor_ = std::move(cursor).value();
    picture_ = std::make_unique<GovernedPicture>(*renderer_);
    picture_->setTarget(frame_target_);
    are_layers_sent_ = false;
    redrawTerrain();
    // What follows may open dialogs, which is not for the middle of painting.
    QMetaObject::invokeMethod(
        this, [this] { Q_EMIT ready(); }, Qt::QueuedConnection);
}

void TerrainView::paintEvent(QPaintEvent* event)
{
    QOpenGLWidget::paintEvent(event);
    // Without a context the base class never calls initializeGL().
    if (!isValid() && !std::exchange(is_context_missing_, true)) {
        reportUnavailable(
            tr("no OpenGL context can be created; install the graphics driver, or Mesa's "
               "software one (libgl1-mesa-dri)"));
    }
}

// Later: who hears of it may open dialogs, which is not for the middle of painting.
void TerrainView::reportUnavailable(const QString& reason)
{
    QMetaObject::invokeMethod(
        this, [this, reason] { Q_EMIT unavailable(reason); }, Qt::QueuedConnection);
}

void TerrainView::releaseGraphics()
{
    if (renderer_) {
        makeCurrent();
        picture_.reset();
        cursor_.reset();
        renderer_.reset();
        doneCurrent();
    }
}

void TerrainView::paintGL()
{
    if (!renderer_) {
        return;
    }
    if (!is_terrain_current_) {
        paintTerrain();
    } else {
        renderer_->present(defaultFramebufferObject());
    }
    paintCursor();
}

void TerrainView::paintTerrain()
{
    if (!std::exchange(are_layers_sent_, true)) {
        renderer_->setLayers(layers_);
    }
    const DrawReport report = picture_->paint({.camera = navigator_.camera(),
                                               .viewport = viewport(),
                                               .stage = stage_,
                                               .is_touching = buttons_.is_pressing,
                                               .is_kept = true},
                                              style_, defaultFramebufferObject());
    last_paint_ = std::chrono::steady_clock::now();
    is_terrain_current_ = true;
    Q_EMIT detailChanged(report.error_px);
    if (stage_ == PictureStage::Moving) {
        still_timer_.start(kStillAfter);
    } else if (report.is_complete) {
        // Input that came meanwhile goes first.
        QMetaObject::invokeMethod(this, &TerrainView::finishStage, Qt::QueuedConnection);
    }
}

void TerrainView::paintCursor()
{
    const auto& pose = stylus_.pose();
    if (!pose || !is_cursor_shown_) {
        return;
    }
    CursorPicture cursor{.shape = CursorShape::Sphere,
                         .position = pose->proxy,
                         .goal = std::nullopt,
                         .shadow = {},
                         .pixels_per_point = devicePixelRatioF()};
    switch (pose->mode) {
    case StylusMode::Hover:
    case StylusMode::Press:
        cursor.shape = pose->is_in_contact ? CursorShape::Cone : CursorShape::Sphere;
        break;
    case StylusMode::Pan:
        cursor.shape = CursorShape::FlatSphere;
        break;
    case StylusMode::Zoom:
        cursor.shape = CursorShape::LongSphere;
        break;
    }
    if (pose->is_in_contact) {
        cursor.goal = pose->goal;
    } else {
        const double radius_m = kShadowPoints * devicePixelRatioF() *
                                metresPerPixel(navigator_.camera(), viewport(), pose->proxy);
        for (int i = 0; i < kShadowSides; ++i) {
            const double around = 2.0 * std::numbers::pi * i / kShadowSides;
            const double x = pose->proxy.x + radius_m * std::cos(around);
            const double y = pose->proxy.y + radius_m * std::sin(around);
            const double z = groundAt(x, y);
            if (std::isfinite(z)) {
                cursor.shadow.push_back({x, y, z});
            }
        }
    }
    renderer_->presentDepth(defaultFramebufferObject(), areaOf(cursor));
    cursor_->draw(cursor, navigator_.camera(), viewport(),
                  renderer_->clip(navigator_.camera(), style_.exaggeration));
}

// Where the cursor may be hidden by the ground.
PixelArea TerrainView::areaOf(const CursorPicture& cursor) const
{
    const double reach = kCursorReachPoints * devicePixelRatioF();
    std::vector<ScenePoint> points = cursor.shadow;
    points.push_back(cursor.position);
    const Viewport size = viewport();
    double left = size.width;
    double right = 0.0;
    double top = size.height;
    double bottom = 0.0;
    for (const ScenePoint& point : points) {
        if (const auto pixel = project(navigator_.camera(), size, point)) {
            left = std::min(left, pixel->x - reach);
            right = std::max(right, pixel->x + reach);
            top = std::min(top, pixel->y - reach);
            bottom = std::max(bottom, pixel->y + reach);
        }
    }
    const auto inside = [](double value, int limit) {
        return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(limit)));
    };
    const int first_column = inside(std::floor(left), size.width);
    const int first_row = inside(size.height - std::ceil(bottom), size.height);
    return {.left = first_column,
            .bottom = first_row,
            .width = std::max(0, inside(std::ceil(right), size.width) - first_column),
            .height = std::max(0, inside(size.height - std::floor(top), size.height) - first_row)};
}

// Something of the picture changed: first what is ready in time.
void TerrainView::redrawTerrain()
{
    stage_ = PictureStage::Moving;
    is_terrain_current_ = false;
    is_completion_reported_ = false;
    update();
}

// Shading that was missing has come.
void TerrainView::redrawWithNews()
{
    if (!renderer_) {
        return;
    }
    const bool is_due = std::chrono::steady_clock::now() - last_paint_ >= kNewsInterval;
    if (stage_ == PictureStage::Moving || is_due || !renderer_->isLoading()) {
        is_terrain_current_ = false;
        update();
    }
}

bool TerrainView::isInHand() const noexcept
{
    return navigator_.isMoving() || drag_action_ == DragAction::Orbit ||
           drag_action_ == DragAction::Pan;
}

PictureStage TerrainView::lastStage() const
{
    return has_antialiasing_ ? PictureStage::Smooth : PictureStage::Sharp;
}

void TerrainView::refineWhenStill()
{
    if (navigator_.isMoving()) {
        return; // the next frame starts the timer again
    }
    if (stage_ == PictureStage::Moving) {
        stage_ = PictureStage::Sharp;
        is_terrain_current_ = false;
        update();
    }
}

// A sharp picture has all its shading.
void TerrainView::finishStage()
{
    if (stage_ == PictureStage::Moving || !is_terrain_current_ || is_completion_reported_) {
        return;
    }
    if (stage_ != lastStage()) {
        stage_ = lastStage();
        is_terrain_current_ = false;
        update();
        return;
    }
    is_completion_reported_ = true;
    Q_EMIT pictureCompleted();
}

void TerrainView::goToOpeningView()
{
    is_at_opening_view_ = true;
    navigator_.jumpTo(openingCamera(map_.dataset->georeference())
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

void TerrainView::mousePressEvent(QMouseEvent* event)
{
    if (ground_.isEmpty() || drag_action_ != DragAction::None) {
        return;
    }
    navigator_.stop();
    drag_action_ = dragActionFor(*event);
    drag_button_ = event->button();
    drag_position_ = event->position();
    pointer_ = event->position();
    grabbed_z_m_ = anchorAt(drag_position_, navigator_.camera()).z;
    if (drag_action_ == DragAction::Orbit) {
        setCamera(onGround(navigator_.camera()));
    }
    buttons_.is_pressing = drag_action_ == DragAction::Touch;
    moveStylus();
}

void TerrainView::mouseMoveEvent(QMouseEvent* event)
{
    const QPointF from = pointer_.value_or(event->position());
    pointer_ = event->position();
    const QPointF moved = event->position() - drag_position_;
    switch (drag_action_) {
    case DragAction::Pan:
        setCamera(dragged(navigator_.camera(), viewport(),
                          {.from = pixelAt(drag_position_),
                           .to = pixelAt(event->position()),
                           .grabbed_z_m = grabbed_z_m_}));
        break;
    case DragAction::Orbit:
        setCamera(
            orbited(navigator_.camera(), kTurnPerPixel * moved.x(), kTurnPerPixel * -moved.y()));
        break;
    case DragAction::Touch:
    case DragAction::None:
        if (!moveByGrab(from, event->position())) {
            moveStylus();
        }
        reportPointer();
        break;
    }
    drag_position_ = event->position();
}

void TerrainView::mouseReleaseEvent(QMouseEvent* event)
{
    if (event->button() == drag_button_ || event->buttons() == Qt::NoButton) {
        drag_action_ = DragAction::None;
        buttons_.is_pressing = false;
        moveStylus();
    }
}

void TerrainView::mouseDoubleClickEvent(QMouseEvent* event)
{
    const std::optional<RayHit> hit = surfaceAt(event->position());
    if (!hit || event->button() != Qt::LeftButton) {
        return;
    }
    flyTo(hit->grid, onGround(navigator_.goal()).distance_m * kFlyFactor);
}

void TerrainView::wheelEvent(QWheelEvent* event)
{
    const double notches = event->angleDelta().y() / kWheelNotch;
    if (ground_.isEmpty() || notches == 0.0) {
        return;
    }
    event->accept();
    if (buttons_.is_pressing) {
        stylus_.deepen(std::pow(kDeeperPerNotch, -notches));
        moveStylus();
        return;
    }
    const bool is_fine = (event->modifiers() & Qt::ControlModifier) != 0;
    const double factor = std::pow(is_fine ? kWheelFactorFine : kWheelFactor, notches);
    const OrbitCamera goal = beforeZoom(factor);
    const ScenePoint anchor = anchorAt(event->position(), goal);
    is_at_opening_view_ = false;
    navigator_.moveTo(zoomed(goal, factor, anchor, limits()), kWheelDuration);
}

void TerrainView::keyPressEvent(QKeyEvent* event)
{
    if (event->key() == Qt::Key_Space && event->modifiers() == Qt::NoModifier) {
        if (!event->isAutoRepeat()) {
            setGrabbing(true);
        }
        return;
    }
    QOpenGLWidget::keyPressEvent(event);
}

void TerrainView::keyReleaseEvent(QKeyEvent* event)
{
    if (event->key() == Qt::Key_Space) {
        if (!event->isAutoRepeat()) {
            setGrabbing(false);
        }
        return;
    }
    QOpenGLWidget::keyReleaseEvent(event);
}

void TerrainView::focusOutEvent(QFocusEvent* event)
{
    QOpenGLWidget::focusOutEvent(event);
    setGrabbing(false);
}

void TerrainView::leaveEvent(QEvent* event)
{
    QOpenGLWidget::leaveEvent(event);
    pointer_.reset();
    moveStylus();
    reportPointer();
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
    return navigationLimits(ground_.box(style_.exaggeration), ground_.pixelMetres());
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

// The scene point under a position: on the surface, or else where `camera` finds one beside it.
ScenePoint TerrainView::anchorAt(QPointF position, const OrbitCamera& camera) const
{
    const Ray ray = pickRay(navigator_.camera(), viewport(), pixelAt(position));
    const auto hit = ground_.cast(ray, style_.exaggeration);
    return hit ? ray.at(hit->distance_m) : anchorBesideMap(camera, ray);
}

// True where the stylus has hold of the map and moved it.
bool TerrainView::moveByGrab(QPointF from, QPointF to)
{
    const auto& pose = stylus_.pose();
    if (!pose || !buttons_.is_grabbing) {
        return false;
    }
    if (pose->mode == StylusMode::Pan) {
        setCamera(dragged(navigator_.camera(), viewport(),
                          {.from = pixelAt(from), .to = pixelAt(to), .grabbed_z_m = grabbed_z_m_}));
        return true;
    }
    if (pose->mode == StylusMode::Zoom) {
        const double factor = std::exp((from.y() - to.y()) / -kGrabZoomPoints);
        setCamera(zoomed(beforeZoom(factor), factor, pose->proxy, limits()));
        return true;
    }
    return false;
}

void TerrainView::setGrabbing(bool is_grabbing)
{
    if (is_grabbing != buttons_.is_grabbing) {
        buttons_.is_grabbing = is_grabbing;
        moveStylus();
    }
}

void TerrainView::moveStylus()
{
    const auto ground =
        pointer_ && !ground_.isEmpty() ? groundUnder(*pointer_) : std::optional<GroundPoint>();
    if (ground) {
        const ScenePoint at = ground_.maps()[ground->index].frame.toScene(
            ground->grid, ground->height_m * style_.exaggeration);
        const bool was_panning = stylus_.pose() && stylus_.pose()->mode == StylusMode::Pan;
        stylus_.aim(*ground, buttons_,
                    metresPerPixel(navigator_.camera(), viewport(), at) * devicePixelRatioF());
        if (!was_panning && stylus_.pose()->mode == StylusMode::Pan) {
            grabbed_z_m_ = at.z; // what is under the pointer stays under it
        }
    } else if (!buttons_.is_pressing && !buttons_.is_grabbing) {
        stylus_.lift();
    }
    update();
    Q_EMIT stylusMoved();
}

void TerrainView::reportPointer()
{
    Q_EMIT pointerMoved(pointer_ ? surfaceAt(*pointer_) : std::nullopt);
}

} // namespace marsview
