#include "ui/canvas/grab_key.h"

#include <QCoreApplication>
#include <QGuiApplication>
#include <QKeyEvent>

#include <chrono>

namespace marsview {
namespace {

// Longer than the usual delay before a held key repeats.
constexpr std::chrono::milliseconds kRepeatDelayMax{1000};

} // namespace

GrabKey::GrabKey(QObject* parent)
    : QObject(parent)
{
    return_timer_.setSingleShot(true);
    return_timer_.setInterval(kRepeatDelayMax);
    connect(&return_timer_, &QTimer::timeout, this, &GrabKey::release);
}

void GrabKey::hold()
{
    if (!is_held_) {
        is_held_ = true;
        QCoreApplication::instance()->installEventFilter(this);
    }
}

void GrabKey::release()
{
    if (is_held_) {
        is_held_ = false;
        return_timer_.stop();
        QCoreApplication::instance()->removeEventFilter(this);
        Q_EMIT released();
    }
}

bool GrabKey::eventFilter(QObject* watched, QEvent* event)
{
    const QEvent::Type type = event->type();
    if (type == QEvent::ApplicationStateChange) {
        const bool is_active = QGuiApplication::applicationState() == Qt::ApplicationActive;
        is_active ? return_timer_.start() : return_timer_.stop();
    } else if (watched->isWidgetType() && (type == QEvent::KeyPress || type == QEvent::KeyRelease ||
                                           type == QEvent::ShortcutOverride)) {
        const auto& key = static_cast<const QKeyEvent&>(*event);
        if (key.key() == Qt::Key_Space) {
            return_timer_.stop();
            if (type == QEvent::KeyRelease && !key.isAutoRepeat()) {
                release();
            }
            return true; // another widget with the focus does not act on it
        }
    }
    return QObject::eventFilter(watched, event);
}

} // namespace marsview
