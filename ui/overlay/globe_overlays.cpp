#include "ui/overlay/globe_overlays.h"

#include "core/globe/body_navigation.h"
#include "core/globe/body_sight.h"
#include "core/session/saved_view.h"
#include "core/view/edge_mark.h"
#include "ui/canvas/map_mouse.h"
#include "ui/globe/globe_labels.h"
#include "ui/globe/globe_view.h"
#include "ui/overlay/annotation_marks.h"
#include "ui/overlay/body_overview.h"
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
#include "ui/overlay/map_overlays.h"
#include "ui/overlay/measure_marks.h"
#include "ui/overlay/overlay_layout.h"
#include "ui/overlay/overview_picture.h"
#include "ui/overlay/place_mark.h"
#include "ui/overlay/scale_bar_view.h"
#include "ui/text/coordinate_text.h"
#include "ui/text/number_text.h"
#include "ui/widgets/focus_frame.h"

#include <QAction>
#include <QApplication>
#include <QMouseEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <tuple>
#include <utility>

namespace marsview {
namespace {

// The places at which it is asked what the picture shows, 2° apart.
constexpr std::size_t kSightColumns = 181;
constexpr std::size_t kSightRows = 91;

// Around a pole: about a pixel of the overview map apart.
constexpr std::size_t kPolarSightSide = 121;

constexpr Angle kFromAbove = Angle::degrees(10.0);
constexpr int kSeenAlpha = 40; // of 255

ScenePoint inDegrees(const GeographicPoint& place)
{
    return {std::remainder(place.longitude.degrees(), 360.0), place.latitude.degrees(), 0.0};
}

ScenePoint onPlane(const PolarPoint& point)
{
    return {point.x, point.y, 0.0};
}

ContourView contoursOf(GlobeView& globe)
{
    const auto pose = [&globe] { return poseOf(globe.camera(), globe.scene().ellipsoid()); };
    const auto labels = [&globe, pose](const ContourLabelOptions& options, double height_px,
                                       const ContourView::Widths& width_of) {
        return globe.scene().isEmpty() ? std::vector<ContourLabel>{}
                                       : contourLabels(globe.scene(), pose(), globe.look(), options,
                                                       height_px, width_of);
    };
    const auto follow = [&globe, pose](const ContourLabel& label) -> std::optional<ContourLabel> {
        if (globe.scene().isEmpty()) {
            return std::nullopt;
        }
        const bool is_behind = dot(label.from, pose().eye - label.from) < 0.0; // the horizon
        return is_behind ? std::nullopt : labelIn(label, pose(), globe.viewport());
    };
    return {.labels = labels,
            .follow = follow,
            .viewport = [&globe] { return globe.viewport(); },
            .exaggeration = [&globe] { return globe.exaggeration(); }};
}

// Bright where the picture shows the ground. Transparent where it shows the whole disc around a
// pole: brightening all of it would only flatten the relief.
QImage seenPicture(const BodySight& sight)
{
    bool is_all_seen = true;
    QImage picture(static_cast<int>(sight.columns), static_cast<int>(sight.rows),
                   QImage::Format_ARGB32);
    for (int row = 0; row < picture.height(); ++row) {
        for (int column = 0; column < picture.width(); ++column) {
            const bool is_seen = sight.margin(static_cast<std::size_t>(column),
                                              static_cast<std::size_t>(row)) > 0.0F;
            is_all_seen = is_all_seen && is_seen;
            picture.setPixel(column, row, qRgba(255, 255, 255, is_seen ? kSeenAlpha : 0));
        }
    }
    if (is_all_seen) {
        picture.fill(Qt::transparent);
    }
    return picture;
}

} // namespace

GlobeOverlays::GlobeOverlays(GlobeView& globe, MapOverlays& flat)
    : QObject(&globe)
    , globe_(globe)
    , flat_(flat)
    , contour_labels_(new ContourLabelsView(globe, contoursOf(globe)))
    , minimap_(new Minimap(&globe))
    , compass_(new Compass(&globe))
    , labels_(new GlobeLabels(globe))
    , crosshair_(new Crosshair(&globe))
    , place_mark_(new PlaceMark(&globe))
    , scale_bar_(new ScaleBarView(&globe))
    , legend_(new Legend(&globe))
    , force_meter_(new ForceMeter(&globe))
    , hand_pointer_(new HandPointer(&globe))
    , hint_(new GestureHint(&globe))
    , focus_frame_(new FocusFrame(&globe))
    , layout_(new OverlayLayout(&globe,
                                {.minimap = minimap_,
                                 .legend = legend_,
                                 .compass = compass_,
                                 .scale_bar = scale_bar_,
                                 .force_meter = force_meter_,
                                 .hint = hint_}))
    , jobs_(*this)
{
    for (QWidget* part : std::initializer_list<QWidget*>{minimap_, compass_, scale_bar_, legend_}) {
        part->setCursor(Qt::ArrowCursor); // not the tool's
    }
    for (QWidget* plate : std::initializer_list<QWidget*>{legend_, scale_bar_}) {
        plate->setProperty(kHidesTerrain, true);
    }
    for (QWidget* part : std::initializer_list<QWidget*>{minimap_, compass_, hint_}) {
        part->installEventFilter(this);
    }
    place_mark_->lower();
    crosshair_->lower();
    labels_->lower();
    contour_labels_->lower();
    // A pin does not cover the name that it marks.
    labels_->setObstacles(
        {minimap_, compass_, scale_bar_, legend_, hint_, force_meter_, place_mark_});
    labels_->setNames(flat_.labels()->names());
    labels_->setCoordinateFormat(flat_.labels()->coordinateFormat());
    connectParts();
    placeCrosshair();
    showSettings();
    showScene();
}

void GlobeOverlays::connectParts()
{
    for (QAction* action : flat_.visibilityActions() + flat_.terrainActions()) {
        connect(action, &QAction::toggled, this, &GlobeOverlays::showSettings);
    }
    connect(flat_.labels(), &MapLabels::namesChanged, labels_,
            [this] { labels_->setNames(flat_.labels()->names()); });
    connect(flat_.labels(), &MapLabels::formatChanged, labels_, [this] {
        labels_->setCoordinateFormat(flat_.labels()->coordinateFormat());
        showScene(); // values on the overview map
    });
    connect(&globe_, &GlobeView::toolChanged, this, &GlobeOverlays::showSettings);
    connect(&flat_, &MapOverlays::settingsChanged, this, &GlobeOverlays::showSettings);
    connect(&flat_, &MapOverlays::markChanged, this, &GlobeOverlays::showMark);
    connect(&globe_, &GlobeView::placed, this, &GlobeOverlays::readOverview);
    connect(&globe_, &GlobeView::sceneChanged, this, &GlobeOverlays::showScene);
    connect(&globe_, &GlobeView::sightChanged, this, &GlobeOverlays::showSight);
    connect(&globe_, &GlobeView::stylusMoved, this, &GlobeOverlays::showTouch);
    connect(&globe_, &GlobeView::crosshairChanged, crosshair_, &QWidget::setVisible);
    connect(&globe_, &GlobeView::gestureMade, hint_, &GestureHint::markDone);
    connect(&globe_, &GlobeView::pictureCompleted, contour_labels_, &ContourLabelsView::find);
    connect(&globe_, &GlobeView::sightChanged, contour_labels_, &ContourLabelsView::follow);
    connect(&globe_, &GlobeView::sceneChanged, contour_labels_, &ContourLabelsView::clear);
    contour_labels_->setObstacles([this] {
        std::vector<QRectF> boxes;
        for (const QWidget* plate : std::initializer_list<const QWidget*>{
                 minimap_, compass_, scale_bar_, legend_, hint_, force_meter_}) {
            if (plate->isVisible()) {
                boxes.emplace_back(plate->geometry());
            }
        }
        for (const GlobeLabels::Label& label : labels_->labels()) {
            boxes.push_back(label.box);
        }
        for (const GlobeLabels::Label& label : labels_->graticuleLabels()) {
            boxes.push_back(label.box);
        }
        return boxes;
    });
    connect(minimap_, &Minimap::placeRequested, this, &GlobeOverlays::lookAt);
    connect(minimap_, &Minimap::dragEnded, this, &GlobeOverlays::showSight);
    connect(compass_, &Compass::northRequested, &globe_, &GlobeView::turnNorthUp);
    connect(hint_, &GestureHint::dismissed, this, [this] {
        if (hint_->isAncestorOf(QApplication::focusWidget())) {
            globe_.setFocus();
        }
        flat_.dismissHint();
    });
    globe_.installEventFilter(this); // the legend is transparent to the mouse
}

void GlobeOverlays::addMarks(MeasureMarks& measurements,
                             AnnotationMarks& annotations,
                             const QList<QWidget*>& others)
{
    measure_marks_ = &measurements;
    annotation_marks_ = &annotations;
    annotations.setNeighbor(measurements);
    annotations.giveWayToNeighbor();
    measurements.setNeighbor(annotations);
    for (DrawnMarks* marks :
         {static_cast<DrawnMarks*>(&measurements), static_cast<DrawnMarks*>(&annotations)}) {
        marks->setObstacles(
            QList<QWidget*>{minimap_, compass_, scale_bar_, legend_, hint_, force_meter_}
            << others);
        marks->lower();
        connect(marks, &DrawnMarks::marksChanged, labels_, [this] {
            std::vector<QRectF> taken = measure_marks_->takenBoxes();
            const std::vector<QRectF> more = annotation_marks_->takenBoxes();
            taken.insert(taken.end(), more.begin(), more.end());
            labels_->setTaken(std::move(taken));
        });
    }
    labels_->lower(); // names give way
    contour_labels_->lower();
    showSettings();
}

// Measurements over annotations.
std::vector<const DrawnMarks*> GlobeOverlays::marks() const
{
    return annotation_marks_ != nullptr
               ? std::vector<const DrawnMarks*>{annotation_marks_, measure_marks_}
               : std::vector<const DrawnMarks*>{};
}

// What the flat map's overlays have been set to.
void GlobeOverlays::showSettings()
{
    const bool has_terrain = globe_.terrain() != nullptr;
    const auto is_on = [this](const char* name) {
        for (const QAction* action : flat_.visibilityActions() + flat_.terrainActions()) {
            if (action->objectName() == QLatin1String(name)) {
                return action->isChecked();
            }
        }
        return true;
    };
    layout_->setCovered(flat_.coveredHeight());
    contour_labels_->setHeightUnit(flat_.heightUnit());
    labels_->setNamesShown(is_on("names"));
    labels_->setGraticuleShown(is_on("graticule"));
    if (measure_marks_ != nullptr) {
        measure_marks_->setHeightUnit(flat_.heightUnit());
    }
    layout_->setWanted(minimap_, !overview_.isNull() && is_on("minimap"));
    layout_->setWanted(legend_, is_on("legend"));
    layout_->setWanted(compass_, has_terrain && is_on("compass"));
    layout_->setWanted(scale_bar_, is_on("compass"));
    layout_->setWanted(hint_, has_terrain && flat_.isHintWanted());
    showLegend();
}

// Heights of a whole map take a moment.
void GlobeOverlays::readOverview()
{
    if (reading_) {
        reading_->cancel();
        reading_.reset();
    }
    overviews_m_ = {};
    if (globe_.scene().isEmpty()) {
        overview_ = {};
        return;
    }
    if (localLayer()) {
        return; // made at once
    }
    readBodyOverview(wantedOverview());
}

void GlobeOverlays::readBodyOverview(BodyOverview overview)
{
    if (reading_ && being_read_ == overview) {
        return;
    }
    if (reading_) {
        reading_->cancel();
    }
    reading_ = std::make_shared<JobMonitor>();
    being_read_ = overview;
    jobs_.run([this, overview, scene = globe_.scene(),
               monitor = reading_](const std::shared_ptr<DetachedJobs::Outlet>& outlet) {
        std::vector<std::vector<float>> heights_m;
        for (const BodyTerrain& terrain : scene.maps()) {
            heights_m.push_back(overviewHeights(terrain, *monitor, overview));
        }
        outlet->post([this, overview, monitor, heights_m = std::move(heights_m)] {
            if (monitor == reading_) {
                reading_.reset();
                heightsOf(overview) = heights_m;
                showOverview();
            }
        });
    });
}

std::vector<std::vector<float>>& GlobeOverlays::heightsOf(BodyOverview overview)
{
    return overviews_m_.at(static_cast<std::size_t>(overview));
}

BodyOverview GlobeOverlays::wantedOverview() const
{
    return minimap_->isDragged() ? shown_ : overviewFor(globe_.camera().target.latitude, shown_);
}

// The widest layer in the middle of the picture, unless all of them together are seen as a ball:
// there, a map of the whole body says more.
std::optional<std::size_t> GlobeOverlays::localLayer() const
{
    const std::vector<BodyTerrain>& maps = globe_.scene().maps();
    if (maps.empty() || isBall(globe_.limits().area)) {
        return std::nullopt;
    }
    // Where several are, or none, the one that is shown stays.
    const auto rank = [&](const BodyTerrain& map) {
        const bool is_in_middle = map.gridAt(globe_.camera().target).has_value();
        return std::tuple(is_in_middle, map.map() == local_.lock(), areaOf(*map.grid()).reach);
    };
    const auto widest =
        std::max_element(maps.begin(), maps.end(), [&](const BodyTerrain& a, const BodyTerrain& b) {
            return rank(a) < rank(b);
        });
    return static_cast<std::size_t>(widest - maps.begin());
}

// As on the flat map.
void GlobeOverlays::showOverview()
{
    const auto local = localLayer();
    if (!local) {
        local_.reset();
        showBodyOverview();
        return;
    }
    const ShownLayer& layer = globe_.layers()[*local];
    const OverviewPicture overview =
        overviewPicture({layer}, SceneSurface({layer.map}), globe_.look(), globe_.exaggeration());
    local_ = layer.map;
    overview_ = overview.image;
    showSettings();
    minimap_->setMap(overview.image, overview.frame, overview.columns, overview.rows);
    showSight();
}

// All layers, on top of each other. Where heights are on their way, the overview that is shown
// stays.
void GlobeOverlays::showBodyOverview()
{
    const BodyScene& scene = globe_.scene();
    const BodyOverview wanted = wantedOverview();
    const bool is_read = heightsOf(wanted).size() == scene.maps().size();
    if (is_read || overview_.isNull()) {
        shown_ = wanted;
    }
    if (!is_read) {
        readBodyOverview(wanted);
    }
    const std::vector<std::vector<float>>& heights_m = heightsOf(shown_);
    QImage picture;
    std::vector<QPolygonF> outlines;
    for (std::size_t i = scene.maps().size(); i > 0; --i) {
        const std::vector<QPolygonF> pieces =
            outlineOf(scene.maps()[i - 1].map()->georeference(), shown_);
        outlines.insert(outlines.end(), pieces.begin(), pieces.end());
        if (heights_m.size() != scene.maps().size()) {
            continue; // on their way
        }
        const QImage layer =
            overviewOf(heights_m[i - 1], shown_, globe_.layers()[i - 1], globe_.look(),
                       globe_.exaggeration(), scene.ellipsoid().equatorial_m);
        if (picture.isNull()) {
            picture = layer.convertToFormat(QImage::Format_ARGB32_Premultiplied);
        } else if (!layer.isNull()) {
            QPainter(&picture).drawImage(0, 0, layer);
        }
    }
    const TerrainLook& look = globe_.look();
    if (!picture.isNull() && look.light_frame == LightFrame::Body) {
        darkenNight(picture, shown_, look.subsolar.value_or(GeographicPoint{}), scene.ellipsoid());
    }
    if (!picture.isNull()) { // until then that of the layers before
        overview_ = picture;
        showSettings();
    }
    const QSize size = overviewSize(shown_);
    minimap_->setMap(overview_, overviewFrame(shown_), static_cast<std::size_t>(size.width()),
                     static_cast<std::size_t>(size.height()));
    if (shown_ != BodyOverview::Whole) {
        minimap_->setDisc(discOf(shown_));
    }
    minimap_->setOutlines(std::move(outlines));
    showSight();
}

MinimapDisc GlobeOverlays::discOf(BodyOverview overview) const
{
    const PolarPlane plane(overview);
    MinimapDisc disc{//: In the corner of the overview map around a pole; may have two short lines
                     .caption = plane.isNorth() ? tr("North\nPole") : tr("South\nPole"),
                     //: For screen readers: what the overview map shows
                     .name = plane.isNorth() ? tr("North pole") : tr("South pole"),
                     .lines = {},
                     .labels = {}};
    const CoordinateFormat format = flat_.labels()->coordinateFormat();
    const Body* body = globe_.scene().maps().front().map()->info().body;
    const double side = plane.isNorth() ? 1.0 : -1.0;
    const auto at = [&](double longitude_deg, double poleward_deg) {
        const PolarPoint point = plane.at({.longitude = Angle::degrees(longitude_deg),
                                           .latitude = Angle::degrees(side * poleward_deg)});
        return QPointF(point.x, point.y);
    };
    const double edge_deg = PolarPlane::kEdge.degrees();
    for (const double poleward_deg : {60.0, 70.0, 80.0}) {
        QPolygonF circle;
        for (int longitude_deg = 0; longitude_deg <= 360; longitude_deg += 5) {
            circle << at(longitude_deg, poleward_deg);
        }
        disc.lines.push_back(circle);
        disc.labels.push_back({at(45.0, poleward_deg), // between meridians
                               QStringLiteral("%1°").arg(numberText(poleward_deg, 0))});
    }
    for (const double longitude_deg : {0.0, 90.0, 180.0, 270.0}) {
        const bool is_of_sides = std::fmod(longitude_deg, 180.0) != 0.0; // east or west of 0°
        disc.lines.push_back(QPolygonF{at(longitude_deg, edge_deg), at(longitude_deg, 90.0)});
        disc.labels.push_back({at(longitude_deg, edge_deg),
                               is_of_sides
                                   ? longitudeText(Angle::degrees(longitude_deg), format, body, 0)
                                   : QStringLiteral("%1°").arg(numberText(longitude_deg, 0))});
    }
    return disc;
}

void GlobeOverlays::showScene()
{
    showSettings();
    if (globe_.terrain() == nullptr) {
        minimap_->clear();
        scale_bar_->clear();
        return;
    }
    showOverview();
}

void GlobeOverlays::showSight()
{
    placeCrosshair();
    showHand();
    showMark();
    if (globe_.terrain() == nullptr || globe_.isHidden()) {
        return;
    }
    const BodyCamera& camera = globe_.camera();
    // As over a plane at the target.
    const OrbitCamera at_target{.distance_m = camera.distance_m,
                                .azimuth = camera.azimuth,
                                .tilt = camera.tilt,
                                .field_of_view = camera.field_of_view};
    compass_->setCamera(at_target);
    scale_bar_->setScale(globe_.metersPerPointInMiddle());
    const auto local = local_.lock();
    const auto wanted = local ? localLayer() : std::nullopt;
    if (wanted && globe_.scene().maps()[*wanted].map() != local) {
        showOverview(); // comes back here
        return;
    }
    if (!local && wantedOverview() != shown_) {
        if (heightsOf(wantedOverview()).size() == globe_.scene().maps().size()) {
            showOverview(); // comes back here
            return;
        }
        readBodyOverview(wantedOverview());
    }
    local ? showLocalSight(*local) : showBodySight();
    showLegend();
}

void GlobeOverlays::showBodySight()
{
    const BodyCamera& camera = globe_.camera();
    const Ellipsoid& ellipsoid = globe_.scene().ellipsoid();
    const Viewport viewport = globe_.viewport();
    const CameraPose pose = poseOf(camera, ellipsoid);
    const auto plane =
        shown_ == BodyOverview::Whole ? std::nullopt : std::optional<PolarPlane>(shown_);
    const BodySight seen = plane ? bodySight(pose, ellipsoid, viewport, *plane, kPolarSightSide)
                                 : bodySight(pose, ellipsoid, viewport, kSightColumns, kSightRows);
    const auto on_map = [&plane](const GeographicPoint& place) {
        return plane ? onPlane(plane->at(place)) : inDegrees(place);
    };
    MinimapSight sight{
        .target = on_map(camera.target),
        .eye = on_map(placeOf(pose.eye, ellipsoid).foot),
        .heading = plane ? plane->heading(camera.azimuth, camera.target.longitude) : camera.azimuth,
        .half_width = Angle::radians(
            std::atan(viewport.aspect() * std::tan(0.5 * camera.field_of_view.radians()))),
        .is_from_above = camera.tilt < kFromAbove,
        .seen = seenPicture(seen),
        .share = shareOfBody(seen)};
    if (plane) {
        sight.place = geographicText(camera.target, flat_.labels()->coordinateFormat(),
                                     globe_.scene().maps().front().map()->info(), 1);
    }
    for (const auto& [from, to] : edgesOf(seen)) {
        if (plane) {
            const PolarPoint a = plane->at(from);
            const PolarPoint b = plane->at(to);
            sight.edges.emplace_back(a.x, a.y, b.x, b.y);
        } else {
            sight.edges.emplace_back(from.longitude.degrees(), from.latitude.degrees(),
                                     to.longitude.degrees(), to.latitude.degrees());
        }
    }
    minimap_->setSight(sight);
}

// The camera of the flat map that has about the same picture.
void GlobeOverlays::showLocalSight(const Map& map)
{
    const BodyCamera& camera = globe_.camera();
    const double exaggeration = globe_.exaggeration();
    const auto flat = orbitCamera(map.georeference(),
                                  {.target = camera.target,
                                   .elevation_m = camera.height_m / exaggeration,
                                   .distance_m = camera.distance_m,
                                   .azimuth = camera.azimuth,
                                   .tilt = camera.tilt,
                                   .field_of_view = camera.field_of_view},
                                  exaggeration);
    if (flat) {
        minimap_->setCamera(*flat, globe_.viewport());
    }
}

// In the frame of the overview map.
void GlobeOverlays::lookAt(const ScenePoint& place)
{
    const auto local = local_.lock();
    if (!local && shown_ != BodyOverview::Whole) {
        // The map does not turn under the view: north is on all sides of the pole.
        const PolarPlane plane(shown_);
        const BodyCamera& camera = globe_.camera();
        const GeographicPoint there = plane.placeAt({place.x, place.y});
        globe_.lookAt(there, plane.azimuth(plane.heading(camera.azimuth, camera.target.longitude),
                                           there.longitude));
        return;
    }
    if (!local) {
        globe_.lookAt({.longitude = Angle::degrees(place.x), .latitude = Angle::degrees(place.y)});
        return;
    }
    const Georeference& georeference = local->georeference();
    if (const auto there = georeference.toGeographic(georeference.sceneFrame().toGrid(place))) {
        globe_.lookAt(*there);
    }
}

// The layer in the middle of the picture, otherwise the topmost one.
std::size_t GlobeOverlays::explainedLayer() const
{
    const auto ground =
        globe_.layers().size() > 1 ? globe_.groundAt(QRectF(globe_.rect()).center()) : std::nullopt;
    return ground ? ground->index : 0;
}

void GlobeOverlays::showLegend()
{
    if (globe_.scene().isEmpty()) {
        legend_->setContent({});
        return;
    }
    const ShownLayer& layer = globe_.layers()[explainedLayer()];
    const std::vector<Layer>& known = flat_.session().layers;
    const auto named = std::find_if(known.begin(), known.end(),
                                    [&](const Layer& l) { return l.map == layer.map; });
    const bool is_named = globe_.layers().size() > 1 && named != known.end();
    const CameraPose pose = poseOf(globe_.camera(), globe_.scene().ellipsoid());
    legend_->setContent(legendContent(
        layer, {.look = globe_.look(),
                .pixel_m = metersPerPixel(pose, globe_.viewport()),
                .exaggeration = globe_.exaggeration(),
                .unit = flat_.heightUnit(),
                .layer = is_named ? QString::fromStdString(named->name) : QString()}));
}

void GlobeOverlays::showTouch()
{
    showHand();
    const auto& stylus = globe_.shownStylus();
    // A replay has no force to show.
    if (!stylus || !stylus->is_in_contact || !(stylus->force_n_max > 0.0) ||
        globe_.terrain() == nullptr) {
        force_meter_->release();
        return;
    }
    // As the hand has it: to the right and away along the view, up along the local vertical.
    const Ellipsoid& ellipsoid = globe_.scene().ellipsoid();
    const CameraPose pose = poseOf(globe_.camera(), ellipsoid);
    const Vec3 up = localAxes(ellipsoid, placeOf(stylus->goal, ellipsoid).foot).up;
    const Vec3 away = normalized(cross(up, pose.axes.right));
    const Vec3 right = cross(away, up);
    const Vec3& force_n = stylus->force_n;
    force_meter_->setForce({dot(force_n, right), dot(force_n, away), dot(force_n, up)},
                           stylus->force_n_max);
}

// An arrow to the cursor, where that cannot be seen.
void GlobeOverlays::showHand()
{
    const auto& stylus = globe_.shownStylus();
    if (!stylus || globe_.terrain() == nullptr) {
        hand_pointer_->release();
        return;
    }
    const double scale = globe_.devicePixelRatioF();
    const auto mark = edgeMark(poseOf(globe_.camera(), globe_.scene().ellipsoid()), stylus->proxy,
                               {.viewport = globe_.viewport(),
                                .inset_px = HandPointer::kInset * scale,
                                .covered_px = flat_.coveredHeight() * scale});
    if (mark) {
        hand_pointer_->pointTo(QPointF(mark->at.x, mark->at.y) / scale, {mark->right, mark->down});
    } else {
        hand_pointer_->release();
    }
}

void GlobeOverlays::showMark()
{
    const auto marked = flat_.markedPlace();
    const double height_m = marked && globe_.terrain() != nullptr
                                ? globe_.scene().height(*marked)
                                : std::numeric_limits<double>::quiet_NaN();
    if (std::isfinite(height_m)) {
        const Ellipsoid& body = globe_.scene().ellipsoid();
        const ScenePoint place =
            targetOf({.target = *marked, .height_m = height_m * globe_.exaggeration()}, body);
        if (globe_.isInPicture(place)) {
            const auto pixel = project(poseOf(globe_.camera(), body), globe_.viewport(), place);
            place_mark_->pointAt(QPointF(pixel->x, pixel->y) / globe_.devicePixelRatioF());
            return;
        }
    }
    place_mark_->hide();
}

void GlobeOverlays::placeCrosshair()
{
    QRect place(QPoint(), crosshair_->sizeHint());
    place.moveCenter(globe_.rect().center());
    crosshair_->setGeometry(place);
    crosshair_->setVisible(globe_.isCrosshairShown());
}

bool GlobeOverlays::eventFilter(QObject* watched, QEvent* event)
{
    if (event->type() == QEvent::Enter && watched != &globe_) {
        globe_.forgetPointer();
    }
    if (watched == &globe_ &&
        (explainAt(*event, *legend_, legend_->summary()) || explainAt(*event, *scale_bar_, {}))) {
        return true;
    }
    if (watched == &globe_ && (event->type() == QEvent::MouseButtonPress ||
                               event->type() == QEvent::MouseButtonRelease)) {
        flat_.clearMarkOnClick(static_cast<const QMouseEvent&>(*event));
    }
    return QObject::eventFilter(watched, event);
}

} // namespace marsview
