#include "ui/globe/globe_view.h"

#include "core/globe/horizon.h"
#include "core/session/range_in_picture.h"
#include "ui/canvas/view_projection.h"

#include <QLabel>
#include <QOpenGLContext>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

using std::chrono::milliseconds;

// The interval at which samples that were requested are looked for.
constexpr milliseconds kSampleInterval{40};

// Of a layer, along each side, when it is looked whether some of it is in the picture.
constexpr std::size_t kProbedParts = 4;

QLabel* textOver(QWidget& view)
{
    auto* label = new QLabel(&view);
    label->setAlignment(Qt::AlignCenter);
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
    , camera_(ground_, [this] { return viewport(); })
    , canvas_(*this, *this)
    , wait_(textOver(*this))
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
    layout->addWidget(wait_);
    sample_timer_.setSingleShot(true);
    lead_timer_.setSingleShot(true);
    connectParts();
}

void GlobeView::connectParts()
{
    connect(&layers_, &GlobeLayers::lookChanged, this, [this] {
        canvas_.updateLayers();
        Q_EMIT sceneChanged();
    });
    connect(&layers_, &GlobeLayers::shownChanged, this, &GlobeView::showLayers);
    connect(&layers_, &GlobeLayers::placingStarted, this, [this] {
        if (ground_.isEmpty()) {
            wait_->setText(tr("Placing the layer on its body…"));
            wait_->show();
        }
    });
    connect(&layers_, &GlobeLayers::blendingStarted, this, [this] {
        wait_->setText(tr("Blending the edges of layers…"));
        wait_->show();
    });
    connect(&layers_, &GlobeLayers::blendingFailed, this, &GlobeView::blendingFailed);
    connect(&layers_, &GlobeLayers::placingFinished, this, &GlobeView::finishPlacing);
    connect(&camera_, &GlobeCamera::cameraChanged, this, [this] {
        canvas_.redraw();
        followTouch();
        report();
        Q_EMIT sightChanged();
    });
    connect(&touch_, &GlobeTouch::moved, this, [this] {
        showCursor();
        update(); // over the picture that was kept
        Q_EMIT stylusMoved();
    });
    connect(&touch_, &GlobeTouch::aimOutdated, this, &GlobeView::followTouch);
    connect(&grab_key_, &GrabKey::released, this, &GlobeView::releaseGrab);
    connect(&sample_timer_, &QTimer::timeout, this, &GlobeView::report);
    connect(&lead_timer_, &QTimer::timeout, this, &GlobeView::report);
    connect(&meshes_, &GlobeMeshes::failed, this, &GlobeView::touchFailed);
    connect(&meshes_, &GlobeMeshes::preparingChanged, this, [this](bool is_preparing) {
        if (!ground_.isEmpty()) {
            wait_->setText(tr("Preparing the terrain for touch…"));
            wait_->setVisible(is_preparing);
        }
    });
    connect(&canvas_, &TerrainCanvas::completed, this, &GlobeView::pictureCompleted);
    connect(&canvas_, &TerrainCanvas::detailChanged, this, &GlobeView::detailChanged);
    connect(&canvas_, &TerrainCanvas::loadingChanged, this, &GlobeView::loadingChanged);
    connect(&canvas_, &TerrainCanvas::problemChanged, this, &GlobeView::problemChanged);
}

GlobeView::~GlobeView()
{
    if (context() != nullptr) {
        disconnect(context(), nullptr, this, nullptr);
    }
    releaseGraphics();
}

void GlobeView::setLayers(const std::vector<ShownLayer>& top_first)
{
    layers_.set(top_first);
}

void GlobeView::showLayers(bool is_other_body)
{
    std::optional<BodyCamera> kept;
    if (is_other_body) {
        camera_.stop();
    } else if (!ground_.isEmpty()) {
        kept = camera_.goal();
    }
    ground_.scene = layers_.scene();
    meshes_.setScene(ground_.scene, exaggeration());
    canvas_.updateLayers();
    if (!ground_.isEmpty()) {
        wait_->hide();
        if (const auto camera = first_camera_ ? std::exchange(first_camera_, std::nullopt) : kept) {
            camera_.jumpTo(*camera);
        } else {
            camera_.jumpHome();
        }
        flyToAwaited();
    } else if (kept) {
        first_camera_ = kept; // layers that are placed on another ellipsoid
    }
    report();
    Q_EMIT sceneChanged();
    Q_EMIT placed();
}

// After all that can be placed are.
void GlobeView::finishPlacing()
{
    Q_EMIT unplacedChanged();
    wait_->setText(tr("Preparing the terrain for touch…"));
    wait_->setVisible(meshes_.isPreparing());
    if (ground_.isEmpty()) {
        if (const auto unplaced = layers_.unplaced(); !unplaced.empty()) {
            Q_EMIT failed(unplaced.front().problem);
        }
    }
}

void GlobeView::setExaggeration(double exaggeration)
{
    const double before = std::exchange(ground_.style.exaggeration, exaggeration);
    meshes_.setScene(ground_.scene, exaggeration);
    if (!ground_.isEmpty() && before != exaggeration) {
        camera_.followTerrain(exaggeration / before);
    }
    Q_EMIT sceneChanged();
}

void GlobeView::setLook(const TerrainLook& look)
{
    ground_.style.look = look;
    canvas_.redraw();
    Q_EMIT sceneChanged();
}

void GlobeView::setCamera(const BodyCamera& camera)
{
    if (!ground_.isEmpty()) {
        camera_.jumpTo(camera);
    } else {
        first_camera_ = camera;
    }
}

void GlobeView::setHomeCamera()
{
    first_camera_.reset();
    if (!ground_.isEmpty()) {
        camera_.jumpHome();
    }
}

Viewport GlobeView::viewport() const
{
    return viewportOf(*this);
}

bool GlobeView::flyToLayer(const std::shared_ptr<const Map>& map)
{
    is_awaited_only_unseen_ = false;
    return flyWhenPlaced(map);
}

bool GlobeView::revealLayer(const std::shared_ptr<const Map>& map)
{
    is_awaited_only_unseen_ = true;
    return flyWhenPlaced(map);
}

bool GlobeView::flyWhenPlaced(const std::shared_ptr<const Map>& map)
{
    awaited_.reset();
    if (!layers_.isWanted(map)) {
        return false;
    }
    awaited_ = map;
    flyToAwaited();
    return true;
}

void GlobeView::flyToAwaited()
{
    const auto map = awaited_.lock();
    const std::vector<BodyTerrain>& maps = ground_.scene.maps();
    const auto placed = std::find_if(
        maps.begin(), maps.end(), [&](const BodyTerrain& terrain) { return terrain.map() == map; });
    if (map && placed != maps.end()) {
        awaited_.reset();
        if (!is_awaited_only_unseen_ || !isAnyInPicture(*placed)) {
            camera_.flyTo(*placed);
        }
    }
}

// Of a few samples all over it.
bool GlobeView::isAnyInPicture(const BodyTerrain& terrain) const
{
    const BodyGrid& grid = *terrain.grid();
    for (std::size_t i = 0; i <= kProbedParts; ++i) {
        for (std::size_t k = 0; k <= kProbedParts; ++k) {
            const std::size_t column = k * (grid.columns() - 1) / kProbedParts;
            const std::size_t row = i * (grid.rows() - 1) / kProbedParts;
            if (isInPicture(grid.at(column, row, 0.0))) {
                return true;
            }
        }
    }
    return false;
}

void GlobeView::flyTo(const BodyCamera& camera)
{
    if (!ground_.isEmpty()) {
        camera_.flyTo(camera);
    } else {
        setCamera(camera);
    }
}

PixelPoint GlobeView::pixelAt(QPointF position) const
{
    const QPointF pixel = position * devicePixelRatioF();
    return {pixel.x(), pixel.y()};
}

std::optional<BodyScenePoint> GlobeView::groundAt(QPointF position) const
{
    return ground_.isEmpty() ? std::nullopt : ground_.cast(camera_.rayThrough(pixelAt(position)));
}

std::optional<BodyHit> GlobeView::hitAt(QPointF position) const
{
    const auto ground = groundAt(position);
    return ground ? std::optional(ground->hit) : std::nullopt;
}

std::optional<BodyScenePoint> GlobeView::placeAt(QPointF position) const
{
    if (ground_.isEmpty()) {
        return std::nullopt;
    }
    const Ray ray = camera_.rayThrough(pixelAt(position));
    const auto ground = ground_.cast(ray);
    return ground ? ground : ground_.voidOn(ray);
}

std::optional<BodyScenePoint> GlobeView::groundBelow(const ScenePoint& place) const
{
    return ground_.isEmpty() ? std::nullopt : ground_.below(place, camera_.pose().eye);
}

std::optional<HeightRange> GlobeView::rangeInPicture(const std::shared_ptr<const Map>& map) const
{
    if (ground_.isEmpty()) {
        return std::nullopt;
    }
    const auto ranges = rangesInPicture(ground_.scene, camera_.pose(), viewport(), exaggeration());
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        if (ground_.scene.maps()[i].map() == map) {
            return ranges[i];
        }
    }
    return std::nullopt;
}

bool GlobeView::isInPicture(const ScenePoint& place) const
{
    if (ground_.isEmpty()) {
        return false;
    }
    const CameraPose pose = camera_.pose();
    const Viewport size = viewport();
    const auto pixel = project(pose, size, place);
    return pixel && pixel->x >= 0.0 && pixel->y >= 0.0 && pixel->x <= size.width &&
           pixel->y <= size.height &&
           !Horizon(ground_.ellipsoid(), ground_.scene.range().minimum_m * exaggeration())
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
    return position ? placeAt(*position) : std::nullopt;
}

bool GlobeView::isCrosshairShown() const
{
    return !ground_.isEmpty() && !pointer_ && hasFocus() && !isStylusRead();
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
    if (ground_.isEmpty()) {
        return 0.0;
    }
    const CameraPose pose = camera_.pose();
    return devicePixelRatioF() * hit.distance_m / pose.distance_m *
           metersPerPixel(pose, viewport());
}

double GlobeView::metersPerPointInMiddle() const
{
    if (ground_.isEmpty()) {
        return 0.0;
    }
    const Ellipsoid& ellipsoid = ground_.ellipsoid();
    const CameraPose pose = poseOf(camera_.camera(), ellipsoid);
    const auto ground = ground_.scene.cast({pose.eye, pose.axes.forward}, exaggeration());
    const ScenePoint middle = ground ? pose.eye + pose.axes.forward * ground->hit.distance_m
                                     : targetOf(camera_.camera(), ellipsoid);
    // Raised terrain is drawn wider than it is.
    const ScenePoint foot = targetOf({.target = placeOf(middle, ellipsoid).foot}, ellipsoid);
    return devicePixelRatioF() * metersPerPixel(pose, viewport(), middle) * length(foot) /
           length(middle);
}

void GlobeView::report()
{
    const auto ground = reading();
    Q_EMIT readingChanged(ground);
    is_over_terrain_ = pointer_ && ground && std::isfinite(ground->hit.height_m);
    showCursor();
    if (isCrosshairShown() != std::exchange(was_crosshair_shown_, isCrosshairShown())) {
        Q_EMIT crosshairChanged(isCrosshairShown());
    }
    // A ray takes what is loaded; where it is coarser, the samples themselves are requested.
    if (ground && !isMoving() && drag_ == MapAction::None) {
        const BodyTerrain& read = ground_.scene.maps()[ground->index];
        if (!read.isExact(ground->hit.grid)) {
            static_cast<void>(
                read.elevationOnGrid(ground->hit.grid, BodyTerrain::Tiles::Requested));
            if (read.map()->heightfield().tiles()->isLoading()) {
                sample_timer_.start(kSampleInterval);
            }
        }
    }
}

void GlobeView::resizeEvent(QResizeEvent* event)
{
    canvas_.redraw(); // before the base class, which paints
    QOpenGLWidget::resizeEvent(event);
    Q_EMIT sightChanged();
}

void GlobeView::initializeGL()
{
    connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &GlobeView::releaseGraphics);
    if (const auto error = canvas_.initialize()) {
        // Later: who hears of it may open dialogs, which is not for the middle of painting.
        QMetaObject::invokeMethod(
            this,
            [this, reason = QString::fromStdString(error->message)] { Q_EMIT failed(reason); },
            Qt::QueuedConnection);
    }
}

void GlobeView::paintGL()
{
    canvas_.paint();
}

std::vector<TerrainLayer> GlobeView::terrainLayers() const
{
    std::vector<TerrainLayer> drawn;
    for (std::size_t i = 0; i < layers().size(); ++i) {
        // Colors are spread over the elevations of the data, whatever is blended.
        const BodyTerrain& terrain = ground_.scene.maps()[i];
        ShownLayer layer = layers()[i];
        layer.color_range = layer.color_range.value_or(layer.map->tintRange());
        layer.slope_range = slopeRangeOf(layer);
        layer.map = terrain.shown();
        drawn.push_back(terrainLayer(layer, layer.map->georeference().sceneFrame()));
        drawn.back().body = terrain.grid();
    }
    return drawn;
}

CanvasCamera GlobeView::canvasCamera() const
{
    return ground_.isEmpty() ? CanvasCamera{} : CanvasCamera{.body_pose = camera_.pose()};
}

bool GlobeView::isTouching() const noexcept
{
    return touch_.isPressing() || (device_ && device_->is_in_contact);
}

std::optional<CursorPicture> GlobeView::canvasCursor() const
{
    const auto& stylus = shownStylus();
    if (!stylus) {
        return std::nullopt;
    }
    const Ellipsoid& ellipsoid = ground_.ellipsoid();
    const LocalAxes local = localAxes(ellipsoid, placeOf(stylus->proxy, ellipsoid).foot);
    return stylusCursor(*stylus, {.right = local.east, .ahead = local.north, .up = local.up});
}

std::optional<ScenePoint>
GlobeView::groundUnderCursor(const CursorPicture& cursor, double right_m, double ahead_m) const
{
    const ScenePoint place =
        cursor.position + cursor.axes.right * right_m + cursor.axes.ahead * ahead_m;
    const GeographicPoint foot = placeOf(place, ground_.ellipsoid()).foot;
    const double height_m = ground_.height(foot);
    return std::isfinite(height_m) ? std::optional(targetOf({.target = foot, .height_m = height_m},
                                                            ground_.ellipsoid()))
                                   : std::nullopt;
}

Result<bool> GlobeView::drawPart(const BodyCamera& camera,
                                 const DrawStyle& style,
                                 const QRect& part,
                                 const PartOptions& options,
                                 QImage& picture)
{
    if (ground_.isEmpty()) {
        return Error{ErrorCode::Unsupported,
                     "cannot draw a picture: the globe is not shown any more; show it again"};
    }
    return canvas_.drawPart({.body_pose = poseOf(camera, ground_.ellipsoid())}, style, part,
                            options, picture);
}

} // namespace marsview
