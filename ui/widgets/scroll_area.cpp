#include "ui/widgets/scroll_area.h"

#include "ui/widgets/focus_frame.h"

#include <QApplication>
#include <QScrollArea>

namespace marsview {

QScrollArea* makeScrollArea(QWidget* parent)
{
    auto* scroll = new QScrollArea(parent);
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    new FocusFrame(scroll, FocusFrame::Ground::Panel);
    // By itself it does so for the Tab key only. What is being clicked stays under the pointer.
    QObject::connect(qApp, &QApplication::focusChanged, scroll,
                     [scroll](const QWidget*, QWidget* now) {
                         if (now != nullptr && scroll->isAncestorOf(now) &&
                             QGuiApplication::mouseButtons() == Qt::NoButton) {
                             scroll->ensureWidgetVisible(now);
                         }
                     });
    return scroll;
}

} // namespace marsview
