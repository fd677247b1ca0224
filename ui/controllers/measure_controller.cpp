#include "ui/controllers/measure_controller.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

constexpr std::size_t kCirclePositions = 180;
constexpr double kSymbolPoints = 26.0; // half the length of the strike line on the screen

} // namespace

// What is measured on the other thread.
struct MeasureController::Job {
    std::uint32_t item = 0;
    Measurement measurement;
    std::shared_ptr<const Map> map;
    JobMonitor monitor;
};

std::size_t verticesNeeded(MeasurementKind kind)
{
    switch (kind) {
    case MeasurementKind::Distance:
    case MeasurementKind::Profile:
        return 2;
    case MeasurementKind::Area:
    case MeasurementKind::Attitude:
    case MeasurementKind::Crater:
        return 3;
    case MeasurementKind::Slope:
        break;
    }
    return 1;
}

bool MeasureItem::isComplete() const
{
    return vertices.size() >= verticesNeeded(kind);
}

MeasureController::MeasureController(TerrainView& view, QUndoStack& undo_stack, QObject* parent)
    : DrawingController(view, undo_stack, Tool::Measure, LineSet::Measurements, parent)
{
    pool_.setMaxThreadCount(1);
}

MeasureController::~MeasureController()
{
    for (const auto& [item, job] : jobs_) {
        job->monitor.cancel();
    }
    pool_.clear();
    pool_.waitForDone();
}

MeasureItem MeasureController::newItem(std::uint32_t id) const
{
    MeasureItem item;
    item.kind = kind_;
    item.name = nameOf(kind_, id);
    return item;
}

QString MeasureController::nameOf(MeasurementKind kind, std::uint32_t number)
{
    switch (kind) {
    case MeasurementKind::Distance:
        return tr("Distance %1").arg(number);
    case MeasurementKind::Profile:
        return tr("Profile %1").arg(number);
    case MeasurementKind::Area:
        return tr("Area %1").arg(number);
    case MeasurementKind::Attitude:
        //: Strike and dip of a plane
        return tr("Attitude %1").arg(number);
    case MeasurementKind::Crater:
        return tr("Crater %1").arg(number);
    case MeasurementKind::Slope:
        break;
    }
    return tr("Point %1").arg(number);
}

bool MeasureController::isShown(const MeasureItem& item) const
{
    const Layer* layer = layerOf(item);
    return layer != nullptr && layer->is_visible;
}

const MeasureOutcome& MeasureController::outcome(std::uint32_t id) const
{
    static const MeasureOutcome kNone;
    const auto hit = outcomes_.find(id);
    return hit != outcomes_.end() ? hit->second : kNone;
}

void MeasureController::begin(MeasurementKind kind)
{
    finishCurrent();
    kind_ = kind;
    view().setTool(Tool::Measure);
    Q_EMIT kindChanged(kind);
}

// Measures what is not as it was.
void MeasureController::stateChanged(const MeasureState& before)
{
    for (const MeasureItem& item : state().items) {
        const MeasureItem* was = before.items.find(item.id);
        if (was == nullptr || was->vertices != item.vertices || was->kind != item.kind ||
            was->layer != item.layer) {
            measureAgain(item);
        }
    }
    std::erase_if(outcomes_, [this](const auto& entry) { return itemOf(entry.first) == nullptr; });
    std::erase_if(measured_on_,
                  [this](const auto& entry) { return itemOf(entry.first) == nullptr; });
    if (before.current != state().current) {
        profile_cursor_m_.reset();
    }
}

void MeasureController::removeAll()
{
    MeasureState after = state();
    after.items.clear();
    after.current = 0;
    push(std::move(after), tr("Remove All Measurements"));
}

std::vector<ProjectMeasurement> MeasureController::saved() const
{
    const std::vector<LayerId> order = projectOrder(session());
    std::vector<ProjectMeasurement> saved;
    for (const MeasureItem& item : state().items) {
        if (item.vertices.size() < verticesNeeded(item.kind)) {
            continue;
        }
        const auto layer = std::find(order.begin(), order.end(), item.layer);
        saved.push_back({.kind = item.kind,
                         .name = item.name.toStdString(),
                         .layer = layer != order.end() ? std::optional(static_cast<std::size_t>(
                                                             layer - order.begin()))
                                                       : std::nullopt,
                         .vertices = item.vertices,
                         .time = item.time,
                         .note = item.note.toStdString(),
                         .color = item.color});
    }
    return saved;
}

std::vector<NamedMeasurement> MeasureController::named() const
{
    std::vector<NamedMeasurement> all;
    for (const MeasureItem& item : state().items) {
        if (auto measurement = named(item.id)) {
            all.push_back(std::move(*measurement));
        }
    }
    return all;
}

std::optional<NamedMeasurement> MeasureController::named(std::uint32_t id) const
{
    const MeasureItem* item = itemOf(id);
    if (item == nullptr || item->vertices.size() < verticesNeeded(item->kind)) {
        return std::nullopt;
    }
    NamedMeasurement named;
    named.measurement.kind = item->kind;
    named.measurement.name = item->name.toStdString();
    named.measurement.vertices = item->vertices;
    named.measurement.time = item->time;
    named.measurement.note = item->note.toStdString();
    named.measurement.color = item->color;
    named.measurement.result = outcome(id).result;
    if (const Layer* layer = layerOf(*item)) {
        named.layer_name = layer->name;
        if (const auto& crs = layer->map->georeference().crs()) {
            named.crs = *crs;
        }
    }
    return named;
}

void MeasureController::open(const std::vector<ProjectMeasurement>& saved,
                             const std::vector<LayerId>& layers)
{
    std::vector<MeasureItem> items;
    for (const ProjectMeasurement& measurement : saved) {
        MeasureItem item;
        item.kind = measurement.kind;
        item.name = QString::fromStdString(measurement.name);
        item.layer = measurement.layer && *measurement.layer < layers.size()
                         ? layers[*measurement.layer]
                         : LayerId::None;
        item.vertices = measurement.vertices;
        item.note = QString::fromStdString(measurement.note);
        item.color = measurement.color;
        item.time = measurement.time;
        items.push_back(std::move(item));
    }
    replaceAll(std::move(items));
}

void MeasureController::setSession(const Session& session)
{
    noteSession(session);
    for (const MeasureItem& item : state().items) {
        const Layer* layer = layerOf(item);
        const auto measured = measured_on_.find(item.id);
        if (layer != nullptr &&
            (measured == measured_on_.end() || measured->second != layer->map)) {
            measureAgain(item);
        }
    }
    Q_EMIT changed(); // names of layers
}

std::vector<ScenePoint> MeasureController::pathOf(const MeasureItem& item) const
{
    constexpr int kStepsOfLeg = 64;
    std::vector<ScenePoint> path;
    const auto add = [&](const std::optional<ScenePoint>& point) {
        if (point) {
            path.push_back(*point);
        }
    };
    for (std::size_t i = 0; item.isLine() && i + 1 < item.vertices.size(); ++i) {
        const auto from = geometry().positionOf(item.vertices[i]);
        const auto to = geometry().positionOf(item.vertices[i + 1]);
        if (!from || !to) {
            return {};
        }
        const GroundLine line = geometry().ground().line(*from, *to);
        for (int step = path.empty() ? 0 : 1; step <= kStepsOfLeg; ++step) {
            add(geometry().scenePoint(line.at(line.lengthM() * step / kStepsOfLeg)));
        }
    }
    return path;
}

void MeasureController::hovered(const std::optional<QPointF>& position)
{
    const MeasureItem* item = current();
    std::optional<double> hovered_m;
    double nearest = kReach;
    for (const Leg& leg : legs()) {
        if (!position || item == nullptr || leg.item != item->id || !item->isLine()) {
            continue;
        }
        for (std::size_t i = 0; i < leg.run.points.size(); ++i) {
            const auto place = scene().positionOf(leg.run.points[i]);
            const double away = place ? distanceBetween(*place, *position) : nearest;
            if (away < nearest) {
                nearest = away;
                hovered_m = leg.begin_m + leg.run.distances_m[i];
            }
        }
    }
    if (hovered_m || profile_cursor_m_) {
        Q_EMIT lineHovered(hovered_m);
    }
}

std::vector<GroundPosition>
MeasureController::cornersOf(const MeasureItem& item,
                             const std::optional<GroundPosition>& next) const
{
    switch (item.kind) {
    case MeasurementKind::Slope:
    case MeasurementKind::Attitude:
        return {}; // points, and a symbol
    case MeasurementKind::Crater: {
        const auto* crater = outcome(item.id).as<Crater>();
        return crater != nullptr ? circleOn(geometry().ground(), crater->center,
                                            0.5 * crater->diameter_m, kCirclePositions)
                                 : std::vector<GroundPosition>();
    }
    default:
        return DrawingController::cornersOf(item, next);
    }
}

void MeasureController::addLines(std::vector<DrapedLine>& lines) const
{
    for (const MeasureItem& item : state().items) {
        if (item.kind == MeasurementKind::Attitude && layerOf(item) != nullptr) {
            addSymbol(lines, item);
        }
    }
}

// The strike line with a tick down the dip, through the middle of the points.
void MeasureController::addSymbol(std::vector<DrapedLine>& lines, const MeasureItem& item) const
{
    const auto* attitude = outcome(item.id).as<Attitude>();
    const auto center =
        attitude != nullptr ? geometry().scenePoint(attitude->center) : std::nullopt;
    if (!center || !std::isfinite(attitude->strike_deg)) {
        return;
    }
    const double half_m = kSymbolPoints * scene().view().devicePixelRatioF() *
                          metersPerPixel(scene().camera(), scene().viewport(), *center);
    const auto away = [&](double azimuth_deg, double length_m) {
        return geometry().scenePoint(
            geometry().ground().ray(attitude->center, azimuth_deg).at(length_m));
    };
    const auto one_end = away(attitude->strike_deg, half_m);
    const auto other_end = away(attitude->strike_deg + 180.0, half_m);
    const auto tick = away(attitude->dip_direction_deg, 0.4 * half_m);
    const Rgb8 color = colorOf(item);
    if (one_end && other_end && tick) {
        lines.push_back(
            {.points = {*one_end, *center, *other_end}, .color = color, .width_points = 3.0});
        lines.push_back({.points = {*center, *tick}, .color = color, .width_points = 3.0});
    }
}

std::optional<QPointF> MeasureController::labelPlace(std::uint32_t id) const
{
    const MeasureItem* item = itemOf(id);
    const Layer* layer = item != nullptr ? layerOf(*item) : nullptr;
    if (layer == nullptr || !layer->is_visible || item->vertices.empty()) {
        return std::nullopt;
    }
    if (const auto* attitude = outcome(id).as<Attitude>()) {
        return geometry().screenPoint(attitude->center);
    }
    if (const auto* crater = outcome(id).as<Crater>()) {
        return geometry().screenPoint(crater->center);
    }
    return geometry().screenPoint(item->vertices.back());
}

void MeasureController::setProfileCursor(std::optional<double> distance_m)
{
    profile_cursor_m_ = distance_m;
    noteMoved();
}

std::optional<QPointF> MeasureController::profileCursorPlace() const
{
    const MeasureItem* item = current();
    if (!profile_cursor_m_ || item == nullptr || geometry().isEmpty()) {
        return std::nullopt;
    }
    double begin_m = 0.0;
    for (std::size_t i = 0; i + 1 < item->vertices.size(); ++i) {
        const auto from = geometry().positionOf(item->vertices[i]);
        const auto to = geometry().positionOf(item->vertices[i + 1]);
        if (!from || !to) {
            return std::nullopt;
        }
        const GroundLine line = geometry().ground().line(*from, *to);
        if (*profile_cursor_m_ <= begin_m + line.lengthM() || i + 2 == item->vertices.size()) {
            return geometry().screenPoint(line.at(*profile_cursor_m_ - begin_m));
        }
        begin_m += line.lengthM();
    }
    return std::nullopt;
}

// Measuring ---------------------------------------------------------------------------------------

void MeasureController::measureAgain(const MeasureItem& item)
{
    if (const auto job = jobs_.find(item.id); job != jobs_.end()) {
        job->second->monitor.cancel();
        jobs_.erase(job);
    }
    MeasureOutcome& outcome = outcomes_[item.id];
    const Layer* layer = layerOf(item);
    outcome.is_running = layer != nullptr && item.vertices.size() >= verticesNeeded(item.kind);
    if (layer == nullptr) {
        measured_on_.erase(item.id);
        return;
    }
    measured_on_[item.id] = layer->map;
    if (!outcome.is_running) {
        outcome.result.reset();
        Q_EMIT measured(item.id);
        return;
    }
    auto job = std::make_shared<Job>();
    job->item = item.id;
    job->measurement.kind = item.kind;
    job->measurement.vertices = item.vertices;
    job->measurement.area.base = VolumeBase::BorderPlane;
    job->map = layer->map;
    jobs_[item.id] = job;
    pool_.start([this, job] {
        const auto run = [&](MeasureDetail detail) {
            auto result = marsview::measured(job->measurement, *job->map, detail, job->monitor);
            if (!result) {
                return true; // canceled
            }
            const bool is_last = detail == MeasureDetail::Full || !result->is_approximate;
            QMetaObject::invokeMethod(
                this, [this, job, result, is_last] { take(*job, result, is_last); },
                Qt::QueuedConnection);
            return is_last;
        };
        if (!job->monitor.isCanceled() && !run(MeasureDetail::Quick)) {
            run(MeasureDetail::Full);
        }
    });
}

void MeasureController::take(const Job& job,
                             std::shared_ptr<const MeasurementResult> result,
                             bool is_last)
{
    const auto latest = jobs_.find(job.item);
    if (latest == jobs_.end() || latest->second.get() != &job) {
        return; // of an earlier geometry
    }
    MeasureOutcome& outcome = outcomes_[job.item];
    outcome.result = std::move(result);
    outcome.is_running = !is_last;
    const std::uint32_t id = job.item;
    if (is_last) {
        jobs_.erase(latest);
    }
    drawSoon();
    Q_EMIT measured(id);
}

} // namespace marsview
