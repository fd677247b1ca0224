#include "ui/commands/layer_commands.h"

#include "core/session/layer_groups.h"
#include "ui/controllers/session_controller.h"
#include "ui/panels/georeferencing_panel.h"
#include "ui/panels/layers_panel.h"
#include "ui/window/main_tool_bar.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_docks.h"

#include <QAction>
#include <QActionGroup>
#include <QDockWidget>

#include <vector>

namespace marsview {

LayerCommands::LayerCommands(const Parts& parts)
    : parts_(parts)
{
    connectActions();
    connectLook();
    connectPanels();
}

void LayerCommands::connectActions()
{
    const auto on = [this](QAction* action, auto reaction) {
        connect(action, &QAction::triggered, this, reaction);
    };
    SessionController& session = parts_.session;
    const LayerActions& layer = parts_.actions.layer;
    on(parts_.actions.toggle_visibility,
       [&session](bool is_visible) { session.setVisible(session.session().active, is_visible); });
    on(layer.go_to, [&session] { session.goTo(session.session().active); });
    on(layer.prepare, [&session] { session.prepare(session.session().active); });
    on(layer.rename, [this] {
        parts_.docks.reveal(*parts_.docks.datasets());
        parts_.layers.editName();
    });
    on(layer.remove, [&session] { session.remove(session.session().active); });
    const auto step = [&session](GroupStep to) {
        const Session& now = session.session();
        if (const auto index = indexBeside(now, now.active, to)) {
            session.move(now.active, *index);
        }
    };
    on(layer.move_up, [step] { step(GroupStep::Up); });
    on(layer.move_down, [step] { step(GroupStep::Down); });
    on(layer.finest_first, [&session](bool is_checked) {
        session.setOrder(is_checked ? LayerOrder::FinestFirst : LayerOrder::Listed);
    });
    on(parts_.actions.override_georeferencing, [this] {
        parts_.docks.reveal(*parts_.docks.georeferencing());
        parts_.georeferencing.edit();
    });
}

void LayerCommands::connectLook()
{
    SessionController& session = parts_.session;
    const WindowActions& actions = parts_.actions;
    connect(actions.exaggerate_more, &QAction::triggered, this,
            [&session] { session.stepExaggeration(1); });
    connect(actions.exaggerate_less, &QAction::triggered, this,
            [&session] { session.stepExaggeration(-1); });
    connect(actions.contours, &QAction::triggered, this,
            [&session](bool is_checked) { session.setContours(is_checked); });
    connect(actions.shading_group, &QActionGroup::triggered, this, [&session](QAction* action) {
        session.setShading(static_cast<ShadingMode>(action->data().toInt()));
    });
    connect(actions.ramp_group, &QActionGroup::triggered, this, [&session](QAction* action) {
        session.setRamp(session.session().active, action->data().toString());
    });
    connect(&parts_.tool_bar, &MainToolBar::exaggerationRequested, this,
            [&session](double exaggeration) { session.setExaggeration(exaggeration); });
    connect(&parts_.tool_bar, &MainToolBar::exaggerationDragged, this,
            [&session](double exaggeration) {
                session.setExaggeration(exaggeration, ChangeKind::OfDrag);
            });
    connect(&parts_.tool_bar, &MainToolBar::dragEnded, &session, &SessionController::endDrag);
}

void LayerCommands::connectPanels()
{
    SessionController& session = parts_.session;
    const LayersPanel& layers = parts_.layers;
    connect(&layers, &LayersPanel::activationRequested, &session, &SessionController::activate);
    connect(&layers, &LayersPanel::visibilityRequested, &session, &SessionController::setVisible);
    connect(&layers, &LayersPanel::nameRequested, &session, &SessionController::rename);
    connect(&layers, &LayersPanel::moveRequested, &session, &SessionController::move);
    connect(&layers, &LayersPanel::rampRequested, &session, &SessionController::setRamp);
    connect(&layers, &LayersPanel::featherRequested, &session, &SessionController::setFeather);
    connect(&session, &SessionController::sceneChanged, this, [this] {
        const Session& now = parts_.session.session();
        parts_.layers.setSession(now, parts_.session.canFeather(now.active));
    });
    connect(&parts_.georeferencing, &GeoreferencingPanel::overridesRequested, this,
            [&session](const RasterOverrides& overrides) {
                session.overrideGeoreferencing(session.session().active, overrides);
            });
    connect(&session, &SessionController::overrideFailed, this,
            [this](LayerId id, const QString& problem) {
                parts_.session.activate(id);
                parts_.docks.reveal(*parts_.docks.georeferencing());
                parts_.georeferencing.showFailure(problem);
            });
}

void LayerCommands::showSession()
{
    const Session& session = parts_.session.session();
    parts_.actions.showSession(session);
    parts_.layers.setSession(session, parts_.session.canFeather(session.active));
    const std::vector<const Layer*> shown = shownLayers(session);
    parts_.tool_bar.setExaggerationEnabled(!shown.empty());
    if (!shown.empty()) {
        parts_.tool_bar.setExaggerationRange(
            exaggerationRange(suitableExaggeration(*shown.front()->map)));
        parts_.tool_bar.showExaggeration(exaggerationOf(session));
    }
}

} // namespace marsview
