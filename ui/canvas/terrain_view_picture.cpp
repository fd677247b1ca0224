// Painting: the terrain in stages, from ready in time to as fine as can be, and the cursor over it.

#include "ui/canvas/terrain_view.h"
#include "ui/render/offscreen_picture.h"

#include <QImage>
#include <QOpenGLContext>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace marsview {
namespace {

// The shadow of the cursor: radius on screen, and how many sides it has.
constexpr double kShadowPoints = 9.0;
constexpr int kShadowSides = 24;

// No part of the cursor is further from its place and its shadow than this.
constexpr double kCursorReachPoints = 32.0;

// Of pictures for files, a pixel.
constexpr int kSmoothSamples = 4;

} // namespace

bool TerrainView::isPictureComplete() const
{
    return is_completion_reported_ && is_terrain_current_ && !navigator_.isMoving();
}

QImage TerrainView::terrainPicture()
{
    is_cursor_shown_ = false;
    QImage picture = grabFramebuffer();
    is_cursor_shown_ = true;
    update(); // the grabbed frame, without the cursor, may reach the screen
    return picture;
}

Result<bool> TerrainView::drawPart(const OrbitCamera& camera,
                                   const DrawStyle& style,
                                   const QRect& part,
                                   QImage& picture)
{
    if (!renderer_) {
        return Error{ErrorCode::Unsupported,
                     "cannot draw a picture: no graphics context; install the graphics driver"};
    }
    makeCurrent();
    if (!std::exchange(are_layers_sent_, true)) {
        renderer_->setLayers(layers_);
    }
    const auto drawn = marsview::drawPart(
        *renderer_,
        {.camera = camera,
         .viewport = {.width = picture.width(), .height = picture.height()},
         .samples = has_antialiasing_ ? kSmoothSamples : 1,
         .part = PixelArea{.left = part.left(),
                           .bottom = picture.height() - part.bottom() - 1,
                           .width = part.width(),
                           .height = part.height()}},
        style,
        {.first = picture.scanLine(part.top()) + static_cast<qsizetype>(3) * part.left(),
         .line_length = picture.bytesPerLine()});
    doneCurrent();
    if (!drawn) {
        return drawn.error();
    }
    return drawn->is_complete;
}

int TerrainView::pictureSideMax()
{
    if (!renderer_) {
        return 0;
    }
    makeCurrent();
    const int side_max = offscreenSideMax();
    doneCurrent();
    return side_max;
}

void TerrainView::initializeGL()
{
    connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &TerrainView::releaseGraphics);
    const auto refuse = [this](const Error& error) {
        renderer_.reset();
        reportUnavailable(QString::fromStdString(error.message));
    };
    auto renderer = TerrainRenderer::create([this] {
        QMetaObject::invokeMethod(this, &TerrainView::redrawWithNews, Qt::QueuedConnection);
    });
    if (!renderer) {
        refuse(renderer.error());
        return;
    }
    auto cursor = CursorRenderer::create();
    if (!cursor) {
        refuse(cursor.error());
        return;
    }
    auto lines = LineRenderer::create();
    if (!lines) {
        refuse(lines.error());
        return;
    }
    renderer_ = std::move(renderer).value();
    line_renderer_ = std::move(lines).value();
    cursor_ = std::move(cursor).value();
    picture_ = std::make_unique<GovernedPicture>(*renderer_);
    picture_->setTarget(frame_target_);
    are_layers_sent_ = false;
    redrawTerrain();
    // What follows may open dialogs, which is not for the middle of painting.
    QMetaObject::invokeMethod(
        this, [this] { Q_EMIT ready(); }, Qt::QueuedConnection);
}

void TerrainView::paintEvent(QPaintEvent* event)
{
    QOpenGLWidget::paintEvent(event);
    // Without a context the base class never calls initializeGL().
    if (!isValid() && !std::exchange(is_context_missing_, true)) {
        reportUnavailable(
            tr("no OpenGL context can be created; install the graphics driver, or Mesa's "
               "software one (libgl1-mesa-dri)"));
    }
}

// Later: who hears of it may open dialogs, which is not for the middle of painting.
void TerrainView::reportUnavailable(const QString& reason)
{
    QMetaObject::invokeMethod(
        this, [this, reason] { Q_EMIT unavailable(reason); }, Qt::QueuedConnection);
}

void TerrainView::releaseGraphics()
{
    if (renderer_) {
        makeCurrent();
        picture_.reset();
        line_renderer_.reset();
        cursor_.reset();
        renderer_.reset();
        doneCurrent();
    }
}

void TerrainView::paintGL()
{
    if (!renderer_) {
        return;
    }
    if (!is_terrain_current_) {
        paintTerrain();
    } else {
        renderer_->present(defaultFramebufferObject());
    }
    paintLines();
    paintCursor();
}

void TerrainView::setLines(std::vector<DrapedLine> lines)
{
    if (!lines.empty() || !lines_.empty()) {
        lines_ = std::move(lines);
        update();
    }
}

void TerrainView::paintLines()
{
    const double scale = devicePixelRatioF();
    const PixelArea area = marsview::areaOf(lines_, navigator_.camera(), viewport(), scale);
    if (area.width == 0 || area.height == 0) {
        return;
    }
    renderer_->presentDepth(defaultFramebufferObject(), area);
    line_renderer_->draw(lines_, navigator_.camera(), viewport(),
                         renderer_->clip(navigator_.camera(), style_.exaggeration), scale);
}

void TerrainView::paintTerrain()
{
    if (!std::exchange(are_layers_sent_, true)) {
        renderer_->setLayers(layers_);
    }
    const DrawReport report =
        picture_->paint({.camera = navigator_.camera(),
                         .viewport = viewport(),
                         .stage = stage_,
                         .last_stage = lastStage(),
                         .is_touching = buttons_.is_pressing || (device_ && device_->is_in_contact),
                         .is_kept = true},
                        style_, defaultFramebufferObject());
    last_paint_ = std::chrono::steady_clock::now();
    is_terrain_current_ = true;
    this->report(report);
    if (stage_ == PictureStage::Moving) {
        if (!still_timer_.isActive()) { // new shading is not a motion
            still_timer_.start(kStillAfter);
        }
    } else if (report.is_complete) {
        // Input that arrived in the meantime is handled first.
        QMetaObject::invokeMethod(this, &TerrainView::finishStage, Qt::QueuedConnection);
    }
}

void TerrainView::report(const DrawReport& report)
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
            this,
            [this] {
                Q_EMIT problemChanged(problem_);
                reportPointer(); // the tile under it may have arrived, too
            },
            Qt::QueuedConnection);
    }
}

void TerrainView::paintCursor()
{
    const auto& pose = shownStylus();
    if (!pose || !is_cursor_shown_) {
        return;
    }
    CursorPicture cursor{.shape = CursorShape::Sphere,
                         .position = pose->proxy,
                         .goal = std::nullopt,
                         .shadow = {},
                         .pixels_per_point = devicePixelRatioF()};
    switch (pose->mode) {
    case StylusMode::Hover:
    case StylusMode::Press:
        cursor.shape = pose->is_in_contact ? CursorShape::Cone : CursorShape::Sphere;
        break;
    case StylusMode::Pan:
        cursor.shape = CursorShape::FlatSphere;
        break;
    case StylusMode::Zoom:
        cursor.shape = CursorShape::LongSphere;
        break;
    }
    if (pose->is_in_contact) {
        cursor.goal = pose->goal;
    } else {
        const double radius_m = kShadowPoints * devicePixelRatioF() *
                                metersPerPixel(navigator_.camera(), viewport(), pose->proxy);
        for (int i = 0; i < kShadowSides; ++i) {
            const double around = 2.0 * std::numbers::pi * i / kShadowSides;
            const double x = pose->proxy.x + radius_m * std::cos(around);
            const double y = pose->proxy.y + radius_m * std::sin(around);
            const double z = groundAt(x, y);
            if (std::isfinite(z)) {
                cursor.shadow.push_back({x, y, z});
            }
        }
    }
    renderer_->presentDepth(defaultFramebufferObject(), areaOf(cursor));
    cursor_->draw(cursor, navigator_.camera(), viewport(),
                  renderer_->clip(navigator_.camera(), style_.exaggeration));
}

// Where the cursor may be hidden by the ground.
PixelArea TerrainView::areaOf(const CursorPicture& cursor) const
{
    const double reach = kCursorReachPoints * devicePixelRatioF();
    std::vector<ScenePoint> points = cursor.shadow;
    points.push_back(cursor.position);
    const Viewport size = viewport();
    double left = size.width;
    double right = 0.0;
    double top = size.height;
    double bottom = 0.0;
    for (const ScenePoint& point : points) {
        if (const auto pixel = project(navigator_.camera(), size, point)) {
            left = std::min(left, pixel->x - reach);
            right = std::max(right, pixel->x + reach);
            top = std::min(top, pixel->y - reach);
            bottom = std::max(bottom, pixel->y + reach);
        }
    }
    const auto inside = [](double value, int limit) {
        return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(limit)));
    };
    const int first_column = inside(std::floor(left), size.width);
    const int first_row = inside(size.height - std::ceil(bottom), size.height);
    return {.left = first_column,
            .bottom = first_row,
            .width = std::max(0, inside(std::ceil(right), size.width) - first_column),
            .height = std::max(0, inside(size.height - std::floor(top), size.height) - first_row)};
}

// The picture changed: first draws the detail that is ready within the frame time.
void TerrainView::redrawTerrain()
{
    stage_ = PictureStage::Moving;
    still_timer_.stop();
    is_terrain_current_ = false;
    is_completion_reported_ = false;
    update();
}

// Missing shading has arrived.
void TerrainView::redrawWithNews()
{
    if (!renderer_) {
        return;
    }
    const bool is_due = std::chrono::steady_clock::now() - last_paint_ >= kNewsInterval;
    if (stage_ == PictureStage::Moving || is_due || !renderer_->isLoading()) {
        is_terrain_current_ = false;
        update();
    }
}

PictureStage TerrainView::lastStage() const
{
    return has_antialiasing_ ? PictureStage::Smooth : PictureStage::Sharp;
}

void TerrainView::refineWhenStill()
{
    if (navigator_.isMoving()) {
        return; // the next frame starts the timer again
    }
    if (stage_ == PictureStage::Moving) {
        stage_ = PictureStage::Sharp;
        is_terrain_current_ = false;
        update();
    }
}

// A sharp picture has all its shading.
void TerrainView::finishStage()
{
    if (stage_ == PictureStage::Moving || !is_terrain_current_ || is_completion_reported_) {
        return;
    }
    if (stage_ != lastStage()) {
        stage_ = lastStage();
        is_terrain_current_ = false;
        update();
        return;
    }
    is_completion_reported_ = true;
    Q_EMIT pictureCompleted();
}

} // namespace marsview
