// A view whose camera a cap moves.
#pragma once

#include "core/view/cap_steering.h"

namespace marsview {

/// The flat map or the globe, each a widget.
class SteeredView {
public:
    virtual ~SteeredView() = default;

    /// Moves as a cap is pushed, for the time since it was asked last: once a frame while the cap
    /// is pushed, and once at rest to end with. Draws nothing where the camera stays where it is.
    virtual void steer(const CapRates& rates, double seconds) = 0;
    virtual void goHome() = 0;
    virtual bool isMoving() const = 0;

protected:
    SteeredView() = default;
    SteeredView(const SteeredView&) = default;
    SteeredView& operator=(const SteeredView&) = default;
};

} // namespace marsview
