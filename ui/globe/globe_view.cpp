#include "ui/globe/globe_view.h"

#include "ui/canvas/view_projection.h"

#include <QLabel>
#include <QMouseEvent>
#include <QOpenGLContext>
#include <QVBoxLayout>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace marsview {
namespace {

using std::chrono::milliseconds;

// As in the flat map.
constexpr double kPanShare = 0.12; // of the distance, a key press
constexpr double kKeyZoomFactor = 0.75;
constexpr Angle kKeyTurn = Angle::degrees(10.0);
constexpr Angle kKeyTilt = Angle::degrees(5.0);
constexpr milliseconds kKeyDuration{180};
constexpr milliseconds kFlyDuration{1200};
constexpr double kFlyFactor = 0.3; // of the distance, when flying nearer
constexpr Angle kTurnPerPixel = Angle::degrees(0.3);
constexpr double kWheelNotch = 120.0;
constexpr double kWheelFactor = 0.8;
constexpr double kWheelFactorFine = 0.96;
constexpr milliseconds kWheelDuration{140};

// The interval at which samples that were requested are looked for.
constexpr milliseconds kSampleInterval{40};

QLabel* overText(QWidget& view, Qt::Alignment alignment)
{
    auto* label = new QLabel(&view);
    label->setAlignment(alignment);
    label->setWordWrap(true);
    label->setAttribute(Qt::WA_TransparentForMouseEvents);
    QPalette palette = label->palette();
    palette.setColor(QPalette::WindowText, QColor(200, 205, 214)); // over the sky
    label->setPalette(palette);
    label->hide();
    return label;
}

} // namespace

GlobeView::GlobeView(QWidget* parent)
    : QOpenGLWidget(parent)
    , jobs_(*this)
    , motion_([this](const BodyCamera& camera) { return bounded(camera); })
    , note_(overText(*this, Qt::AlignHCenter | Qt::AlignBottom))
    , wait_(overText(*this, Qt::AlignCenter))
{
    setObjectName(QStringLiteral("globe"));
    setAccessibleName(tr("Globe"));
    setAccessibleDescription(
        tr("The terrain on its body; the status bar shows the position and elevation under the "
           "pointer, or in the middle while the keyboard is used"));
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setMinimumSize(160, 120);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(wait_, 1);
    layout->addWidget(note_);
    note_->setObjectName(QStringLiteral("globeNote"));
    still_timer_.setSingleShot(true);
    connect(&still_timer_, &QTimer::timeout, this, &GlobeView::refine);
    sample_timer_.setSingleShot(true);
    connect(&sample_timer_, &QTimer::timeout, this, &GlobeView::report);
    connect(&motion_, &GlobeMotion::cameraChanged, this, [this] {
        redraw();
        report();
    });
}

GlobeView::~GlobeView()
{
    if (placing_) {
        placing_->cancel();
    }
    if (context() != nullptr) {
        disconnect(context(), nullptr, this, nullptr);
    }
    releaseGraphics();
}

void GlobeView::setLayer(const std::optional<ShownLayer>& layer)
{
    const bool is_same_map = layer && layer_ && layer->map == layer_->map;
    layer_ = layer;
    is_layer_sent_ = false;
    if (is_same_map) {
        redraw();
        return;
    }
    if (placing_) {
        placing_->cancel();
        placing_.reset();
    }
    if (terrain_ && !first_camera_) {
        const Body* before = terrain_->map()->info().body;
        if (layer && before != nullptr && layer->map->info().body == before) {
            first_camera_ = motion_.goal();
        }
    }
    terrain_.reset();
    motion_.stop();
    if (layer) {
        place(*layer);
    }
    redraw();
    report();
    Q_EMIT placed();
}

// Projections take some time for each sample.
void GlobeView::place(const ShownLayer& layer)
{
    wait_->setText(tr("Placing the layer on its body…"));
    wait_->show();
    placing_ = std::make_shared<JobMonitor>();
    jobs_.run([this, map = layer.map,
               monitor = placing_](const std::shared_ptr<DetachedJobs::Outlet>& outlet) {
        auto grid = BodyGrid::make(map->georeference(), *monitor);
        outlet->post([this, map, monitor, grid = std::move(grid)] {
            if (monitor != placing_ || !layer_ || layer_->map != map) {
                return; // superseded
            }
            placing_.reset();
            if (grid) {
                showPlaced(*grid);
                return;
            }
            const QString reason = QString::fromStdString(grid.error().message);
            //: In the middle of the globe; %1 says why
            wait_->setText(tr("This layer has no place on the globe: it %1").arg(reason));
            Q_EMIT failed(reason);
        });
    });
}

void GlobeView::showPlaced(const std::shared_ptr<const BodyGrid>& grid)
{
    wait_->hide();
    terrain_.emplace(layer_->map, grid);
    is_layer_sent_ = false;
    const auto first = std::exchange(first_camera_, std::nullopt);
    motion_.jumpTo(first.value_or(homeCamera(limits(), viewport())));
    Q_EMIT placed();
}

void GlobeView::setNote(const QString& note)
{
    note_->setText(note);
    note_->setVisible(!note.isEmpty());
}

void GlobeView::setExaggeration(double exaggeration)
{
    const double before = std::exchange(style_.exaggeration, exaggeration);
    if (terrain_ && before != exaggeration) {
        BodyCamera camera = motion_.goal();
        camera.height_m *= exaggeration / before;
        motion_.jumpTo(camera);
    }
}

void GlobeView::setLook(const TerrainLook& look)
{
    style_.look = look;
    redraw();
}

void GlobeView::setAntialiasing(bool is_wanted)
{
    has_antialiasing_ = is_wanted;
    redraw();
}

void GlobeView::setFrameTarget(milliseconds target)
{
    frame_target_ = target;
    if (picture_) {
        picture_->setTarget(target);
    }
}

void GlobeView::setCamera(const BodyCamera& camera)
{
    if (terrain_) {
        motion_.jumpTo(camera);
    } else {
        first_camera_ = camera;
    }
}

Viewport GlobeView::viewport() const
{
    return viewportOf(*this);
}

BodyLimits GlobeView::limits() const
{
    const HeightRange range = terrain_->map()->heightfield().range().value_or(HeightRange{});
    return bodyLimits(*terrain_->grid(), range.minimum_m * style_.exaggeration,
                      range.maximum_m * style_.exaggeration);
}

BodyCamera GlobeView::bounded(const BodyCamera& camera) const
{
    if (!terrain_) {
        return camera;
    }
    return constrained(camera, limits(), [this](const GeographicPoint& place) {
        return terrain_->height(place) * style_.exaggeration;
    });
}

// The same picture, its target on the terrain in the middle of it.
BodyCamera GlobeView::onGround(const BodyCamera& camera) const
{
    const Ellipsoid& ellipsoid = terrain_->grid()->ellipsoid();
    const CameraPose pose = poseOf(camera, ellipsoid);
    const Ray ray{pose.eye, pose.axes.forward};
    const auto hit = terrain_->cast(ray, style_.exaggeration);
    const BodyLimits bounds = limits();
    if (!hit || hit->distance_m < bounds.distance_min_m ||
        hit->distance_m > bounds.distance_max_m) {
        return camera;
    }
    const BodyPlace place = placeOf(ray.at(hit->distance_m), ellipsoid);
    const LocalAxes local = localAxes(ellipsoid, place.foot);
    BodyCamera result = camera;
    result.target = place.foot;
    result.height_m = place.height_m;
    result.distance_m = hit->distance_m;
    const double down = std::clamp(-dot(ray.direction, local.up), -1.0, 1.0);
    result.tilt = Angle::radians(std::acos(down));
    // Straight down the picture's upper edge has the heading.
    const Vec3 ahead = std::abs(down) > 1.0 - 1e-9 ? pose.axes.up : ray.direction;
    result.azimuth = Angle::radians(std::atan2(dot(ahead, local.east), dot(ahead, local.north)));
    return result;
}

void GlobeView::fly(const BodyCamera& goal, milliseconds duration)
{
    is_zooming_ = false;
    const Ellipsoid ellipsoid = terrain_->grid()->ellipsoid();
    const BodyCamera bounded_goal = bounded(goal);
    motion_.follow([from = motion_.camera(), bounded_goal, ellipsoid](
                       double share) { return flown(from, bounded_goal, ellipsoid, share); },
                   duration);
}

void GlobeView::step(NavigationStep step)
{
    if (!terrain_) {
        return;
    }
    const Ellipsoid& ellipsoid = terrain_->grid()->ellipsoid();
    BodyCamera camera = onGround(motion_.goal());
    switch (step) {
    case NavigationStep::PanLeft:
        camera = panned(camera, -kPanShare, 0.0, ellipsoid);
        break;
    case NavigationStep::PanRight:
        camera = panned(camera, kPanShare, 0.0, ellipsoid);
        break;
    case NavigationStep::PanAway:
        camera = panned(camera, 0.0, kPanShare, ellipsoid);
        break;
    case NavigationStep::PanNearer:
        camera = panned(camera, 0.0, -kPanShare, ellipsoid);
        break;
    case NavigationStep::ZoomIn:
        camera.distance_m *= kKeyZoomFactor;
        break;
    case NavigationStep::ZoomOut:
        camera = motion_.goal();
        camera.distance_m /= kKeyZoomFactor;
        break;
    case NavigationStep::TurnLeft:
        camera = orbited(camera, -kKeyTurn, {});
        break;
    case NavigationStep::TurnRight:
        camera = orbited(camera, kKeyTurn, {});
        break;
    case NavigationStep::TiltUp:
        camera = orbited(camera, {}, kKeyTilt);
        break;
    case NavigationStep::TiltDown:
        camera = orbited(camera, {}, -kKeyTilt);
        break;
    }
    fly(camera, kKeyDuration);
}

void GlobeView::goHome()
{
    if (terrain_) {
        fly(homeCamera(limits(), viewport()), kFlyDuration);
    }
}

void GlobeView::turnNorthUp()
{
    if (terrain_) {
        BodyCamera camera = onGround(motion_.goal());
        camera.azimuth = {};
        fly(camera, kFlyDuration);
    }
}

void GlobeView::flyTo(const GeographicPoint& place, double distance_m)
{
    if (!terrain_) {
        return;
    }
    BodyCamera camera = onGround(motion_.goal());
    camera.target = place;
    const double height_m = terrain_->height(place) * style_.exaggeration;
    camera.height_m = std::isfinite(height_m) ? height_m : 0.0;
    if (distance_m > 0.0) {
        camera.distance_m = distance_m;
    }
    fly(camera, kFlyDuration);
}

PixelPoint GlobeView::pixelAt(QPointF position) const
{
    const QPointF pixel = position * devicePixelRatioF();
    return {pixel.x(), pixel.y()};
}

std::optional<BodyHit> GlobeView::hitAt(QPointF position) const
{
    if (!terrain_) {
        return std::nullopt;
    }
    const CameraPose pose = poseOf(motion_.camera(), terrain_->grid()->ellipsoid());
    return terrain_->cast(pickRay(pose, viewport(), pixelAt(position)), style_.exaggeration);
}

std::optional<RayHit> GlobeView::reading() const
{
    std::optional<QPointF> position = pointer_;
    if (!position && hasFocus()) {
        position = QRectF(rect()).center();
    }
    const auto hit = position ? hitAt(*position) : std::nullopt;
    return hit ? std::optional(
                     RayHit{.grid = hit->grid, .height_m = hit->height_m, .t = hit->distance_m})
               : std::nullopt;
}

double GlobeView::metersPerPoint(const RayHit& hit) const
{
    if (!terrain_) {
        return 0.0;
    }
    const CameraPose pose = poseOf(motion_.camera(), terrain_->grid()->ellipsoid());
    return devicePixelRatioF() * hit.t / pose.distance_m * metersPerPixel(pose, viewport());
}

// The ground that a drag or a zoom holds; beside the body, the nearest point of its edge.
HeldPoint GlobeView::heldAtPosition(QPointF position) const
{
    const Ellipsoid& ellipsoid = terrain_->grid()->ellipsoid();
    const PixelPoint pixel = pixelAt(position);
    const Ray ray = pickRay(poseOf(motion_.camera(), ellipsoid), viewport(), pixel);
    const auto hit = terrain_->cast(ray, style_.exaggeration);
    return {.point = hit ? ray.at(hit->distance_m)
                         : pointOnBody(ray, ellipsoid, targetOf(motion_.camera(), ellipsoid)),
            .pixel = pixel};
}

void GlobeView::zoom(double factor, QPointF position, milliseconds duration)
{
    if (is_zooming_ && motion_.isMoving()) {
        factor *= std::pow(zoom_left_, 1.0 - motion_.share());
    }
    const BodyLimits bounds = limits();
    const BodyCamera from =
        factor < 1.0 && !motion_.isMoving() ? onGround(motion_.camera()) : motion_.camera();
    const HeldPoint held = heldAtPosition(position);
    is_zooming_ = true;
    zoom_left_ = factor;
    motion_.follow(
        [from, factor, held, bounds, size = viewport()](double share) {
            return zoomed(from, std::pow(factor, share), size, held, bounds);
        },
        duration);
}

void GlobeView::mousePressEvent(QMouseEvent* event)
{
    if (!terrain_ || drag_ != Drag::None) {
        return;
    }
    motion_.stop();
    drag_button_ = event->button();
    drag_position_ = event->position();
    const bool is_pan = event->modifiers().testFlag(Qt::ShiftModifier) ||
                        (event->button() == Qt::LeftButton && tool_ != Tool::Orbit);
    drag_ = is_pan ? Drag::Pan : Drag::Orbit;
    setCursor(is_pan ? Qt::ClosedHandCursor : Qt::SizeAllCursor);
    if (is_pan) {
        held_ = heldAtPosition(event->position());
    } else {
        motion_.jumpTo(onGround(motion_.camera()));
    }
}

void GlobeView::mouseMoveEvent(QMouseEvent* event)
{
    pointer_ = event->position();
    const QPointF moved = event->position() - drag_position_;
    if (drag_ == Drag::Pan && held_ && !moved.isNull()) {
        held_->pixel = pixelAt(event->position());
        motion_.jumpTo(heldAt(motion_.camera(), terrain_->grid()->ellipsoid(), viewport(), *held_));
    } else if (drag_ == Drag::Orbit && !moved.isNull()) {
        motion_.jumpTo(
            orbited(motion_.camera(), kTurnPerPixel * moved.x(), kTurnPerPixel * -moved.y()));
    } else {
        report();
    }
    drag_position_ = event->position();
}

void GlobeView::mouseReleaseEvent(QMouseEvent* event)
{
    if (event->button() == drag_button_ || event->buttons() == Qt::NoButton) {
        drag_ = Drag::None;
        held_.reset();
        unsetCursor();
    }
}

void GlobeView::mouseDoubleClickEvent(QMouseEvent* event)
{
    const auto hit = event->button() == Qt::LeftButton ? hitAt(event->position()) : std::nullopt;
    if (!hit) {
        return;
    }
    const auto place = terrain_->map()->georeference().toGeographic(hit->grid);
    if (place) {
        flyTo(*place, onGround(motion_.goal()).distance_m * kFlyFactor);
    }
}

void GlobeView::wheelEvent(QWheelEvent* event)
{
    const double notches = event->angleDelta().y() / kWheelNotch;
    if (!terrain_ || notches == 0.0) {
        return;
    }
    event->accept();
    const bool is_fine = event->modifiers().testFlag(Qt::ControlModifier);
    zoom(std::pow(is_fine ? kWheelFactorFine : kWheelFactor, notches), event->position(),
         kWheelDuration);
}

void GlobeView::leaveEvent(QEvent* event)
{
    QOpenGLWidget::leaveEvent(event);
    pointer_.reset();
    report();
}

void GlobeView::focusInEvent(QFocusEvent* event)
{
    QOpenGLWidget::focusInEvent(event);
    report();
}

void GlobeView::focusOutEvent(QFocusEvent* event)
{
    QOpenGLWidget::focusOutEvent(event);
    report();
}

void GlobeView::report()
{
    const auto hit = reading();
    Q_EMIT readingChanged(hit);
    // A ray takes what is loaded; where it is coarser, the samples themselves are requested.
    if (hit && !isMoving() && drag_ == Drag::None) {
        const Heightfield& heightfield = terrain_->map()->heightfield();
        if (!heightfield.isExact(hit->grid)) {
            static_cast<void>(heightfield.height(hit->grid));
            if (heightfield.tiles()->isLoading()) {
                sample_timer_.start(kSampleInterval);
            }
        }
    }
}

void GlobeView::resizeEvent(QResizeEvent* event)
{
    redraw();
    QOpenGLWidget::resizeEvent(event);
}

void GlobeView::redraw()
{
    stage_ = PictureStage::Moving;
    still_timer_.stop();
    is_current_ = false;
    is_complete_ = false;
    update();
}

void GlobeView::refine()
{
    if (!isMoving() && stage_ == PictureStage::Moving) {
        stage_ = PictureStage::Sharp;
        is_current_ = false;
        update();
    }
}

void GlobeView::initializeGL()
{
    connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &GlobeView::releaseGraphics);
    auto renderer = TerrainRenderer::create([this] {
        QMetaObject::invokeMethod(
            this,
            [this] {
                is_current_ = false;
                update();
            },
            Qt::QueuedConnection);
    });
    if (!renderer) {
        const QString reason = QString::fromStdString(renderer.error().message);
        QMetaObject::invokeMethod(
            this, [this, reason] { Q_EMIT failed(reason); }, Qt::QueuedConnection);
        return;
    }
    renderer_ = std::move(renderer).value();
    picture_ = std::make_unique<GovernedPicture>(*renderer_);
    picture_->setTarget(frame_target_);
    is_layer_sent_ = false;
}

void GlobeView::releaseGraphics()
{
    if (renderer_) {
        makeCurrent();
        picture_.reset();
        renderer_.reset();
        doneCurrent();
    }
}

void GlobeView::sendLayer()
{
    if (std::exchange(is_layer_sent_, true)) {
        return;
    }
    if (!terrain_ || !layer_) {
        renderer_->setLayers({});
        return;
    }
    TerrainLayer layer =
        terrainLayer(layer_->map, layer_->map->georeference().sceneFrame(), *layer_->ramp);
    layer.tint_range = colorRangeOf(*layer_);
    layer.slope_range = slopeRangeOf(*layer_);
    layer.body = terrain_->grid();
    renderer_->setLayers({layer});
}

void GlobeView::paintGL()
{
    if (!renderer_) {
        return;
    }
    if (is_current_) {
        renderer_->present(defaultFramebufferObject());
        return;
    }
    sendLayer();
    const PictureStage last = has_antialiasing_ ? PictureStage::Smooth : PictureStage::Sharp;
    PictureRequest request{
        .camera = {}, .viewport = viewport(), .stage = stage_, .last_stage = last, .is_kept = true};
    if (terrain_) {
        request.body_pose = poseOf(motion_.camera(), terrain_->grid()->ellipsoid());
    }
    const DrawReport report = picture_->paint(request, style_, defaultFramebufferObject());
    is_current_ = true;
    Q_EMIT detailChanged(report.error_px);
    const bool is_loading = stage_ != PictureStage::Moving && !report.is_complete;
    if (is_loading != std::exchange(is_loading_, is_loading)) {
        Q_EMIT loadingChanged(is_loading);
    }
    QString problem = report.problem ? QString::fromStdString(report.problem->message) : QString();
    if (problem != problem_) {
        problem_ = std::move(problem);
        QMetaObject::invokeMethod(
            this, [this] { Q_EMIT problemChanged(problem_); }, Qt::QueuedConnection);
    }
    if (stage_ == PictureStage::Moving) {
        if (!still_timer_.isActive()) {
            still_timer_.start(kStillAfter);
        }
        return;
    }
    if (!report.is_complete) {
        return; // the renderer asks for another picture
    }
    if (stage_ != last) {
        QMetaObject::invokeMethod(
            this,
            [this, last] {
                if (stage_ != PictureStage::Moving && is_current_) {
                    stage_ = last;
                    is_current_ = false;
                    update();
                }
            },
            Qt::QueuedConnection);
        return;
    }
    if (!std::exchange(is_complete_, true)) {
        QMetaObject::invokeMethod(
            this, [this] { Q_EMIT pictureCompleted(); }, Qt::QueuedConnection);
    }
}

} // namespace marsview
