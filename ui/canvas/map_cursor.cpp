#include "ui/canvas/map_cursor.h"

#include "ui/widgets/plate.h"

#include <QGuiApplication>
#include <QPainter>
#include <QPainterPath>
#include <QPixmap>

namespace marsview {
namespace {

CursorShape shapeOf(const StylusPose& pose)
{
    switch (pose.mode) {
    case StylusMode::Pan:
        return CursorShape::FlatSphere;
    case StylusMode::Zoom:
        return CursorShape::LongSphere;
    case StylusMode::Hover:
    case StylusMode::Press:
        break;
    }
    return pose.is_in_contact ? CursorShape::Cone : CursorShape::Sphere;
}

constexpr int kRotateSide = 24; // points

// An arrow around an upright axis: black on white, seen over any terrain.
QCursor rotateCursor()
{
    const qreal scale = qGuiApp->devicePixelRatio();
    QPixmap pixmap(QSize(kRotateSide, kRotateSide) * scale);
    pixmap.setDevicePixelRatio(scale);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    QPainterPath path;
    path.moveTo(12.0, 4.0); // the axis
    path.lineTo(12.0, 20.0);
    const QRectF ring(3.0, 8.0, 18.0, 8.0);
    path.arcMoveTo(ring, 60.0);
    path.arcTo(ring, 60.0, -300.0); // clockwise, open at the back
    const QPointF tip = path.currentPosition();
    path.moveTo(tip + QPointF(-4.5, -0.5));
    path.lineTo(tip);
    path.lineTo(tip + QPointF(-1.5, 4.5));
    drawContrasting(painter, path, Qt::white, 1.8);
    return QCursor(pixmap, kRotateSide / 2, kRotateSide / 2);
}

} // namespace

MapCursor mapCursor(const PointerState& state)
{
    if (state.stylus == StylusMode::Pan) {
        return MapCursor::ClosedHand;
    }
    if (state.stylus == StylusMode::Zoom) {
        return MapCursor::Zoom;
    }
    switch (state.drag) {
    case MapAction::Pan:
        return MapCursor::ClosedHand;
    case MapAction::Orbit:
        return MapCursor::Rotate;
    case MapAction::Touch:
    case MapAction::MovePoint:
        return MapCursor::Cross;
    default:
        break;
    }
    if (!state.is_over_terrain) {
        return MapCursor::Arrow;
    }
    switch (state.tool) {
    case Tool::Pan:
        return MapCursor::OpenHand;
    case Tool::Touch:
    case Tool::Measure:
    case Tool::Annotate:
        return MapCursor::Cross;
    case Tool::Orbit:
        return MapCursor::Rotate;
    }
    return MapCursor::Arrow;
}

QCursor cursorOf(MapCursor cursor)
{
    switch (cursor) {
    case MapCursor::Arrow:
        return Qt::ArrowCursor;
    case MapCursor::OpenHand:
        return Qt::OpenHandCursor;
    case MapCursor::ClosedHand:
        return Qt::ClosedHandCursor;
    case MapCursor::Cross:
        return Qt::CrossCursor;
    case MapCursor::Rotate:
        return rotateCursor();
    case MapCursor::Zoom:
        return Qt::SizeVerCursor;
    }
    return Qt::ArrowCursor;
}

CursorPicture stylusCursor(const StylusPose& pose, const CursorAxes& axes)
{
    return {.shape = shapeOf(pose),
            .position = pose.proxy,
            .axes = axes,
            .goal = pose.is_in_contact ? std::optional(pose.goal) : std::nullopt};
}

} // namespace marsview
