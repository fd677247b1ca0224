// The mouse over the map: its gestures move the camera, the stylus or the points of a tool.
#pragma once

#include "core/view/camera.h"
#include "ui/canvas/camera_controller.h"
#include "ui/canvas/gestures.h"
#include "ui/canvas/map_cursor.h"
#include "ui/canvas/place_reader.h"
#include "ui/canvas/place_tool.h"
#include "ui/canvas/touch_tool.h"
#include "ui/canvas/view_projection.h"
#include "ui/widgets/still_click.h"

#include <QObject>
#include <QPointF>

#include <map>
#include <optional>

class QKeyEvent;
class QMouseEvent;
class QWheelEvent;
class QWidget;

namespace marsview {

/// A property of children of the view that hide the terrain, though the mouse goes through them.
inline constexpr const char* kHidesTerrain = "hidesTerrain";

/// The parts of the view that gestures act on. All outlive the mouse.
struct MouseParts {
    QWidget& view; // has the pointer's shape
    const ShownScene& scene;
    CameraController& camera;
    const ViewProjection& projection;
    TouchTool& touch;
    PlaceReader& reader;
};

/// Turns the events of the view into the actions of the chosen tool; see gestureBindings().
class MapMouse final : public QObject {
    Q_OBJECT

public:
    explicit MapMouse(const MouseParts& parts);

    /// What a drag with the left button does; Pan to begin with. A drag that is under way ends.
    void setTool(Tool tool);
    Tool tool() const noexcept { return tool_; }
    /// Hears of clicks, drags and keys while `tool` is chosen. Null for none; otherwise it outlives
    /// this or is taken back before.
    void setPlaceTool(Tool tool, PlaceTool* place_tool) { place_tools_[tool] = place_tool; }

    void press(const QMouseEvent& event);
    void move(const QMouseEvent& event);
    void release(const QMouseEvent& event);
    void doubleClick(const QMouseEvent& event);
    void wheel(QWheelEvent& event);
    /// True where the key was for the chosen tool.
    bool key(const QKeyEvent& event);
    /// Whether the chosen tool places points.
    bool isPlacing() const { return placeTool() != nullptr; }
    /// The stylus of a device at a place of the scene, for the chosen tool; see PlaceTool.
    void pressStylus(const ScenePoint& place);
    void moveStylus(const ScenePoint& place);
    void releaseStylus();
    /// The pointer goes onto a child of the view that takes the mouse.
    void enterOverlay();
    /// Ends a touch until the button is pressed again: its surface is gone.
    void releaseTouch();
    /// The stylus moved: shows the pointer's shape.
    void showCursor();

Q_SIGNALS:
    void toolChanged(Tool tool);
    /// A gesture moved the camera or the stylus, or asked for the menu.
    void gestureMade(MapAction action);
    /// The context menu of what lies at a position of the view is asked for.
    void menuRequested(QPointF position);
    /// The left button was pressed and released in one place with a tool that places no points.
    void clicked(QPointF position);

private:
    PlaceTool* placeTool() const
    {
        const auto found = place_tools_.find(tool_);
        return found != place_tools_.end() ? found->second : nullptr;
    }
    void setDrag(MapAction action);
    void beginDrag(MapAction action);
    void dragTo(QPointF position);
    void endDrag();
    bool moveByGrab(QPointF from, QPointF to);
    void pan(QPointF from, QPointF to, double grabbed_z_m);
    bool isOverOverlay(QPointF position) const;

    MouseParts parts_;
    Tool tool_ = Tool::Pan;
    std::map<Tool, PlaceTool*> place_tools_;
    MapCursor cursor_ = MapCursor::Arrow;
    MapAction drag_ = MapAction::None;
    Qt::MouseButton drag_button_ = Qt::NoButton;
    bool may_be_click_ = false; // the drag has not left the place where it began
    StillClick still_click_;
    QPointF drag_position_;
    double grabbed_z_m_ = 0.0; // of what the drag has hold of
};

} // namespace marsview
