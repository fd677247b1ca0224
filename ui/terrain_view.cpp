#include "ui/terrain_view.h"

#include "core/view/exaggeration.h"

#include <QLabel>
#include <QMouseEvent>
#include <QOpenGLContext>
#include <QVBoxLayout>
#include <QWheelEvent>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

namespace marsview {
namespace {

using std::chrono::milliseconds;

// Which drag does what: the first line that fits is taken. The left button is to touch the ground
// once there is something to touch it with, and only pans until then.
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
    DragBinding{Qt::LeftButton, Qt::NoModifier, DragAction::Pan},
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

bool isSameFrame(const SceneFrame& a, const SceneFrame& b)
{
    return a.origin == b.origin && a.east_per_column == b.east_per_column &&
           a.east_per_row == b.east_per_row && a.north_per_column == b.north_per_column &&
           a.north_per_row == b.north_per_row;
}

} // namespace

TerrainView::TerrainView(QWidget* parent)
    : QOpenGLWidget(parent)
    , navigator_([this](const OrbitCamera& camera) { return bounded(camera); })
    , empty_hint_(new QLabel(this))
{
    style_.ramp = &defaultColorRamp({});
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
    connect(&navigator_, &Navigator::cameraChanged, this, [this] {
        is_completion_reported_ = false;
        update();
        reportPointer();
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
    const LoadedMap map = top_first.empty() ? LoadedMap{} : top_first.front().map;
    pending_ramp_ = top_first.empty() ? nullptr : top_first.front().ramp;
    const LoadedMap& latest = is_pending_ ? pending_map_ : map_;
    if (map.dataset != latest.dataset) {
        setMap(map);
    } else if (!is_pending_ && pending_ramp_ != nullptr) {
        style_.ramp = pending_ramp_;
        is_completion_reported_ = false;
        update();
    }
}

void TerrainView::setLook(const TerrainLook& look)
{
    look_ = look;
    style_.light_azimuth = look.light_azimuth;
    style_.light_altitude = look.light_altitude;
    is_completion_reported_ = false;
    update();
}

void TerrainView::setAntialiasing(bool) {}

void TerrainView::setFrameTarget(std::chrono::milliseconds) {}

void TerrainView::flyTo(GridPoint grid, double distance_m)
{
    if (!map_) {
        return;
    }
    OrbitCamera goal = onGround(navigator_.goal());
    const double height_m = map_.dataset->heightfield().height(grid);
    const double z_m = std::isfinite(height_m) ? height_m * style_.exaggeration : goal.target.z;
    goal.target = map_.dataset->georeference().sceneFrame().toScene(grid, z_m);
    if (distance_m > 0.0) {
        goal.distance_m = distance_m;
    }
    navigator_.moveTo(goal, kFlyDuration);
}

void TerrainView::setMap(const LoadedMap& map)
{
    pending_map_ = map;
    is_pending_ = true;
    is_pending_sent_ = false;
    is_completion_reported_ = false;
    update();
}

void TerrainView::setCamera(const OrbitCamera& camera)
{
    navigator_.jumpTo(camera);
}

void TerrainView::setExaggeration(double exaggeration)
{
    if (exaggeration == style_.exaggeration) {
        return;
    }
    const double before = style_.exaggeration;
    // A motion that is under way ends where it would have ended.
    const OrbitCamera goal = map_ ? onGround(navigator_.goal()) : navigator_.goal();
    style_.exaggeration = exaggeration;
    navigator_.jumpTo(reexaggerated(goal, before, exaggeration));
    Q_EMIT exaggerationChanged(exaggeration);
}

void TerrainView::step(NavigationStep step)
{
    if (!map_) {
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
    navigator_.moveTo(camera, kKeyDuration);
}

void TerrainView::goHome()
{
    if (map_) {
        navigator_.moveTo(homeCamera(box(), viewport()), kFlyDuration);
    }
}

void TerrainView::turnNorthUp()
{
    if (map_) {
        OrbitCamera camera = onGround(navigator_.goal());
        camera.azimuth = {};
        navigator_.moveTo(camera, kFlyDuration);
    }
}

std::optional<RayHit> TerrainView::surfaceAt(QPointF position) const
{
    if (!map_) {
        return std::nullopt;
    }
    const Ray ray = pickRay(navigator_.camera(), viewport(), pixelAt(position));
    return castRay(map_.dataset->heightfield(), *map_.pyramid,
                   gridRay(ray.origin, ray.direction, map_.dataset->georeference().sceneFrame(),
                           style_.exaggeration));
}

std::optional<QPointF> TerrainView::positionOf(GridPoint grid) const
{
    if (!map_) {
        return std::nullopt;
    }
    const double height_m = map_.dataset->heightfield().height(grid);
    const auto pixel = project(
        navigator_.camera(), viewport(),
        map_.dataset->georeference().sceneFrame().toScene(grid, height_m * style_.exaggeration));
    if (!pixel || !std::isfinite(pixel->x)) {
        return std::nullopt;
    }
    return QPointF(pixel->x, pixel->y) / devicePixelRatioF();
}

bool TerrainView::isPictureComplete() const
{
    return map_ && !is_pending_ && is_completion_reported_ && !navigator_.isMoving();
}

void TerrainView::initializeGL()
{
    connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &TerrainView::releaseGraphics);
    Result<std::unique_ptr<TerrainRenderer>> renderer = TerrainRenderer::create();
    if (!renderer) {
        const QString reason = QString::fromStdString(renderer.error().message);
        QMetaObject::invokeMethod(
            this, [this, reason] { Q_EMIT unavailable(reason); }, Qt::QueuedConnection);
        return;
    }
    renderer_ = std::move(renderer).value();
    if (map_ && !is_pending_) {
        setMap(map_); // the window got another context
    }
    // What follows may load or close things, which is not for the middle of painting.
    QMetaObject::invokeMethod(
        this, [this, limits = renderer_->limits()] { Q_EMIT ready(limits); }, Qt::QueuedConnection);
}

void TerrainView::paintGL()
{
    if (!renderer_) {
        return;
    }
    if (is_pending_ && !is_pending_sent_) {
        renderer_->setTerrain(pending_map_.draw_data);
        is_pending_sent_ = true;
    }
    const bool is_complete = renderer_->advance();
    if (is_complete && is_pending_) {
        showPendingMap();
    }
    renderer_->draw(navigator_.camera(), style_, viewport());
    if (!is_complete) {
        update();
    } else if (map_ && !is_completion_reported_ && !navigator_.isMoving()) {
        is_completion_reported_ = true;
        QMetaObject::invokeMethod(
            this, [this] { Q_EMIT pictureCompleted(); }, Qt::QueuedConnection);
    }
}

void TerrainView::releaseGraphics()
{
    if (renderer_) {
        makeCurrent();
        renderer_.reset();
        doneCurrent();
    }
}

// The renderer has the map: from here on camera, picking and picture are about the same one.
void TerrainView::showPendingMap()
{
    const bool is_same_place = map_ && pending_map_ &&
                               isSameFrame(map_.dataset->georeference().sceneFrame(),
                                           pending_map_.dataset->georeference().sceneFrame());
    map_ = std::move(pending_map_);
    pending_map_ = {};
    is_pending_ = false;
    empty_hint_->setVisible(!map_);
    if (map_) {
        style_.ramp = pending_ramp_;
        if (!is_same_place) {
            const HeightRange& range = map_.draw_data->range;
            style_.exaggeration =
                defaultExaggeration(box().extent_m(), range.maximum_m - range.minimum_m);
            navigator_.jumpTo(openingCamera(map_.dataset->georeference())
                                  .value_or(homeCamera(box(), viewport())));
        }
    }
    QMetaObject::invokeMethod(
        this,
        [this] {
            Q_EMIT mapShown(map_);
            Q_EMIT exaggerationChanged(style_.exaggeration);
            reportPointer();
        },
        Qt::QueuedConnection);
}

void TerrainView::resizeEvent(QResizeEvent* event)
{
    is_completion_reported_ = false; // before the base class, which paints
    QOpenGLWidget::resizeEvent(event);
    update();
}

void TerrainView::mousePressEvent(QMouseEvent* event)
{
    if (!map_ || drag_action_ != DragAction::None) {
        return;
    }
    navigator_.stop();
    drag_action_ = dragActionFor(*event);
    drag_position_ = event->position();
    grabbed_z_m_ = anchorAt(drag_position_, navigator_.camera()).z;
    if (drag_action_ == DragAction::Orbit) {
        navigator_.jumpTo(onGround(navigator_.camera()));
    }
}

void TerrainView::mouseMoveEvent(QMouseEvent* event)
{
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
    case DragAction::None:
        reportPointer();
        break;
    }
    drag_position_ = event->position();
}

void TerrainView::mouseReleaseEvent(QMouseEvent* event)
{
    if (event->buttons() == Qt::NoButton) {
        drag_action_ = DragAction::None;
    }
}

void TerrainView::mouseDoubleClickEvent(QMouseEvent* event)
{
    const std::optional<RayHit> hit = surfaceAt(event->position());
    if (!hit || event->button() != Qt::LeftButton) {
        return;
    }
    OrbitCamera goal = onGround(navigator_.goal());
    goal.target = map_.dataset->georeference().sceneFrame().toScene(
        hit->grid, hit->height_m * style_.exaggeration);
    goal.distance_m *= kFlyFactor;
    navigator_.moveTo(goal, kFlyDuration);
}

void TerrainView::wheelEvent(QWheelEvent* event)
{
    const double notches = event->angleDelta().y() / kWheelNotch;
    if (!map_ || notches == 0.0) {
        return;
    }
    const bool is_fine = (event->modifiers() & Qt::ControlModifier) != 0;
    const double factor = std::pow(is_fine ? kWheelFactorFine : kWheelFactor, notches);
    const OrbitCamera goal = beforeZoom(factor);
    const ScenePoint anchor = anchorAt(event->position(), goal);
    navigator_.moveTo(zoomed(goal, factor, anchor, limits()), kWheelDuration);
    event->accept();
}

void TerrainView::leaveEvent(QEvent* event)
{
    QOpenGLWidget::leaveEvent(event);
    pointer_.reset();
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

double TerrainView::groundAt(double east_m, double north_m) const
{
    const Dataset& dataset = *map_.dataset;
    GridPoint grid = dataset.georeference().sceneFrame().toGrid({east_m, north_m, 0.0});
    // The edge of the map is ground too, whatever rounding makes of it.
    const auto on_edge = [](double place, std::size_t count) {
        const double nearest = std::clamp(place, 0.0, static_cast<double>(count - 1));
        return std::abs(nearest - place) < 1e-6 ? nearest : place;
    };
    grid = {on_edge(grid.column, dataset.heightfield().columns()),
            on_edge(grid.row, dataset.heightfield().rows())};
    return dataset.heightfield().height(grid) * style_.exaggeration;
}

SceneBox TerrainView::box() const
{
    const TerrainDrawData& drawn = *map_.draw_data;
    return sceneBox(drawn.frame, drawn.columns, drawn.rows, drawn.range, style_.exaggeration);
}

NavigationLimits TerrainView::limits() const
{
    const Georeference& georeference = map_.dataset->georeference();
    return navigationLimits(
        box(), std::min(georeference.pixelWidthMetres(), georeference.pixelHeightMetres()));
}

OrbitCamera TerrainView::bounded(const OrbitCamera& camera) const
{
    if (!map_) {
        return camera;
    }
    return constrained(camera, limits(),
                       [this](double east_m, double north_m) { return groundAt(east_m, north_m); });
}

// The same picture, its target on the ground in the middle of it.
OrbitCamera TerrainView::onGround(const OrbitCamera& camera) const
{
    const Ray ray{.origin = eyeOf(camera), .direction = axesOf(camera).forward};
    const auto hit =
        castRay(map_.dataset->heightfield(), *map_.pyramid,
                gridRay(ray.origin, ray.direction, map_.dataset->georeference().sceneFrame(),
                        style_.exaggeration));
    const NavigationLimits bounds = limits();
    if (!hit || hit->t < bounds.distance_min_m || hit->t > bounds.distance_max_m) {
        return camera;
    }
    return retargeted(camera, hit->t);
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
    if (const auto hit = surfaceAt(position)) {
        return map_.dataset->georeference().sceneFrame().toScene(
            hit->grid, hit->height_m * style_.exaggeration);
    }
    return anchorBesideMap(camera, pickRay(navigator_.camera(), viewport(), pixelAt(position)));
}

void TerrainView::reportPointer()
{
    Q_EMIT pointerMoved(pointer_ ? surfaceAt(*pointer_) : std::nullopt);
}

} // namespace marsview
