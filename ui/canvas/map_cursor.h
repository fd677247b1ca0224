// The shapes of the pointer and of a stylus over the map.
#pragma once

#include "haptics/interaction/mouse_stylus.h"
#include "ui/canvas/gestures.h"
#include "ui/render/cursor_renderer.h"

#include <QCursor>

namespace marsview {

enum class MapCursor { Arrow, OpenHand, ClosedHand, Cross, Rotate, Zoom };

/// What the pointer is doing.
struct PointerState {
    Tool tool = Tool::Pan;
    MapAction drag = MapAction::None;      // that is under way
    StylusMode stylus = StylusMode::Hover; // Pan and Zoom while the space bar grabs
    bool is_over_terrain = false;
};

/// Shows the action of the current drag, otherwise that of the tool; an arrow without a map.
MapCursor mapCursor(const PointerState& state);

QCursor cursorOf(MapCursor cursor);

/// How a stylus is drawn: upright along `axes`, in contact with the spring to the hand.
CursorPicture stylusCursor(const StylusPose& pose, const CursorAxes& axes);

} // namespace marsview
