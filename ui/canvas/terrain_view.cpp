#include "ui/canvas/terrain_view.h"

#include "core/view/exaggeration.h"
#include "ui/canvas/map_cursor.h"
#include "ui/widgets/elided_label.h"

#include <QChildEvent>
#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QOpenGLContext>
#include <QVBoxLayout>
#include <QWheelEvent>

#include <cmath>
#include <utility>

namespace marsview {

TerrainView::TerrainView(QWidget* parent)
    : QOpenGLWidget(parent)
    , camera_(scene_, [this] { return viewport(); })
    , projection_(*this, scene_, camera_)
    , touch_(scene_, projection_)
    , reader_({.view = *this,
               .scene = scene_,
               .camera = camera_,
               .projection = projection_,
               .touch = touch_})
    , mouse_({.view = *this,
              .scene = scene_,
              .camera = camera_,
              .projection = projection_,
              .touch = touch_,
              .reader = reader_})
    , canvas_(*this, *this)
    , empty_hint_(new ElidedLabel({}, this)) // names of files may be long
{
    setAccessibleName(tr("Map"));
    setAccessibleDescription(
        tr("The terrain in perspective; the status bar shows the position and elevation under the "
           "pointer or the stylus, or at the crosshair in the middle while the keyboard is used"));
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setMinimumSize(160, 120);
    setHint({});
    empty_hint_->setObjectName(QStringLiteral("emptyHint"));
    empty_hint_->setAlignment(Qt::AlignCenter);
    empty_hint_->setFocusPolicy(Qt::NoFocus);
    empty_hint_->setAttribute(Qt::WA_TransparentForMouseEvents);
    // Over the sky, which is dark in every palette.
    QPalette palette = empty_hint_->palette();
    palette.setColor(QPalette::WindowText, QColor(200, 205, 214));
    empty_hint_->setPalette(palette);
    QFont font = empty_hint_->font();
    font.setPointSizeF(font.pointSizeF() * 1.4);
    empty_hint_->setFont(font);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(empty_hint_);
    connectParts();
}

void TerrainView::connectParts()
{
    connect(&camera_, &CameraController::cameraChanged, this, [this] {
        touch_.noteMotion();
        canvas_.redraw();
        touch_.follow();
        reader_.report();
        Q_EMIT sightChanged();
    });
    connect(&grab_key_, &GrabKey::released, this, [this] { setGrabbing(false); });
    connect(&touch_, &TouchTool::redrawNeeded, this, [this] { update(); });
    connect(&touch_, &TouchTool::moved, &mouse_, &MapMouse::showCursor);
    connect(&touch_, &TouchTool::moved, this, &TerrainView::stylusMoved);
    connect(&reader_, &PlaceReader::readingChanged, this, &TerrainView::pointerMoved);
    connect(&reader_, &PlaceReader::crosshairChanged, this, &TerrainView::crosshairChanged);
    connect(&mouse_, &MapMouse::toolChanged, this, &TerrainView::toolChanged);
    connect(&mouse_, &MapMouse::gestureMade, this, &TerrainView::gestureMade);
    connect(&mouse_, &MapMouse::menuRequested, this, &TerrainView::menuRequested);
    connect(&mouse_, &MapMouse::clicked, this, &TerrainView::clicked);
    connect(&canvas_, &TerrainCanvas::completed, this, &TerrainView::pictureCompleted);
    connect(&canvas_, &TerrainCanvas::detailChanged, this, &TerrainView::detailChanged);
    connect(&canvas_, &TerrainCanvas::loadingChanged, this, &TerrainView::loadingChanged);
    connect(&canvas_, &TerrainCanvas::problemChanged, this, [this](const QString& problem) {
        Q_EMIT problemChanged(problem);
        reader_.report(); // the tile under it may have arrived, too
    });
}

TerrainView::~TerrainView()
{
    if (context() != nullptr) {
        // The base class destroys the context after this class's members are gone.
        disconnect(context(), nullptr, this, nullptr);
    }
    releaseGraphics();
}

void TerrainView::setLayers(const std::vector<ShownLayer>& top_first,
                            std::optional<double> exaggeration)
{
    const ShownScene before = scene_;
    scene_.setLayers(top_first);
    const bool is_other_map = map() != before.map();
    if (before.map() && is_other_map) {
        sights_.remember(before.map(),
                         {.camera = camera_.goal(), .exaggeration = before.style.exaggeration});
    }
    const NextSight next = nextSight(before, scene_, camera_.goal(), sights_, exaggeration);
    scene_.style.exaggeration = next.exaggeration;
    empty_hint_->setVisible(scene_.isEmpty());
    if (isCompletionOf(before, scene_)) {
        mouse_.releaseTouch();
    }
    // Before the camera moves, which aims the stylus.
    touch_.updateGround();
    canvas_.updateLayers();
    if (next.is_opening) {
        camera_.goToOpeningView();
    } else if (next.camera && *next.camera != camera_.goal()) {
        camera_.jumpTo(*next.camera);
    }
    canvas_.redraw();
    touch_.follow();
    Q_EMIT layersChanged();
    if (!is_other_map && next.exaggeration != before.style.exaggeration) {
        Q_EMIT exaggerationChanged(next.exaggeration);
    }
    if (is_other_map) {
        QMetaObject::invokeMethod(
            this,
            [this] {
                Q_EMIT mapShown(map());
                Q_EMIT exaggerationChanged(scene_.style.exaggeration);
                reader_.report();
            },
            Qt::QueuedConnection);
    }
}

std::vector<TerrainLayer> TerrainView::terrainLayers() const
{
    std::vector<TerrainLayer> layers;
    for (std::size_t i = 0; i < scene_.layers().size(); ++i) {
        layers.push_back(terrainLayer(scene_.layers()[i], scene_.ground().maps()[i].frame));
    }
    return layers;
}

std::optional<CursorPicture> TerrainView::canvasCursor() const
{
    const auto& pose = shownStylus();
    return pose ? std::optional(stylusCursor(*pose, {})) : std::nullopt;
}

std::optional<ScenePoint>
TerrainView::groundUnderCursor(const CursorPicture& cursor, double right_m, double ahead_m) const
{
    const double x = cursor.position.x + right_m;
    const double y = cursor.position.y + ahead_m;
    const double z = scene_.groundHeight(x, y);
    return std::isfinite(z) ? std::optional(ScenePoint{x, y, z}) : std::nullopt;
}

void TerrainView::replacePreview(const std::shared_ptr<const Map>& preview,
                                 const std::shared_ptr<const Map>& map)
{
    sights_.replacePreview(preview, map);
}

void TerrainView::setHint(const QString& hint)
{
    hint_ = hint;
    empty_hint_->setText(!hint.isEmpty() ? hint
                         //: Shown in the middle of the window while no layer has a check mark
                         : is_all_hidden_
                             ? tr("All layers are hidden; check one in the list of layers")
                             //: Shown while no map is open. DEM = digital elevation model.
                             : tr("Drop a DEM here or press Ctrl+O"));
}

void TerrainView::setAllHidden(bool is_so)
{
    is_all_hidden_ = is_so;
    setHint(hint_);
}

void TerrainView::setLook(const TerrainLook& look)
{
    scene_.style.look = look;
    canvas_.redraw();
    Q_EMIT lookChanged();
}

void TerrainView::setExaggeration(double exaggeration)
{
    if (exaggeration == scene_.style.exaggeration) {
        return;
    }
    const double before = scene_.style.exaggeration;
    // A motion in progress keeps its end.
    const OrbitCamera goal = camera_.goalOnGround();
    scene_.style.exaggeration = exaggeration;
    touch_.updateGround();
    camera_.followTerrain(reexaggerated(goal, before, exaggeration));
    Q_EMIT exaggerationChanged(exaggeration);
}

void TerrainView::step(NavigationStep step)
{
    if (!scene_.isEmpty()) {
        reader_.noteStep();
        camera_.step(step);
    }
}

void TerrainView::goHome()
{
    if (!scene_.isEmpty()) {
        reader_.noteStep();
        camera_.goHome();
    }
}

void TerrainView::turnNorthUp()
{
    if (!scene_.isEmpty()) {
        reader_.noteStep();
        camera_.turnNorthUp();
    }
}

void TerrainView::goTo(GridPoint grid)
{
    if (scene_.isEmpty()) {
        return;
    }
    setFocus(Qt::OtherFocusReason);
    camera_.flyTo(grid, 0.0);
    reader_.noteTypedPlace(scene_.placeOf(grid, 0.0));
}

std::optional<RayHit> TerrainView::surfaceAt(QPointF position) const
{
    const std::optional<GroundPoint> ground = projection_.placeUnder(position);
    return ground ? std::optional(scene_.onTopmost(*ground)) : std::nullopt;
}

double TerrainView::metersPerPoint(const RayHit& hit) const
{
    return map() ? projection_.metersPerPoint(scene_.placeOf(hit.grid, hit.height_m)) : 0.0;
}

std::optional<QPointF> TerrainView::positionOf(GridPoint grid) const
{
    if (!map()) {
        return std::nullopt;
    }
    return projection_.positionOf(scene_.placeOf(grid, map()->heightfield().heightNow(grid)));
}

void TerrainView::showDevice(const std::optional<StylusPose>& pose)
{
    if (!touch_.showDevice(pose)) {
        return;
    }
    if (!pose) {
        mouse_.releaseStylus();
    } else {
        mouse_.moveStylus(pose->proxy);
    }
    if (!pose || reader_.source() == ReadingSource::Stylus) {
        reader_.report();
    }
}

void TerrainView::setGrabbing(bool is_grabbing)
{
    if (touch_.setGrabbing(is_grabbing)) {
        Q_EMIT grabbingChanged(is_grabbing);
    }
}

void TerrainView::initializeGL()
{
    connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &TerrainView::releaseGraphics);
    if (const auto error = canvas_.initialize()) {
        reportUnavailable(QString::fromStdString(error->message));
        return;
    }
    // What follows may open dialogs, which is not for the middle of painting.
    QMetaObject::invokeMethod(
        this, [this] { Q_EMIT ready(); }, Qt::QueuedConnection);
}

void TerrainView::paintGL()
{
    canvas_.paint();
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

void TerrainView::resizeEvent(QResizeEvent* event)
{
    canvas_.redraw(); // before the base class, which paints
    QOpenGLWidget::resizeEvent(event);
    camera_.resize();
    Q_EMIT sightChanged();
}

void TerrainView::mousePressEvent(QMouseEvent* event)
{
    mouse_.press(*event);
}

void TerrainView::mouseMoveEvent(QMouseEvent* event)
{
    mouse_.move(*event);
}

void TerrainView::mouseReleaseEvent(QMouseEvent* event)
{
    mouse_.release(*event);
}

void TerrainView::mouseDoubleClickEvent(QMouseEvent* event)
{
    mouse_.doubleClick(*event);
}

void TerrainView::wheelEvent(QWheelEvent* event)
{
    mouse_.wheel(*event);
}

// The mouse asks when its button is released; this is for the keyboard.
void TerrainView::contextMenuEvent(QContextMenuEvent* event)
{
    event->accept();
    if (event->reason() != QContextMenuEvent::Mouse && !scene_.isEmpty()) {
        Q_EMIT menuRequested(projection_.center());
    }
}

void TerrainView::keyPressEvent(QKeyEvent* event)
{
    if (event->key() == Qt::Key_Space && event->modifiers() == Qt::NoModifier) {
        if (!event->isAutoRepeat()) {
            grab_key_.hold();
            setGrabbing(true);
        }
        return;
    }
    if (event->key() == Qt::Key_F10 && event->modifiers() == Qt::ShiftModifier) {
        if (!scene_.isEmpty()) { // the other key of the context menu, which Qt leaves out on X11
            Q_EMIT menuRequested(projection_.center());
        }
        return;
    }
    if (!mouse_.key(*event)) {
        QOpenGLWidget::keyPressEvent(event);
    }
}

void TerrainView::focusInEvent(QFocusEvent* event)
{
    QOpenGLWidget::focusInEvent(event);
    reader_.report();
}

void TerrainView::focusOutEvent(QFocusEvent* event)
{
    QOpenGLWidget::focusOutEvent(event);
    reader_.report();
}

void TerrainView::leaveEvent(QEvent* event)
{
    QOpenGLWidget::leaveEvent(event);
    reader_.forgetPointer();
}

void TerrainView::childEvent(QChildEvent* event)
{
    QOpenGLWidget::childEvent(event);
    if (event->added() && event->child()->isWidgetType()) {
        event->child()->installEventFilter(this);
    }
}

// The view is not left where the pointer goes onto one of its overlays.
bool TerrainView::eventFilter(QObject* watched, QEvent* event)
{
    if (event->type() == QEvent::Enter &&
        !static_cast<QWidget*>(watched)->testAttribute(Qt::WA_TransparentForMouseEvents)) {
        mouse_.enterOverlay();
    }
    return QOpenGLWidget::eventFilter(watched, event);
}

} // namespace marsview
