// Layers that are shown as previews, and the maps that replace them.

#include "ui/canvas/terrain_view.h"
#include "ui/controllers/session_controller.h"

#include <algorithm>
#include <utility>

namespace marsview {

Preparation SessionController::preparationOf(LayerId id) const
{
    const Layer* layer = layerOf(session_, id);
    if (layer == nullptr || !layer->map->isPreview()) {
        return {};
    }
    const RasterSpec& spec = layer->map->spec();
    if (const auto current = preparer_->current(); current && isPreparedAlike(*current, spec)) {
        return {.state = PreparationState::Running};
    }
    if (preparer_->has(spec)) {
        return {.state = PreparationState::Waiting};
    }
    const Ending* ending = endingOf(spec);
    if (ending == nullptr || ending->how == Ending::How::Done) {
        return {};
    }
    return {.state = ending->how == Ending::How::Failed ? PreparationState::Failed
                                                        : PreparationState::Stopped,
            .problem = ending->problem,
            .ending = ending->number};
}

void SessionController::prepare(LayerId id)
{
    const Layer* layer = layerOf(session_, id);
    if (layer != nullptr && layer->map->isPreview()) {
        forgetEnding(layer->map->spec());
        lookAfterPreviews();
    }
}

void SessionController::stopPreparing()
{
    if (const auto spec = preparer_->current()) {
        preparer_->remove(*spec);
        endPreparing({.how = Ending::How::Stopped, .spec = *spec});
    }
}

void SessionController::stopAll()
{
    are_previews_left_alone_ = true;
    cancel();
    preparer_->removeAll();
}

// A prepared map that was opened in place of its preview.
void SessionController::acceptComplete(const Load& load, const std::shared_ptr<const Map>& map)
{
    const Layer* layer = layerOf(session_, load.layer);
    if (layer == nullptr || !isOfSameMap(*layer->map, *map)) {
        lookAfterPreviews(); // removed or overridden in the meantime
        return;
    }
    if (map->isPreview()) {
        endPreparing({.how = Ending::How::Failed,
                      .spec = load.spec,
                      //: %1 is a file
                      .problem = tr("%1: its overviews are gone. Build them again, or choose "
                                    "another folder for prepared maps in the preferences")
                                     .arg(QString::fromStdString(load.spec.path))});
        return;
    }
    replacePreview(layer->map, map);
}

// In place: the same layers, looks and camera, without a step of undo.
void SessionController::replacePreview(const std::shared_ptr<const Map>& preview,
                                       const std::shared_ptr<const Map>& map)
{
    std::erase_if(successors_, [](const Successor& s) { return s.preview.expired(); });
    successors_.push_back({.preview = preview, .map = map});
    view_.replacePreview(preview, map);
    apply(session_);
    Q_EMIT preparationChanged();
}

std::shared_ptr<const Map> SessionController::latest(std::shared_ptr<const Map> map) const
{
    // Each step leads from a preview to what came later: there is an end.
    for (auto next = successors_.begin(); next != successors_.end();) {
        if (next->preview.lock() == map) {
            map = next->map;
            next = successors_.begin();
        } else {
            ++next;
        }
    }
    return map;
}

void SessionController::endPreparing(const Ending& ending)
{
    forgetEnding(ending.spec);
    endings_.push_back(ending);
    endings_.back().number = ++ending_count_;
    lookAfterPreviews();
    Q_EMIT preparationChanged();
}

const SessionController::Ending* SessionController::endingOf(const RasterSpec& spec) const
{
    const auto hit = std::find_if(endings_.begin(), endings_.end(), [&spec](const Ending& ending) {
        return isPreparedAlike(ending.spec, spec);
    });
    return hit != endings_.end() ? &*hit : nullptr;
}

void SessionController::forgetEnding(const RasterSpec& spec)
{
    std::erase_if(endings_,
                  [&spec](const Ending& ending) { return isPreparedAlike(ending.spec, spec); });
}

bool SessionController::isCompleting(LayerId id) const
{
    const auto is_it = [id](const Load& load) {
        return load.purpose == Load::Purpose::Complete && load.layer == id;
    };
    return (current_ && is_it(*current_)) || std::any_of(waiting_.begin(), waiting_.end(), is_it);
}

// Starts or queues building the overviews of every preview in the session, unless that was stopped
// or failed, and cancels building those of other maps.
void SessionController::lookAfterPreviews()
{
    if (are_previews_left_alone_) {
        return;
    }
    const auto is_wanted = [this](const RasterSpec& spec) {
        return std::any_of(session_.layers.begin(), session_.layers.end(), [&](const Layer& layer) {
            return layer.map->isPreview() && isPreparedAlike(layer.map->spec(), spec);
        });
    };
    // Those that wait first, so that none of them is started.
    const std::vector<RasterSpec> prepared = preparer_->all();
    for (auto spec = prepared.rbegin(); spec != prepared.rend(); ++spec) {
        if (!is_wanted(*spec)) {
            preparer_->remove(*spec);
        }
    }
    bool is_changed = false;
    for (const Layer& layer : session_.layers) {
        const RasterSpec& spec = layer.map->spec();
        if (!layer.map->isPreview() || preparer_->has(spec)) {
            continue;
        }
        const Ending* ending = endingOf(spec);
        if (ending == nullptr) {
            preparer_->enqueue(
                {.spec = spec, .is_preview_wanted = layer.map->kind() == MapKind::RoughPreview});
            is_changed = true;
        } else if (ending->how == Ending::How::Done && !isCompleting(layer.id)) {
            enqueue({.purpose = Load::Purpose::Complete, .spec = spec, .layer = layer.id});
        }
    }
    startNext();
    if (is_changed) {
        Q_EMIT preparationChanged();
    }
}

} // namespace marsview
