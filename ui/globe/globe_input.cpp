// The events of the globe: what mouse, wheel and keys do.

#include "ui/canvas/overlay_cover.h"
#include "ui/globe/globe_view.h"

#include <QApplication>
#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>

#include <chrono>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

using std::chrono::milliseconds;

// As in the flat map.
constexpr Angle kTurnPerPixel = Angle::degrees(0.3);
constexpr double kWheelNotch = 120.0;
constexpr double kWheelFactor = 0.8;
constexpr double kWheelFactorFine = 0.96;
constexpr milliseconds kWheelDuration{140};

constexpr double kDeeperPerNotch = 1.15;  // of the stylus' depth
constexpr double kGrabZoomPoints = 160.0; // of the hand, for a factor of e

// The pointer is read for so long after it moved, in place of the stylus of a device.
constexpr milliseconds kLeadDuration{2000};

} // namespace

PlaceTool* GlobeView::placeTool() const
{
    const auto found = place_tools_.find(tool_);
    return found != place_tools_.end() ? found->second : nullptr;
}

void GlobeView::setTool(Tool tool)
{
    endDrag();
    if (PlaceTool* left = placeTool(); left != nullptr && tool != tool_) {
        left->hover(std::nullopt);
        left->releaseStylus();
    }
    tool_ = tool;
    touch_.setChosen(tool == Tool::Touch);
    followTouch();
    showCursor();
    Q_EMIT toolChanged();
}

void GlobeView::showDevice(const std::optional<StylusPose>& pose)
{
    if (pose == device_) {
        return;
    }
    const bool was_shown = device_.has_value();
    device_ = pose;
    update(); // over the picture that was kept
    Q_EMIT stylusMoved();
    if (pose) {
        moveStylus(pose->proxy);
    } else {
        releaseStylus();
    }
    if (isStylusRead() || was_shown != device_.has_value()) {
        report();
    }
}

const std::optional<StylusPose>& GlobeView::shownStylus() const noexcept
{
    const auto& mouse = touch_.pose();
    const bool is_mouse_at_work = mouse && mouse->mode != StylusMode::Hover;
    return device_ && !is_mouse_at_work ? device_ : mouse;
}

// On the grid of the topmost map, also where the place is outside it.
std::optional<RayHit> GlobeView::onTopmost(const ScenePoint& place) const
{
    const auto ground = groundBelow(place);
    const auto grid =
        ground
            ? layers().front().map->georeference().toGrid(placeOf(place, ground_.ellipsoid()).foot)
            : std::nullopt;
    return grid ? std::optional(RayHit{.grid = ground->index == 0 ? ground->hit.grid : *grid,
                                       .height_m = ground->hit.height_m,
                                       .t = ground->hit.distance_m})
                : std::nullopt;
}

void GlobeView::pressStylus(const ScenePoint& place)
{
    PlaceTool* tool = placeTool();
    const auto hit = tool != nullptr ? onTopmost(place) : std::nullopt;
    if (hit) {
        tool->pressStylus(*hit);
    }
}

void GlobeView::moveStylus(const ScenePoint& place)
{
    PlaceTool* tool = placeTool();
    const auto hit = tool != nullptr ? onTopmost(place) : std::nullopt;
    if (hit) {
        tool->moveStylus(*hit);
    }
}

void GlobeView::releaseStylus()
{
    if (PlaceTool* tool = placeTool()) {
        tool->releaseStylus();
    }
}

void GlobeView::notePointer(QPointF position)
{
    if (device_ && pointer_ != position) {
        lead_timer_.start(kLeadDuration);
    }
    pointer_ = position;
}

void GlobeView::mousePressEvent(QMouseEvent* event)
{
    if (ground_.isEmpty() || drag_ != MapAction::None) {
        return;
    }
    camera_.stop();
    drag_button_ = event->button();
    drag_position_ = event->position();
    notePointer(event->position());
    PlaceTool* tool = placeTool();
    if (tool != nullptr && event->button() == Qt::LeftButton &&
        event->modifiers() == Qt::NoModifier && tool->grab(event->position())) {
        drag_ = MapAction::MovePoint;
        showCursor();
        return;
    }
    const MapAction click = actionOf(Gesture::Click, event->button(), event->modifiers(), tool_);
    may_be_click_ = click != MapAction::None && click != MapAction::SelectFeature;
    if (click == MapAction::SelectFeature) {
        still_click_.press(*event);
    }
    drag_ = actionOf(Gesture::Drag, event->button(), event->modifiers(), tool_);
    if (drag_ == MapAction::Pan) {
        held_ = camera_.hold(pixelAt(event->position()));
    } else if (drag_ == MapAction::Orbit && !may_be_click_) {
        camera_.aimAtGround();
    }
    touch_.setPressing(drag_ == MapAction::Touch);
    followTouch();
    showCursor();
}

void GlobeView::mouseMoveEvent(QMouseEvent* event)
{
    still_click_.move(event->position());
    if (drag_ == MapAction::None && isOverOverlay(*this, event->position())) {
        forgetPointer();
        return;
    }
    notePointer(event->position());
    const QPointF moved = event->position() - drag_position_;
    if (may_be_click_) {
        if (moved.manhattanLength() < QApplication::startDragDistance()) {
            return;
        }
        may_be_click_ = false; // a drag after all, from where it began
        if (drag_ == MapAction::Orbit) {
            camera_.aimAtGround();
        }
    }
    if (drag_ == MapAction::MovePoint) {
        if (PlaceTool* tool = placeTool()) {
            tool->drag(event->position());
        }
        report();
    } else if (drag_ == MapAction::Pan && held_ && !moved.isNull()) {
        held_->pixel = pixelAt(event->position());
        camera_.pull(*held_);
    } else if (drag_ == MapAction::Orbit && !moved.isNull()) {
        camera_.orbit(kTurnPerPixel * moved.x(), kTurnPerPixel * -moved.y());
    } else {
        if (!moved.isNull()) {
            touch_.noteMotion();
        }
        if (!moveByGrab(drag_position_, event->position())) {
            followTouch();
        }
        report();
        if (PlaceTool* tool = placeTool(); tool != nullptr && drag_ == MapAction::None) {
            tool->hover(event->position());
        }
    }
    if (drag_ != MapAction::None && !moved.isNull()) {
        Q_EMIT gestureMade(drag_);
    }
    drag_position_ = event->position();
}

void GlobeView::mouseReleaseEvent(QMouseEvent* event)
{
    if (event->button() != drag_button_ && event->buttons() != Qt::NoButton) {
        return;
    }
    const bool is_click = may_be_click_;
    const bool is_still = still_click_.release(*event, tool_ == Tool::Touch);
    endDrag();
    followTouch();
    showCursor();
    if (is_still) {
        Q_EMIT clicked(event->position());
        return;
    }
    const MapAction action =
        is_click ? actionOf(Gesture::Click, event->button(), event->modifiers(), tool_)
                 : MapAction::None;
    if (action == MapAction::OpenMenu) {
        Q_EMIT menuRequested(event->position());
    } else if (PlaceTool* tool = placeTool(); tool != nullptr && action == MapAction::AddPoint) {
        tool->click(event->position());
    }
}

void GlobeView::endDrag()
{
    const MapAction ended = std::exchange(drag_, MapAction::None);
    if (PlaceTool* tool = placeTool(); tool != nullptr && ended == MapAction::MovePoint) {
        tool->release();
    }
    may_be_click_ = false;
    still_click_.forget();
    held_.reset();
    touch_.setPressing(false);
}

// The mouse asks when its button is released; this is for the keyboard.
void GlobeView::contextMenuEvent(QContextMenuEvent* event)
{
    event->accept();
    if (event->reason() != QContextMenuEvent::Mouse && !ground_.isEmpty()) {
        Q_EMIT menuRequested(QRectF(rect()).center());
    }
}

void GlobeView::keyPressEvent(QKeyEvent* event)
{
    if (event->key() == Qt::Key_Space && event->modifiers() == Qt::NoModifier &&
        (device_ || touch_.isChosen())) {
        if (!event->isAutoRepeat()) {
            grab();
        }
        return;
    }
    if (event->key() == Qt::Key_F10 && event->modifiers() == Qt::ShiftModifier) {
        if (!ground_.isEmpty()) { // the other key of the context menu, which Qt leaves out on X11
            Q_EMIT menuRequested(QRectF(rect()).center());
        }
        return;
    }
    PlaceTool* tool = placeTool();
    if (tool == nullptr || !tool->key(*event)) {
        QOpenGLWidget::keyPressEvent(event);
    }
}

// By the device, or by the stylus of the mouse: in contact, the ground under the pointer stays
// there.
void GlobeView::grab()
{
    grab_key_.hold();
    if (device_) {
        Q_EMIT grabbingChanged(true);
        return;
    }
    touch_.setGrabbing(true);
    const auto& pose = touch_.pose();
    grabbed_ = pose && pose->mode == StylusMode::Pan && pointer_
                   ? std::optional(camera_.hold(pixelAt(*pointer_)))
                   : std::nullopt;
    showCursor();
}

void GlobeView::releaseGrab()
{
    grabbed_.reset();
    if (touch_.isGrabbing()) {
        touch_.setGrabbing(false);
        followTouch();
        showCursor();
    } else {
        Q_EMIT grabbingChanged(false);
    }
}

// True where the stylus has hold of the body and moved it.
bool GlobeView::moveByGrab(QPointF from, QPointF to)
{
    const auto& pose = touch_.pose();
    if (!pose || !touch_.isGrabbing()) {
        return false;
    }
    if (pose->mode == StylusMode::Pan && grabbed_) {
        grabbed_->pixel = pixelAt(to);
        camera_.pull(*grabbed_);
        return true;
    }
    if (pose->mode == StylusMode::Zoom) {
        camera_.zoomAtOnce(std::exp((to.y() - from.y()) / kGrabZoomPoints), pose->proxy);
        return true;
    }
    return false;
}

// Where the pointer is on the terrain, and how long a point of the screen is there.
void GlobeView::followTouch()
{
    if (!touch_.isChosen()) {
        return;
    }
    const auto ground = pointer_ ? groundAt(*pointer_) : std::nullopt;
    if (!ground) {
        touch_.follow(std::nullopt, 1.0);
        return;
    }
    const Ellipsoid& ellipsoid = ground_.ellipsoid();
    const ScenePoint point = camera_.rayThrough(pixelAt(*pointer_)).at(ground->hit.distance_m);
    touch_.follow(BodyAim{.index = ground->index,
                          .point = point,
                          .up = localAxes(ellipsoid, placeOf(point, ellipsoid).foot).up},
                  devicePixelRatioF() * metersPerPixel(camera_.pose(), viewport(), point));
}

void GlobeView::showCursor()
{
    const auto& pose = touch_.pose();
    const MapCursor cursor = mapCursor({.tool = tool_,
                                        .drag = may_be_click_ ? MapAction::None : drag_,
                                        .stylus = pose ? pose->mode : StylusMode::Hover,
                                        .is_over_terrain = is_over_terrain_});
    if (cursor != std::exchange(cursor_, cursor)) {
        setCursor(cursorOf(cursor));
    }
}

void GlobeView::mouseDoubleClickEvent(QMouseEvent* event)
{
    const MapAction action =
        actionOf(Gesture::DoubleClick, event->button(), event->modifiers(), tool_);
    if (PlaceTool* tool = placeTool(); tool != nullptr && action == MapAction::FinishDrawing) {
        tool->doubleClick(event->position());
        return;
    }
    const auto ground = action == MapAction::FlyThere ? groundAt(event->position()) : std::nullopt;
    if (!ground) {
        return;
    }
    const auto place = layers()[ground->index].map->georeference().toGeographic(ground->hit.grid);
    if (place) {
        flyNearer(*place);
        Q_EMIT gestureMade(MapAction::FlyThere);
    }
}

void GlobeView::wheelEvent(QWheelEvent* event)
{
    const double notches = event->angleDelta().y() / kWheelNotch;
    if (ground_.isEmpty() || notches == 0.0) {
        return;
    }
    event->accept();
    const Gesture gesture = touch_.isPressing() ? Gesture::WheelWhilePressing : Gesture::Wheel;
    const MapAction action = actionOf(gesture, Qt::NoButton, event->modifiers(), tool_);
    if (action == MapAction::PressDeeper) {
        touch_.deepen(std::pow(kDeeperPerNotch, -notches));
        followTouch();
    } else {
        const double factor = action == MapAction::ZoomFinely ? kWheelFactorFine : kWheelFactor;
        camera_.zoom(std::pow(factor, notches), camera_.hold(pixelAt(event->position())),
                     kWheelDuration);
    }
    Q_EMIT gestureMade(action);
}

void GlobeView::leaveEvent(QEvent* event)
{
    QOpenGLWidget::leaveEvent(event);
    pointer_.reset();
    followTouch();
    report();
    if (PlaceTool* tool = placeTool()) {
        tool->hover(std::nullopt);
    }
}

void GlobeView::focusInEvent(QFocusEvent* event)
{
    QOpenGLWidget::focusInEvent(event);
    report();
}

void GlobeView::focusOutEvent(QFocusEvent* event)
{
    QOpenGLWidget::focusOutEvent(event);
    report();
}

} // namespace marsview
