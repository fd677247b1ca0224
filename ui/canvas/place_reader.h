// The place that is read: under the pointer, under the stylus of a device, or in the middle of the
// picture while the keyboard is used.
#pragma once

#include "ui/canvas/camera_controller.h"
#include "ui/canvas/shown_scene.h"
#include "ui/canvas/touch_tool.h"
#include "ui/canvas/view_projection.h"

#include <QObject>
#include <QTimer>

#include <optional>

class QWidget;

namespace marsview {

/// What the place that is read lies under.
enum class ReadingSource { Pointer, Stylus, Crosshair };

/// The parts of the view that decide on the place. All outlive the reader.
struct ReadParts {
    const QWidget& view; // whose focus counts
    const ShownScene& scene;
    const CameraController& camera;
    const ViewProjection& projection;
    TouchTool& touch; // has the pointer and the device
};

/// Chooses the place and waits for its samples at full resolution.
class PlaceReader final : public QObject {
    Q_OBJECT

public:
    explicit PlaceReader(const ReadParts& parts);

    /// The place under the stylus of a haptic device, unless the pointer or a key has just moved;
    /// otherwise under the pointer; or at the crosshair in the middle of the picture, while the
    /// view has the focus and the pointer is not over it or a key moved the camera last. Its height
    /// is NaN where a map has no data. Nothing outside all maps.
    std::optional<RayHit> reading() const;
    ReadingSource source() const;
    bool isCrosshairShown() const;

    /// The pointer moves to a position of the view.
    void notePointer(QPointF position);
    void forgetPointer();
    /// A drag began or ended: no crosshair during it.
    void setDragging(bool is_dragging) { is_dragging_ = is_dragging; }
    /// A step, maybe by a key of the view, moved the camera.
    void noteStep();
    /// A place was typed that the camera flies to: it is read until pointer or camera move.
    void noteTypedPlace(const ScenePoint& place);
    /// Keeps the crosshair while another widget that shows the reading has the focus.
    void setReadElsewhere(bool is_read);
    void setCrosshairAllowed(bool is_allowed);

    /// Something changed that the reading depends on.
    void report();

Q_SIGNALS:
    void readingChanged(const std::optional<RayHit>& hit);
    void crosshairChanged(bool is_shown);

private:
    struct TypedPlace {
        ScenePoint place;
        OrbitCamera goal; // that looks at it
    };

    bool isStylusRead() const;
    void lead();
    void setKeyboardUsed(bool is_used);
    std::optional<GroundPoint> groundRead() const;
    void readSamples();

    ReadParts parts_;
    QTimer rest_timer_; // runs until what is under the pointer has been read
    QTimer lead_timer_; // runs for a while after pointer or keys moved: they are read
    std::optional<TypedPlace> typed_place_;
    bool is_keyboard_used_ = false; // to navigate, since the pointer moved last
    bool is_dragging_ = false;
    bool is_read_elsewhere_ = false;
    bool is_crosshair_allowed_ = true;
    bool was_crosshair_shown_ = false;
};

} // namespace marsview
