#include "ui/overlay/measure_marks.h"

#include "ui/controllers/measure_controller.h"
#include "ui/text/measure_text.h"
#include "ui/widgets/plate.h"

#include <QEvent>
#include <QFontMetricsF>
#include <QPainter>
#include <QPainterPath>

namespace marsview {
namespace {

constexpr double kHandleRadius = 4.5;
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

void MeasureMarks::paintEvent(QPaintEvent* /*event*/)
{
    const MeasureState& state = controller_.state();
    if (state.items.empty()) {
        return;
    }
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const std::vector<MeasureHandle> handles = controller_.handles();
    for (auto handle = handles.rbegin(); handle != handles.rend(); ++handle) {
        const bool is_current = handle->item == state.current;
        QPainterPath dot;
        const double radius = is_current ? kHandleRadius : kHandleRadius - 1.0;
        dot.addEllipse(handle->place, radius, radius);
        painter.setOpacity(handle->is_hidden ? kHiddenOpacity : 1.0);
        painter.fillPath(dot, is_current ? kCurrentColor : kOtherColor);
        painter.setPen(QPen(QColor(0, 0, 0, 200), 1.5));
        painter.drawPath(dot);
    }
    painter.setOpacity(1.0);
    if (const auto cursor = controller_.profileCursorPlace()) {
        QPainterPath ring;
        ring.addEllipse(*cursor, kHandleRadius + 2.0, kHandleRadius + 2.0);
        drawContrasting(painter, ring, Qt::white, 2.0);
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
        drawPlate(painter, plate);
        painter.setPen(item.id == state.current ? kCurrentColor : overlayTextColor());
        drawText(painter, plate, Qt::AlignCenter, text);
    }
}

} // namespace marsview
