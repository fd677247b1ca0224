#include "ui/overlay/map_overlays.h"

#include "core/session/range_in_picture.h"
#include "core/view/edge_mark.h"
#include "core/view/scale_bar.h"
#include "ui/canvas/terrain_view.h"
#include "ui/overlay/compass.h"
#include "ui/overlay/contour_labels_view.h"
#include "ui/overlay/crosshair.h"
#include "ui/overlay/explained_part.h"
#include "ui/overlay/force_meter.h"
#include "ui/overlay/gesture_hint.h"
#include "ui/overlay/hand_pointer.h"
#include "ui/overlay/legend.h"
#include "ui/overlay/legend_content.h"
#include "ui/overlay/map_labels.h"
#include "ui/overlay/minimap.h"
#include "ui/overlay/overlay_layout.h"
#include "ui/overlay/overview_picture.h"
#include "ui/overlay/place_mark.h"
#include "ui/overlay/scale_bar_view.h"
#include "ui/widgets/focus_frame.h"

#include <QAction>
#include <QApplication>
#include <QImage>
#include <QMouseEvent>
#include <QPainter>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

// Which layers the picture shows is looked for when it has been still for so long, with few rays.
constexpr std::chrono::milliseconds kProbeAfter{150};
constexpr PictureProbes kProbes{.columns = 24, .rows = 16};

ContourView contoursOf(TerrainView& view)
{
    const auto labels = [&view](const ContourLabelOptions& options, double height_px,
                                const ContourView::Widths& width_of) {
        return view.map() ? contourLabels(view.ground(), view.camera(), view.look(), options,
                                          height_px, width_of)
                          : std::vector<ContourLabel>{};
    };
    return {.labels = labels,
            .follow =
                [&view](const ContourLabel& label) {
                    return labelIn(label, view.camera(), view.viewport());
                },
            .viewport = [&view] { return view.viewport(); },
            .exaggeration = [&view] { return view.exaggeration(); }};
}

} // namespace

MapOverlays::MapOverlays(TerrainView& view)
    : QObject(&view)
    , view_(view)
    , contour_labels_(new ContourLabelsView(view, contoursOf(view)))
    , labels_(new MapLabels(view))
    , minimap_(new Minimap(&view))
    , compass_(new Compass(&view))
    , crosshair_(new Crosshair(&view))
    , place_mark_(new PlaceMark(&view))
    , scale_bar_(new ScaleBarView(&view))
    , legend_(new Legend(&view))
    , force_meter_(new ForceMeter(&view))
    , hand_pointer_(new HandPointer(&view))
    , hint_(new GestureHint(&view))
    , focus_frame_(new FocusFrame(&view))
    , layout_(new OverlayLayout(&view,
                                {.minimap = minimap_,
                                 .legend = legend_,
                                 .compass = compass_,
                                 .scale_bar = scale_bar_,
                                 .force_meter = force_meter_,
                                 .hint = hint_}))
{
    makeAction(tr("&Overview Map"), QStringLiteral("minimap"), {minimap_});
    makeAction(tr("&Legend"), QStringLiteral("legend"), {legend_});
    makeAction(tr("&Compass and Scale Bar"), QStringLiteral("compass"), {compass_, scale_bar_});
    for (QWidget* part : std::initializer_list<QWidget*>{minimap_, compass_, scale_bar_, legend_}) {
        part->setCursor(Qt::ArrowCursor); // not the tool's
    }
    connect(&view_, &TerrainView::layersChanged, this, &MapOverlays::showMap);
    connect(&view_, &TerrainView::lookChanged, this, &MapOverlays::showMap);
    connect(&view_, &TerrainView::exaggerationChanged, this, &MapOverlays::showMap);
    connect(&view_, &TerrainView::sightChanged, this, &MapOverlays::showSight);
    connect(&view_, &TerrainView::stylusMoved, this, &MapOverlays::showTouch);
    probe_timer_.setSingleShot(true);
    probe_timer_.setInterval(kProbeAfter);
    connect(&probe_timer_, &QTimer::timeout, this, &MapOverlays::findSeenLayers);
    view_.installEventFilter(this); // the legend is transparent to the mouse
    connect(&view_, &TerrainView::crosshairChanged, crosshair_, &QWidget::setVisible);
    connect(&view_, &TerrainView::sightChanged, this, &MapOverlays::placeCrosshair);
    connect(&view_, &TerrainView::sightChanged, this, &MapOverlays::showMark);
    place_mark_->lower();
    crosshair_->lower();
    labels_->lower();
    contour_labels_->lower();
    connect(&view_, &TerrainView::pictureCompleted, contour_labels_, &ContourLabelsView::find);
    connect(&view_, &TerrainView::sightChanged, contour_labels_, &ContourLabelsView::follow);
    connect(&view_, &TerrainView::layersChanged, contour_labels_, &ContourLabelsView::clear);
    connect(&view_, &TerrainView::lookChanged, contour_labels_, &ContourLabelsView::clear);
    connect(&view_, &TerrainView::exaggerationChanged, contour_labels_, &ContourLabelsView::clear);
    contour_labels_->setObstacles([this] {
        std::vector<QRectF> boxes;
        for (const QWidget* plate : plates()) {
            if (plate->isVisible()) {
                boxes.emplace_back(plate->geometry());
            }
        }
        for (const MapLabels::Label& label : labels_->nameLabels()) {
            boxes.push_back(label.box);
        }
        for (const MapLabels::Label& label : labels_->graticuleLabels()) {
            boxes.push_back(label.box);
        }
        return boxes;
    });
    QList<QWidget*> obstacles = plates();
    obstacles.append(place_mark_); // a pin does not cover the name that it marks
    labels_->setObstacles({obstacles.begin(), obstacles.end()});
    const auto add = [this](const QString& text, const QString& name, bool is_on, auto show) {
        auto* action = new QAction(text, this);
        action->setObjectName(name);
        action->setCheckable(true);
        action->setChecked(is_on);
        connect(action, &QAction::toggled, labels_, show);
        terrain_actions_.append(action);
    };
    add(tr("N&ames"), QStringLiteral("names"), true, &MapLabels::setNamesShown);
    add(tr("Grat&icule"), QStringLiteral("graticule"), false, &MapLabels::setGraticuleShown);
    for (QWidget* plate : std::initializer_list<QWidget*>{legend_, scale_bar_}) {
        plate->setProperty(kHidesTerrain, true);
    }
    placeCrosshair();
    connect(minimap_, &Minimap::placeRequested, &view_, &TerrainView::lookAt);
    connect(&view_, &TerrainView::gestureMade, hint_, &GestureHint::markDone);
    connect(hint_, &GestureHint::dismissed, this, &MapOverlays::dismissHint);
    connect(&view_, &TerrainView::toolChanged, this, &MapOverlays::showMap);
    layout_->setWanted(hint_, false);
    connect(compass_, &Compass::northRequested, &view_, &TerrainView::turnNorthUp);
    showMap();
}

QList<QWidget*> MapOverlays::plates() const
{
    return {minimap_, compass_, scale_bar_, legend_, hint_, force_meter_};
}

void MapOverlays::offerHint()
{
    is_hint_offered_ = true;
    showMap();
    Q_EMIT settingsChanged();
}

void MapOverlays::dismissHint()
{
    if (is_hint_offered_) {
        is_hint_offered_ = false;
        if (hint_->isAncestorOf(QApplication::focusWidget())) {
            view_.setFocus();
        }
        layout_->setWanted(hint_, false);
        Q_EMIT settingsChanged();
        Q_EMIT hintDismissed();
    }
}

void MapOverlays::makeAction(const QString& text, const QString& name, const QList<QWidget*>& parts)
{
    auto* action = new QAction(text, this);
    action->setObjectName(name);
    action->setCheckable(true);
    action->setChecked(true);
    connect(action, &QAction::toggled, this, [this, parts](bool is_wanted) {
        for (QWidget* part : parts) {
            layout_->setWanted(part, is_wanted);
        }
    });
    actions_.append(action);
}

void MapOverlays::setCovered(int height)
{
    covered_height_ = height;
    layout_->setCovered(height);
    showHand();
    Q_EMIT settingsChanged();
}

void MapOverlays::markPlace(const std::optional<GridPoint>& grid,
                            const std::optional<GeographicPoint>& place)
{
    marked_ = MarkedPlace{.map = view_.map(), .grid = grid, .place = place};
    showMark();
    Q_EMIT markChanged();
}

void MapOverlays::clearMark()
{
    marked_.reset();
    showMark();
    Q_EMIT markChanged();
}

std::optional<GeographicPoint> MapOverlays::markedPlace() const
{
    const auto map = marked_ ? marked_->map.lock() : nullptr;
    if (map && marked_->place) {
        return marked_->place;
    }
    return map && marked_->grid && map->georeference().body() != nullptr
               ? map->georeference().toGeographic(*marked_->grid)
               : std::nullopt;
}

void MapOverlays::showMark()
{
    if (marked_ && marked_->map.lock() != view_.map()) {
        marked_.reset();
    }
    const auto place = marked_ && marked_->grid ? view_.positionOf(*marked_->grid) : std::nullopt;
    if (place && view_.rect().contains(place->toPoint())) {
        place_mark_->pointAt(*place);
    } else {
        place_mark_->hide();
    }
}

// A drag looks around the place, a click has done with it.
void MapOverlays::clearMarkOnClick(const QMouseEvent& event)
{
    if (event.button() != Qt::LeftButton || !marked_) {
        return;
    }
    if (event.type() == QEvent::MouseButtonPress) {
        pressed_at_ = event.pos();
    } else if ((event.pos() - pressed_at_).manhattanLength() < QApplication::startDragDistance()) {
        clearMark();
    }
}

// It names what a drag does with the tools that move and touch.
bool MapOverlays::isHintWanted() const
{
    return is_hint_offered_ && view_.tool() != Tool::Measure && view_.tool() != Tool::Annotate;
}

void MapOverlays::showMap()
{
    showMark();
    layout_->setWanted(compass_, bool(view_.map()) && actions_.back()->isChecked());
    layout_->setWanted(hint_, bool(view_.map()) && isHintWanted());
    if (!view_.map()) {
        minimap_->clear();
        scale_bar_->clear();
        legend_->setContent({});
        return;
    }
    const OverviewPicture overview =
        overviewPicture(view_.shownLayers(), view_.ground(), view_.look(), view_.exaggeration());
    minimap_->setMap(overview.image, overview.frame, overview.columns, overview.rows);
    seen_.clear();
    showSight();
}

void MapOverlays::showSight()
{
    showHand();
    if (!view_.map()) {
        return;
    }
    minimap_->setCamera(view_.camera(), view_.viewport());
    compass_->setCamera(view_.camera());
    scale_bar_->setCamera(view_.camera(), view_.viewport());
    if (view_.shownLayers().size() > 1) {
        probe_timer_.start();
    }
    showLegend();
}

void MapOverlays::setSession(const Session& session)
{
    session_ = session;
    showLegend();
    Q_EMIT settingsChanged();
}

void MapOverlays::setHeightUnit(HeightUnit unit)
{
    height_unit_ = unit;
    contour_labels_->setHeightUnit(unit);
    showLegend();
    Q_EMIT settingsChanged();
}

bool MapOverlays::eventFilter(QObject* watched, QEvent* event)
{
    if (watched == &view_ &&
        (explainAt(*event, *legend_, legend_->summary()) || explainAt(*event, *scale_bar_, {}))) {
        return true;
    }
    if (watched == &view_ && (event->type() == QEvent::MouseButtonPress ||
                              event->type() == QEvent::MouseButtonRelease)) {
        clearMarkOnClick(static_cast<const QMouseEvent&>(*event));
    }
    return QObject::eventFilter(watched, event);
}

void MapOverlays::findSeenLayers()
{
    seen_.clear();
    for (const auto& range : rangesInPicture(view_.ground(), view_.camera(), view_.viewport(),
                                             view_.exaggeration(), kProbes)) {
        seen_.push_back(range.has_value());
    }
    showLegend();
}

// The active layer where the picture shows it, otherwise the topmost layer that it shows.
std::size_t MapOverlays::explainedLayer() const
{
    const std::vector<ShownLayer>& shown = view_.shownLayers();
    const auto is_seen = [this, &shown](std::size_t index) {
        return seen_.size() != shown.size() || seen_[index];
    };
    const Layer* active = activeLayer(session_);
    std::size_t topmost = 0;
    for (std::size_t i = shown.size(); i > 0; --i) {
        if (is_seen(i - 1)) {
            topmost = i - 1;
            if (active != nullptr && shown[i - 1].map.get() == active->map.get()) {
                return i - 1;
            }
        }
    }
    return topmost;
}

void MapOverlays::showLegend()
{
    if (!view_.map()) {
        legend_->setContent({});
        return;
    }
    const std::vector<ShownLayer>& shown = view_.shownLayers();
    const ShownLayer& layer = shown[explainedLayer()];
    const auto known =
        std::find_if(session_.layers.begin(), session_.layers.end(),
                     [&layer](const Layer& l) { return l.map.get() == layer.map.get(); });
    const bool is_named = shown.size() > 1 && known != session_.layers.end();
    legend_->setContent(legendContent(
        layer, {.look = view_.look(),
                .pixel_m = metersPerPixel(view_.camera(), view_.viewport()),
                .exaggeration = view_.exaggeration(),
                .unit = height_unit_,
                .layer = is_named ? QString::fromStdString(known->name) : QString()}));
}

void MapOverlays::showTouch()
{
    showHand();
    const auto& stylus = view_.shownStylus();
    // A replay has no force to show.
    if (!stylus || !stylus->is_in_contact || !(stylus->force_n_max > 0.0)) {
        force_meter_->release();
        return;
    }
    // As the hand has it: to the right and away along the heading of the view.
    const double azimuth = view_.camera().azimuth.radians();
    const Vec3 right{std::cos(azimuth), -std::sin(azimuth), 0.0};
    const Vec3 away{std::sin(azimuth), std::cos(azimuth), 0.0};
    const Vec3& force_n = stylus->force_n;
    force_meter_->setForce({dot(force_n, right), dot(force_n, away), force_n.z},
                           stylus->force_n_max);
}

void MapOverlays::placeCrosshair()
{
    QRect place(QPoint(), crosshair_->sizeHint());
    place.moveCenter(view_.rect().center());
    crosshair_->setGeometry(place);
}

// An arrow to the cursor, where that cannot be seen.
void MapOverlays::showHand()
{
    const auto& stylus = view_.shownStylus();
    const double scale = view_.devicePixelRatioF();
    const auto mark = stylus ? edgeMark(view_.camera(), stylus->proxy,
                                        {.viewport = view_.viewport(),
                                         .inset_px = HandPointer::kInset * scale,
                                         .covered_px = covered_height_ * scale})
                             : std::nullopt;
    if (mark) {
        hand_pointer_->pointTo(QPointF(mark->at.x, mark->at.y) / scale, {mark->right, mark->down});
    } else {
        hand_pointer_->release();
    }
    const auto pixel =
        stylus ? project(view_.camera(), view_.viewport(), stylus->proxy) : std::nullopt;
    labels_->setCursorPlace(pixel ? std::optional(QPointF(pixel->x, pixel->y) / scale)
                                  : std::nullopt);
}

} // namespace marsview
