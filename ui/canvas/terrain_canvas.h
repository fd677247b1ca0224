// Paints a view: the terrain in stages, from ready in time to as fine as can be, with lines and the
// cursor of a stylus over it.
#pragma once

#include "core/base/result.h"
#include "core/view/camera.h"
#include "ui/canvas/line_painter.h"
#include "ui/canvas/line_sets.h"
#include "ui/canvas/part_drawing.h"
#include "ui/render/cursor_renderer.h"
#include "ui/render/governed_picture.h"
#include "ui/render/terrain_renderer.h"

#include <QImage>
#include <QObject>
#include <QString>
#include <QTimer>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

class QOpenGLWidget;
class QRect;

namespace marsview {

/// From where a picture is drawn.
struct CanvasCamera {
    OrbitCamera camera{};
    std::optional<CameraPose> body_pose{}; // replaces `camera` where layers lie on their body

    CameraPose pose() const { return body_pose ? *body_pose : CameraPose(camera); }
};

/// What a canvas draws: the flat map, or layers on their body. Asked when a picture is painted.
class CanvasScene {
public:
    /// The uppermost first.
    virtual std::vector<TerrainLayer> terrainLayers() const = 0;
    /// The exaggeration and look of now.
    virtual const DrawStyle& style() const noexcept = 0;
    virtual CanvasCamera canvasCamera() const = 0;
    virtual bool isMoving() const noexcept = 0;
    /// See FrameRequest.
    virtual bool isTouching() const noexcept = 0;
    /// The stylus in the picture, without its shadow; nothing for none.
    virtual std::optional<CursorPicture> canvasCursor() const = 0;
    /// The terrain straight below a cursor, moved by these meters along its axes; nothing without
    /// terrain there.
    virtual std::optional<ScenePoint>
    groundUnderCursor(const CursorPicture& cursor, double right_m, double ahead_m) const = 0;

protected:
    ~CanvasScene() = default;
};

/// Draws only when something changed: the terrain when it, its look or the camera did, otherwise
/// what lies over a copy of its picture.
class TerrainCanvas final : public QObject {
    Q_OBJECT

public:
    /// Both outlive the canvas; the view has the graphics context.
    TerrainCanvas(QOpenGLWidget& view, const CanvasScene& scene);

    /// With the context current. The error if it does not suit.
    std::optional<Error> initialize();
    /// Before the context is destroyed.
    void release();
    bool isReady() const noexcept { return renderer_ != nullptr; }
    /// With the context current and the view's frame buffer bound.
    void paint();

    /// The layers of the scene changed.
    void updateLayers();
    /// The camera, the size of the picture or the look changed.
    void redraw();
    void setAntialiasing(bool is_wanted);
    /// The time that a frame may take while something moves.
    void setFrameTarget(std::chrono::milliseconds target);
    /// Lines on the terrain, drawn over every picture, the sets in their order.
    void setLines(std::vector<DrapedLine> lines, LineSet set);
    void setDots(DotSet dots, LineSet set);

    /// The picture shows all there is, as well as can be.
    bool isComplete() const noexcept { return is_completion_reported_ && is_terrain_current_; }
    /// Why pieces of the picture cannot be read; empty where all can.
    const QString& problem() const noexcept { return problem_; }
    /// The picture of the terrain alone, without cursor.
    QImage terrainPicture();
    /// A part of the picture of any size that `camera` has, into `picture`, RGB888 of that size.
    /// False, and nothing drawn, while pieces of it are missing: they are on their way. Lines are
    /// as wide as in the view where the picture is as high.
    Result<bool> drawPart(const CanvasCamera& camera,
                          const DrawStyle& style,
                          const QRect& part,
                          const PartOptions& options,
                          QImage& picture);
    /// Pixels a side that the graphics driver draws; 0 without a graphics context.
    int pictureSideMax();

Q_SIGNALS:
    void completed();
    /// The screen-space error of the picture, in pixels.
    void detailChanged(double pixels);
    /// Whether pieces that the picture at rest lacks are on their way.
    void loadingChanged(bool is_loading);
    void problemChanged(const QString& problem);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void sendLayers();
    void paintTerrain();
    void paintLines(TerrainPicture terrain);
    void paintCursor();
    std::vector<ScenePoint> shadowOf(const CursorPicture& cursor, double radius_m) const;
    void report(const DrawReport& report);
    void redrawWithNews();
    void refineWhenStill();
    void finishStage();
    bool beginFiner();
    void drawFiner();
    PictureRequest pictureRequest(PictureStage stage) const;
    PictureStage lastStage() const;

    QOpenGLWidget& view_;
    const CanvasScene& scene_;
    std::unique_ptr<TerrainRenderer> renderer_;
    std::unique_ptr<GovernedPicture> picture_;
    std::unique_ptr<CursorRenderer> cursor_;
    std::unique_ptr<LinePainter> line_painter_;
    LineSets lines_;
    std::chrono::milliseconds frame_target_{33};
    bool has_antialiasing_ = true;
    bool are_layers_sent_ = true;
    bool is_empty_ = true; // no layers were sent

    PictureStage stage_ = PictureStage::Moving;
    bool is_terrain_current_ = false; // the picture that was kept is of now
    bool is_completion_reported_ = false;
    // Follows the last stage where neighboring pixels differ much; null when it is done.
    std::unique_ptr<SupersampledPicture> finer_;
    bool is_finer_decided_ = false;     // for the picture that was kept
    bool is_finer_picture_new_ = false; // its colors are to be shown
    QTimer finer_timer_;
    bool is_loading_ = false;
    bool is_cursor_shown_ = true;
    QString problem_;
    QTimer still_timer_; // runs out when nothing has moved for a while
    std::chrono::steady_clock::time_point last_paint_{};
};

} // namespace marsview
