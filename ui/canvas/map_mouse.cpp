#include "ui/canvas/map_mouse.h"

#include "ui/canvas/overlay_cover.h"

#include <QApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <QWidget>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

// Grabbed in free space, so many points of the hand zoom by a factor of e.
constexpr double kGrabZoomPoints = 160.0;

constexpr double kDeeperPerNotch = 1.15; // of the stylus' depth

// A drag across 600 pixels turns the map by half a turn.
constexpr Angle kTurnPerPixel = Angle::degrees(0.3);

constexpr double kWheelNotch = 120.0; // Qt counts eighths of a degree, a notch has 15 degrees
constexpr double kWheelFactor = 0.8;  // of the distance, a notch towards the terrain
constexpr double kWheelFactorFine = 0.96;
constexpr std::chrono::milliseconds kWheelDuration{140};

} // namespace

MapMouse::MapMouse(const MouseParts& parts)
    : parts_(parts)
{}

void MapMouse::setTool(Tool tool)
{
    if (tool == tool_) {
        return;
    }
    endDrag();
    if (PlaceTool* left = placeTool()) {
        left->hover(std::nullopt);
        left->releaseStylus();
    }
    tool_ = tool;
    parts_.touch.setChosen(tool == Tool::Touch);
    parts_.touch.follow();
    parts_.view.update(); // the cursor of the mouse's stylus comes or goes
    Q_EMIT toolChanged(tool);
}

void MapMouse::press(const QMouseEvent& event)
{
    if (parts_.scene.isEmpty() || drag_ != MapAction::None) {
        return;
    }
    parts_.camera.stop();
    drag_button_ = event.button();
    drag_position_ = event.position();
    parts_.touch.setPointer(event.position());
    if (PlaceTool* tool = placeTool(); tool != nullptr && event.button() == Qt::LeftButton &&
                                       event.modifiers() == Qt::NoModifier &&
                                       tool->grab(event.position())) {
        beginDrag(MapAction::MovePoint);
        return;
    }
    const MapAction click = actionOf(Gesture::Click, event.button(), event.modifiers(), tool_);
    may_be_click_ = click != MapAction::None && click != MapAction::SelectFeature;
    if (click == MapAction::SelectFeature) {
        still_click_.press(event);
    }
    beginDrag(actionOf(Gesture::Drag, event.button(), event.modifiers(), tool_));
    parts_.reader.report();
}

void MapMouse::setDrag(MapAction action)
{
    drag_ = action;
    parts_.reader.setDragging(action != MapAction::None);
}

void MapMouse::beginDrag(MapAction action)
{
    setDrag(action);
    grabbed_z_m_ = parts_.projection.anchorAt(drag_position_, parts_.camera.camera()).z;
    if (action == MapAction::Orbit && !may_be_click_) {
        parts_.camera.jumpTo(parts_.camera.onGround(parts_.camera.camera()));
    }
    parts_.touch.setPressing(action == MapAction::Touch);
    parts_.touch.follow();
}

void MapMouse::move(const QMouseEvent& event)
{
    still_click_.move(event.position());
    parts_.reader.notePointer(event.position());
    if (drag_ == MapAction::None && isOverOverlay(event.position())) {
        parts_.reader.forgetPointer();
        return;
    }
    if (may_be_click_) {
        const QPointF moved = event.position() - drag_position_;
        if (moved.manhattanLength() < QApplication::startDragDistance()) {
            return;
        }
        // A drag after all, from where it began.
        may_be_click_ = false;
        if (drag_ == MapAction::Orbit) {
            parts_.camera.jumpTo(parts_.camera.onGround(parts_.camera.camera()));
        }
    }
    dragTo(event.position());
    if (PlaceTool* tool = placeTool(); tool != nullptr && drag_ == MapAction::None) {
        tool->hover(event.position());
    }
}

void MapMouse::dragTo(QPointF position)
{
    const QPointF from = parts_.touch.pointer().value_or(position);
    parts_.touch.setPointer(position);
    const QPointF moved = position - drag_position_;
    if (!moved.isNull()) {
        parts_.touch.noteMotion();
    }
    switch (drag_) {
    case MapAction::Pan:
        pan(drag_position_, position, grabbed_z_m_);
        break;
    case MapAction::Orbit:
        parts_.camera.jumpTo(
            orbited(parts_.camera.camera(), kTurnPerPixel * moved.x(), kTurnPerPixel * -moved.y()));
        break;
    case MapAction::MovePoint:
        if (PlaceTool* tool = placeTool()) {
            tool->drag(position);
        }
        parts_.reader.report();
        break;
    default:
        if (!moveByGrab(from, position)) {
            parts_.touch.follow();
        }
        parts_.reader.report();
        break;
    }
    if (drag_ != MapAction::None && !moved.isNull()) {
        Q_EMIT gestureMade(drag_);
    }
    drag_position_ = position;
}

void MapMouse::release(const QMouseEvent& event)
{
    if (event.button() != drag_button_ && event.buttons() != Qt::NoButton) {
        return;
    }
    const bool is_click = std::exchange(may_be_click_, false);
    const bool is_still = still_click_.release(event, tool_ == Tool::Touch);
    endDrag();
    if (is_still) {
        Q_EMIT clicked(event.position());
        return;
    }
    const MapAction action =
        is_click ? actionOf(Gesture::Click, event.button(), event.modifiers(), tool_)
                 : MapAction::None;
    if (action == MapAction::OpenMenu) {
        Q_EMIT menuRequested(event.position());
    } else if (PlaceTool* tool = placeTool(); tool != nullptr && action == MapAction::AddPoint) {
        tool->click(event.position());
    }
}

void MapMouse::endDrag()
{
    const MapAction ended = drag_;
    setDrag(MapAction::None);
    if (PlaceTool* tool = placeTool(); tool != nullptr && ended == MapAction::MovePoint) {
        tool->release();
    }
    may_be_click_ = false;
    still_click_.forget();
    parts_.touch.setPressing(false);
    parts_.touch.follow();
}

void MapMouse::doubleClick(const QMouseEvent& event)
{
    const MapAction action =
        actionOf(Gesture::DoubleClick, event.button(), event.modifiers(), tool_);
    if (PlaceTool* tool = placeTool(); tool != nullptr && action == MapAction::FinishDrawing) {
        tool->doubleClick(event.position());
        return;
    }
    const auto ground = parts_.projection.groundUnder(event.position());
    if (!ground || action != MapAction::FlyThere) {
        return;
    }
    parts_.camera.flyNearer(parts_.scene.onTopmost(*ground).grid, parts_.view.devicePixelRatioF());
    Q_EMIT gestureMade(MapAction::FlyThere);
}

void MapMouse::wheel(QWheelEvent& event)
{
    const double notches = event.angleDelta().y() / kWheelNotch;
    if (parts_.scene.isEmpty() || notches == 0.0) {
        return;
    }
    event.accept();
    const Gesture gesture =
        parts_.touch.isPressing() ? Gesture::WheelWhilePressing : Gesture::Wheel;
    const MapAction action = actionOf(gesture, Qt::NoButton, event.modifiers(), tool_);
    if (action == MapAction::PressDeeper) {
        parts_.touch.deepen(std::pow(kDeeperPerNotch, -notches));
    } else {
        const double factor =
            std::pow(action == MapAction::ZoomFinely ? kWheelFactorFine : kWheelFactor, notches);
        const OrbitCamera goal = parts_.camera.beforeZoom(factor);
        const ScenePoint anchor = parts_.projection.anchorAt(event.position(), goal);
        parts_.camera.moveTo(zoomed(goal, factor, anchor, parts_.camera.limits()), kWheelDuration);
    }
    Q_EMIT gestureMade(action);
}

bool MapMouse::key(const QKeyEvent& event)
{
    PlaceTool* tool = placeTool();
    return tool != nullptr && tool->key(event);
}

void MapMouse::pressStylus(const ScenePoint& place)
{
    PlaceTool* tool = placeTool();
    if (const auto ground = parts_.scene.groundBelow(place); ground && tool != nullptr) {
        tool->pressStylus(parts_.scene.onTopmost(*ground));
    }
}

void MapMouse::moveStylus(const ScenePoint& place)
{
    PlaceTool* tool = placeTool();
    if (tool == nullptr) {
        return;
    }
    if (const auto ground = parts_.scene.groundBelow(place)) {
        tool->moveStylus(parts_.scene.onTopmost(*ground));
    }
}

void MapMouse::releaseStylus()
{
    if (PlaceTool* tool = placeTool()) {
        tool->releaseStylus();
    }
}

void MapMouse::enterOverlay()
{
    if (drag_ == MapAction::None) {
        parts_.reader.forgetPointer();
    }
}

void MapMouse::releaseTouch()
{
    if (drag_ == MapAction::Touch) {
        setDrag(MapAction::None);
    }
    parts_.touch.setPressing(false);
}

// True where the stylus has hold of the map and moved it.
bool MapMouse::moveByGrab(QPointF from, QPointF to)
{
    const auto& pose = parts_.touch.pose();
    if (!pose || !parts_.touch.isGrabbing()) {
        return false;
    }
    if (pose->mode == StylusMode::Pan) {
        pan(from, to, parts_.touch.grabbedHeight());
        return true;
    }
    if (pose->mode == StylusMode::Zoom) {
        const double factor = std::exp((from.y() - to.y()) / -kGrabZoomPoints);
        parts_.camera.jumpTo(
            zoomed(parts_.camera.beforeZoom(factor), factor, pose->proxy, parts_.camera.limits()));
        return true;
    }
    return false;
}

void MapMouse::pan(QPointF from, QPointF to, double grabbed_z_m)
{
    parts_.camera.jumpTo(dragged(parts_.camera.camera(), viewportOf(parts_.view),
                                 {.from = parts_.projection.pixelAt(from),
                                  .to = parts_.projection.pixelAt(to),
                                  .grabbed_z_m = grabbed_z_m}));
}

bool MapMouse::isOverOverlay(QPointF position) const
{
    return marsview::isOverOverlay(parts_.view, position);
}

void MapMouse::showCursor()
{
    const auto& pose = parts_.touch.pose();
    const MapCursor cursor = mapCursor({.tool = tool_,
                                        .drag = may_be_click_ ? MapAction::None : drag_,
                                        .stylus = pose ? pose->mode : StylusMode::Hover,
                                        .is_over_terrain = parts_.touch.isOverTerrain()});
    if (cursor != std::exchange(cursor_, cursor)) {
        parts_.view.setCursor(cursorOf(cursor));
    }
}

} // namespace marsview
