// How often something slow is made again while the camera moves.
#pragma once

#include <QElapsedTimer>

namespace marsview {

/// Keeps the time that goes into it to a tenth of the whole.
class DrawingPace {
public:
    /// Whether what was made last should still do while the camera moves.
    bool isTooSoon() const
    {
        return since_.isValid() && since_.nsecsElapsed() < kRestShare * making_ns_;
    }
    void begin() { since_.start(); }
    void end()
    {
        making_ns_ = since_.nsecsElapsed();
        since_.start();
    }

private:
    static constexpr qint64 kRestShare = 9;

    QElapsedTimer since_; // it was last begun, or made
    qint64 making_ns_ = 0;
};

} // namespace marsview
