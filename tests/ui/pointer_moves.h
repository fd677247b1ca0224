// The pointer over a widget: moves of the X server's, and double clicks.
#pragma once

#include "tests/ui/timeout.h"

#include <QMouseEvent>
#include <QObject>
#include <QPoint>
#include <QTest>
#include <QWidget>

#include <optional>

namespace marsview {

/// Moves the pointer to a position of the widget. False if the widget hears nothing of that.
///
/// The pointer may already be there, where the last test left it: a motion to the same position is
/// no event, and the X server may report two motions as one. So it moves to another position first
/// and waits until that has arrived.
inline bool movePointer(QWidget& widget, QPoint to)
{
    class LastMove final : public QObject {
    public:
        std::optional<QPoint> at;

    protected:
        bool eventFilter(QObject* watched, QEvent* event) override
        {
            if (event->type() == QEvent::MouseMove) {
                at = static_cast<QMouseEvent*>(event)->position().toPoint();
            }
            return QObject::eventFilter(watched, event);
        }
    };
    LastMove last;
    widget.installEventFilter(&last);
    const auto move = [&](QPoint at) {
        QTest::mouseMove(&widget, at);
        return QTest::qWaitFor([&] { return last.at == at; }, kTimeout);
    };
    return move(to - QPoint(9, 7)) && move(to);
}

/// Double-clicks with the left button and releases it.
///
/// QTest::mouseDClick() alone leaves the button held down in QGuiApplication::mouseButtons(), for
/// all tests that follow in the process.
inline void doubleClick(QWidget& widget, QPoint at)
{
    QTest::mouseDClick(&widget, Qt::LeftButton, {}, at);
    QTest::mouseRelease(&widget, Qt::LeftButton, {}, at);
}

} // namespace marsview
