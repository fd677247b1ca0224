// Saved views of the session.

#include "core/view/exaggeration.h"
#include "ui/controllers/session_controller.h"

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

QString viewName(const SavedView& view)
{
    return QString::fromStdString(view.name);
}

bool isLayerOn(const Layer& layer, const std::string& body)
{
    return layer.map->info().body != nullptr && layer.map->info().body->name == body;
}

} // namespace

ViewId SessionController::addView(SavedView view)
{
    view.id = ViewId::None;
    //: Continues "Undo …"; %1 is a saved view
    const QString text = tr("Save View %1").arg(viewName(view));
    const Session after = withView(session_, std::move(view));
    change(text, after);
    return after.views.back().id;
}

void SessionController::updateView(const SavedView& view)
{
    if (viewOf(session_, view.id) != nullptr) {
        //: Continues "Undo …"; %1 is a saved view
        change(tr("Update View %1").arg(viewName(view)), withView(session_, view));
    }
}

void SessionController::renameView(ViewId id, const QString& name)
{
    const QString trimmed = name.trimmed();
    const SavedView* known = viewOf(session_, id);
    if (known != nullptr && !trimmed.isEmpty()) {
        //: Continues "Undo …"; %1 is a saved view
        const QString text = tr("Rename View %1").arg(viewName(*known));
        SavedView view = *known;
        view.name = trimmed.toStdString();
        change(text, withView(session_, std::move(view)));
    }
}

void SessionController::moveView(ViewId id, std::size_t index)
{
    if (const SavedView* view = viewOf(session_, id)) {
        //: Continues "Undo …"; %1 is a saved view
        change(tr("Move View %1").arg(viewName(*view)), movedView(session_, id, index));
    }
}

void SessionController::removeView(ViewId id)
{
    if (const SavedView* view = viewOf(session_, id)) {
        //: Continues "Undo …"; %1 is a saved view
        change(tr("Remove View %1").arg(viewName(*view)), withoutView(session_, id));
    }
}

bool SessionController::canShow(const SavedView& view) const
{
    return layerForView(view) != nullptr;
}

// The layer that the view was saved on; without it, one of the same body, rather one that is in the
// picture.
const Layer* SessionController::layerForView(const SavedView& view) const
{
    if (const Layer* layer = layerOf(session_, view.layer)) {
        return layer;
    }
    if (view.body.empty()) {
        return nullptr;
    }
    for (const Layer* layer : shownLayers(session_)) {
        if (isLayerOn(*layer, view.body)) {
            return layer;
        }
    }
    const auto found =
        std::find_if(session_.layers.begin(), session_.layers.end(),
                     [&](const Layer& layer) { return isLayerOn(layer, view.body); });
    return found != session_.layers.end() ? &*found : nullptr;
}

bool SessionController::prepareView(ViewId id)
{
    const SavedView* known = viewOf(session_, id);
    if (known == nullptr) {
        return false;
    }
    const SavedView view = *known;
    const Layer* layer = layerForView(view);
    if (layer == nullptr) {
        return false;
    }
    const auto is_in_picture = [&](const Session& session) {
        const auto shown = shownLayers(session);
        return std::any_of(shown.begin(), shown.end(), [&](const Layer* one) {
            return one->id == layer->id || (!view.body.empty() && isLayerOn(*one, view.body));
        });
    };
    const LayerId wanted = layer->id;
    Session after = is_in_picture(session_) ? session_ : withLayerShown(session_, wanted);
    const auto shown = shownLayers(after);
    if (shown.empty()) {
        return false;
    }
    const ExaggerationRange range = exaggerationRange(suitableExaggeration(*shown.front()->map));
    after =
        withExaggeration(std::move(after), std::clamp(view.exaggeration, range.least, range.most));
    //: Continues "Undo …"; %1 is a saved view
    change(tr("Go to View %1").arg(viewName(view)), after);
    return true;
}

} // namespace marsview
