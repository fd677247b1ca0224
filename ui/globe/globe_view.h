// The globe: a layer on its body, with a camera from space to the ground.
#pragma once

#include "core/base/job_monitor.h"
#include "core/globe/body_motion.h"
#include "core/globe/body_navigation.h"
#include "core/session/body_terrain.h"
#include "core/terrain/ray_cast.h"
#include "ui/canvas/camera_controller.h"
#include "ui/canvas/shown_layer.h"
#include "ui/canvas/tool.h"
#include "ui/controllers/detached_jobs.h"
#include "ui/globe/globe_motion.h"
#include "ui/render/governed_picture.h"
#include "ui/render/terrain_renderer.h"

#include <QOpenGLWidget>
#include <QPointF>
#include <QTimer>

#include <chrono>
#include <memory>
#include <optional>

class QLabel;

namespace marsview {

/// Shows one layer where it lies on its body. Placing a layer takes place on a worker thread: until
/// then the view says so. GUI thread.
class GlobeView final : public QOpenGLWidget {
    Q_OBJECT

public:
    explicit GlobeView(QWidget* parent = nullptr);
    ~GlobeView() override;

    /// The layer to show; nothing for an empty view. The camera stays if the layers have one body.
    void setLayer(const std::optional<ShownLayer>& layer);
    /// Null until a layer is placed.
    const BodyTerrain* terrain() const noexcept { return terrain_ ? &*terrain_ : nullptr; }
    /// A sentence over the picture, such as what it leaves out; empty for none.
    void setNote(const QString& note);
    /// Keeps the camera over its ground.
    void setExaggeration(double exaggeration);
    void setLook(const TerrainLook& look);
    void setAntialiasing(bool is_wanted);
    void setFrameTarget(std::chrono::milliseconds target);
    /// Pan or Orbit: what a drag with the left button does. Others pan.
    void setTool(Tool tool) { tool_ = tool; }

    const BodyCamera& camera() const noexcept { return motion_.camera(); }
    const BodyCamera& cameraGoal() const noexcept { return motion_.goal(); }
    bool isMoving() const noexcept { return motion_.isMoving(); }
    /// Within the limits; before a layer is placed, when it is.
    void setCamera(const BodyCamera& camera);
    Viewport viewport() const;
    BodyLimits limits() const;

    void step(NavigationStep step);
    void goHome();
    void turnNorthUp();
    /// Flies along a great circle; `distance_m` of 0 keeps the distance.
    void flyTo(const GeographicPoint& place, double distance_m);

    /// The terrain under a position of the widget.
    std::optional<BodyHit> hitAt(QPointF position) const;
    /// Under the pointer, on the layer's grid; at the middle while the pointer is elsewhere and the
    /// view has the focus.
    std::optional<RayHit> reading() const;
    /// Meters on the terrain in one point of the screen.
    double metersPerPoint(const RayHit& hit) const;

    /// True when the picture shows all there is, as well as can be, and nothing moves.
    bool isPictureComplete() const { return is_complete_ && !isMoving(); }

Q_SIGNALS:
    void readingChanged(const std::optional<RayHit>& hit);
    void detailChanged(double pixels);
    void loadingChanged(bool is_loading);
    void problemChanged(const QString& problem);
    /// The layer is placed, or another one or none is shown.
    void placed();
    void pictureCompleted();
    /// No suitable graphics context, or a layer that has no place on its body.
    void failed(const QString& reason);

protected:
    void initializeGL() override;
    void paintGL() override;
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;

private:
    enum class Drag { None, Pan, Orbit };

    void place(const ShownLayer& layer);
    void showPlaced(const std::shared_ptr<const BodyGrid>& grid);
    void sendLayer();
    void releaseGraphics();
    void redraw();
    void refine();
    void report();
    BodyCamera bounded(const BodyCamera& camera) const;
    BodyCamera onGround(const BodyCamera& camera) const;
    HeldPoint heldAtPosition(QPointF position) const;
    PixelPoint pixelAt(QPointF position) const;
    void fly(const BodyCamera& goal, std::chrono::milliseconds duration);
    void zoom(double factor, QPointF position, std::chrono::milliseconds duration);

    std::optional<ShownLayer> layer_;
    std::optional<BodyTerrain> terrain_;
    std::shared_ptr<JobMonitor> placing_;
    DetachedJobs jobs_;
    DrawStyle style_;
    std::optional<BodyCamera> first_camera_; // of a layer that is being placed
    GlobeMotion motion_;
    Tool tool_ = Tool::Pan;

    Drag drag_ = Drag::None;
    Qt::MouseButton drag_button_ = Qt::NoButton;
    QPointF drag_position_;
    std::optional<HeldPoint> held_;
    std::optional<QPointF> pointer_;
    double zoom_left_ = 1.0; // the whole factor of the zoom in progress
    bool is_zooming_ = false;

    std::unique_ptr<TerrainRenderer> renderer_;
    std::unique_ptr<GovernedPicture> picture_;
    std::chrono::milliseconds frame_target_{33};
    bool has_antialiasing_ = true;
    bool is_layer_sent_ = true;
    PictureStage stage_ = PictureStage::Moving;
    bool is_current_ = false; // the picture that was kept is of now
    bool is_complete_ = false;
    bool is_loading_ = false;
    QString problem_;
    QTimer still_timer_;
    QTimer sample_timer_;
    QLabel* note_ = nullptr;
    QLabel* wait_ = nullptr;
};

} // namespace marsview
