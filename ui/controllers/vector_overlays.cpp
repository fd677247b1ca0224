#include "ui/controllers/vector_overlays.h"

#include "core/session/measurement.h"
#include "core/vector/feature_placement.h"
#include "ui/controllers/file_work.h"
#include "ui/text/body_text.h"

#include <QFileInfo>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <variant>

namespace marsview {
namespace {

constexpr double kLineWidth = 1.8; // points
constexpr double kDotWidth = 7.0;  // points
constexpr double kHaloWidth = 2.5; // points on each side of the selected feature
constexpr Rgb8 kHaloColor{255, 255, 255};
constexpr double kPiecePoints = 6.0; // a part of a line that is drawn straight
// Of all overlays, in a picture at rest and in one that moves.
constexpr std::size_t kPointsMax = 120000;
constexpr std::size_t kMovingPointsMax = 8000;
constexpr std::size_t kEdgePiecesMax = 400; // of one edge
constexpr qint64 kRestShare = 9; // at most a tenth of the time goes into lines while moving

QString textOf(const FieldValue& value)
{
    struct Text {
        QString operator()(std::monostate) const { return {}; }
        QString operator()(std::int64_t number) const { return QString::number(number); }
        QString operator()(double number) const { return QString::number(number, 'g', 10); }
        QString operator()(const std::string& text) const { return QString::fromStdString(text); }
    };
    return std::visit(Text{}, value);
}

// Empty where a place is not on the map.
std::optional<PlanePoint> planPoint(const ScenePlan& plan, const DrawnVertex& place)
{
    const auto* geographic = std::get_if<GeographicPoint>(&place);
    const auto grid = geographic != nullptr
                          ? plan.georeference.toGrid(*geographic)
                          : std::optional(plan.georeference.toGrid(std::get<MapPoint>(place)));
    if (!grid) {
        return std::nullopt;
    }
    const ScenePoint at = plan.georeference.sceneFrame().toScene(*grid, 0.0);
    return PlanePoint{at.x, at.y};
}

// All halos lie below all lines, so that none covers a line where two meet.
std::vector<DrapedLine> withHalos(std::vector<DrapedLine> lines)
{
    std::vector<DrapedLine> all = lines;
    for (DrapedLine& halo : all) {
        halo.color = kHaloColor;
        halo.width_points += 2.0 * kHaloWidth;
    }
    all.insert(all.end(), std::make_move_iterator(lines.begin()),
               std::make_move_iterator(lines.end()));
    return all;
}

} // namespace

VectorOverlays::VectorOverlays(TerrainView& view, FileWork& work, QObject* parent)
    : QObject(parent)
    , flat_(view)
    , work_(work)
{
    pool_.setMaxThreadCount(1);
    joinScene();
}

VectorOverlays::~VectorOverlays()
{
    work_.cancelOf(*this);
    pool_.clear();
    pool_.waitForDone(); // posted results are discarded with this object
}

void VectorOverlays::joinScene()
{
    connect(scene_, &DrawingScene::sightChanged, this, [this] {
        is_hasty_ = true;
        draw_soon_.request();
    });
    connect(scene_, &DrawingScene::exaggerationChanged, this, [this] { draw_soon_.request(); });
    connect(scene_, &DrawingScene::pictureCompleted, this, [this] { // finer ground has come
        is_hasty_ = false;
        if (const auto map = scene_->map(); map && map->heightfield().isTiled()) {
            forgetDotPlaces();
        }
        draw_soon_.request();
    });
    connect(scene_, &DrawingScene::mapsChanged, this, &VectorOverlays::placeAll);
}

void VectorOverlays::drawOn(DrawingScene* scene)
{
    DrawingScene* next = scene != nullptr ? scene : &flat_;
    if (next != scene_) {
        scene_->disconnect(this);
        scene_->setLines({}, LineSet::Overlays);
        scene_->setDots({}, LineSet::Overlays);
        scene_->setLines({}, LineSet::Selection);
        scene_ = next;
        joinScene();
        placeAll();
    }
}

void VectorOverlays::forgetDotPlaces()
{
    for (auto& [path, entry] : entries_) {
        entry.dot_places.clear();
    }
}

void VectorOverlays::placeAll()
{
    forgetDotPlaces();
    for (const VectorOverlay& overlay : overlays_) {
        place({.path = overlay.path, .crs = overlay.crs});
    }
    for (const Request& request : std::exchange(waiting_, {})) {
        place(request);
    }
    draw_soon_.request();
}

void VectorOverlays::open(const QString& file, const QString& crs)
{
    place({.path = QFileInfo(file).absoluteFilePath().toStdString(),
           .crs = crs.toStdString(),
           .is_asked_for = true});
}

void VectorOverlays::setSession(const Session& session)
{
    if (overlays_ == session.overlays) {
        return;
    }
    overlays_ = session.overlays;
    dropSelectionIfHidden();
    placeAll();
}

// Reads the file, unless it is known, and finds where its features are on the map.
void VectorOverlays::place(const Request& request)
{
    const std::shared_ptr<const ScenePlan> plan = scene_->plan();
    if (!plan) { // until a map is shown; on a body, placing it takes a moment
        if (request.is_asked_for) {
            waiting_.push_back(request);
        }
        return;
    }
    Entry& entry = entries_[request.path];
    const bool is_known = !request.is_asked_for && entry.crs == request.crs;
    if (is_known && (entry.has_failed || entry.plan.lock() == plan)) {
        return;
    }
    entry.plan = plan;
    entry.crs = request.crs;
    ++running_;
    const QString path = QString::fromStdString(request.path);
    //: In the status bar: %1 is a file
    const auto monitor = work_.begin(*this, tr("Reading %1").arg(QFileInfo(path).fileName()), path);
    pool_.start([this, request, plan, known = is_known ? entry.file : nullptr, monitor] {
        QMetaObject::invokeMethod(
            this,
            [this, request, plan = std::weak_ptr(plan), monitor,
             outcome = readFor(request, *plan, known, *monitor)] {
                work_.end(monitor);
                take(request, plan, outcome);
            },
            Qt::QueuedConnection);
    });
}

VectorOverlays::Outcome VectorOverlays::readFor(const Request& request,
                                                const ScenePlan& plan,
                                                std::shared_ptr<const VectorFile> known,
                                                JobMonitor& monitor)
{
    constexpr double kReadShare = 0.7; // of the time
    Outcome outcome{.file = std::move(known), .placed = {}, .problem = {}, .likely = {}};
    const bool is_read = outcome.file != nullptr;
    if (!is_read) {
        const JobPart part(monitor, 0.0, kReadShare);
        auto file = readVectorFile(request.path, monitor);
        if (!file) {
            outcome.problem = file.error();
            return outcome;
        }
        if (!request.crs.empty()) {
            Result<Crs> crs = Crs::fromText(request.crs);
            if (!crs) {
                outcome.problem =
                    Error{crs.error().code, request.path + ": " + crs.error().message};
                return outcome;
            }
            file->content.body = crs->body();
            file->content.crs = std::move(*crs);
        }
        outcome.file = std::make_shared<const VectorFile>(std::move(*file));
    }
    const FeatureCollection& content = outcome.file->content;
    const Map& map = *plan.map;
    const Status fits =
        checkSameBody(request.path, content, map.georeference().crs(), map.info().body);
    if (fits) {
        const JobPart part(monitor, is_read ? 0.0 : kReadShare, 1.0);
        outcome.placed = placedOn(plan, *outcome.file, monitor);
        if (!outcome.placed) {
            outcome.problem = Error{ErrorCode::Canceled, request.path + ": reading was canceled"};
        }
    } else {
        outcome.problem = fits.error();
        outcome.likely = likelyCrs(content, map.info().body);
    }
    return outcome;
}

void VectorOverlays::take(const Request& request,
                          const std::weak_ptr<const ScenePlan>& plan,
                          Outcome outcome)
{
    --running_;
    Entry& entry = entries_[request.path];
    const auto on = plan.lock();
    const bool is_first = !entry.file && !entry.has_failed;
    const bool is_canceled = outcome.problem && outcome.problem->code == ErrorCode::Canceled;
    if (!on || entry.plan.lock() != on || entry.crs != request.crs) {
        // Another map is shown by now. A file that the user has asked for is for that one.
        if (request.is_asked_for && entry.crs == request.crs && !is_canceled) {
            place(request);
        }
        return;
    }
    if (is_canceled) { // until it is opened again
        entry.has_failed = true;
        Q_EMIT changed();
        return;
    }
    if (outcome.file) {
        if (entry.file != outcome.file && selected_ && selected_->path == request.path) {
            select(std::nullopt); // its number may be that of another feature now
            Q_EMIT selectionLost();
        }
        entry.file = outcome.file;
        entry.placed = std::move(outcome.placed);
        entry.dot_places.clear();
        entry.coarsening = 1.0;
        entry.has_failed = false;
    } else {
        entry.has_failed = true;
    }
    // On a map of another body an overlay is hidden without a word, unless it was asked for.
    if (request.is_asked_for && outcome.likely) {
        Q_EMIT isOnOtherBody(QString::fromStdString(request.path), bodyName(*on->map->info().body),
                             QString::fromStdString(outcome.likely->wkt()));
    } else if (outcome.problem && (request.is_asked_for || (is_first && !outcome.file))) {
        Q_EMIT failed(QString::fromStdString(outcome.problem->message));
    } else if (request.is_asked_for) {
        QStringList notices;
        for (const std::string& notice : entry.file->notices) {
            notices.append(QString::fromStdString(notice));
        }
        Q_EMIT wasRead(QString::fromStdString(request.path), QString::fromStdString(request.crs),
                       notices);
    }
    draw_soon_.request();
    Q_EMIT changed();
}

std::shared_ptr<const VectorOverlays::Placed>
VectorOverlays::placedOn(const ScenePlan& plan, const VectorFile& file, JobMonitor& monitor)
{
    constexpr double kPlaceShare = 0.7; // of the time; the rest is for the index
    constexpr std::size_t kBetweenLooks = 1024;
    auto placed = std::make_shared<Placed>();
    const std::optional<Crs>& crs =
        file.content.crs ? file.content.crs : plan.map->georeference().crs();
    const FeaturePlacement placement(crs, plan.georeference);
    PlaneFeatures features;
    for (std::size_t layer = 0; layer < file.content.layers.size(); ++layer) {
        const std::vector<Feature>& all = file.content.layers[layer].features;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (i % kBetweenLooks == 0) {
                if (monitor.isCanceled()) {
                    return nullptr;
                }
                monitor.report(kPlaceShare * static_cast<double>(i) /
                               static_cast<double>(all.size()));
            }
            placement.add(static_cast<std::uint32_t>(placed->features.size()), all[i].shape,
                          all[i].parts, features);
            placed->features.emplace_back(layer, i);
        }
    }
    for (const PlanePoint& point : features.points) {
        placed->box.include(point);
    }
    placed->index = FeatureIndex(std::move(features));
    return placed;
}

void VectorOverlays::drawLines()
{
    // While the camera moves, lines of a moment ago do if new ones take long; the picture at rest
    // asks again.
    if (is_hasty_ && drawn_at_.isValid() &&
        drawn_at_.nsecsElapsed() < kRestShare * hasty_drawing_ns_) {
        return;
    }
    drawn_at_.start();
    const std::size_t points_max = is_hasty_ ? kMovingPointsMax : kPointsMax;
    const auto plan = scene_->plan();
    std::vector<const VectorOverlay*> shown;
    for (const VectorOverlay& overlay : overlays_) {
        const auto entry = entries_.find(overlay.path);
        if (overlay.is_visible && entry != entries_.end() && entry->second.placed &&
            entry->second.plan.lock() == plan && plan) {
            shown.push_back(&overlay);
        }
    }
    if (shown.empty() && !is_drawn_) {
        return;
    }
    Drawn drawn;
    for (const VectorOverlay* overlay : shown) {
        addLines(*overlay, entries_.at(overlay->path), points_max / shown.size(), drawn);
    }
    is_drawn_ = !drawn.lines.empty() || !drawn.dots.empty() || !drawn.selected.empty();
    scene_->setLines(std::move(drawn.lines), LineSet::Overlays);
    scene_->setDots({.dots = std::move(drawn.dots), .width_points = kDotWidth, .stamps = nullptr},
                    LineSet::Overlays);
    scene_->setLines(withHalos(std::move(drawn.selected)), LineSet::Selection);
    hasty_drawing_ns_ = is_hasty_ ? drawn_at_.nsecsElapsed() : 0;
    drawn_at_.start();
}

void VectorOverlays::addLines(const VectorOverlay& overlay,
                              Entry& entry,
                              std::size_t points_max,
                              Drawn& drawn)
{
    // Details of a point of the screen.
    const auto resolution = scene_->planResolution();
    const FeatureIndex::Selection selection =
        entry.placed->index.select(resolution, points_max, entry.coarsening);
    entry.coarsening = selection.coarsening;
    const bool has_selected = selected_ && selected_->path == overlay.path;
    const auto is_selected = [&](std::uint32_t feature) {
        return has_selected && feature == selected_->number;
    };
    const auto add_disc = [&](const ScenePoint& place) { // a line without length
        drawn.selected.push_back(
            {.points = {place, place}, .color = overlay.color, .width_points = kDotWidth});
    };
    bool is_selected_seen = !has_selected;
    for (const auto& piece : selection.pieces) {
        std::vector<DrapedLine>& lines = is_selected(piece.feature) ? drawn.selected : drawn.lines;
        is_selected_seen = is_selected_seen || is_selected(piece.feature);
        DrapedLine line{.points = {}, .color = overlay.color, .width_points = kLineWidth};
        const auto end_run = [&] { // no terrain there, or not on this side of the body
            if (line.points.size() > 1) {
                lines.push_back(line);
            }
            line.points.clear();
        };
        const auto add = [&](double x, double y) {
            const auto point = scene_->onTerrain(PlanePoint{x, y});
            if (point && !scene_->isBehindHorizon(*point)) {
                line.points.push_back(*point);
            } else {
                end_run();
            }
        };
        const PlanePoint& first = selection.points[piece.begin];
        if (piece.shape == PlaneShape::Dot) {
            const auto place = placeOfDot(entry, piece.part, first);
            if (place && !scene_->isBehindHorizon(*place)) {
                if (is_selected(piece.feature)) {
                    add_disc(*place);
                } else {
                    drawn.dots.push_back({.place = *place, .color = overlay.color});
                }
            }
            continue;
        }
        add(first.x, first.y);
        for (std::size_t i = piece.begin + 1; i < piece.end; ++i) {
            const PlanePoint& a = selection.points[i - 1];
            const PlanePoint& b = selection.points[i];
            PlaneBox box;
            box.include(a);
            box.include(b);
            const double point_m = resolution(box);
            const double pieces_wanted =
                std::isfinite(point_m) ? std::hypot(b.x - a.x, b.y - a.y) / (kPiecePoints * point_m)
                                       : 1.0;
            const auto pieces = static_cast<std::size_t>(
                std::clamp(std::ceil(pieces_wanted), 1.0, static_cast<double>(kEdgePiecesMax)));
            for (std::size_t k = 1; k <= pieces; ++k) {
                const double share = static_cast<double>(k) / static_cast<double>(pieces);
                add(a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share);
            }
        }
        end_run();
    }
    if (is_selected_seen) {
        return;
    }
    // It is too small for a piece of its own here, or out of sight.
    if (selected_on_.lock() != entry.placed) {
        selected_box_ = entry.placed->index.boxOf(selected_->number);
        selected_on_ = entry.placed;
    }
    if (std::isfinite(resolution(selected_box_))) {
        const auto place =
            scene_->onTerrain(PlanePoint{(selected_box_.min_x + selected_box_.max_x) / 2.0,
                                         (selected_box_.min_y + selected_box_.max_y) / 2.0});
        if (place && !scene_->isBehindHorizon(*place)) {
            add_disc(*place);
        }
    }
}

void VectorOverlays::select(const std::optional<FeatureId>& feature)
{
    if (feature != selected_) {
        selected_ = feature;
        selected_on_.reset();
        draw_soon_.request();
    }
}

void VectorOverlays::dropSelectionIfHidden()
{
    const bool is_drawn =
        selected_ &&
        std::any_of(overlays_.begin(), overlays_.end(), [this](const VectorOverlay& overlay) {
            return overlay.is_visible && overlay.path == selected_->path;
        });
    if (selected_ && !is_drawn) {
        select(std::nullopt);
        Q_EMIT selectionLost();
    }
}

// Finding heights takes longer than drawing: they are kept until the maps change.
std::optional<ScenePoint>
VectorOverlays::placeOfDot(Entry& entry, std::uint32_t part, const PlanePoint& point) const
{
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    constexpr double kNowhere = std::numeric_limits<double>::infinity();
    if (entry.dot_places.empty()) {
        entry.dot_places.assign(entry.placed->index.partCount(), {0.0, 0.0, kUnknown});
    }
    ScenePoint& known = entry.dot_places[part];
    const double exaggeration = scene_->dotExaggeration();
    if (std::isnan(known.z)) {
        known = scene_->onTerrain(point).value_or(ScenePoint{0.0, 0.0, kNowhere});
        known.z /= exaggeration;
    }
    return known.z < kNowhere ? std::optional(ScenePoint{known.x, known.y, known.z * exaggeration})
                              : std::nullopt;
}

bool VectorOverlays::isElsewhere(const std::string& path) const
{
    const auto entry = entries_.find(path);
    return entry != entries_.end() && entry->second.file && !entry->second.placed;
}

std::vector<VectorOverlays::InSight>
VectorOverlays::filesInSight(const std::shared_ptr<const ScenePlan>& plan) const
{
    std::vector<InSight> files;
    for (auto overlay = overlays_.rbegin(); overlay != overlays_.rend(); ++overlay) {
        const auto entry = entries_.find(overlay->path);
        if (overlay->is_visible && entry != entries_.end() && entry->second.placed &&
            entry->second.plan.lock() == plan) {
            files.push_back({*overlay, entry->second});
        }
    }
    return files;
}

std::optional<DrawnVertex> VectorOverlays::vertexNear(QPointF position, double reach) const
{
    const auto plan = scene_->plan();
    const std::vector<InSight> files = plan ? filesInSight(plan) : std::vector<InSight>();
    if (files.empty()) {
        return std::nullopt;
    }
    const auto plan_point_at = [&](QPointF where) {
        const auto place = scene_->placeAt(where);
        return place ? planPoint(*plan, place->vertex) : std::nullopt;
    };
    const auto at = plan_point_at(position);
    if (!at) {
        return std::nullopt;
    }
    // The reach on the terrain is longest in one of these directions, nearly.
    double reach_m = 0.0;
    for (const QPointF& away : {QPointF(reach, 0.0), QPointF(-reach, 0.0), QPointF(0.0, reach)}) {
        if (const auto edge = plan_point_at(position + away)) {
            reach_m = std::max(reach_m, std::hypot(edge->x - at->x, edge->y - at->y));
        }
    }
    std::optional<DrawnVertex> nearest;
    for (const auto& [overlay, entry] : files) {
        const auto vertex = entry.placed->index.nearestVertex(*at, reach_m);
        const auto place = vertex ? scene_->onTerrain(*vertex) : std::nullopt;
        const auto seen = place ? scene_->positionOf(*place) : std::nullopt;
        const double distance =
            seen ? std::hypot(seen->x() - position.x(), seen->y() - position.y()) : HUGE_VAL;
        if (distance <= reach && !scene_->isHidden(*place)) {
            reach = distance;
            const SceneFrame& frame = plan->georeference.sceneFrame();
            nearest = vertexAt(plan->georeference, frame.toGrid({vertex->x, vertex->y, 0.0}));
        }
    }
    return nearest;
}

std::vector<VectorOverlays::Hit> VectorOverlays::featuresAt(const DrawnVertex& place,
                                                            double reach_m,
                                                            std::size_t attributes_max) const
{
    std::vector<Hit> hits;
    const auto plan = scene_->plan();
    if (!plan) {
        return hits;
    }
    const auto at = planPoint(*plan, place);
    if (!at) {
        return hits;
    }
    const auto* geographic = std::get_if<GeographicPoint>(&place);
    if (plan->has_equator_scale && geographic != nullptr) {
        constexpr double kScaleMax = 20.0;
        reach_m *= std::min(1.0 / std::cos(geographic->latitude.radians()), kScaleMax);
    }
    for (const auto& [overlay, entry] : filesInSight(plan)) {
        const auto found = entry.placed->index.find(*at, reach_m);
        if (!found) {
            continue;
        }
        const auto [layer_index, feature_index] = entry.placed->features[*found];
        const FeatureLayer& layer = entry.file->content.layers[layer_index];
        const Feature& feature = layer.features[feature_index];
        Hit hit{.file = QFileInfo(QString::fromStdString(overlay.path)).fileName(),
                .attributes = {},
                .feature = {overlay.path, *found},
                .shape = feature.shape};
        for (std::size_t i = 0; i < layer.fields.size() && i < feature.values.size() &&
                                hit.attributes.size() < attributes_max;
             ++i) {
            if (const QString text = textOf(feature.values[i]); !text.isEmpty()) {
                hit.attributes.emplace_back(QString::fromStdString(layer.fields[i].name), text);
            }
        }
        hits.push_back(std::move(hit));
    }
    return hits;
}

void VectorOverlays::goTo(const std::string& path)
{
    const auto entry = entries_.find(path);
    if (entry != entries_.end() && entry->second.placed &&
        entry->second.plan.lock() == scene_->plan() &&
        entry->second.placed->box.min_x <= entry->second.placed->box.max_x) {
        scene_->flyToBox(entry->second.placed->box);
    }
}

} // namespace marsview
