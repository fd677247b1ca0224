// Mouse, wheel and keys: what moves the camera and the stylus.

#include "ui/terrain_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>

#include <algorithm>
#include <array>
#include <cmath>

namespace marsview {
namespace {

using std::chrono::milliseconds;

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

constexpr double kFlyFactor = 0.3; // of the distance, a double click

// After so long without a move the pointer rests.
constexpr milliseconds kRestInterval{120};

// How often it is looked whether what is under the pointer has come.
constexpr milliseconds kArrivalInterval{40};

} // namespace

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
    has_hand_moved_ = false;
    moveStylus();
    reportPointer();
}

void TerrainView::mouseMoveEvent(QMouseEvent* event)
{
    const QPointF from = pointer_.value_or(event->position());
    pointer_ = event->position();
    const QPointF moved = event->position() - drag_position_;
    has_hand_moved_ = has_hand_moved_ || !moved.isNull();
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
}

const std::optional<StylusPose>& TerrainView::shownStylus() const noexcept
{
    const auto& mouse = stylus_.pose();
    const bool is_mouse_at_work = mouse && mouse->mode != StylusMode::Hover;
    return device_ && !is_mouse_at_work ? device_ : mouse;
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
        Q_EMIT grabbingChanged(is_grabbing);
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
    if (stylus_.isWaiting() != touch_timer_.isActive()) {
        touch_timer_.isActive() ? touch_timer_.stop() : touch_timer_.start();
    }
    update();
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
    if (drag_action_ == DragAction::Touch) {
        drag_action_ = DragAction::None;
    }
    buttons_.is_pressing = false;
}

void TerrainView::reportPointer()
{
    Q_EMIT pointerMoved(pointer_ ? surfaceAt(*pointer_) : std::nullopt);
    // A ray takes what is there. Where the pointer rests, the samples themselves are read.
    const auto ground = pointer_ ? groundUnder(*pointer_) : std::optional<GroundPoint>();
    if (ground && !ground_.maps()[ground->index].map.dataset->heightfield().isExact(ground->grid)) {
        pointer_timer_.start(kRestInterval);
    }
}

void TerrainView::readUnderPointer()
{
    const auto ground = pointer_ ? groundUnder(*pointer_) : std::optional<GroundPoint>();
    if (!ground) {
        return;
    }
    const Heightfield& heightfield = ground_.maps()[ground->index].map.dataset->heightfield();
    if (!heightfield.isExact(ground->grid)) {
        static_cast<void>(heightfield.height(ground->grid)); // asks for it
        if (heightfield.tiles()->isLoading()) {
            pointer_timer_.start(kArrivalInterval);
            return;
        }
    }
    // It was there, or came at once, or cannot be read.
    if (heightfield.isExact(ground->grid)) {
        moveStylus();
        if (!has_hand_moved_) {
            stylus_.pressAnew();
            update();
            Q_EMIT stylusMoved();
        }
        reportPointer();
    }
}

} // namespace marsview
