// The gestures of the paper's section 4.2, scripted, with everything that a hand felt.
#pragma once

#include "haptics/loop/loop_state.h"

#include <array>
#include <string_view>
#include <vector>

namespace marsview {

enum class TouchGesture {
    Pan,
    FlingIntoALimit,
    ZoomIn,
    ZoomOut,
    Ratchets,
    Twist,
};

inline constexpr std::array kTouchGestures{TouchGesture::Pan,      TouchGesture::FlingIntoALimit,
                                           TouchGesture::ZoomIn,   TouchGesture::ZoomOut,
                                           TouchGesture::Ratchets, TouchGesture::Twist};

/// "pan", "fling-into-a-limit", …
std::string_view touchGestureName(TouchGesture gesture) noexcept;
/// What the hand does, in a few words.
std::string_view touchGestureTitle(TouchGesture gesture) noexcept;

/// A passive hand of 0.1 kg makes the gesture over hills of 6 m, 200 m across, in a ClosedLoop. One
/// record for each tick of 1 ms; the same records for every call.
std::vector<TickRecord> makeGesture(TouchGesture gesture);

} // namespace marsview
