#include "ui/canvas/terrain_canvas.h"

#include "ui/canvas/map_cursor.h"
#include "ui/render/cursor_solids.h"
#include "ui/render/offscreen_picture.h"

#include <QOpenGLWidget>
#include <QRect>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace marsview {
namespace {

// The shadow of the cursor: radius on screen, and how many sides it has.
constexpr double kShadowPoints = 9.0;
constexpr int kShadowSides = 24;

// Around the place below the stylus, on the terrain.
std::vector<ScenePoint> shadowOf(const ScenePoint& place, double radius_m, const ShownScene& scene)
{
    std::vector<ScenePoint> shadow;
    for (int i = 0; i < kShadowSides; ++i) {
        const double around = 2.0 * std::numbers::pi * i / kShadowSides;
        const double x = place.x + radius_m * std::cos(around);
        const double y = place.y + radius_m * std::sin(around);
        const double z = scene.groundHeight(x, y);
        if (std::isfinite(z)) {
            shadow.push_back({x, y, z});
        }
    }
    return shadow;
}

} // namespace

TerrainCanvas::TerrainCanvas(const CanvasParts& parts)
    : parts_(parts)
{
    still_timer_.setSingleShot(true);
    connect(&still_timer_, &QTimer::timeout, this, &TerrainCanvas::refineWhenStill);
}

std::optional<Error> TerrainCanvas::initialize()
{
    auto renderer = TerrainRenderer::create([this] {
        QMetaObject::invokeMethod(this, &TerrainCanvas::redrawWithNews, Qt::QueuedConnection);
    });
    if (!renderer) {
        return renderer.error();
    }
    auto cursor = CursorRenderer::create();
    if (!cursor) {
        return cursor.error();
    }
    auto lines = LinePainter::create();
    if (!lines) {
        return lines.error();
    }
    renderer_ = std::move(renderer).value();
    line_painter_ = std::move(lines).value();
    cursor_ = std::move(cursor).value();
    picture_ = std::make_unique<GovernedPicture>(*renderer_);
    picture_->setTarget(frame_target_);
    are_layers_sent_ = false;
    redraw();
    return std::nullopt;
}

void TerrainCanvas::release()
{
    if (renderer_) {
        parts_.view.makeCurrent();
        picture_.reset();
        line_painter_.reset();
        cursor_.reset();
        renderer_.reset();
        parts_.view.doneCurrent();
    }
}

void TerrainCanvas::updateLayers()
{
    are_layers_sent_ = false;
    redraw();
}

void TerrainCanvas::sendLayers()
{
    if (std::exchange(are_layers_sent_, true)) {
        return;
    }
    std::vector<TerrainLayer> layers;
    for (std::size_t i = 0; i < parts_.scene.layers().size(); ++i) {
        const ShownLayer& shown = parts_.scene.layers()[i];
        layers.push_back(
            terrainLayer(shown.map, parts_.scene.ground().maps()[i].frame, *shown.ramp));
        layers.back().tint_range = colorRangeOf(shown);
        layers.back().slope_range = slopeRangeOf(shown);
    }
    renderer_->setLayers(layers);
}

void TerrainCanvas::setAntialiasing(bool is_wanted)
{
    if (is_wanted != has_antialiasing_) {
        has_antialiasing_ = is_wanted;
        redraw();
    }
}

void TerrainCanvas::setFrameTarget(std::chrono::milliseconds target)
{
    frame_target_ = target;
    if (picture_) {
        picture_->setTarget(target);
    }
}

void TerrainCanvas::setLines(std::vector<DrapedLine> lines, LineSet set)
{
    if (lines_.set(std::move(lines), set)) {
        parts_.view.update();
    }
}

void TerrainCanvas::setDots(DotSet dots, LineSet set)
{
    if (lines_.setDots(std::move(dots), set)) {
        parts_.view.update();
    }
}

QImage TerrainCanvas::terrainPicture()
{
    is_cursor_shown_ = false;
    QImage picture = parts_.view.grabFramebuffer();
    is_cursor_shown_ = true;
    parts_.view.update(); // the grabbed frame, without the cursor, may reach the screen
    return picture;
}

Result<bool> TerrainCanvas::drawPart(const OrbitCamera& camera,
                                     const DrawStyle& style,
                                     const QRect& part,
                                     PictureLines lines,
                                     QImage& picture)
{
    if (!renderer_) {
        return Error{ErrorCode::Unsupported,
                     "cannot draw a picture: no graphics context; install the graphics driver"};
    }
    parts_.view.makeCurrent();
    sendLayers();
    Result<bool> drawn = marsview::drawPart(
        {.terrain = *renderer_,
         .line_renderer = lines == PictureLines::Drawn ? &line_painter_->lines() : nullptr,
         .lines = lines_,
         .view_height = static_cast<double>(parts_.view.height()),
         .has_antialiasing = has_antialiasing_},
        {.camera = camera, .viewport = {}}, style, part, picture);
    parts_.view.doneCurrent();
    return drawn;
}

int TerrainCanvas::pictureSideMax()
{
    if (!renderer_) {
        return 0;
    }
    parts_.view.makeCurrent();
    const int side_max = offscreenSideMax();
    parts_.view.doneCurrent();
    return side_max;
}

void TerrainCanvas::paint()
{
    if (!renderer_) {
        return;
    }
    const bool is_new = !is_terrain_current_;
    if (is_new) {
        paintTerrain();
    }
    paintLines(is_new ? TerrainPicture::New : TerrainPicture::Same);
    paintCursor();
}

void TerrainCanvas::paintTerrain()
{
    sendLayers();
    const DrawReport report =
        picture_->paint({.camera = parts_.camera.camera(),
                         .viewport = viewportOf(parts_.view),
                         .stage = stage_,
                         .last_stage = lastStage(),
                         .is_touching = parts_.touch.isTouching(),
                         .is_kept = true},
                        parts_.scene.style, parts_.view.defaultFramebufferObject());
    last_paint_ = std::chrono::steady_clock::now();
    is_terrain_current_ = true;
    this->report(report);
    if (stage_ == PictureStage::Moving) {
        if (!still_timer_.isActive()) { // new shading is not a motion
            still_timer_.start(kStillAfter);
        }
    } else if (report.is_complete) {
        // Input that arrived in the meantime is handled first.
        QMetaObject::invokeMethod(this, &TerrainCanvas::finishStage, Qt::QueuedConnection);
    }
}

void TerrainCanvas::report(const DrawReport& report)
{
    Q_EMIT detailChanged(report.error_px);
    // In motion something is always on its way.
    const bool is_loading = stage_ != PictureStage::Moving && !report.is_complete;
    if (is_loading != is_loading_) {
        is_loading_ = is_loading;
        Q_EMIT loadingChanged(is_loading);
    }
    QString problem = report.problem ? QString::fromStdString(report.problem->message) : QString();
    if (problem != problem_) {
        problem_ = std::move(problem);
        // Later: who hears of it may change the layout, which is not for the middle of painting.
        QMetaObject::invokeMethod(
            this, [this] { Q_EMIT problemChanged(problem_); }, Qt::QueuedConnection);
    }
}

void TerrainCanvas::paintLines(TerrainPicture terrain)
{
    const OrbitCamera& camera = parts_.camera.camera();
    line_painter_->paint(lines_, *renderer_, terrain,
                         {.camera = camera,
                          .viewport = viewportOf(parts_.view),
                          .clip = renderer_->clip(camera, parts_.scene.style.exaggeration),
                          .pixels_per_point = parts_.projection.pixelsPerPoint()},
                         parts_.view.defaultFramebufferObject());
}

void TerrainCanvas::paintCursor()
{
    const auto& pose = parts_.touch.shown();
    if (!pose || !is_cursor_shown_) {
        return;
    }
    const OrbitCamera& camera = parts_.camera.camera();
    const Viewport size = viewportOf(parts_.view);
    CursorPicture cursor{.shape = shapeOf(*pose),
                         .position = pose->proxy,
                         .goal = std::nullopt,
                         .shadow = {},
                         .pixels_per_point = parts_.projection.pixelsPerPoint()};
    if (pose->is_in_contact) {
        cursor.goal = pose->goal;
    } else {
        const double radius_m = kShadowPoints * parts_.projection.metersPerPoint(pose->proxy);
        cursor.shadow = shadowOf(pose->proxy, radius_m, parts_.scene);
    }
    renderer_->presentDepth(parts_.view.defaultFramebufferObject(),
                            areaOfCursor(cursor, camera, size));
    cursor_->draw(cursor, camera, size, renderer_->clip(camera, parts_.scene.style.exaggeration));
}

void TerrainCanvas::redraw()
{
    stage_ = PictureStage::Moving;
    still_timer_.stop();
    is_terrain_current_ = false;
    is_completion_reported_ = false;
    parts_.view.update();
}

// Missing shading has arrived.
void TerrainCanvas::redrawWithNews()
{
    if (!renderer_) {
        return;
    }
    const bool is_due = std::chrono::steady_clock::now() - last_paint_ >= kNewsInterval;
    if (stage_ == PictureStage::Moving || is_due || !renderer_->isLoading()) {
        is_terrain_current_ = false;
        parts_.view.update();
    }
}

PictureStage TerrainCanvas::lastStage() const
{
    return has_antialiasing_ ? PictureStage::Smooth : PictureStage::Sharp;
}

void TerrainCanvas::refineWhenStill()
{
    if (parts_.camera.isMoving()) {
        return; // the next frame starts the timer again
    }
    if (stage_ == PictureStage::Moving) {
        stage_ = PictureStage::Sharp;
        is_terrain_current_ = false;
        parts_.view.update();
    }
}

// A sharp picture has all its shading.
void TerrainCanvas::finishStage()
{
    if (stage_ == PictureStage::Moving || !is_terrain_current_ || is_completion_reported_) {
        return;
    }
    if (stage_ != lastStage()) {
        stage_ = lastStage();
        is_terrain_current_ = false;
        parts_.view.update();
        return;
    }
    is_completion_reported_ = true;
    Q_EMIT completed();
}

} // namespace marsview
