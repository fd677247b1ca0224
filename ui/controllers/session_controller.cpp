#include "ui/controllers/session_controller.h"

#include "core/raster/sample_suggestions.h"
#include "core/session/range_in_picture.h"
#include "core/view/exaggeration.h"
#include "ui/canvas/terrain_view.h"
#include "ui/text/number_text.h"

#include <QFileInfo>

#include <algorithm>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

// Undone layers keep their samples in memory.
constexpr int kUndoStepsMax = 100;

// Places at which a layer is looked for on screen, along each side.
constexpr int kMiddleProbes = 5;

QString nameOf(const Layer& layer)
{
    return QString::fromStdString(layer.name);
}

bool isSame(const std::vector<ShownLayer>& a, const std::vector<ShownLayer>& b)
{
    return std::equal(
        a.begin(), a.end(), b.begin(), b.end(), [](const ShownLayer& x, const ShownLayer& y) {
            const HeightRange a_range = colorRangeOf(x);
            const HeightRange b_range = colorRangeOf(y);
            return x.map == y.map && x.ramp == y.ramp &&
                   marsview::slopeRangeOf(x) == marsview::slopeRangeOf(y) &&
                   a_range.minimum_m == b_range.minimum_m && a_range.maximum_m == b_range.maximum_m;
        });
}

GridPoint placeOn(const Map& map, double column_share, double row_share)
{
    return {column_share * static_cast<double>(map.heightfield().columns() - 1),
            row_share * static_cast<double>(map.heightfield().rows() - 1)};
}

// From where the larger side of a map fills most of a picture that is 40° high.
double distanceToSee(const Map& map)
{
    const Georeference& georeference = map.georeference();
    const double side_m =
        std::max(static_cast<double>(georeference.columns()) * georeference.pixelWidthMeters(),
                 static_cast<double>(georeference.rows()) * georeference.pixelHeightMeters());
    return 1.2 * side_m / (2.0 * std::tan(Angle::degrees(20.0).radians()));
}

} // namespace

// With a layer in the picture: on top if it cannot be shown together with the current layers.
Session SessionController::withLayerShown(const Session& session, LayerId id)
{
    Session after = withVisibility(session, id, true);
    const std::vector<LayerState> states = placement(after);
    return states[indexOf(after, id)] == LayerState::Shown
               ? after
               : activated(moved(std::move(after), id, 0), id);
}

const ColorRamp& rampOf(const Layer& layer)
{
    const ColorRamp* ramp = colorRampNamed(layer.ramp);
    const Body* body = layer.map->info().body;
    return ramp != nullptr ? *ramp
                           : defaultColorRamp(body != nullptr ? body->name : std::string_view{});
}

SessionController::SessionController(TerrainView& view, QObject* parent)
    : QObject(parent)
    , view_(view)
    , loader_(new LoadController(this))
    , preparer_(new MapPreparer(this))
{
    undo_stack_.setUndoLimit(kUndoStepsMax);
    connect(&view_, &TerrainView::mapShown, this, &SessionController::revealWhatCame);
    connect(loader_, &LoadController::progressed, this, [this](double fraction) {
        if (current_) {
            Q_EMIT loadProgressed({.file = QString::fromStdString(current_->spec.path),
                                   .fraction = fraction,
                                   .position = begun_count_,
                                   .count = asked_count_});
        }
    });
    connect(loader_, &LoadController::succeeded, this, &SessionController::accept);
    connect(loader_, &LoadController::failed, this, [this](const LoadFailure& failure) {
        // Without those samples the map would be empty. A copy: accept() ends the load with the
        // map.
        if (const std::shared_ptr<const Map> declared = current_->as_declared) {
            accept(declared);
            return;
        }
        const Load load = *std::exchange(current_, std::nullopt);
        const QString problem = QString::fromStdString(failure.error.message);
        if (load.purpose == Load::Purpose::Complete) {
            endPreparing({.how = Ending::How::Failed, .spec = load.spec, .problem = problem});
        } else if (load.purpose == Load::Purpose::Override) {
            Q_EMIT overrideFailed(load.layer, problem);
        } else if (load.purpose == Load::Purpose::Project) {
            keepMissing(load.layer, problem);
        } else {
            Q_EMIT failed(problem);
        }
        endLoad();
    });
    connect(preparer_, &MapPreparer::progressed, this, &SessionController::preparingProgressed);
    connect(preparer_, &MapPreparer::ended, this, &SessionController::preparingEnded);
    connect(
        preparer_, &MapPreparer::previewed, this, [this](const std::shared_ptr<const Map>& map) {
            std::vector<std::shared_ptr<const Map>> rough;
            for (const Layer& layer : session_.layers) {
                if (layer.map->kind() == MapKind::RoughPreview && isOfSameMap(*layer.map, *map)) {
                    rough.push_back(layer.map);
                }
            }
            for (const auto& preview : rough) {
                replacePreview(preview, map);
            }
        });
    connect(preparer_, &MapPreparer::prepared, this, [this](const RasterSpec& spec) {
        endPreparing({.how = Ending::How::Done, .spec = spec});
    });
    connect(preparer_, &MapPreparer::failed, this, [this](const LoadFailure& failure) {
        endPreparing({.how = Ending::How::Failed,
                      .spec = failure.spec,
                      .problem = QString::fromStdString(failure.error.message)});
    });
}

void SessionController::setOpener(const MapOpener& opener)
{
    loader_->setOpener(opener);
    preparer_->setOpener(opener);
}

SessionController::~SessionController()
{
    are_previews_left_alone_ = true;
}

void SessionController::open(const QStringList& files)
{
    openFiles(files, false);
}

void SessionController::openAtStart(const QStringList& files)
{
    openFiles(files, true);
}

void SessionController::openFiles(const QStringList& files, bool is_at_start)
{
    if (files.isEmpty()) {
        return;
    }
    are_previews_left_alone_ = false;
    // The sample is for people who have nothing of their own to look at.
    std::erase_if(waiting_, [](const Load& load) { return load.purpose == Load::Purpose::Sample; });
    if (current_ && current_->purpose == Load::Purpose::Sample) {
        current_.reset();
        loader_->cancel();
    }
    for (const QString& file : files) {
        enqueue({.purpose = Load::Purpose::Open,
                 .spec = {.path = file.toStdString()},
                 .is_at_start = is_at_start});
    }
    startNext();
}

void SessionController::openSample(const QString& file)
{
    if (session_.layers.empty() && !isBusy()) {
        enqueue({.purpose = Load::Purpose::Sample, .spec = {.path = file.toStdString()}});
        startNext();
    }
}

void SessionController::overrideGeoreferencing(LayerId id, const RasterOverrides& overrides)
{
    const Layer* layer = layerOf(session_, id);
    if (layer == nullptr) {
        return;
    }
    Load load{.purpose = Load::Purpose::Override, .spec = layer->map->spec(), .layer = id};
    load.spec.overrides = overrides;
    enqueue(std::move(load));
    startNext();
}

void SessionController::openProject(const Project& project)
{
    waiting_.clear();
    current_.reset();
    loader_->cancel();
    are_previews_left_alone_ = false;
    replaced_sample_.reset();
    is_sample_adopted_ = false;
    to_reveal_ = LayerId::None;
    project_active_ = LayerId::None;
    undo_stack_.clear();
    Session session;
    session.look = project.look;
    session.order = project.order;
    session.overlays = project.overlays;
    session.next_id = session_.next_id;
    session.next_view_id = session_.next_view_id;
    std::vector<LayerId> ids;
    for (std::size_t i = 0; i < project.layers.size(); ++i) {
        const LayerId id{session.next_id};
        ids.push_back(id);
        session =
            withMissing(std::move(session), {.id = id, .record = project.layers[i], .index = i});
        if (project.active == i) {
            project_active_ = id;
        }
    }
    for (SavedView& view : savedViews(project.views, ids, session.next_view_id)) {
        session = withView(std::move(session), std::move(view));
    }
    apply(session);
    for (const MissingLayer& missing : session.missing) {
        enqueue(
            {.purpose = Load::Purpose::Project, .spec = missing.record.spec, .layer = missing.id});
    }
    endLoad();
}

void SessionController::locate(LayerId id, const QString& file)
{
    if (const MissingLayer* missing = missingLayer(id)) {
        Load load{.purpose = Load::Purpose::Locate, .spec = missing->record.spec, .layer = id};
        load.spec.path = file.toStdString();
        enqueue(std::move(load));
        startNext();
    }
}

void SessionController::removeMissing(LayerId id)
{
    if (const MissingLayer* missing = missingLayer(id)) {
        //: Continues "Undo …"; %1 is a layer
        change(tr("Remove %1").arg(QString::fromStdString(missing->record.name)),
               withoutMissing(session_, id));
        dropLoadsOf(id);
    }
}

const MissingLayer* SessionController::missingLayer(LayerId id) const
{
    const auto missing = std::find_if(session_.missing.begin(), session_.missing.end(),
                                      [id](const MissingLayer& one) { return one.id == id; });
    return missing != session_.missing.end() ? &*missing : nullptr;
}

// A layer of a project that is loaded, or a missing one that was located.
void SessionController::acceptMissing(const Load& load, const std::shared_ptr<const Map>& map)
{
    const MissingLayer* missing = missingLayer(load.layer);
    if (missing == nullptr || layerOf(session_, load.layer) != nullptr) {
        return;
    }
    Session after = withProjectLayer(session_, layerFrom(missing->record, map), load.layer);
    if (load.layer == project_active_) {
        after = activated(std::move(after), load.layer);
    }
    const QString name = QString::fromStdString(layerOf(after, load.layer)->name);
    if (load.purpose == Load::Purpose::Locate) {
        //: Continues "Undo …"; %1 is a layer
        change(tr("Locate %1").arg(name), after);
    } else {
        //: Continues "Undo …"; %1 is a layer
        changeWhileOpening(tr("Open %1").arg(name), after);
    }
}

void SessionController::keepMissing(LayerId id, const QString& problem)
{
    if (const MissingLayer* missing = missingLayer(id)) {
        MissingLayer with_problem = *missing;
        with_problem.problem = problem.toStdString();
        //: Continues "Undo …"; %1 is a layer
        changeWhileOpening(tr("Keep %1").arg(QString::fromStdString(missing->record.name)),
                           withMissing(session_, std::move(with_problem)));
    }
}

// Not a step of undo, unless the user has changed something since the project was opened: undoing
// that would otherwise lose layers that were loaded later.
void SessionController::changeWhileOpening(const QString& text, const Session& after)
{
    if (undo_stack_.count() == 0) {
        apply(after);
    } else {
        change(text, after);
    }
}

void SessionController::enqueue(Load load)
{
    if (!isBusy()) {
        asked_count_ = 0;
        begun_count_ = 0;
    }
    ++asked_count_;
    waiting_.push_back(std::move(load));
}

void SessionController::startNext()
{
    if (current_ || waiting_.empty()) {
        return;
    }
    current_ = std::move(waiting_.front());
    waiting_.pop_front();
    ++begun_count_;
    const Layer* layer = layerOf(session_, current_->layer);
    const bool is_known = layer != nullptr && current_->purpose == Load::Purpose::Override;
    loader_->start({.spec = current_->spec, .loaded = is_known ? layer->map : nullptr});
}

void SessionController::endLoad()
{
    startNext();
    if (!isBusy()) {
        Q_EMIT loadingEnded();
    }
}

void SessionController::cancel()
{
    if (!isBusy()) {
        return;
    }
    std::vector<Load> dropped(waiting_.begin(), waiting_.end());
    if (current_) {
        dropped.push_back(*current_);
    }
    waiting_.clear();
    current_.reset();
    loader_->cancel();
    for (const Load& load : dropped) {
        if (load.purpose == Load::Purpose::Complete) {
            endPreparing({.how = Ending::How::Stopped, .spec = load.spec});
        } else if (load.purpose == Load::Purpose::Project) {
            //: %1 is a file
            keepMissing(load.layer,
                        tr("%1: loading was canceled").arg(QString::fromStdString(load.spec.path)));
        }
    }
    Q_EMIT loadingCanceled();
    Q_EMIT loadingEnded();
}

// Drops loads for a layer that was removed.
void SessionController::dropLoadsOf(LayerId id)
{
    const bool was_busy = isBusy();
    std::erase_if(waiting_, [id](const Load& load) { return load.layer == id; });
    if (current_ && current_->layer == id) {
        current_.reset();
        loader_->cancel();
    }
    if (was_busy) {
        endLoad();
    }
}

void SessionController::accept(const std::shared_ptr<const Map>& map)
{
    const Load load = *std::exchange(current_, std::nullopt);
    if (load.purpose == Load::Purpose::Complete) {
        acceptComplete(load, map);
        endLoad();
        return;
    }
    if (map->isPreview()) {
        forgetEnding(load.spec); // whatever became of it before, it is wanted now
    }
    if (load.purpose == Load::Purpose::Project || load.purpose == Load::Purpose::Locate) {
        acceptMissing(load, map);
        endLoad();
        return;
    }
    if (load.purpose == Load::Purpose::Override) {
        if (const Layer* layer = layerOf(session_, load.layer)) {
            //: Continues "Undo …"; %1 is a layer
            change(tr("Georeferencing of %1").arg(nameOf(*layer)),
                   withMap(session_, load.layer, map));
        }
    } else if (openAgainWithNodata(load, map)) {
        return;
    } else {
        const bool is_sample = load.purpose == Load::Purpose::Sample;
        Layer top{.map = map, .is_sample = is_sample};
        if (const Body* body = map->info().body; is_sample && body != nullptr) {
            top.name = body->name; // the user did not choose that file
        }
        Session before = session_;
        for (Layer& layer : before.layers) {
            layer.is_sample = layer.is_sample && !is_sample_adopted_;
        }
        const Session after = added(before, std::move(top));
        to_reveal_ = after.active;
        if (load.as_declared && load.as_declared != map) {
            assumed_nodata_.push_back({.layer = after.active, .raw = *load.spec.overrides.nodata});
        }
        for (const Layer& layer : before.layers) {
            if (layer.is_sample && !is_sample) {
                replaced_sample_ = layer;
            }
        }
        if ((is_sample || load.is_at_start) && undo_stack_.count() == 0) {
            apply(after);
        } else {
            //: Continues "Undo …"; %1 is a layer
            change(tr("Open %1").arg(nameOf(after.layers.front())), after);
        }
        if (!is_sample) {
            Q_EMIT opened(QString::fromStdString(load.spec.path));
        }
    }
    endLoad();
}

// The first picture of a map would be a slab over a pit of what is certainly no elevation.
bool SessionController::openAgainWithNodata(const Load& load, const std::shared_ptr<const Map>& map)
{
    const std::optional<double> nodata = certainNodata(map->info());
    if (!nodata || load.purpose != Load::Purpose::Open || load.as_declared) {
        return false;
    }
    Load again = load;
    again.spec.overrides.nodata = nodata;
    again.as_declared = map;
    waiting_.push_front(std::move(again));
    --begun_count_; // it is the same file
    startNext();
    return true;
}

bool SessionController::isNodataAssumed(const Layer& layer) const
{
    return std::any_of(
        assumed_nodata_.begin(), assumed_nodata_.end(), [&layer](const AssumedNodata& assumed) {
            return assumed.layer == layer.id && layer.map->spec().overrides.nodata == assumed.raw;
        });
}

void SessionController::remove(LayerId id)
{
    if (const Layer* layer = layerOf(session_, id)) {
        //: Continues "Undo …"; %1 is a layer
        const QString text = tr("Remove %1").arg(nameOf(*layer));
        change(text, removed(session_, id));
        dropLoadsOf(id);
    }
}

void SessionController::move(LayerId id, std::size_t index)
{
    if (const Layer* layer = layerOf(session_, id)) {
        //: Continues "Undo …"; %1 is a layer
        change(tr("Move %1").arg(nameOf(*layer)), activated(moved(session_, id, index), id));
    }
}

void SessionController::setVisible(LayerId id, bool is_visible)
{
    if (const Layer* layer = layerOf(session_, id)) {
        //: Continues "Undo …"; %1 is a layer
        const QString text = is_visible ? tr("Show %1") : tr("Hide %1");
        const QString name = nameOf(*layer);
        const Session after =
            is_visible ? withLayerInScene(*layer) : withVisibility(session_, id, false);
        if (is_visible && shownLayers(after).front()->id == id) {
            to_reveal_ = id;
        }
        change(text.arg(name), after);
    }
}

const Layer* SessionController::replacedSample() const
{
    return replaced_sample_ && layerOf(session_, replaced_sample_->id) == nullptr
               ? &*replaced_sample_
               : nullptr;
}

void SessionController::keepSample()
{
    if (const Layer* sample = replacedSample()) {
        Session after = session_;
        after.layers.push_back(*sample);
        after.layers.back().is_sample = false;
        //: Continues "Undo …"; %1 is a layer
        change(tr("Keep %1").arg(nameOf(*sample)), after);
    }
}

void SessionController::setRamp(LayerId id, const QString& ramp)
{
    if (const Layer* layer = layerOf(session_, id)) {
        //: Continues "Undo …"; %1 is a layer
        change(tr("Color Ramp of %1").arg(nameOf(*layer)),
               withRamp(session_, id, ramp.toStdString()));
    }
}

void SessionController::rename(LayerId id, const QString& name)
{
    const QString trimmed = name.trimmed();
    const Layer* layer = layerOf(session_, id);
    if (layer != nullptr && !trimmed.isEmpty()) {
        //: Continues "Undo …"; %1 is a layer
        change(tr("Rename %1").arg(nameOf(*layer)), withName(session_, id, trimmed.toStdString()));
    }
}

void SessionController::setShading(ShadingMode mode)
{
    TerrainLook look = session_.look;
    look.mode = mode;
    //: Continues "Undo …"
    change(tr("Shading"), withLook(session_, look));
}

void SessionController::setOrder(LayerOrder order)
{
    if (order != session_.order) {
        //: Continues "Undo …"
        change(tr("Order of Layers"), withOrder(session_, order));
    }
}

void SessionController::setContours(bool has_contours)
{
    TerrainLook look = session_.look;
    look.has_contours = has_contours;
    //: Continues "Undo …"
    change(tr("Contours"), withLook(session_, look));
}

void SessionController::setOverlay(const VectorOverlay& overlay)
{
    const auto& overlays = session_.overlays;
    const bool is_known =
        std::any_of(overlays.begin(), overlays.end(),
                    [&](const VectorOverlay& known) { return known.path == overlay.path; });
    const QString name = QFileInfo(QString::fromStdString(overlay.path)).fileName();
    //: Continues "Undo …"; %1 is a file
    change(is_known ? tr("Change %1").arg(name) : tr("Open %1").arg(name),
           withOverlay(session_, overlay));
}

void SessionController::removeOverlay(const std::string& path)
{
    const QString name = QFileInfo(QString::fromStdString(path)).fileName();
    //: Continues "Undo …"; %1 is a file
    change(tr("Close %1").arg(name), withoutOverlay(session_, path));
}

void SessionController::setContourInterval(double interval_m)
{
    TerrainLook look = session_.look;
    look.has_contours = true;
    look.contour_interval_m = interval_m;
    //: Continues "Undo …"
    change(tr("Contour Interval"), withLook(session_, look));
}

void SessionController::setLight(Angle azimuth, Angle altitude)
{
    TerrainLook look = session_.look;
    look.light_azimuth = azimuth;
    look.light_altitude = altitude;
    //: Continues "Undo …"
    change(tr("Light"), withLook(session_, look),
           {.kind = SessionRun::Kind::Light, .serial = drag_serial_});
}

void SessionController::fixLightInView()
{
    TerrainLook look = session_.look;
    look.light_frame = LightFrame::View;
    //: Continues "Undo …"
    change(tr("Light Fixed in the View"), withLook(session_, look));
}

void SessionController::setSubsolarPoint(const GeographicPoint& place)
{
    TerrainLook look = session_.look;
    const bool is_fixed = look.light_frame == LightFrame::Body;
    look.light_frame = LightFrame::Body;
    look.subsolar = place;
    //: Continues "Undo …"
    change(is_fixed ? tr("Subsolar Point") : tr("Light Fixed on the Body"),
           withLook(session_, look));
}

void SessionController::setStretch(LayerId id, const ColorStretch& stretch, ChangeKind kind)
{
    if (const Layer* layer = layerOf(session_, id)) {
        //: Continues "Undo …"; %1 is a layer
        change(tr("Color Stretch of %1").arg(nameOf(*layer)), withStretch(session_, id, stretch),
               runOf(kind, SessionRun::Kind::Stretch));
    }
}

// The steps of one drag are merged into one undo step.
SessionRun SessionController::runOf(ChangeKind kind, SessionRun::Kind what) const
{
    return kind == ChangeKind::OfDrag ? SessionRun{.kind = what, .serial = drag_serial_}
                                      : SessionRun{};
}

void SessionController::setSlopeRange(LayerId id,
                                      const std::optional<SlopeRange>& range,
                                      ChangeKind kind)
{
    if (const Layer* layer = layerOf(session_, id)) {
        //: Continues "Undo …"; %1 is a layer
        change(tr("Slope Colors of %1").arg(nameOf(*layer)), withSlopeRange(session_, id, range),
               runOf(kind, SessionRun::Kind::Stretch));
    }
}

void SessionController::setFeather(LayerId id, std::size_t cells)
{
    if (const Layer* layer = layerOf(session_, id)) {
        //: Continues "Undo …"; %1 is a layer
        change(tr("Blended Edges of %1").arg(nameOf(*layer)), withFeather(session_, id, cells));
    }
}

bool SessionController::canFeather(LayerId id) const
{
    if (!other_scene_) {
        return false;
    }
    const std::vector<const Layer*> layers = layersOnBody(session_);
    return std::any_of(layers.begin(), layers.end(),
                       [id](const Layer* layer) { return layer->id == id; }) &&
           layers.back()->id != id;
}

SlopeRange SessionController::slopeRangeOf(const Layer& layer) const
{
    return layer.slope_range.value_or(layer.map->slopeRange());
}

void SessionController::stretchToView(LayerId id)
{
    const Layer* layer = layerOf(session_, id);
    const auto range = layer != nullptr ? rangeInPicture(layer->map) : std::nullopt;
    if (range && isStretchRange(range->minimum_m, range->maximum_m)) {
        //: Continues "Undo …"; %1 is a layer
        change(tr("Stretch of %1 to Current View").arg(nameOf(*layer)),
               withStretch(session_, id, fixedStretch(range->minimum_m, range->maximum_m)));
    }
}

std::optional<HeightRange>
SessionController::rangeInPicture(const std::shared_ptr<const Map>& map) const
{
    if (other_scene_) {
        return other_scene_->range_in_picture(map);
    }
    const std::vector<SceneMap>& maps = view_.ground().maps();
    const auto ranges =
        rangesInPicture(view_.ground(), view_.camera(), view_.viewport(), view_.exaggeration());
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        if (maps[i].map == map) {
            return ranges[i];
        }
    }
    return std::nullopt;
}

HeightRange SessionController::stretchedRangeOf(const Layer& layer) const
{
    std::erase_if(known_ranges_, [](const KnownRange& known) { return known.map.expired(); });
    const auto known =
        std::find_if(known_ranges_.begin(), known_ranges_.end(), [&layer](const KnownRange& range) {
            return range.map.lock() == layer.map && range.stretch == layer.stretch;
        });
    if (known != known_ranges_.end()) {
        return known->range;
    }
    const HeightRange range = stretchedRange(layer.stretch, {.heights = layer.map->heightfield(),
                                                             .means = layer.map->analysis()->means,
                                                             .automatic = layer.map->tintRange()});
    if (layer.stretch.kind == StretchKind::Percentile) {
        known_ranges_.push_back({.map = layer.map, .stretch = layer.stretch, .range = range});
    }
    return range;
}

void SessionController::setExaggeration(double exaggeration, ChangeKind kind)
{
    const std::vector<const Layer*> shown = shownLayers(session_);
    if (shown.empty() || !(exaggeration > 0.0)) {
        return;
    }
    const ExaggerationRange range = exaggerationRange(suitableExaggeration(*shown.front()->map));
    const double bounded = std::clamp(exaggeration, range.least, range.most);
    const SessionRun run = runOf(kind, SessionRun::Kind::Exaggeration);
    //: Continues "Undo …"; %1 is a factor
    change(tr("Exaggeration ×%1").arg(shortNumberText(bounded, 3)),
           withExaggeration(session_, bounded), run);
}

void SessionController::stepExaggeration(int steps)
{
    setExaggeration(steppedExaggeration(exaggerationOf(session_), steps));
}

void SessionController::endDrag()
{
    ++drag_serial_;
}

void SessionController::activate(LayerId id)
{
    if (id != session_.active) {
        apply(activated(session_, id));
    }
}

void SessionController::change(const QString& text, const Session& after, SessionRun run)
{
    if (after == session_) {
        return;
    }
    undo_stack_.push(new SessionCommand(
        text, session_, after, [this](const Session& session) { apply(session); }, run));
}

void SessionController::apply(const Session& session)
{
    // Steps of undo know of other active layers; ids given since then stay given.
    const std::uint32_t next_id = std::max(session_.next_id, session.next_id);
    const std::uint32_t next_view_id = std::max(session_.next_view_id, session.next_view_id);
    session_ = session;
    session_.next_id = next_id;
    session_.next_view_id = next_view_id;
    for (Layer& layer : session_.layers) {
        layer.map = latest(layer.map);
    }
    show();
    Q_EMIT sessionChanged();
    lookAfterPreviews();
}

void SessionController::show()
{
    std::vector<ShownLayer> shown;
    for (const Layer* layer : shownLayers(session_)) {
        shown.push_back({.map = layer->map,
                         .ramp = &rampOf(*layer),
                         .color_range = stretchedRangeOf(*layer),
                         .slope_range = layer->slope_range});
    }
    view_.setAllHidden(shown.empty() && !session_.layers.empty());
    if (!isSame(shown, shown_)) {
        shown_ = std::move(shown);
        view_.setLayers(shown_, exaggerationOf(session_));
    } else if (!shown_.empty()) {
        view_.setExaggeration(exaggerationOf(session_));
    }
    if (view_.look() != session_.look) {
        view_.setLook(session_.look);
    }
}

void SessionController::revealWhatCame()
{
    const Layer* layer = layerOf(session_, to_reveal_);
    const Map* scene = view_.map().get();
    if (layer == nullptr || scene != layer->map.get()) {
        return;
    }
    to_reveal_ = LayerId::None;
    if (other_scene_ && other_scene_->reveal(layer->map)) {
        return;
    }
    for (int row = 0; row < kMiddleProbes; ++row) {
        for (int column = 0; column < kMiddleProbes; ++column) {
            const auto position =
                view_.positionOf(placeOn(*scene, static_cast<double>(column) / (kMiddleProbes - 1),
                                         static_cast<double>(row) / (kMiddleProbes - 1)));
            if (position && QRectF(view_.rect()).contains(*position)) {
                return;
            }
        }
    }
    goTo(layer->id);
}

void SessionController::showOn(std::optional<OtherScene> scene)
{
    other_scene_ = std::move(scene);
    Q_EMIT sceneChanged();
}

bool SessionController::isInScene(const Layer& layer) const
{
    const auto layers = other_scene_ ? layersOnBody(session_) : shownLayers(session_);
    return std::any_of(layers.begin(), layers.end(),
                       [&layer](const Layer* one) { return one->id == layer.id; });
}

void SessionController::goTo(LayerId id)
{
    const auto fly_elsewhere = [&](const Layer* layer) {
        return layer != nullptr && other_scene_ && other_scene_->fly_to(layer->map);
    };
    if (fly_elsewhere(layerOf(session_, id))) {
        return;
    }
    const auto is_shown = [&] {
        const auto shown = shownLayers(session_);
        return std::find(shown.begin(), shown.end(), layerOf(session_, id)) != shown.end();
    };
    if (const Layer* hidden = layerOf(session_, id); hidden != nullptr && !is_shown()) {
        //: Continues "Undo …"; %1 is a layer
        change(tr("Show %1").arg(nameOf(*hidden)), withLayerInScene(*hidden));
    }
    const Layer* layer = layerOf(session_, id);
    if (layer != nullptr && !fly_elsewhere(layer) && is_shown()) {
        flyOnFlatMapTo(*layer->map);
    }
}

// The flat map has one CRS, another scene all layers of a body.
Session SessionController::withLayerInScene(const Layer& layer) const
{
    const bool is_of_body = other_scene_ && view_.map() && layer.map->info().body != nullptr &&
                            layer.map->info().body == view_.map()->info().body;
    return is_of_body ? withVisibility(session_, layer.id, true)
                      : withLayerShown(session_, layer.id);
}

void SessionController::flyOnFlatMapTo(const Map& map)
{
    if (const Map* scene = view_.map().get()) {
        const GridPoint center =
            scene->georeference().toGrid(placeOn(map, 0.5, 0.5), map.georeference());
        view_.flyTo(center, distanceToSee(map));
    }
}

} // namespace marsview
