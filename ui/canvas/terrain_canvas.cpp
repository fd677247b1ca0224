#include "ui/canvas/terrain_canvas.h"

#include "ui/canvas/view_projection.h"
#include "ui/render/offscreen_picture.h"

#include <QEvent>
#include <QOpenGLWidget>
#include <QRect>

#include <cmath>
#include <numbers>
#include <utility>

namespace marsview {
namespace {

// The shadow of the cursor: radius on screen, and how many sides it has.
constexpr double kShadowPoints = 9.0;
constexpr int kShadowSides = 24;

// How often missing pieces of a block are looked for, at least.
constexpr std::chrono::milliseconds kArrivalInterval{50};

} // namespace

TerrainCanvas::TerrainCanvas(QOpenGLWidget& view, const CanvasScene& scene)
    : view_(view)
    , scene_(scene)
{
    still_timer_.setSingleShot(true);
    connect(&still_timer_, &QTimer::timeout, this, &TerrainCanvas::refineWhenStill);
    finer_timer_.setSingleShot(true);
    connect(&finer_timer_, &QTimer::timeout, this, &TerrainCanvas::drawFiner);
    view_.installEventFilter(this);
}

// Qt 6.4 does not paint a view that was hidden before its window was first painted, until it is
// updated again.
bool TerrainCanvas::eventFilter(QObject* watched, QEvent* event)
{
    if (event->type() == QEvent::Show) {
        QMetaObject::invokeMethod(
            this, [this] { view_.update(); }, Qt::QueuedConnection);
    }
    return QObject::eventFilter(watched, event);
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
        view_.makeCurrent();
        finer_.reset();
        picture_.reset();
        line_painter_.reset();
        cursor_.reset();
        renderer_.reset();
        view_.doneCurrent();
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
    const std::vector<TerrainLayer> layers = scene_.terrainLayers();
    is_empty_ = layers.empty();
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
        view_.update();
    }
}

void TerrainCanvas::setDots(DotSet dots, LineSet set)
{
    if (lines_.setDots(std::move(dots), set)) {
        view_.update();
    }
}

QImage TerrainCanvas::terrainPicture()
{
    is_cursor_shown_ = false;
    QImage picture = view_.grabFramebuffer();
    is_cursor_shown_ = true;
    view_.update(); // the grabbed frame, without the cursor, may reach the screen
    return picture;
}

Result<bool> TerrainCanvas::drawPart(const CanvasCamera& camera,
                                     const DrawStyle& style,
                                     const QRect& part,
                                     const PartOptions& options,
                                     QImage& picture)
{
    if (!renderer_) {
        return Error{ErrorCode::Unsupported,
                     "cannot draw a picture: no graphics context; install the graphics driver"};
    }
    view_.makeCurrent();
    sendLayers();
    Result<bool> drawn = marsview::drawPart(
        {.terrain = *renderer_,
         .line_renderer = options.lines == PictureLines::Drawn ? &line_painter_->lines() : nullptr,
         .lines = lines_,
         .view_height = static_cast<double>(view_.height()),
         .has_antialiasing = has_antialiasing_,
         .is_supersampled = has_antialiasing_ && options.is_supersampled},
        {.camera = camera.camera, .viewport = {}, .body_pose = camera.body_pose}, style, part,
        picture);
    view_.doneCurrent();
    return drawn;
}

int TerrainCanvas::pictureSideMax()
{
    if (!renderer_) {
        return 0;
    }
    view_.makeCurrent();
    const int side_max = offscreenSideMax();
    view_.doneCurrent();
    return side_max;
}

void TerrainCanvas::paint()
{
    if (!renderer_) {
        return;
    }
    bool is_new = !is_terrain_current_;
    if (is_new) {
        paintTerrain();
    } else if (std::exchange(is_finer_picture_new_, false)) {
        renderer_->present(view_.defaultFramebufferObject());
        is_new = true;
        QMetaObject::invokeMethod(this, &TerrainCanvas::finishStage, Qt::QueuedConnection);
    }
    if (!is_empty_) {
        paintLines(is_new ? TerrainPicture::New : TerrainPicture::Same);
        paintCursor();
    } else if (!is_new) {
        renderer_->present(view_.defaultFramebufferObject());
    }
}

void TerrainCanvas::paintTerrain()
{
    sendLayers();
    finer_.reset();
    is_finer_decided_ = false;
    is_finer_picture_new_ = false;
    const DrawReport report =
        picture_->paint(pictureRequest(stage_), scene_.style(), view_.defaultFramebufferObject());
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

PictureRequest TerrainCanvas::pictureRequest(PictureStage stage) const
{
    CanvasCamera camera = scene_.canvasCamera();
    return {.camera = camera.camera,
            .viewport = viewportOf(view_),
            .stage = stage,
            .last_stage = lastStage(),
            .is_touching = scene_.isTouching(),
            .is_kept = true,
            .body_pose = std::move(camera.body_pose)};
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
    const CameraPose pose = scene_.canvasCamera().pose();
    line_painter_->paint(lines_, *renderer_, terrain,
                         {.camera = pose,
                          .viewport = viewportOf(view_),
                          .clip = renderer_->clip(pose, scene_.style().exaggeration),
                          .pixels_per_point = view_.devicePixelRatioF()},
                         view_.defaultFramebufferObject());
}

void TerrainCanvas::paintCursor()
{
    std::optional<CursorPicture> cursor = is_cursor_shown_ ? scene_.canvasCursor() : std::nullopt;
    if (!cursor) {
        return;
    }
    const CameraPose pose = scene_.canvasCamera().pose();
    const Viewport size = viewportOf(view_);
    cursor->pixels_per_point = view_.devicePixelRatioF();
    if (!cursor->goal) {
        cursor->shadow = shadowOf(*cursor, kShadowPoints * cursor->pixels_per_point *
                                               metersPerPixel(pose, size, cursor->position));
    }
    renderer_->presentDepth(view_.defaultFramebufferObject(), areaOfCursor(*cursor, pose, size));
    cursor_->draw(*cursor, pose, size, renderer_->clip(pose, scene_.style().exaggeration));
}

// Around the place below the stylus, on the terrain.
std::vector<ScenePoint> TerrainCanvas::shadowOf(const CursorPicture& cursor, double radius_m) const
{
    std::vector<ScenePoint> shadow;
    for (int i = 0; i < kShadowSides; ++i) {
        const double around = 2.0 * std::numbers::pi * i / kShadowSides;
        if (const auto ground = scene_.groundUnderCursor(cursor, radius_m * std::cos(around),
                                                         radius_m * std::sin(around))) {
            shadow.push_back(*ground);
        }
    }
    return shadow;
}

void TerrainCanvas::redraw()
{
    stage_ = PictureStage::Moving;
    still_timer_.stop();
    is_terrain_current_ = false;
    is_completion_reported_ = false;
    finer_.reset();
    view_.update();
}

// Missing shading has arrived.
void TerrainCanvas::redrawWithNews()
{
    if (!renderer_) {
        return;
    }
    if (finer_) {
        finer_timer_.start(0);
        return;
    }
    const bool is_due = std::chrono::steady_clock::now() - last_paint_ >= kNewsInterval;
    if (stage_ == PictureStage::Moving || is_due || !renderer_->isLoading()) {
        is_terrain_current_ = false;
        view_.update();
    }
}

PictureStage TerrainCanvas::lastStage() const
{
    return has_antialiasing_ ? PictureStage::Smooth : PictureStage::Sharp;
}

void TerrainCanvas::refineWhenStill()
{
    if (scene_.isMoving()) {
        return; // the next frame starts the timer again
    }
    if (stage_ == PictureStage::Moving) {
        stage_ = PictureStage::Sharp;
        is_terrain_current_ = false;
        view_.update();
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
        view_.update();
        return;
    }
    if (finer_ || is_finer_picture_new_ || beginFiner()) {
        return;
    }
    is_completion_reported_ = true;
    Q_EMIT completed();
}

// A hand that touches the terrain needs its cursor more often than blocks are drawn.
bool TerrainCanvas::beginFiner()
{
    if (std::exchange(is_finer_decided_, true) || !has_antialiasing_ || is_empty_ ||
        scene_.isTouching()) {
        return false;
    }
    view_.makeCurrent();
    finer_ = picture_->finer(pictureRequest(stage_), scene_.style());
    view_.doneCurrent();
    if (finer_) {
        finer_timer_.start(0);
    }
    return finer_ != nullptr;
}

void TerrainCanvas::drawFiner()
{
    if (!finer_) {
        return;
    }
    if (scene_.isTouching()) {
        finer_.reset(); // the smooth picture stays
        finishStage();
        return;
    }
    view_.makeCurrent();
    const Result<bool> drawn = finer_->drawNext();
    if (drawn && finer_->isDone()) {
        renderer_->setKeptColors(finer_->colors());
    }
    view_.doneCurrent();
    if (!drawn) {
        finer_.reset();
        finishStage();
    } else if (finer_->isDone()) {
        finer_.reset();
        is_finer_picture_new_ = true;
        view_.update();
    } else {
        finer_timer_.start(*drawn ? std::chrono::milliseconds{0} : kArrivalInterval);
    }
}

} // namespace marsview
