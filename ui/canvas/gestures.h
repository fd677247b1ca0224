// The gestures of the mouse and their actions: one table for the view and for the list of keys.
#pragma once

#include "ui/canvas/tool.h"

#include <QString>
#include <Qt>

#include <optional>
#include <span>
#include <vector>

namespace marsview {

enum class Gesture {
    Drag,
    Click, ///< pressed and released in one place
    DoubleClick,
    Wheel,
    WheelWhilePressing, ///< while the stylus presses into the terrain
};

/// The action that a gesture requests.
enum class MapAction {
    None,
    Pan,
    Orbit,
    Touch,
    Zoom,
    ZoomFinely,
    PressDeeper,
    FlyThere,
    AddPoint,  // of a measurement or an annotation
    MovePoint, // bound to no gesture: the tool says where a drag does that
    FinishDrawing,
    SelectFeature, // of a vector file, or a measurement or annotation
    OpenMenu,
};

struct GestureBinding {
    Gesture gesture;
    Qt::MouseButton button;          // NoButton for the wheel
    Qt::KeyboardModifiers modifiers; // that have to be down; others are ignored
    std::optional<Tool> tool;        // that has to be chosen; none: any
    MapAction action;
};

/// The first that fits counts.
std::span<const GestureBinding> gestureBindings();

/// The action of a gesture with that tool; None if nothing is bound to it.
MapAction
actionOf(Gesture gesture, Qt::MouseButton button, Qt::KeyboardModifiers modifiers, Tool tool);

/// A line of the list of keys.
struct GestureLine {
    QString gesture; // "Shift+drag", "Right or middle drag", "Left drag (Touch)"
    QString action;  // "Turn and tilt"
};

/// All bindings; those that differ in the button alone share a line.
std::vector<GestureLine> gestureLines();

} // namespace marsview
