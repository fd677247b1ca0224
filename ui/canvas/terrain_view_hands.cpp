// Mouse, wheel and keys: what moves the camera and the stylus.

#include "ui/canvas/terrain_view.h"

#include <QApplication>
#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>

#include <cmath>
#include <utility>

namespace marsview {
namespace {

using std::chrono::milliseconds;

// Grabbed in free space, so many points of the hand zoom by a factor of e.
constexpr double kGrabZoomPoints = 160.0;

constexpr double kDeeperPerNotch = 1.15; // of the stylus' depth

// A drag across 600 pixels turns the map by half a turn.
constexpr Angle kTurnPerPixel = Angle::degrees(0.3);

constexpr double kWheelNotch = 120.0; // Qt counts eighths of a degree, a notch has 15 degrees
constexpr double kWheelFactor = 0.8;  // of the distance, a notch towards the ground
constexpr double kWheelFactorFine = 0.96;
constexpr milliseconds kWheelDuration{140};

constexpr double kFlyFactor = 0.3; // of the distance, a double click

} // namespace

void TerrainView::setTool(Tool tool)
{
    if (tool == tool_) {
        return;
    }
    endDrag();
    if (PlaceTool* left = placeTool()) {
        left->hover(std::nullopt);
    }
    tool_ = tool;
    moveStylus();
    update(); // the cursor of the mouse's stylus comes or goes
    Q_EMIT toolChanged(tool);
}

void TerrainView::mousePressEvent(QMouseEvent* event)
{
    if (ground_.isEmpty() || drag_action_ != MapAction::None) {
        return;
    }
    navigator_.stop();
    drag_button_ = event->button();
    drag_position_ = event->position();
    pointer_ = event->position();
    if (PlaceTool* tool = placeTool(); tool != nullptr && event->button() == Qt::LeftButton &&
                                       event->modifiers() == Qt::NoModifier &&
                                       tool->grab(event->position())) {
        beginDrag(MapAction::MovePoint);
        return;
    }
    may_be_click_ =
        actionOf(Gesture::Click, event->button(), event->modifiers(), tool_) != MapAction::None;
    beginDrag(actionOf(Gesture::Drag, event->button(), event->modifiers(), tool_));
    reportPointer();
}

void TerrainView::beginDrag(MapAction action)
{
    drag_action_ = action;
    grabbed_z_m_ = anchorAt(drag_position_, navigator_.camera()).z;
    if (action == MapAction::Orbit && !may_be_click_) {
        setCamera(onGround(navigator_.camera()));
    }
    buttons_.is_pressing = action == MapAction::Touch;
    has_hand_moved_ = false;
    moveStylus();
}

void TerrainView::mouseMoveEvent(QMouseEvent* event)
{
    is_keyboard_used_ = is_keyboard_used_ && pointer_ == event->position(); // reported again
    if (pointer_ != event->position()) {
        leadReading();
    }
    if (drag_action_ == MapAction::None && isOverOverlay(event->position())) {
        forgetPointer();
        return;
    }
    if (may_be_click_) {
        const QPointF moved = event->position() - drag_position_;
        if (moved.manhattanLength() < QApplication::startDragDistance()) {
            return;
        }
        // A drag after all, from where it began.
        may_be_click_ = false;
        if (drag_action_ == MapAction::Orbit) {
            setCamera(onGround(navigator_.camera()));
        }
    }
    dragTo(event->position());
    if (PlaceTool* tool = placeTool(); tool != nullptr && drag_action_ == MapAction::None) {
        tool->hover(event->position());
    }
}

void TerrainView::dragTo(QPointF position)
{
    const QPointF from = pointer_.value_or(position);
    pointer_ = position;
    const QPointF moved = position - drag_position_;
    has_hand_moved_ = has_hand_moved_ || !moved.isNull();
    switch (drag_action_) {
    case MapAction::Pan:
        setCamera(dragged(navigator_.camera(), viewport(),
                          {.from = pixelAt(drag_position_),
                           .to = pixelAt(position),
                           .grabbed_z_m = grabbed_z_m_}));
        break;
    case MapAction::Orbit:
        setCamera(
            orbited(navigator_.camera(), kTurnPerPixel * moved.x(), kTurnPerPixel * -moved.y()));
        break;
    case MapAction::MovePoint:
        place_tool_->drag(position);
        reportPointer();
        break;
    default:
        if (!moveByGrab(from, position)) {
            moveStylus();
        }
        reportPointer();
        break;
    }
    if (drag_action_ != MapAction::None && !moved.isNull()) {
        Q_EMIT gestureMade(drag_action_);
    }
    drag_position_ = position;
}

void TerrainView::mouseReleaseEvent(QMouseEvent* event)
{
    if (event->button() != drag_button_ && event->buttons() != Qt::NoButton) {
        return;
    }
    const bool is_click = std::exchange(may_be_click_, false);
    endDrag();
    const MapAction action =
        is_click ? actionOf(Gesture::Click, event->button(), event->modifiers(), tool_)
                 : MapAction::None;
    if (action == MapAction::OpenMenu) {
        Q_EMIT menuRequested(event->position());
    } else if (PlaceTool* tool = placeTool(); tool != nullptr && action == MapAction::AddPoint) {
        tool->click(event->position());
    }
}

void TerrainView::endDrag()
{
    if (std::exchange(drag_action_, MapAction::None) == MapAction::MovePoint) {
        place_tool_->release();
    }
    may_be_click_ = false;
    buttons_.is_pressing = false;
    moveStylus();
}

// The mouse asks when its button is released, see above; this is for the keyboard.
void TerrainView::contextMenuEvent(QContextMenuEvent* event)
{
    event->accept();
    if (event->reason() != QContextMenuEvent::Mouse && !ground_.isEmpty()) {
        Q_EMIT menuRequested(QRectF(rect()).center());
    }
}

void TerrainView::mouseDoubleClickEvent(QMouseEvent* event)
{
    const MapAction action =
        actionOf(Gesture::DoubleClick, event->button(), event->modifiers(), tool_);
    if (PlaceTool* tool = placeTool(); tool != nullptr && action == MapAction::FinishMeasurement) {
        tool->doubleClick(event->position());
        return;
    }
    const std::optional<RayHit> hit = surfaceAt(event->position());
    if (!hit || action != MapAction::FlyThere) {
        return;
    }
    flyNearer(*hit);
    Q_EMIT gestureMade(MapAction::FlyThere);
}

void TerrainView::flyNearer(const RayHit& hit)
{
    flyTo(hit.grid, onGround(navigator_.goal()).distance_m * kFlyFactor);
}

void TerrainView::wheelEvent(QWheelEvent* event)
{
    const double notches = event->angleDelta().y() / kWheelNotch;
    if (ground_.isEmpty() || notches == 0.0) {
        return;
    }
    event->accept();
    const Gesture gesture = buttons_.is_pressing ? Gesture::WheelWhilePressing : Gesture::Wheel;
    const MapAction action = actionOf(gesture, Qt::NoButton, event->modifiers(), tool_);
    if (action == MapAction::PressDeeper) {
        stylus_.deepen(std::pow(kDeeperPerNotch, -notches));
        moveStylus();
    } else {
        const double factor =
            std::pow(action == MapAction::ZoomFinely ? kWheelFactorFine : kWheelFactor, notches);
        const OrbitCamera goal = beforeZoom(factor);
        const ScenePoint anchor = anchorAt(event->position(), goal);
        is_at_opening_view_ = false;
        navigator_.moveTo(zoomed(goal, factor, anchor, limits()), kWheelDuration);
    }
    Q_EMIT gestureMade(action);
}

void TerrainView::keyPressEvent(QKeyEvent* event)
{
    if (event->key() == Qt::Key_Space && event->modifiers() == Qt::NoModifier) {
        if (!event->isAutoRepeat()) {
            setGrabbing(true);
        }
        return;
    }
    if (event->key() == Qt::Key_F10 && event->modifiers() == Qt::ShiftModifier) {
        if (!ground_.isEmpty()) { // the other key of the context menu, which Qt leaves out on X11
            Q_EMIT menuRequested(QRectF(rect()).center());
        }
        return;
    }
    if (PlaceTool* tool = placeTool(); tool != nullptr && tool->key(*event)) {
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
    reportPointer();
}

void TerrainView::leaveEvent(QEvent* event)
{
    QOpenGLWidget::leaveEvent(event);
    forgetPointer();
}

void TerrainView::setContactModel(ContactModelKind model)
{
    stylus_.setModel(model);
    update();
    Q_EMIT stylusMoved();
}

void TerrainView::showDevice(const std::optional<StylusPose>& pose)
{
    if (pose == device_) {
        return;
    }
    device_ = pose;
    update();
    Q_EMIT stylusMoved();
    if (!device_ || isStylusRead()) {
        reportPointer();
    }
}

const std::optional<StylusPose>& TerrainView::shownStylus() const noexcept
{
    static const std::optional<StylusPose> kNone;
    const auto& mouse = tool_ == Tool::Touch ? stylus_.pose() : kNone;
    const bool is_mouse_at_work = mouse && mouse->mode != StylusMode::Hover;
    return device_ && !is_mouse_at_work ? device_ : mouse;
}

// The scene point under a position: on the surface, or else where `camera` places one off the map.
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
        Q_EMIT grabbingChanged(is_grabbing);
    }
}

void TerrainView::moveStylus()
{
    const bool was_shown = shownStylus().has_value();
    const auto ground =
        pointer_ && !ground_.isEmpty() ? groundUnder(*pointer_) : std::optional<GroundPoint>();
    if (ground) {
        const ScenePoint at = ground_.maps()[ground->index].frame.toScene(
            ground->grid, ground->height_m * style_.exaggeration);
        const bool was_panning = stylus_.pose() && stylus_.pose()->mode == StylusMode::Pan;
        stylus_.aim(*ground, buttons_,
                    metersPerPixel(navigator_.camera(), viewport(), at) * devicePixelRatioF());
        if (!was_panning && stylus_.pose()->mode == StylusMode::Pan) {
            grabbed_z_m_ = at.z; // the grabbed point stays under the pointer
        }
    } else if (!buttons_.is_pressing && !buttons_.is_grabbing) {
        stylus_.lift();
    }
    is_pointer_over_terrain_ = ground.has_value();
    showMapCursor();
    if (stylus_.isWaiting() != touch_timer_.isActive()) {
        touch_timer_.isActive() ? touch_timer_.stop() : touch_timer_.start();
    }
    if (was_shown || shownStylus()) {
        update();
    }
    Q_EMIT stylusMoved();
}

void TerrainView::refreshTouch()
{
    if (!stylus_.isWaiting()) {
        touch_timer_.stop();
    } else if (stylus_.refresh()) {
        if (!has_hand_moved_) {
            stylus_.pressAnew();
        }
        update();
        Q_EMIT stylusMoved();
    }
}

// Until the button is pressed again.
void TerrainView::releaseTouch()
{
    if (drag_action_ == MapAction::Touch) {
        drag_action_ = MapAction::None;
    }
    buttons_.is_pressing = false;
}

void TerrainView::showMapCursor()
{
    const MapCursor cursor =
        mapCursor({.tool = tool_,
                   .drag = may_be_click_ ? MapAction::None : drag_action_,
                   .stylus = stylus_.pose() ? stylus_.pose()->mode : StylusMode::Hover,
                   .is_over_terrain = is_pointer_over_terrain_});
    if (cursor != std::exchange(map_cursor_, cursor)) {
        setCursor(cursorOf(cursor));
    }
}

} // namespace marsview
