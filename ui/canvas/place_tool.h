// A tool that works with places on the map, such as measuring.
#pragma once

#include "core/terrain/ray_cast.h"

#include <QPointF>

#include <optional>

class QKeyEvent;

namespace marsview {

/// Hears what the pointer and the keys do over the view while its tool is chosen. Positions are
/// those of the view. Navigation stays with the view: dragging pans where nothing is grabbed.
class PlaceTool {
public:
    virtual ~PlaceTool() = default;

    /// The left button was pressed. True where the tool has something there that the drag moves.
    virtual bool grab(QPointF position) = 0;
    virtual void drag(QPointF position) = 0;
    virtual void release() = 0;
    /// The left button was pressed and released in one place where nothing was grabbed.
    virtual void click(QPointF position) = 0;
    virtual void doubleClick(QPointF position) = 0;
    /// Nothing: the pointer has left the map.
    virtual void hover(std::optional<QPointF> position) = 0;
    /// True where the key was for the tool.
    virtual bool key(const QKeyEvent& event) = 0;

    // The stylus of a haptic device. Places are those of the topmost map's grid on the terrain
    // below the stylus.

    /// The button of the stylus was pressed: sets a point, or picks up an existing one.
    virtual void pressStylus(const RayHit& place) = 0;
    /// The stylus moved, with its button pressed or not.
    virtual void moveStylus(const RayHit& place) = 0;
    virtual void releaseStylus() = 0;
};

} // namespace marsview
