#include "ui/controllers/measure_controller.h"

#include <QCoreApplication>
#include <QKeyEvent>
#include <QUndoCommand>
#include <QUndoStack>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace marsview {
namespace {

constexpr double kHandleReach = 9.0; // points from a handle or line, in which it is grabbed
constexpr double kSamePlace = 3.0;   // points: Enter again there finishes

// A part of a line is drawn straight if it is not longer on the screen, in points.
constexpr double kPieceLength = 5.0;
constexpr int kSplitsMin = 5; // so that none is lost between places out of the picture
constexpr int kSplitsMax = 18;
constexpr std::size_t kPiecesMax = 6000; // of a leg

constexpr std::size_t kCirclePositions = 180;
constexpr double kSymbolPoints = 26.0; // half the length of the strike line on the screen

constexpr Rgb8 kCurrentColor{255, 221, 64};
constexpr Rgb8 kOtherColor{240, 240, 240};

QString kindName(MeasurementKind kind)
{
    const auto tr = [](const char* text) {
        return QCoreApplication::translate("MeasureController", text);
    };
    switch (kind) {
    case MeasurementKind::Distance:
        return tr(QT_TRANSLATE_NOOP("MeasureController", "Distance"));
    case MeasurementKind::Profile:
        return tr(QT_TRANSLATE_NOOP("MeasureController", "Profile"));
    case MeasurementKind::Area:
        return tr(QT_TRANSLATE_NOOP("MeasureController", "Area"));
    case MeasurementKind::Attitude:
        //: Strike and dip of a plane
        return tr(QT_TRANSLATE_NOOP("MeasureController", "Attitude"));
    case MeasurementKind::Crater:
        return tr(QT_TRANSLATE_NOOP("MeasureController", "Crater"));
    case MeasurementKind::Slope:
        break;
    }
    return tr(QT_TRANSLATE_NOOP("MeasureController", "Point"));
}

double distanceBetween(QPointF a, QPointF b)
{
    return std::hypot(a.x() - b.x(), a.y() - b.y());
}

} // namespace

// Between two states of the measurements.
class MeasureCommand final : public QUndoCommand {
public:
    MeasureCommand(MeasureController& controller,
                   MeasureState before,
                   MeasureState after,
                   const QString& text)
        : QUndoCommand(text)
        , controller_(controller)
        , before_(std::move(before))
        , after_(std::move(after))
    {}
    void undo() override { controller_.setState(before_); }
    void redo() override { controller_.setState(after_); }

private:
    MeasureController& controller_;
    MeasureState before_;
    MeasureState after_;
};

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

MeasureController::MeasureController(TerrainView& view, QUndoStack& undo_stack, QObject* parent)
    : QObject(parent)
    , view_(view)
    , undo_stack_(undo_stack)
{
    pool_.setMaxThreadCount(1);
    draw_timer_.setSingleShot(true);
    draw_timer_.setInterval(0);
    connect(&draw_timer_, &QTimer::timeout, this, &MeasureController::drawLines);
    const auto draw_soon = [this] { draw_timer_.start(); };
    connect(&view_, &TerrainView::sightChanged, this, draw_soon);
    connect(&view_, &TerrainView::exaggerationChanged, this, draw_soon);
    connect(&view_, &TerrainView::layersChanged, this, draw_soon);
    connect(&view_, &TerrainView::pictureCompleted, this, draw_soon); // finer ground has come
    view_.setPlaceTool(this);
}

MeasureController::~MeasureController()
{
    view_.setPlaceTool(nullptr);
    for (const auto& [item, job] : jobs_) {
        job->monitor.cancel();
    }
    pool_.clear();
    pool_.waitForDone();
}

const MeasureItem* MeasureController::itemOf(std::uint32_t id) const
{
    const auto hit = std::find_if(state_.items.begin(), state_.items.end(),
                                  [id](const MeasureItem& item) { return item.id == id; });
    return hit != state_.items.end() ? &*hit : nullptr;
}

MeasureItem* MeasureController::editable(MeasureState& state, std::uint32_t id) const
{
    const auto hit = std::find_if(state.items.begin(), state.items.end(),
                                  [id](const MeasureItem& item) { return item.id == id; });
    return hit != state.items.end() ? &*hit : nullptr;
}

const MeasureOutcome& MeasureController::outcome(std::uint32_t id) const
{
    static const MeasureOutcome kNone;
    const auto hit = outcomes_.find(id);
    return hit != outcomes_.end() ? hit->second : kNone;
}

const Layer* MeasureController::layerOf(const MeasureItem& item) const
{
    return marsview::layerOf(session_, item.layer);
}

void MeasureController::begin(MeasurementKind kind)
{
    if (const MeasureItem* item = current(); item != nullptr && !item->is_finished) {
        finish();
    }
    kind_ = kind;
    view_.setTool(Tool::Measure);
    Q_EMIT kindChanged(kind);
}

void MeasureController::push(MeasureState after, const QString& text)
{
    if (!(after == state_)) {
        undo_stack_.push(new MeasureCommand(*this, state_, std::move(after), text));
    }
}

// Measures what is not as it was.
void MeasureController::setState(MeasureState state)
{
    const MeasureState before = std::exchange(state_, std::move(state));
    for (const MeasureItem& item : state_.items) {
        const auto was =
            std::find_if(before.items.begin(), before.items.end(),
                         [&](const MeasureItem& other) { return other.id == item.id; });
        if (was == before.items.end() || was->vertices != item.vertices || was->kind != item.kind ||
            was->layer != item.layer) {
            measureAgain(item);
        }
    }
    std::erase_if(outcomes_, [this](const auto& entry) { return itemOf(entry.first) == nullptr; });
    std::erase_if(measured_on_,
                  [this](const auto& entry) { return itemOf(entry.first) == nullptr; });
    if (before.current != state_.current) {
        profile_cursor_m_.reset();
    }
    drawLines();
    Q_EMIT changed();
}

void MeasureController::select(std::uint32_t id)
{
    MeasureState state = state_; // not a step of undo
    state.current = itemOf(id) != nullptr ? id : 0;
    if (!(state == state_)) {
        setState(std::move(state));
    }
}

void MeasureController::remove(std::uint32_t id)
{
    const MeasureItem* item = itemOf(id);
    if (item == nullptr) {
        return;
    }
    const QString text = tr("Remove %1").arg(item->name);
    MeasureState state = state_;
    std::erase_if(state.items, [id](const MeasureItem& other) { return other.id == id; });
    if (state.current == id) {
        state.current = state.items.empty() ? 0 : state.items.back().id;
    }
    push(std::move(state), text);
}

void MeasureController::rename(std::uint32_t id, const QString& name)
{
    MeasureState state = state_;
    if (MeasureItem* item = editable(state, id); item != nullptr && !name.trimmed().isEmpty()) {
        item->name = name.trimmed();
        push(std::move(state), tr("Rename Measurement"));
    }
}

void MeasureController::setNote(std::uint32_t id, const QString& note)
{
    MeasureState state = state_;
    if (MeasureItem* item = editable(state, id)) {
        item->note = note.trimmed();
        push(std::move(state), tr("Edit Note"));
    }
}

void MeasureController::setColor(std::uint32_t id, const std::optional<Rgb8>& color)
{
    MeasureState state = state_;
    if (MeasureItem* item = editable(state, id)) {
        item->color = color;
        const QString text = tr("Color of %1").arg(item->name);
        push(std::move(state), text);
    }
}

void MeasureController::removeAll()
{
    MeasureState state = state_;
    state.items.clear();
    state.current = 0;
    push(std::move(state), tr("Remove All Measurements"));
}

void MeasureController::addPointAt(GridPoint grid)
{
    view_.setTool(Tool::Measure);
    RayHit hit;
    hit.grid = grid;
    if (const auto place = placeOf(hit)) {
        addPoint(*place);
    }
}

void MeasureController::removeLastPoint()
{
    MeasureState state = state_;
    MeasureItem* item = editable(state, state.current);
    if (item == nullptr) {
        return;
    }
    if (item->vertices.size() <= 1) {
        remove(item->id);
        return;
    }
    item->vertices.pop_back();
    push(std::move(state), tr("Remove Point"));
}

void MeasureController::finish()
{
    MeasureState state = state_;
    MeasureItem* item = editable(state, state.current);
    if (item == nullptr || item->is_finished) {
        return;
    }
    if (item->vertices.size() < verticesNeeded(item->kind)) {
        remove(item->id);
        return;
    }
    item->is_finished = true;
    setState(std::move(state)); // with the last point, not a step of undo of its own
}

void MeasureController::movePoint(std::uint32_t id, std::size_t index, const MeasuredVertex& vertex)
{
    MeasureState state = state_;
    MeasureItem* item = editable(state, id);
    if (item != nullptr && index < item->vertices.size()) {
        item->vertices[index] = vertex;
        push(std::move(state), tr("Move Point"));
    }
}

std::vector<ProjectMeasurement> MeasureController::saved() const
{
    const std::vector<LayerId> order = projectOrder(session_);
    std::vector<ProjectMeasurement> saved;
    for (const MeasureItem& item : state_.items) {
        if (item.vertices.size() < verticesNeeded(item.kind)) {
            continue;
        }
        const auto layer = std::find(order.begin(), order.end(), item.layer);
        saved.push_back(
            {.kind = item.kind,
             .name = item.name.toStdString(),
             .layer = layer != order.end()
                          ? std::optional(static_cast<std::size_t>(layer - order.begin()))
                          : std::nullopt,
             .vertices = item.vertices,
             .time = DrawnTime(std::chrono::milliseconds(item.time.toMSecsSinceEpoch())),
             .note = item.note.toStdString(),
             .color = item.color});
    }
    return saved;
}

std::vector<NamedMeasurement> MeasureController::named() const
{
    std::vector<NamedMeasurement> all;
    for (const MeasureItem& item : state_.items) {
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
    named.measurement.time = std::chrono::system_clock::time_point(
        std::chrono::milliseconds(item->time.toMSecsSinceEpoch()));
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
    MeasureState state;
    for (const ProjectMeasurement& measurement : saved) {
        MeasureItem item;
        item.id = state.next_id++;
        item.kind = measurement.kind;
        item.name = QString::fromStdString(measurement.name);
        item.layer = measurement.layer && *measurement.layer < layers.size()
                         ? layers[*measurement.layer]
                         : LayerId::None;
        item.vertices = measurement.vertices;
        item.is_finished = true;
        item.note = QString::fromStdString(measurement.note);
        item.color = measurement.color;
        item.time = QDateTime::fromMSecsSinceEpoch(measurement.time.time_since_epoch().count());
        state.items.push_back(std::move(item));
    }
    grabbed_.reset();
    // Results of items that have the same numbers are not those of these.
    setState({});
    setState(std::move(state));
}

void MeasureController::setSession(const Session& session)
{
    session_ = session;
    for (const MeasureItem& item : state_.items) {
        const Layer* layer = layerOf(item);
        const auto measured = measured_on_.find(item.id);
        if (layer != nullptr &&
            (measured == measured_on_.end() || measured->second != layer->map)) {
            measureAgain(item);
        }
    }
    draw_timer_.start();
    Q_EMIT changed(); // names of layers
}

// Places ------------------------------------------------------------------------------------------

std::optional<MeasureController::Place> MeasureController::placeOf(const RayHit& hit) const
{
    // The scene is that of the topmost map.
    if (!geometry_ || geometry_map_ != view_.map()) {
        return std::nullopt;
    }
    const auto vertex = vertexAt(geometry_map_->georeference(), hit.grid);
    for (const Layer& layer : session_.layers) {
        if (vertex && layer.map == geometry_map_) {
            return Place{*vertex, layer.id};
        }
    }
    return std::nullopt;
}

std::optional<LayerId> MeasureController::layerSeenAt(QPointF position) const
{
    if (const auto ground = view_.groundUnder(position)) {
        const auto& map = view_.ground().maps()[ground->index].map;
        for (const Layer& layer : session_.layers) {
            if (layer.map == map) {
                return layer.id;
            }
        }
    }
    return std::nullopt;
}

// On the layer that is seen there, whatever layer is selected.
std::optional<MeasureController::Place> MeasureController::placeAt(QPointF position) const
{
    const auto hit = view_.surfaceAt(position);
    std::optional<Place> place = hit ? placeOf(*hit) : std::nullopt;
    if (place) {
        place->layer = layerSeenAt(position).value_or(place->layer);
    }
    return place;
}

// The same by crosshair, stylus or hand.
std::optional<MeasureController::Place> MeasureController::placeRead() const
{
    const auto hit = view_.reading();
    std::optional<Place> place = hit ? placeOf(*hit) : std::nullopt;
    if (const auto position = place ? screenPoint(place->vertex) : std::nullopt) {
        place->layer = layerSeenAt(*position).value_or(place->layer);
    }
    return place;
}

std::optional<ScenePoint> MeasureController::scenePoint(GroundPosition position) const
{
    const auto grid = geometry_ ? geometry_->toGrid(position) : std::nullopt;
    if (!grid) {
        return std::nullopt;
    }
    ScenePoint point = geometry_map_->georeference().sceneFrame().toScene(*grid, 0.0);
    point.z = view_.ground().height(point.x, point.y) * view_.exaggeration();
    return std::isfinite(point.z) ? std::optional(point) : std::nullopt;
}

std::optional<GroundPosition> MeasureController::positionOf(const MeasuredVertex& vertex) const
{
    const auto* geographic = std::get_if<GeographicPoint>(&vertex);
    if (!geometry_ || (geographic != nullptr) != geometry_->ground().ellipsoid().has_value()) {
        return std::nullopt;
    }
    return geographic != nullptr ? geometry_->ground().position(*geographic)
                                 : geometry_->fromMap(std::get<MapPoint>(vertex));
}

std::optional<ScenePoint> MeasureController::scenePoint(const MeasuredVertex& vertex) const
{
    const auto position = positionOf(vertex);
    return position ? scenePoint(*position) : std::nullopt;
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
        const auto from = positionOf(item.vertices[i]);
        const auto to = positionOf(item.vertices[i + 1]);
        if (!from || !to) {
            return {};
        }
        const GroundLine line = geometry_->ground().line(*from, *to);
        for (int step = path.empty() ? 0 : 1; step <= kStepsOfLeg; ++step) {
            add(scenePoint(line.at(line.lengthM() * step / kStepsOfLeg)));
        }
    }
    return path;
}

// The tool ----------------------------------------------------------------------------------------

void MeasureController::addPoint(const Place& place)
{
    MeasureState state = state_;
    MeasureItem* item = editable(state, state.current);
    if (item == nullptr || item->is_finished) {
        MeasureItem fresh;
        fresh.id = state.next_id++;
        fresh.kind = kind_;
        fresh.name = QStringLiteral("%1 %2").arg(kindName(kind_)).arg(fresh.id);
        fresh.layer = place.layer;
        fresh.time = QDateTime::currentDateTime();
        state.items.push_back(std::move(fresh));
        item = &state.items.back();
        state.current = item->id;
    }
    item->vertices.push_back(place.vertex);
    item->is_finished = item->kind == MeasurementKind::Slope;
    push(std::move(state), tr("Add Point to %1").arg(item->name));
}

bool MeasureController::grab(QPointF position)
{
    for (const MeasureHandle& handle : handles()) {
        if (distanceBetween(handle.place, position) <= kHandleReach) {
            select(handle.item);
            grabbed_ = Grabbed{handle.item, handle.index, state_};
            return true;
        }
    }
    // Between two points of the current item, once it is finished, a drag inserts one.
    const MeasureItem* item = current();
    if (item == nullptr || !item->is_finished || (!item->isLine() && !item->isClosed())) {
        return false;
    }
    for (const Leg& leg : legs_) {
        if (leg.item != item->id) {
            continue;
        }
        for (const ScenePoint& point : leg.points) {
            const auto place = view_.positionOfPlace(point);
            const auto there = place && distanceBetween(*place, position) <= kHandleReach
                                   ? placeAt(position)
                                   : std::nullopt;
            if (there) {
                grabbed_ = Grabbed{item->id, leg.index + 1, state_};
                MeasureState state = state_;
                MeasureItem& changed_item = *editable(state, item->id);
                changed_item.vertices.insert(changed_item.vertices.begin() +
                                                 static_cast<std::ptrdiff_t>(leg.index + 1),
                                             there->vertex);
                setState(std::move(state));
                return true;
            }
        }
    }
    return false;
}

void MeasureController::drag(QPointF position)
{
    const auto place = placeAt(position);
    MeasureState state = state_;
    MeasureItem* item = grabbed_ ? editable(state, grabbed_->item) : nullptr;
    if (place && item != nullptr && grabbed_->index < item->vertices.size()) {
        item->vertices[grabbed_->index] = place->vertex;
        setState(std::move(state));
    }
}

void MeasureController::release()
{
    if (!grabbed_) {
        return;
    }
    const Grabbed grabbed = *std::exchange(grabbed_, std::nullopt);
    MeasureState after = std::exchange(state_, grabbed.before);
    const bool is_inserted =
        grabbed.before.items.size() == after.items.size() && itemOf(grabbed.item) != nullptr &&
        editable(after, grabbed.item)->vertices.size() != itemOf(grabbed.item)->vertices.size();
    if (after == state_) {
        return;
    }
    push(std::move(after), is_inserted ? tr("Insert Point") : tr("Move Point"));
}

void MeasureController::click(QPointF position)
{
    if (const auto place = placeAt(position)) {
        addPoint(*place);
    }
}

void MeasureController::doubleClick(QPointF /*position*/)
{
    finish(); // the first of the two clicks placed the point
}

void MeasureController::hover(std::optional<QPointF> position)
{
    pointer_ = position;
    const MeasureItem* item = current();
    if (item != nullptr && !item->is_finished) {
        draw_timer_.start(); // the line to the pointer
        return;
    }
    std::optional<double> hovered_m;
    double nearest = kHandleReach;
    for (const Leg& leg : legs_) {
        if (!position || item == nullptr || leg.item != item->id || !item->isLine()) {
            continue;
        }
        for (std::size_t i = 0; i < leg.points.size(); ++i) {
            const auto place = view_.positionOfPlace(leg.points[i]);
            const double away = place ? distanceBetween(*place, *position) : nearest;
            if (away < nearest) {
                nearest = away;
                hovered_m = leg.begin_m + leg.distances_m[i];
            }
        }
    }
    if (hovered_m || profile_cursor_m_) {
        Q_EMIT lineHovered(hovered_m);
    }
}

bool MeasureController::key(const QKeyEvent& event)
{
    const MeasureItem* item = current();
    const bool is_open = item != nullptr && !item->is_finished;
    switch (event.key()) {
    case Qt::Key_Return:
    case Qt::Key_Enter: {
        const auto place = placeRead();
        const auto here = place ? screenPoint(place->vertex) : std::nullopt;
        const auto last = is_open ? screenPoint(item->vertices.back()) : std::optional<QPointF>();
        if (here && last && distanceBetween(*here, *last) <= kSamePlace) {
            finish();
        } else if (place) {
            addPoint(*place);
        }
        return true;
    }
    case Qt::Key_Backspace:
        removeLastPoint();
        return true;
    case Qt::Key_Delete:
        if (item == nullptr) {
            return false;
        }
        remove(item->id);
        return true;
    case Qt::Key_Escape:
        if (is_open) {
            remove(item->id);
            return true;
        }
        if (item != nullptr) {
            select(0);
            return true;
        }
        return false;
    default:
        return false;
    }
}

// The picture -------------------------------------------------------------------------------------

// Splits the line until its parts are short on the screen.
void MeasureController::addLeg(const GroundLine& line, Leg leg)
{
    struct Mark {
        double distance_m = 0.0;
        std::optional<ScenePoint> point;
        std::optional<QPointF> screen;
    };
    const auto mark_at = [&](double distance_m) {
        Mark mark{distance_m, scenePoint(line.at(distance_m)), std::nullopt};
        if (mark.point) {
            mark.screen = view_.positionOfPlace(*mark.point);
        }
        return mark;
    };
    const QRectF sight = QRectF(view_.rect());
    // Both on the same side of the picture.
    const auto is_outside = [&](const Mark& a, const Mark& b) {
        if (!a.screen || !b.screen) {
            return !a.screen && !b.screen;
        }
        return (a.screen->x() < sight.left() && b.screen->x() < sight.left()) ||
               (a.screen->x() > sight.right() && b.screen->x() > sight.right()) ||
               (a.screen->y() < sight.top() && b.screen->y() < sight.top()) ||
               (a.screen->y() > sight.bottom() && b.screen->y() > sight.bottom());
    };
    const auto end_run = [&] {
        if (leg.points.size() > 1) {
            legs_.push_back(leg);
        }
        leg.points.clear();
        leg.distances_m.clear();
    };
    std::size_t pieces = 0;
    const auto add = [&](const Mark& mark) {
        if (!mark.point) {
            end_run(); // no terrain there
            return;
        }
        leg.points.push_back(*mark.point);
        leg.distances_m.push_back(mark.distance_m);
        ++pieces;
    };
    const auto split = [&](const auto& self, const Mark& a, const Mark& b, int depth) -> void {
        const bool is_short =
            a.screen && b.screen && distanceBetween(*a.screen, *b.screen) <= kPieceLength;
        const bool is_enough = depth >= kSplitsMax || pieces >= kPiecesMax ||
                               (depth >= kSplitsMin && (is_short || is_outside(a, b)));
        if (is_enough) {
            add(b);
            return;
        }
        const Mark middle = mark_at(0.5 * (a.distance_m + b.distance_m));
        self(self, a, middle, depth + 1);
        self(self, middle, b, depth + 1);
    };
    const Mark first = mark_at(0.0);
    const Mark last = mark_at(line.lengthM());
    add(first);
    split(split, first, last, 0);
    end_run();
}

// The strike line with a tick down the dip, through the middle of the points.
Rgb8 MeasureController::colorOf(const MeasureItem& item) const
{
    return item.color.value_or(item.id == state_.current ? kCurrentColor : kOtherColor);
}

void MeasureController::addSymbol(std::vector<DrapedLine>& lines, const MeasureItem& item) const
{
    const auto* attitude = outcome(item.id).as<Attitude>();
    const auto center = attitude != nullptr ? scenePoint(attitude->center) : std::nullopt;
    if (!center || !std::isfinite(attitude->strike_deg)) {
        return;
    }
    const double half_m = kSymbolPoints * view_.devicePixelRatioF() *
                          metersPerPixel(view_.camera(), view_.viewport(), *center);
    const auto away = [&](double azimuth_deg, double length_m) {
        return scenePoint(geometry_->ground().ray(attitude->center, azimuth_deg).at(length_m));
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

void MeasureController::drawLines()
{
    draw_timer_.stop();
    if (geometry_map_ != view_.map()) {
        geometry_map_ = view_.map();
        geometry_ =
            geometry_map_
                ? std::make_unique<MeasuredTerrain>(geometry_map_->georeference(),
                                                    readSamples(geometry_map_->heightfield()))
                : nullptr;
    }
    legs_.clear();
    if (!geometry_) {
        view_.setLines({});
        Q_EMIT moved();
        return;
    }
    const Ground& ground = geometry_->ground();
    const auto place_of_pointer = pointer_ && !grabbed_ ? placeAt(*pointer_) : std::nullopt;
    for (const MeasureItem& item : state_.items) {
        const Layer* layer = layerOf(item);
        if (layer == nullptr || !layer->is_visible || item.kind == MeasurementKind::Slope) {
            continue;
        }
        std::vector<GroundPosition> corners;
        for (const MeasuredVertex& vertex : item.vertices) {
            if (const auto position = positionOf(vertex)) {
                corners.push_back(*position);
            }
        }
        const bool is_open = item.id == state_.current && !item.is_finished;
        if (is_open && place_of_pointer) {
            if (const auto position = positionOf(place_of_pointer->vertex)) {
                corners.push_back(*position);
            }
        }
        if (item.kind == MeasurementKind::Attitude) {
            continue; // points and a symbol
        }
        if (item.kind == MeasurementKind::Crater) {
            const auto* crater = outcome(item.id).as<Crater>();
            if (crater == nullptr) {
                continue;
            }
            corners = circleOn(ground, crater->center, 0.5 * crater->diameter_m, kCirclePositions);
        }
        const bool is_closed = !item.isLine() && corners.size() > 2;
        double begin_m = 0.0;
        for (std::size_t i = 0; i + (is_closed ? 0 : 1) < corners.size(); ++i) {
            const GroundLine line = ground.line(corners[i], corners[(i + 1) % corners.size()]);
            addLeg(
                line,
                {.item = item.id, .index = i, .begin_m = begin_m, .points = {}, .distances_m = {}});
            begin_m += line.lengthM();
        }
    }
    std::vector<DrapedLine> lines;
    for (const bool is_current : {false, true}) { // the current one over the others
        for (const Leg& leg : legs_) {
            if ((leg.item == state_.current) == is_current) {
                const MeasureItem* item = itemOf(leg.item);
                lines.push_back({.points = leg.points,
                                 .color = item != nullptr ? colorOf(*item) : kOtherColor,
                                 .width_points = is_current ? 2.5 : 1.8});
            }
        }
    }
    for (const MeasureItem& item : state_.items) {
        if (item.kind == MeasurementKind::Attitude && layerOf(item) != nullptr) {
            addSymbol(lines, item);
        }
    }
    view_.setLines(std::move(lines));
    Q_EMIT moved();
}

std::vector<MeasureHandle> MeasureController::handles() const
{
    std::vector<MeasureHandle> handles;
    for (const MeasureItem& item : state_.items) {
        const Layer* layer = layerOf(item);
        if (layer == nullptr || !layer->is_visible) {
            continue;
        }
        for (std::size_t i = 0; i < item.vertices.size(); ++i) {
            const auto point = scenePoint(item.vertices[i]);
            const auto place = point ? view_.positionOfPlace(*point) : std::nullopt;
            if (!place || !QRectF(view_.rect()).contains(*place)) {
                continue;
            }
            // The ground in front of it, if any, is nearer by more than the picture's error.
            const ScenePoint eye = eyeOf(view_.camera());
            const double way_m = length(*point - eye);
            const auto seen = view_.ground().cast(
                Ray{.origin = eye, .direction = normalized(*point - eye)}, view_.exaggeration());
            handles.push_back({.place = *place,
                               .item = item.id,
                               .index = i,
                               .is_hidden = seen && seen->distance_m < 0.99 * way_m});
        }
    }
    // The current ones are grabbed first and drawn last.
    std::stable_partition(handles.begin(), handles.end(), [this](const MeasureHandle& handle) {
        return handle.item == state_.current;
    });
    return handles;
}

std::optional<QPointF> MeasureController::labelPlace(std::uint32_t id) const
{
    const MeasureItem* item = itemOf(id);
    const Layer* layer = item != nullptr ? layerOf(*item) : nullptr;
    if (layer == nullptr || !layer->is_visible || item->vertices.empty()) {
        return std::nullopt;
    }
    if (const auto* attitude = outcome(id).as<Attitude>()) {
        return screenPoint(attitude->center);
    }
    if (const auto* crater = outcome(id).as<Crater>()) {
        return screenPoint(crater->center);
    }
    return screenPoint(item->vertices.back());
}

void MeasureController::setProfileCursor(std::optional<double> distance_m)
{
    profile_cursor_m_ = distance_m;
    Q_EMIT moved();
}

std::optional<QPointF> MeasureController::profileCursorPlace() const
{
    const MeasureItem* item = current();
    if (!profile_cursor_m_ || item == nullptr || !geometry_) {
        return std::nullopt;
    }
    double begin_m = 0.0;
    for (std::size_t i = 0; i + 1 < item->vertices.size(); ++i) {
        const auto from = positionOf(item->vertices[i]);
        const auto to = positionOf(item->vertices[i + 1]);
        if (!from || !to) {
            return std::nullopt;
        }
        const GroundLine line = geometry_->ground().line(*from, *to);
        if (*profile_cursor_m_ <= begin_m + line.lengthM() || i + 2 == item->vertices.size()) {
            return screenPoint(line.at(*profile_cursor_m_ - begin_m));
        }
        begin_m += line.lengthM();
    }
    return std::nullopt;
}

void MeasureController::show(std::uint32_t id)
{
    const MeasureItem* item = itemOf(id);
    if (item == nullptr) {
        return;
    }
    select(id);
    ScenePoint low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                   0.0};
    ScenePoint high{-low.x, -low.y, 0.0};
    for (const MeasuredVertex& vertex : item->vertices) {
        if (const auto point = scenePoint(vertex)) {
            low = {std::min(low.x, point->x), std::min(low.y, point->y), point->z};
            high = {std::max(high.x, point->x), std::max(high.y, point->y), point->z};
        }
    }
    if (!(low.x <= high.x)) {
        return;
    }
    OrbitCamera camera = view_.cameraGoal();
    camera.target = {0.5 * (low.x + high.x), 0.5 * (low.y + high.y), 0.5 * (low.z + high.z)};
    const double extent_m = std::hypot(high.x - low.x, high.y - low.y);
    if (extent_m > 0.0) {
        camera.distance_m = 1.8 * extent_m;
    }
    view_.flyTo(camera);
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
    draw_timer_.start();
    Q_EMIT measured(id);
}

} // namespace marsview
