#include "ui/overlay/measure_marks.h"

#include "ui/controllers/measure_controller.h"
#include "ui/text/measure_text.h"
#include "ui/widgets/plate.h"

#include <QEvent>
#include <QFontMetricsF>
#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

constexpr double kHandleRadius = 4.5;
constexpr double kHandleRim = 1.5;
constexpr double kHiddenOpacity = 0.35;
constexpr QPointF kLabelOffset{10.0, -10.0}; // of its lower left corner from its place
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
        marks.push_back({box_around(handle->place, radius + kHandleRim),
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
        marks.push_back({box_around(*cursor, radius + 4.0), [cursor, radius](QPainter& painter) {
                             QPainterPath ring;
                             ring.addEllipse(*cursor, radius, radius);
                             drawContrasting(painter, ring, Qt::white, 2.0);
                         }});
    }
    const QFontMetricsF metrics(font());
    for (const MeasureItem& item : state.items) {
        const MeasureOutcome& outcome = controller_.outcome(item.id);
        const auto place = controller_.labelPlace(item.id);
        const QString text = outcome.result ? measureSummary(*outcome.result, unit_) : QString();
        if (!place || text.isEmpty()) {
            continue;
        }
        const QSizeF size(metrics.horizontalAdvance(text) + 2.0 * kLabelPadding,
                          metrics.height() + kLabelPadding);
        QRectF plate(*place + kLabelOffset - QPointF(0.0, size.height()), size);
        // Within the view where there is room.
        plate.moveRight(std::min(plate.right(), static_cast<double>(width()) - 2.0));
        plate.moveTop(std::max(plate.top(), 2.0));
        const QColor color = item.id == state.current ? kCurrentColor : overlayTextColor();
        marks.push_back({plate, [plate, text, color](QPainter& painter) {
                             drawPlate(painter, plate);
                             painter.setPen(color);
                             drawText(painter, plate, Qt::AlignCenter, text);
                         }});
    }
    return marks;
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
