// The place that the status bar reads: under the pointer, under the stylus of a device, or in the
// middle of the picture for the keyboard.

#include "ui/canvas/terrain_view.h"

#include <QChildEvent>
#include <QKeyEvent>
#include <QWidget>

#include <algorithm>

namespace marsview {
namespace {

using std::chrono::milliseconds;

// The pointer rests if it has not moved for so long.
constexpr milliseconds kRestInterval{120};

// The interval at which samples that were requested are looked for.
constexpr milliseconds kPointerInterval{40};

// The pointer is read for so long after it moved, in place of the stylus of a device.
constexpr milliseconds kLeadInterval{2000};

std::optional<GroundPoint> groundBelow(const SceneSurface& ground, const ScenePoint& place)
{
    const auto index = ground.mapAt(place.x, place.y);
    if (!index) {
        return std::nullopt;
    }
    return GroundPoint{.index = *index,
                       .grid = ground.maps()[*index].frame.toGrid(place),
                       .height_m = ground.height(place.x, place.y)};
}

} // namespace

bool TerrainView::isCrosshairShown() const
{
    const bool is_keyboard_here = hasFocus() || is_read_elsewhere_;
    return is_crosshair_allowed_ && map_ && drag_action_ == MapAction::None && is_keyboard_here &&
           (!pointer_ || is_keyboard_used_) && !isStylusRead();
}

bool TerrainView::isStylusRead() const
{
    return device_ && !lead_timer_.isActive();
}

// The pointer, or the keys, have moved: with a device at hand as well, they are read for a while.
void TerrainView::leadReading()
{
    if (device_) {
        lead_timer_.start(kLeadInterval);
    }
}

std::optional<GroundPoint> TerrainView::groundRead() const
{
    if (isStylusRead()) {
        return groundBelow(ground_, device_->proxy);
    }
    if (isCrosshairShown()) {
        // A ridge in front of the place would be read instead of it.
        if (typed_place_ && typed_place_->goal == navigator_.goal()) {
            return groundBelow(ground_, typed_place_->place);
        }
        return groundUnder(QRectF(rect()).center());
    }
    return pointer_ ? groundUnder(*pointer_) : std::nullopt;
}

ReadingSource TerrainView::readingSource() const
{
    return isStylusRead()       ? ReadingSource::Stylus
           : isCrosshairShown() ? ReadingSource::Crosshair
                                : ReadingSource::Pointer;
}

std::optional<RayHit> TerrainView::reading() const
{
    const std::optional<GroundPoint> ground = groundRead();
    return ground ? std::optional(onTopmost(*ground)) : std::nullopt;
}

double TerrainView::metersPerPoint(const RayHit& hit) const
{
    if (!map_) {
        return 0.0;
    }
    const ScenePoint place =
        map_->georeference().sceneFrame().toScene(hit.grid, hit.height_m * style_.exaggeration);
    return metersPerPixel(navigator_.camera(), viewport(), place) * devicePixelRatioF();
}

void TerrainView::setReadElsewhere(bool is_read)
{
    is_read_elsewhere_ = is_read;
    reportPointer();
}

void TerrainView::setCrosshairAllowed(bool is_allowed)
{
    is_crosshair_allowed_ = is_allowed;
    reportPointer();
}

void TerrainView::setKeyboardUsed(bool is_used)
{
    if (is_used) {
        leadReading();
    }
    if (is_used != is_keyboard_used_) {
        is_keyboard_used_ = is_used;
        reportPointer();
    }
}

void TerrainView::forgetPointer()
{
    if (pointer_) {
        pointer_.reset();
        moveStylus();
    }
    reportPointer();
}

bool TerrainView::isOverOverlay(QPointF position) const
{
    const auto children = findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly);
    return std::any_of(children.begin(), children.end(), [&](const QWidget* child) {
        const bool hides_terrain = !child->testAttribute(Qt::WA_TransparentForMouseEvents) ||
                                   child->property(kHidesTerrain).toBool();
        return child->isVisible() && !child->isWindow() && hides_terrain &&
               child->geometry().contains(position.toPoint());
    });
}

void TerrainView::childEvent(QChildEvent* event)
{
    QOpenGLWidget::childEvent(event);
    if (event->added() && event->child()->isWidgetType()) {
        event->child()->installEventFilter(this);
    }
}

// The view is not left where the pointer goes onto one of its overlays.
bool TerrainView::eventFilter(QObject* watched, QEvent* event)
{
    if (event->type() == QEvent::Enter && drag_action_ == MapAction::None &&
        !static_cast<QWidget*>(watched)->testAttribute(Qt::WA_TransparentForMouseEvents)) {
        forgetPointer();
    }
    return QOpenGLWidget::eventFilter(watched, event);
}

void TerrainView::focusInEvent(QFocusEvent* event)
{
    QOpenGLWidget::focusInEvent(event);
    reportPointer();
}

void TerrainView::reportPointer()
{
    const bool is_crosshair = isCrosshairShown();
    if (is_crosshair != was_crosshair_shown_) {
        was_crosshair_shown_ = is_crosshair;
        Q_EMIT crosshairChanged(is_crosshair);
    }
    const auto ground = groundRead();
    Q_EMIT pointerMoved(ground ? std::optional(onTopmost(*ground)) : std::nullopt);
    // A ray takes what is loaded. Where the pointer rests, the samples themselves are read.
    if (ground && !ground_.maps()[ground->index].map->heightfield().isExact(ground->grid)) {
        pointer_timer_.start(kRestInterval);
    }
}

void TerrainView::readUnderPointer()
{
    const auto ground = groundRead();
    if (!ground) {
        return;
    }
    const Heightfield& heightfield = ground_.maps()[ground->index].map->heightfield();
    if (!heightfield.isExact(ground->grid)) {
        static_cast<void>(heightfield.height(ground->grid)); // requests it
        if (heightfield.tiles()->isLoading()) {
            pointer_timer_.start(kPointerInterval);
            return;
        }
    }
    // It was loaded before or just now, or cannot be read.
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
