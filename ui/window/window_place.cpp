#include "ui/window/window_place.h"

#include <QEvent>
#include <QScreen>
#include <QStyle>
#include <QWidget>
#include <QWindow>

#include <algorithm>

namespace marsview {
namespace {

// The frame of a window that was not shown yet is unknown; most desktops take no more than this.
QMargins likelyFrame(const QWidget& window)
{
    const int side = window.style()->pixelMetric(QStyle::PM_DefaultFrameWidth, nullptr, &window);
    const int title = window.style()->pixelMetric(QStyle::PM_TitleBarHeight, nullptr, &window);
    return {side, title, side, side};
}

QMargins frameOf(const QWidget& window)
{
    const QRect inner = window.geometry();
    const QRect outer = window.frameGeometry();
    const QMargins frame(inner.left() - outer.left(), inner.top() - outer.top(),
                         outer.right() - inner.right(), outer.bottom() - inner.bottom());
    return frame.isNull() && !window.isVisible() ? likelyFrame(window) : frame;
}

} // namespace

QRect fittedTo(const QRect& frame, const QRect& available)
{
    QRect fitted(frame.topLeft(), frame.size().boundedTo(available.size()));
    fitted.moveRight(std::min(fitted.right(), available.right()));
    fitted.moveBottom(std::min(fitted.bottom(), available.bottom()));
    fitted.moveLeft(std::max(fitted.left(), available.left()));
    fitted.moveTop(std::max(fitted.top(), available.top()));
    return fitted;
}

WindowPlace::WindowPlace(QWidget& window)
    : QObject(&window)
    , window_(window)
{
    window_.installEventFilter(this);
}

void WindowPlace::fit()
{
    const QScreen* screen = window_.screen();
    if (screen == nullptr || window_.isMaximized() || window_.isFullScreen()) {
        return;
    }
    const QMargins frame = frameOf(window_);
    const QRect now = window_.geometry().marginsAdded(frame);
    const QRect fitted = fittedTo(now, screen->availableGeometry());
    if (fitted.size() != now.size()) {
        window_.resize(fitted.marginsRemoved(frame).size());
    }
    // Before it is shown the desktop chooses the place, unless it is a remembered one.
    const bool has_place = window_.isVisible() || window_.testAttribute(Qt::WA_Moved);
    if (has_place && fitted.topLeft() != now.topLeft()) {
        window_.move(fitted.topLeft());
    }
}

bool WindowPlace::eventFilter(QObject* watched, QEvent* event)
{
    if (event->type() == QEvent::Show && !event->spontaneous()) {
        followScreen();
        // The desktop adds the frame after the window is shown.
        QMetaObject::invokeMethod(this, &WindowPlace::fit, Qt::QueuedConnection);
    }
    return QObject::eventFilter(watched, event);
}

void WindowPlace::followScreen()
{
    QWindow* handle = window_.windowHandle();
    if (handle == nullptr || is_following_) {
        return;
    }
    is_following_ = true;
    const auto follow = [this](QScreen* screen) {
        if (screen != nullptr) {
            connect(screen, &QScreen::availableGeometryChanged, this, &WindowPlace::fit,
                    Qt::UniqueConnection);
        }
    };
    connect(handle, &QWindow::screenChanged, this, [this, follow](QScreen* screen) {
        follow(screen);
        fit();
    });
    follow(handle->screen());
}

} // namespace marsview
