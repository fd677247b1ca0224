// The place that the status bar reads: under the pointer, or in the middle of the picture for the
// keyboard.

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
constexpr milliseconds kArrivalInterval{40};

} // namespace

bool TerrainView::isCrosshairShown() const
{
    const bool is_keyboard_here = hasFocus() || is_read_elsewhere_;
    return is_crosshair_allowed_ && map_ && drag_action_ == MapAction::None && is_keyboard_here &&
           (!pointer_ || is_keyboard_used_);
}

std::optional<QPointF> TerrainView::readPosition() const
{
    if (isCrosshairShown()) {
        return QPointF(width() / 2.0, height() / 2.0);
    }
    return pointer_;
}

std::optional<RayHit> TerrainView::reading() const
{
    const auto position = readPosition();
    return position ? surfaceAt(*position) : std::nullopt;
}

double TerrainView::metresPerPoint(const RayHit& hit) const
{
    if (!map_) {
        return 0.0;
    }
    const ScenePoint place =
        map_->georeference().sceneFrame().toScene(hit.grid, hit.height_m * style_.exaggeration);
    return metresPerPixel(navigator_.camera(), viewport(), place) * devicePixelRatioF();
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
    const auto position = readPosition();
    Q_EMIT pointerMoved(position ? surfaceAt(*position) : std::nullopt);
    // A ray takes what is loaded. Where the pointer rests, the samples themselves are read.
    const auto ground = position ? groundUnder(*position) : std::optional<GroundPoint>();
    if (ground && !ground_.maps()[ground->index].map->heightfield().isExact(ground->grid)) {
        pointer_timer_.start(kRestInterval);
    }
}

void TerrainView::readUnderPointer()
{
    const auto position = readPosition();
    const auto ground = position ? groundUnder(*position) : std::optional<GroundPoint>();
    if (!ground) {
        return;
    }
    const Heightfield& heightfield = ground_.maps()[ground->index].map->heightfield();
    if (!heightfield.isExact(ground->grid)) {
        static_cast<void>(heightfield.height(ground->grid)); // requests it
        if (heightfield.tiles()->isLoading()) {
            pointer_timer_.start(kArrivalInterval);
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
