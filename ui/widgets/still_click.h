// A click that is not the end of a drag, for buttons whose drags begin at once.
#pragma once

#include <QApplication>
#include <QMouseEvent>
#include <QPointF>

#include <optional>
#include <utility>

namespace marsview {

/// From press to release. Unlike a click that delays the drag until it is decided which of the two
/// it is, this one leaves small motions to the drag: the terrain follows the pointer from the first
/// pixel on. A value.
class StillClick {
public:
    void press(const QMouseEvent& event)
    {
        begin_ = Begin{.position = event.position(), .time_ms = event.timestamp()};
    }
    void move(QPointF position)
    {
        if (begin_ && (position - begin_->position).manhattanLength() > kReach) {
            begin_.reset();
        }
    }
    void forget() { begin_.reset(); }
    /// Whether it was a click. `is_feeling`: a stylus that rests on the terrain for longer feels
    /// it.
    bool release(const QMouseEvent& event, bool is_feeling)
    {
        move(event.position());
        const std::optional<Begin> begin = std::exchange(begin_, std::nullopt);
        const auto longest_ms = static_cast<unsigned long>(QApplication::doubleClickInterval());
        return begin && (!is_feeling || event.timestamp() - begin->time_ms <= longest_ms);
    }

private:
    static constexpr double kReach = 3.0; // points of the screen

    struct Begin {
        QPointF position;
        unsigned long time_ms = 0;
    };
    std::optional<Begin> begin_;
};

} // namespace marsview
