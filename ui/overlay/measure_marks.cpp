#include "ui/overlay/measure_marks.h"

#include "ui/controllers/measure_controller.h"
#include "ui/text/measure_text.h"
#include "ui/widgets/plate.h"

#include <QEvent>
#include <QFontMetricsF>
#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <array>
#include <utility>

namespace marsview {
namespace {

constexpr double kHandleRadius = 4.5;
constexpr double kHandleRim = 1.5;
constexpr double kHiddenOpacity = 0.35;
constexpr QPointF kLabelOffset{10.0, -10.0}; // from its place to its nearest corner
constexpr double kLabelPadding = 4.0;

const QColor kCurrentColor(255, 221, 64);
const QColor kOtherColor(240, 240, 240);

} // namespace

MeasureMarks::MeasureMarks(MeasureController& controller, QWidget* view)
    : QWidget(view)
    , controller_(controller)
{
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
    setAccessibleName(tr("Points of the measurements"));
    setGeometry(view->rect());
    view->installEventFilter(this);
    const auto repaint = [this] { update(); };
    connect(&controller_, &MeasureController::moved, this, repaint);
    connect(&controller_, &MeasureController::changed, this, repaint);
    connect(&controller_, &MeasureController::measured, this, repaint);
}

void MeasureMarks::setHeightUnit(HeightUnit unit)
{
    unit_ = unit;
    update();
}

bool MeasureMarks::eventFilter(QObject* watched, QEvent* event)
{
    if (watched == parent() && event->type() == QEvent::Resize) {
        setGeometry(parentWidget()->rect());
    }
    return QWidget::eventFilter(watched, event);
}

// In the order in which they are drawn.
std::vector<MeasureMarks::Mark> MeasureMarks::marks() const
{
    const MeasureState& state = controller_.state();
    std::vector<Mark> marks;
    if (state.items.empty()) {
        return marks;
    }
    const auto box_around = [](QPointF place, double radius) {
        return QRectF(place - QPointF(radius, radius), QSizeF(2.0 * radius, 2.0 * radius));
    };
    const std::vector<MeasureHandle> handles = controller_.handles();
    for (auto handle = handles.rbegin(); handle != handles.rend(); ++handle) {
        const bool is_current = handle->item == state.current;
        const double radius = is_current ? kHandleRadius : kHandleRadius - 1.0;
        marks.push_back({box_around(handle->place, radius + kHandleRim), false,
                         [handle = *handle, is_current, radius](QPainter& painter) {
                             QPainterPath dot;
                             dot.addEllipse(handle.place, radius, radius);
                             painter.setOpacity(handle.is_hidden ? kHiddenOpacity : 1.0);
                             painter.fillPath(dot, is_current ? kCurrentColor : kOtherColor);
                             painter.setPen(QPen(QColor(0, 0, 0, 200), kHandleRim));
                             painter.drawPath(dot);
                             painter.setOpacity(1.0);
                         }});
    }
    if (const auto cursor = controller_.profileCursorPlace()) {
        const double radius = kHandleRadius + 2.0;
        marks.push_back(
            {box_around(*cursor, radius + 4.0), false, [cursor, radius](QPainter& painter) {
                 QPainterPath ring;
                 ring.addEllipse(*cursor, radius, radius);
                 drawContrasting(painter, ring, Qt::white, 2.0);
             }});
    }
    const QFontMetricsF metrics(font());
    for (const MeasureItem& item : state.items) {
        const MeasureOutcome& outcome = controller_.outcome(item.id);
        const auto place = controller_.labelPlace(item.id);
        // What lies beyond the picture has its numbers in the panel.
        const QString text = outcome.result ? measureSummary(*outcome.result, unit_) : QString();
        if (!place || text.isEmpty() || !QRectF(rect()).contains(*place)) {
            continue;
        }
        const QSizeF size(metrics.horizontalAdvance(text) + 2.0 * kLabelPadding,
                          metrics.height() + kLabelPadding);
        const auto box = labelBox(*place, size);
        if (!box) {
            continue;
        }
        const QRectF plate = *box;
        const QColor color = item.id == state.current ? kCurrentColor : overlayTextColor();
        marks.push_back({plate, true, [plate, text, color](QPainter& painter) {
                             drawPlate(painter, plate);
                             painter.setPen(color);
                             drawText(painter, plate, Qt::AlignCenter, text);
                         }});
    }
    return marks;
}

// Beside the place, within the view and clear of the obstacles. Empty if there is no room.
std::optional<QRectF> MeasureMarks::labelBox(QPointF place, const QSizeF& size) const
{
    const double x = kLabelOffset.x();
    const double y = kLabelOffset.y();
    const std::array<QPointF, 4> corners{place + QPointF(x, y - size.height()),
                                         place + QPointF(-x - size.width(), y - size.height()),
                                         place + QPointF(x, -y),
                                         place + QPointF(-x - size.width(), -y)};
    const QRectF room = QRectF(rect()).adjusted(2.0, 2.0, -2.0, -2.0);
    for (const QPointF& corner : corners) {
        const QRectF box(corner, size);
        const bool is_clear =
            std::none_of(obstacles_.begin(), obstacles_.end(), [&box](const QWidget* obstacle) {
                return obstacle->isVisible() && box.intersects(obstacle->geometry());
            });
        if (is_clear && room.contains(box)) {
            return box;
        }
    }
    return std::nullopt;
}

std::vector<QRectF> MeasureMarks::labelBoxes() const
{
    std::vector<QRectF> boxes;
    for (const Mark& mark : marks()) {
        if (mark.is_label) {
            boxes.push_back(mark.box);
        }
    }
    return boxes;
}

void MeasureMarks::paintEvent(QPaintEvent* /*event*/)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    for (const Mark& mark : marks()) {
        mark.draw(painter);
    }
}

std::vector<PicturePart> MeasureMarks::partsFor(const QSize& picture) const
{
    // The field of view is vertical, and the camera looks at the middle of both pictures.
    const double scale = static_cast<double>(picture.height()) / height();
    const QPointF corner(0.5 * (width() - picture.width() / scale), 0.0);
    std::vector<PicturePart> parts;
    for (const Mark& mark : marks()) {
        const QRectF box = mark.box.adjusted(-1.0, -1.0, 1.0, 1.0);
        QImage image((box.size() * scale).toSize(), QImage::Format_ARGB32_Premultiplied);
        image.fill(Qt::transparent);
        QPainter painter(&image);
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setFont(font());
        painter.scale(scale, scale);
        painter.translate(-box.topLeft());
        mark.draw(painter);
        painter.end();
        parts.push_back(
            {.image = std::move(image), .at = ((box.topLeft() - corner) * scale).toPoint()});
    }
    return parts;
}

} // namespace marsview
