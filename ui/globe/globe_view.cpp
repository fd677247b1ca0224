#include "ui/globe/globe_view.h"

#include "core/globe/horizon.h"
#include "core/session/range_in_picture.h"
#include "ui/canvas/view_projection.h"
#include "ui/render/offscreen_picture.h"

#include <QLabel>
#include <QOpenGLContext>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <filesystem>
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

constexpr double kShadowPoints = 9.0;
constexpr int kShadowSides = 24;

// The interval at which samples that were requested are looked for.
constexpr milliseconds kSampleInterval{40};

std::vector<ScenePoint> placesOf(const BodyTerrain& map, double exaggeration)
{
    const HeightRange range = map.map()->heightfield().range().value_or(HeightRange{});
    return placesOver(*map.grid(), range.minimum_m * exaggeration, range.maximum_m * exaggeration);
}

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
    connect(&touch_, &GlobeTouch::moved, this, [this] {
        showCursor();
        update(); // over the picture that was kept
        Q_EMIT stylusMoved();
    });
    connect(&grab_key_, &GrabKey::released, this, &GlobeView::releaseGrab);
    lead_timer_.setSingleShot(true);
    connect(&lead_timer_, &QTimer::timeout, this, &GlobeView::report);
    connect(&meshes_, &GlobeMeshes::failed, this, &GlobeView::touchFailed);
    connect(&meshes_, &GlobeMeshes::preparingChanged, this, [this](bool is_preparing) {
        if (!scene_.isEmpty()) {
            wait_->setText(tr("Preparing the terrain for touch…"));
            wait_->setVisible(is_preparing);
        }
    });
    connect(&motion_, &GlobeMotion::cameraChanged, this, [this] {
        redraw();
        followTouch();
        report();
        Q_EMIT sightChanged();
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

void GlobeView::setLayers(const std::vector<ShownLayer>& top_first)
{
    const auto is_same_map = [](const ShownLayer& a, const ShownLayer& b) {
        return a.map == b.map;
    };
    const bool are_same =
        std::equal(top_first.begin(), top_first.end(), wanted_.begin(), wanted_.end(), is_same_map);
    const Body* before = wanted_.empty() ? nullptr : wanted_.front().map->info().body;
    const bool look_same =
        are_same && std::equal(top_first.begin(), top_first.end(), wanted_.begin(),
                               [](const ShownLayer& a, const ShownLayer& b) {
                                   const HeightRange a_range = colorRangeOf(a);
                                   const HeightRange b_range = colorRangeOf(b);
                                   return a.ramp == b.ramp && a.slope_range == b.slope_range &&
                                          a_range.minimum_m == b_range.minimum_m &&
                                          a_range.maximum_m == b_range.maximum_m;
                               });
    if (look_same) {
        return;
    }
    wanted_ = top_first;
    are_layers_sent_ = false;
    if (are_same) {
        for (ShownLayer& layer : layers_) {
            layer = *std::find_if(wanted_.begin(), wanted_.end(), [&](const ShownLayer& wanted) {
                return is_same_map(wanted, layer);
            });
        }
        redraw();
        Q_EMIT sceneChanged();
        return;
    }
    if (placing_) {
        placing_->cancel();
        placing_.reset();
    }
    const std::optional<Ellipsoid> ellipsoid = sceneEllipsoid();
    std::erase_if(placed_, [&](const Placed& placed) {
        return (placed.grid && placed.grid->ellipsoid() != ellipsoid) ||
               std::none_of(wanted_.begin(), wanted_.end(),
                            [&](const ShownLayer& layer) { return layer.map == placed.map; });
    });
    std::optional<BodyCamera> kept;
    if (wanted_.empty() || wanted_.front().map->info().body != before) {
        scene_ = {};
        layers_.clear();
        motion_.stop();
    } else if (!scene_.isEmpty()) {
        kept = motion_.goal();
    }
    showPlaced();
    if (scene_.isEmpty() && kept) {
        first_camera_ = kept; // layers that are placed on another ellipsoid
    }
    placeNext();
}

// Of the lowest layer, which the others are put on in most cases.
std::optional<Ellipsoid> GlobeView::sceneEllipsoid() const
{
    for (auto layer = wanted_.rbegin(); layer != wanted_.rend(); ++layer) {
        const auto& crs = layer->map->georeference().crs();
        if (crs && crs->ellipsoid()) {
            return crs->ellipsoid();
        }
    }
    return std::nullopt;
}

const GlobeView::Placed* GlobeView::placedOf(const ShownLayer& layer) const
{
    const auto found = std::find_if(placed_.begin(), placed_.end(),
                                    [&](const Placed& placed) { return placed.map == layer.map; });
    return found != placed_.end() ? &*found : nullptr;
}

// Projections take some time for each sample.
void GlobeView::placeNext()
{
    const auto next = std::find_if(wanted_.begin(), wanted_.end(), [this](const ShownLayer& layer) {
        return placedOf(layer) == nullptr;
    });
    if (next == wanted_.end()) {
        showMissing();
        return;
    }
    if (scene_.isEmpty()) {
        wait_->setText(tr("Placing the layer on its body…"));
        wait_->show();
    }
    placing_ = std::make_shared<JobMonitor>();
    jobs_.run([this, map = next->map, ellipsoid = sceneEllipsoid(),
               monitor = placing_](const std::shared_ptr<DetachedJobs::Outlet>& outlet) {
        auto grid = BodyGrid::make(map->georeference(), *monitor, ellipsoid);
        outlet->post([this, map, monitor, grid = std::move(grid)] {
            if (monitor != placing_) {
                return; // superseded
            }
            placing_.reset();
            placed_.push_back(
                {.map = map,
                 .grid = grid ? *grid : nullptr,
                 .problem = grid ? QString() : QString::fromStdString(grid.error().message)});
            showPlaced();
            placeNext();
        });
    });
}

// Those that are placed.
void GlobeView::showPlaced()
{
    const bool was_empty = scene_.isEmpty();
    std::vector<BodyTerrain> maps;
    layers_.clear();
    for (const ShownLayer& layer : wanted_) {
        const Placed* placed = placedOf(layer);
        if (placed != nullptr && placed->grid) {
            maps.emplace_back(layer.map, placed->grid);
            layers_.push_back(layer);
        }
    }
    scene_ = BodyScene(std::move(maps));
    meshes_.setScene(scene_, style_.exaggeration);
    are_layers_sent_ = false;
    if (!scene_.isEmpty()) {
        wait_->hide();
        const BodyCamera next = was_empty ? homeView() : motion_.goal();
        motion_.jumpTo(std::exchange(first_camera_, std::nullopt).value_or(next));
        flyToAwaited();
    }
    redraw();
    report();
    Q_EMIT sceneChanged();
    Q_EMIT placed();
}

// After all that can be placed are.
void GlobeView::showMissing()
{
    QStringList notes;
    for (const ShownLayer& layer : wanted_) {
        const Placed& placed = *placedOf(layer);
        if (!placed.grid) {
            //: Over the globe; %1 is a file, %2 says why
            notes.append(tr("%1 has no place on the globe: it %2")
                             .arg(QString::fromStdString(
                                      std::filesystem::path(layer.map->spec().path).filename()),
                                  placed.problem));
        }
    }
    note_->setText(notes.join(QLatin1Char('\n')));
    note_->setVisible(!notes.isEmpty());
    if (scene_.isEmpty()) {
        wait_->hide();
    }
    if (!wanted_.empty() && scene_.isEmpty()) {
        Q_EMIT failed(placedOf(wanted_.front())->problem);
    }
}

void GlobeView::setExaggeration(double exaggeration)
{
    const double before = std::exchange(style_.exaggeration, exaggeration);
    meshes_.setScene(scene_, exaggeration);
    if (!scene_.isEmpty() && before != exaggeration) {
        BodyCamera camera = motion_.goal();
        camera.height_m *= exaggeration / before;
        motion_.jumpTo(camera);
    }
    Q_EMIT sceneChanged();
}

void GlobeView::setLook(const TerrainLook& look)
{
    style_.look = look;
    redraw();
    Q_EMIT sceneChanged();
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
    if (!scene_.isEmpty()) {
        motion_.jumpTo(camera);
    } else {
        first_camera_ = camera;
    }
}

void GlobeView::setHomeCamera()
{
    first_camera_.reset();
    if (!scene_.isEmpty()) {
        motion_.jumpTo(homeView());
    }
}

Viewport GlobeView::viewport() const
{
    return viewportOf(*this);
}

BodyLimits GlobeView::limitsOf(const BodyTerrain& map) const
{
    const HeightRange range = scene_.range();
    return bodyLimits(*map.grid(), range.minimum_m * style_.exaggeration,
                      range.maximum_m * style_.exaggeration);
}

BodyLimits GlobeView::limits() const
{
    std::optional<BodyLimits> all;
    for (const BodyTerrain& map : scene_.maps()) {
        const BodyLimits limits = limitsOf(map);
        all = all ? united(*all, limits) : limits;
    }
    return *all;
}

// All layers.
BodyCamera GlobeView::homeView() const
{
    std::vector<ScenePoint> places;
    for (const BodyTerrain& map : scene_.maps()) {
        const std::vector<ScenePoint> more = placesOf(map, style_.exaggeration);
        places.insert(places.end(), more.begin(), more.end());
    }
    return homeCamera(limits(), places, viewport());
}

// From the side that the camera has, unless that is seen as a ball.
BodyCamera GlobeView::viewOf(const BodyTerrain& map) const
{
    const BodyLimits bounds = limitsOf(map);
    const std::vector<ScenePoint> places = placesOf(map, style_.exaggeration);
    BodyCamera camera = homeCamera(bounds, places, viewport());
    if (isBall(bounds.area)) {
        return camera;
    }
    const BodyCamera now = onGround(motion_.goal());
    camera.azimuth = now.azimuth;
    camera.tilt = now.tilt;
    return withGroundAhead(framed(camera, places, viewport(), bounds.ellipsoid), bounds.ellipsoid);
}

BodyCamera GlobeView::bounded(const BodyCamera& camera) const
{
    if (scene_.isEmpty()) {
        return camera;
    }
    return constrained(camera, limits(), [this](const GeographicPoint& place) {
        return scene_.height(place) * style_.exaggeration;
    });
}

// The same picture, its target on the terrain in the middle of it.
BodyCamera GlobeView::onGround(const BodyCamera& camera) const
{
    const Ellipsoid& ellipsoid = scene_.ellipsoid();
    const CameraPose pose = poseOf(camera, ellipsoid);
    const Ray ray{pose.eye, pose.axes.forward};
    const auto ground = scene_.cast(ray, style_.exaggeration);
    const BodyLimits bounds = limits();
    if (!ground || ground->hit.distance_m < bounds.distance_min_m ||
        ground->hit.distance_m > bounds.distance_max_m) {
        return camera;
    }
    const BodyPlace place = placeOf(ray.at(ground->hit.distance_m), ellipsoid);
    const LocalAxes local = localAxes(ellipsoid, place.foot);
    BodyCamera result = camera;
    result.target = place.foot;
    result.height_m = place.height_m;
    result.distance_m = ground->hit.distance_m;
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
    const Ellipsoid ellipsoid = scene_.ellipsoid();
    const BodyCamera bounded_goal = bounded(goal);
    motion_.follow([from = motion_.camera(), bounded_goal, ellipsoid](
                       double share) { return flown(from, bounded_goal, ellipsoid, share); },
                   duration);
}

void GlobeView::step(NavigationStep step)
{
    if (scene_.isEmpty()) {
        return;
    }
    const Ellipsoid& ellipsoid = scene_.ellipsoid();
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

// Speed and pivot are found when a push begins, as on the flat map: found again in each frame, they
// would jump from ridge to ridge.
void GlobeView::steer(const CapRates& rates, double seconds)
{
    if (scene_.isEmpty() || !doesSteer(rates)) {
        cap_ = {};
        return;
    }
    const double rise = capSpeed(rates.push.z);
    const bool begins = !doesSteer(cap_) || (doesTurn(rates) && !doesTurn(cap_));
    BodyCamera camera = motion_.camera();
    if (rise < 0.0 || (begins && rise == 0.0)) {
        camera = onGround(camera);
    }
    camera = bounded(steered(camera, rates, seconds, limits()));
    if (isMoving() || !(camera == motion_.camera())) {
        cap_ = rates;
        motion_.jumpTo(camera);
    }
}

void GlobeView::goHome()
{
    if (!scene_.isEmpty()) {
        fly(homeView(), kFlyDuration);
    }
}

void GlobeView::turnNorthUp()
{
    if (!scene_.isEmpty()) {
        BodyCamera camera = onGround(motion_.goal());
        camera.azimuth = {};
        fly(camera, kFlyDuration);
    }
}

void GlobeView::flyTo(const GeographicPoint& place, double distance_m)
{
    if (scene_.isEmpty()) {
        return;
    }
    BodyCamera camera = onGround(motion_.goal());
    camera.target = place;
    const double height_m = scene_.height(place) * style_.exaggeration;
    camera.height_m = std::isfinite(height_m) ? height_m : 0.0;
    if (distance_m > 0.0) {
        camera.distance_m = distance_m;
    }
    fly(camera, kFlyDuration);
}

bool GlobeView::flyToLayer(const std::shared_ptr<const Map>& map)
{
    awaited_.reset();
    if (std::none_of(wanted_.begin(), wanted_.end(),
                     [&](const ShownLayer& layer) { return layer.map == map; })) {
        return false;
    }
    awaited_ = map;
    flyToAwaited();
    return true;
}

void GlobeView::flyToAwaited()
{
    const auto map = awaited_.lock();
    const auto placed =
        std::find_if(scene_.maps().begin(), scene_.maps().end(),
                     [&](const BodyTerrain& terrain) { return terrain.map() == map; });
    if (map && placed != scene_.maps().end()) {
        awaited_.reset();
        fly(viewOf(*placed), kFlyDuration);
    }
}

void GlobeView::flyTo(const BodyCamera& camera)
{
    if (!scene_.isEmpty()) {
        fly(camera, kFlyDuration);
    } else {
        setCamera(camera);
    }
}

void GlobeView::lookAt(const GeographicPoint& place)
{
    if (scene_.isEmpty()) {
        return;
    }
    BodyCamera camera = motion_.camera();
    camera.target = place;
    const double height_m = scene_.height(place) * style_.exaggeration;
    camera.height_m = std::isfinite(height_m) ? height_m : 0.0;
    motion_.jumpTo(camera);
}

PixelPoint GlobeView::pixelAt(QPointF position) const
{
    const QPointF pixel = position * devicePixelRatioF();
    return {pixel.x(), pixel.y()};
}

std::optional<BodyScenePoint> GlobeView::groundAt(QPointF position) const
{
    if (scene_.isEmpty()) {
        return std::nullopt;
    }
    const CameraPose pose = poseOf(motion_.camera(), scene_.ellipsoid());
    return scene_.cast(pickRay(pose, viewport(), pixelAt(position)), style_.exaggeration);
}

std::optional<BodyHit> GlobeView::hitAt(QPointF position) const
{
    const auto ground = groundAt(position);
    return ground ? std::optional(ground->hit) : std::nullopt;
}

std::optional<BodyScenePoint> GlobeView::groundBelow(const ScenePoint& place) const
{
    if (scene_.isEmpty()) {
        return std::nullopt;
    }
    const GeographicPoint foot = placeOf(place, scene_.ellipsoid()).foot;
    const auto index = scene_.mapAt(foot);
    const auto grid = index ? scene_.maps()[*index].gridAt(foot) : std::nullopt;
    if (!grid) {
        return std::nullopt;
    }
    const ScenePoint eye = poseOf(motion_.camera(), scene_.ellipsoid()).eye;
    return BodyScenePoint{.index = *index,
                          .hit = {.grid = *grid,
                                  .height_m = scene_.maps()[*index].heightOnGrid(*grid),
                                  .distance_m = length(place - eye)}};
}

std::optional<HeightRange> GlobeView::rangeInPicture(const std::shared_ptr<const Map>& map) const
{
    if (scene_.isEmpty()) {
        return std::nullopt;
    }
    const auto ranges = rangesInPicture(scene_, poseOf(motion_.camera(), scene_.ellipsoid()),
                                        viewport(), style_.exaggeration);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        if (scene_.maps()[i].map() == map) {
            return ranges[i];
        }
    }
    return std::nullopt;
}

bool GlobeView::isInPicture(const ScenePoint& place) const
{
    if (scene_.isEmpty()) {
        return false;
    }
    const CameraPose pose = poseOf(motion_.camera(), scene_.ellipsoid());
    const Viewport size = viewport();
    const auto pixel = project(pose, size, place);
    return pixel && pixel->x >= 0.0 && pixel->y >= 0.0 && pixel->x <= size.width &&
           pixel->y <= size.height &&
           !Horizon(scene_.ellipsoid(), scene_.range().minimum_m * style_.exaggeration)
                .hides(place, pose.eye);
}

ReadingSource GlobeView::readingSource() const
{
    return isStylusRead()       ? ReadingSource::Stylus
           : isCrosshairShown() ? ReadingSource::Crosshair
                                : ReadingSource::Pointer;
}

std::optional<BodyScenePoint> GlobeView::reading() const
{
    if (isStylusRead()) {
        return groundBelow(device_->proxy);
    }
    std::optional<QPointF> position = pointer_;
    if (!position && hasFocus()) {
        position = QRectF(rect()).center();
    }
    return position ? groundAt(*position) : std::nullopt;
}

bool GlobeView::isCrosshairShown() const
{
    return !scene_.isEmpty() && !pointer_ && hasFocus() && !isStylusRead();
}

void GlobeView::forgetPointer()
{
    if (pointer_ && drag_ == MapAction::None) {
        pointer_.reset();
        followTouch();
        report();
    }
}

double GlobeView::metersPerPoint(const BodyHit& hit) const
{
    if (scene_.isEmpty()) {
        return 0.0;
    }
    const CameraPose pose = poseOf(motion_.camera(), scene_.ellipsoid());
    return devicePixelRatioF() * hit.distance_m / pose.distance_m *
           metersPerPixel(pose, viewport());
}

double GlobeView::metersPerPointInMiddle() const
{
    if (scene_.isEmpty()) {
        return 0.0;
    }
    const Ellipsoid& ellipsoid = scene_.ellipsoid();
    const CameraPose pose = poseOf(motion_.camera(), ellipsoid);
    const auto ground = scene_.cast({pose.eye, pose.axes.forward}, style_.exaggeration);
    const ScenePoint middle = ground ? pose.eye + pose.axes.forward * ground->hit.distance_m
                                     : targetOf(motion_.camera(), ellipsoid);
    // Raised terrain is drawn wider than it is.
    const ScenePoint foot = targetOf({.target = placeOf(middle, ellipsoid).foot}, ellipsoid);
    return devicePixelRatioF() * metersPerPixel(pose, viewport(), middle) * length(foot) /
           length(middle);
}

// The ground that a drag or a zoom holds; beside the body, the nearest point of its edge.
HeldPoint GlobeView::heldAtPosition(QPointF position) const
{
    const Ellipsoid& ellipsoid = scene_.ellipsoid();
    const PixelPoint pixel = pixelAt(position);
    const Ray ray = pickRay(poseOf(motion_.camera(), ellipsoid), viewport(), pixel);
    const auto ground = scene_.cast(ray, style_.exaggeration);
    return {.point = ground ? ray.at(ground->hit.distance_m)
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

void GlobeView::report()
{
    const auto ground = reading();
    Q_EMIT readingChanged(ground);
    is_over_terrain_ = pointer_ && ground;
    showCursor();
    if (isCrosshairShown() != std::exchange(was_crosshair_shown_, isCrosshairShown())) {
        Q_EMIT crosshairChanged(isCrosshairShown());
    }
    // A ray takes what is loaded; where it is coarser, the samples themselves are requested.
    if (ground && !isMoving() && drag_ == MapAction::None) {
        const Heightfield& heightfield = layers_[ground->index].map->heightfield();
        if (!heightfield.isExact(ground->hit.grid)) {
            static_cast<void>(heightfield.height(ground->hit.grid));
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
    Q_EMIT sightChanged();
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
    if (auto lines = LinePainter::create()) {
        line_painter_ = std::move(lines).value();
    }
    if (auto solids = CursorSolids::create()) {
        cursor_solids_ = std::move(solids).value();
    }
    picture_ = std::make_unique<GovernedPicture>(*renderer_);
    picture_->setTarget(frame_target_);
    are_layers_sent_ = false;
}

void GlobeView::releaseGraphics()
{
    if (renderer_) {
        makeCurrent();
        picture_.reset();
        line_painter_.reset();
        cursor_solids_.reset();
        renderer_.reset();
        doneCurrent();
    }
}

void GlobeView::sendLayers()
{
    if (std::exchange(are_layers_sent_, true)) {
        return;
    }
    std::vector<TerrainLayer> sent;
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        const ShownLayer& shown = layers_[i];
        TerrainLayer layer =
            terrainLayer(shown.map, shown.map->georeference().sceneFrame(), *shown.ramp);
        layer.tint_range = colorRangeOf(shown);
        layer.slope_range = slopeRangeOf(shown);
        layer.body = scene_.maps()[i].grid();
        sent.push_back(std::move(layer));
    }
    renderer_->setLayers(sent);
}

Result<bool> GlobeView::drawPart(const BodyCamera& camera,
                                 const DrawStyle& style,
                                 const QRect& part,
                                 PictureLines lines,
                                 QImage& picture)
{
    if (!renderer_) {
        return Error{ErrorCode::Unsupported,
                     "cannot draw a picture: no graphics context; install the graphics driver"};
    }
    if (scene_.isEmpty()) {
        return Error{ErrorCode::Unsupported,
                     "cannot draw a picture: the globe is not shown any more; show it again"};
    }
    makeCurrent();
    sendLayers();
    DrawRequest request;
    request.body_pose = poseOf(camera, scene_.ellipsoid());
    Result<bool> drawn = marsview::drawPart(
        {.terrain = *renderer_,
         .line_renderer =
             lines == PictureLines::Drawn && line_painter_ ? &line_painter_->lines() : nullptr,
         .lines = lines_,
         .view_height = static_cast<double>(height()),
         .has_antialiasing = has_antialiasing_},
        std::move(request), style, part, picture);
    doneCurrent();
    return drawn;
}

int GlobeView::pictureSideMax()
{
    if (!renderer_) {
        return 0;
    }
    makeCurrent();
    const int side_max = offscreenSideMax();
    doneCurrent();
    return side_max;
}

void GlobeView::paintGL()
{
    if (!renderer_) {
        return;
    }
    if (is_current_) {
        paintOver(TerrainPicture::Same);
        return;
    }
    sendLayers();
    const PictureStage last = has_antialiasing_ ? PictureStage::Smooth : PictureStage::Sharp;
    PictureRequest request{
        .camera = {}, .viewport = viewport(), .stage = stage_, .last_stage = last, .is_kept = true};
    if (!scene_.isEmpty()) {
        request.body_pose = poseOf(motion_.camera(), scene_.ellipsoid());
    }
    const DrawReport report = picture_->paint(request, style_, defaultFramebufferObject());
    is_current_ = true;
    paintOver(TerrainPicture::New);
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

// Around the place below the stylus, on the terrain.
std::vector<ScenePoint> GlobeView::shadowAt(const StylusPose& pose, double radius_m) const
{
    const Ellipsoid& ellipsoid = scene_.ellipsoid();
    const LocalAxes local = localAxes(ellipsoid, placeOf(pose.proxy, ellipsoid).foot);
    std::vector<ScenePoint> shadow;
    for (int i = 0; i < kShadowSides; ++i) {
        const double around = 2.0 * std::numbers::pi * i / kShadowSides;
        const BodyPlace place = placeOf(pose.proxy + local.east * (radius_m * std::cos(around)) +
                                            local.north * (radius_m * std::sin(around)),
                                        ellipsoid);
        const double height_m = scene_.height(place.foot) * style_.exaggeration;
        if (std::isfinite(height_m)) {
            shadow.push_back(targetOf({.target = place.foot, .height_m = height_m}, ellipsoid));
        }
    }
    return shadow;
}

void GlobeView::setLines(std::vector<DrapedLine> lines, LineSet set)
{
    if (lines_.set(std::move(lines), set)) {
        update(); // over the picture that was kept
    }
}

void GlobeView::setDots(DotSet dots, LineSet set)
{
    if (lines_.setDots(std::move(dots), set)) {
        update();
    }
}

void GlobeView::paintOver(TerrainPicture terrain)
{
    if (!scene_.isEmpty()) {
        paintLines(terrain);
        paintCursor();
    } else if (terrain == TerrainPicture::Same) {
        renderer_->present(defaultFramebufferObject());
    }
}

void GlobeView::paintLines(TerrainPicture terrain)
{
    const CameraPose pose = poseOf(motion_.camera(), scene_.ellipsoid());
    if (line_painter_) {
        line_painter_->paint(lines_, *renderer_, terrain,
                             {.camera = pose,
                              .viewport = viewport(),
                              .clip = renderer_->clip(pose, style_.exaggeration),
                              .pixels_per_point = devicePixelRatioF()},
                             defaultFramebufferObject());
    } else if (terrain == TerrainPicture::Same) {
        renderer_->present(defaultFramebufferObject());
    }
}

void GlobeView::paintCursor()
{
    const auto& stylus = shownStylus();
    if (!stylus || !cursor_solids_) {
        return;
    }
    const Ellipsoid& ellipsoid = scene_.ellipsoid();
    const CameraPose pose = poseOf(motion_.camera(), ellipsoid);
    const Viewport size = viewport();
    CursorPicture cursor{.shape = shapeOf(*stylus),
                         .position = stylus->proxy,
                         .goal = std::nullopt,
                         .shadow = {},
                         .pixels_per_point = devicePixelRatioF()};
    if (stylus->is_in_contact) {
        cursor.goal = stylus->goal;
    } else {
        cursor.shadow = shadowAt(*stylus, kShadowPoints * devicePixelRatioF() *
                                              metersPerPixel(pose, size, stylus->proxy));
    }
    const LocalAxes local = localAxes(ellipsoid, placeOf(stylus->proxy, ellipsoid).foot);
    renderer_->presentDepth(defaultFramebufferObject(), areaOfCursor(cursor, pose, size));
    cursor_solids_->draw(cursor, {.right = local.east, .ahead = local.north, .up = local.up}, pose,
                         size, renderer_->clip(pose, style_.exaggeration));
}

} // namespace marsview
