#include "ui/widgets/focus_frame.h"

#include "ui/widgets/plate.h"

#include <QEvent>
#include <QFocusEvent>
#include <QPainter>
#include <QPainterPath>
#include <QRegion>

namespace marsview {
namespace {

constexpr int kFrameWidth = 4; // of the frame with its dark rim

bool isByKey(Qt::FocusReason reason)
{
    return reason == Qt::TabFocusReason || reason == Qt::BacktabFocusReason ||
           reason == Qt::ShortcutFocusReason;
}

// A window that becomes active again, or a menu that closes, gives the focus back as it was.
bool isReturn(Qt::FocusReason reason)
{
    return reason == Qt::ActiveWindowFocusReason || reason == Qt::PopupFocusReason ||
           reason == Qt::MenuBarFocusReason;
}

} // namespace

FocusFrame::FocusFrame(QWidget* parent, Ground ground)
    : QWidget(parent)
    , ground_(ground)
{
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
    setAccessibleName(tr("Keyboard focus"));
    setGeometry(parent->rect());
    parent->installEventFilter(this);
    hide();
}

bool FocusFrame::eventFilter(QObject* watched, QEvent* event)
{
    switch (event->type()) {
    case QEvent::FocusIn: {
        const Qt::FocusReason reason = static_cast<QFocusEvent*>(event)->reason();
        if (!isReturn(reason)) {
            setVisible(isByKey(reason));
            raise();
        }
        break;
    }
    case QEvent::FocusOut:
        if (!isReturn(static_cast<QFocusEvent*>(event)->reason())) {
            hide();
        }
        break;
    case QEvent::MouseButtonPress:
        hide();
        break;
    case QEvent::Resize:
        setGeometry(parentWidget()->rect());
        break;
    default:
        break;
    }
    return QWidget::eventFilter(watched, event);
}

void FocusFrame::paintEvent(QPaintEvent* /*event*/)
{
    QPainter painter(this);
    if (ground_ == Ground::Panel) {
        constexpr double kWidth = 2.0;
        painter.setPen(QPen(palette().color(QPalette::Highlight), kWidth));
        painter.drawRect(QRectF(rect()).adjusted(1.0, 1.0, -1.0, -1.0));
        return;
    }
    QPainterPath edge;
    edge.addRect(QRectF(rect()).adjusted(1.5, 1.5, -1.5, -1.5));
    drawContrasting(painter, edge, overlayFocusColor(), 2.0);
}

// The picture within is not painted again with the frame.
void FocusFrame::resizeEvent(QResizeEvent* /*event*/)
{
    setMask(QRegion(rect()) -
            rect().adjusted(kFrameWidth, kFrameWidth, -kFrameWidth, -kFrameWidth));
}

} // namespace marsview
