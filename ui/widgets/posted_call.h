// Work that is done once for any number of requests, before the window is painted.
#pragma once

#include <QCoreApplication>
#include <QEvent>
#include <QObject>

#include <functional>
#include <utility>

namespace marsview {

/// Calls a function from the event loop. Qt posts paint requests with a low priority: what is
/// requested while an input is handled, is done before the picture of that input is painted. A
/// timer of zero fires after it, and the window is painted twice. GUI thread.
class PostedCall final : public QObject {
public:
    explicit PostedCall(std::function<void()> call)
        : call_(std::move(call))
    {}

    void request()
    {
        if (!std::exchange(is_pending_, true)) {
            QCoreApplication::postEvent(this, new QEvent(QEvent::User));
        }
    }
    void cancel()
    {
        if (std::exchange(is_pending_, false)) {
            QCoreApplication::removePostedEvents(this, QEvent::User);
        }
    }
    bool isPending() const noexcept { return is_pending_; }

    bool event(QEvent* event) override
    {
        if (event->type() != QEvent::User) {
            return QObject::event(event);
        }
        is_pending_ = false;
        call_();
        return true;
    }

private:
    std::function<void()> call_;
    bool is_pending_ = false;
};

} // namespace marsview
