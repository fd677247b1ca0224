#include "ui/commands/scene_commands.h"

#include "core/session/saved_view.h"
#include "ui/canvas/terrain_view.h"
#include "ui/controllers/haptics/device_session.h"
#include "ui/globe/globe_view.h"
#include "ui/window/status_readout.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_messages.h"

#include <QAction>
#include <QActionGroup>
#include <QMenu>
#include <QWidget>

#include <utility>
#include <variant>

namespace marsview {

SceneCommands::SceneCommands(const Parts& parts)
    : parts_(parts)
{
    const WindowActions& actions = parts_.actions;
    parts_.flat_actions += {actions.save_picture,
                            actions.add_point,
                            actions.finish_measurement,
                            actions.remove_measurement,
                            actions.remove_measurements,
                            actions.open_vector,
                            actions.vector_files->menuAction(),
                            actions.stretch_to_view,
                            actions.layer.go_to,
                            actions.haptic_devices,
                            actions.replay_touch};
    parts_.flat_actions += {actions.add_annotation_point, actions.finish_annotation,
                            actions.remove_annotations, actions.import_annotations};
    parts_.flat_actions += actions.measure_kinds->actions() + actions.annotation_shapes->actions();
    for (QAction* action : actions.tools->actions()) {
        const Tool tool = static_cast<Tool>(action->data().toInt());
        if (tool != Tool::Pan && tool != Tool::Orbit) {
            parts_.flat_actions.append(action);
        }
    }
    parts_.globe.addActions(parts_.view.actions()); // their keys
    connectParts();
    showChoices();
}

void SceneCommands::connectParts()
{
    TerrainView* view = &parts_.view;
    connect(parts_.actions.scenes, &QActionGroup::triggered, this,
            [this](QAction* action) { choose(static_cast<SceneChoice>(action->data().toInt())); });
    connect(view, &TerrainView::layersChanged, this, &SceneCommands::follow);
    connect(view, &TerrainView::lookChanged, this, &SceneCommands::follow);
    connect(view, &TerrainView::exaggerationChanged, this, &SceneCommands::follow);
    connect(view, &TerrainView::toolChanged, &parts_.globe, &GlobeView::setTool);
    connect(&parts_.device, &DeviceSession::connectionChanged, this, &SceneCommands::showChoices);
    connect(&parts_.globe, &GlobeView::failed, this, [this](const QString& reason) {
        choose(SceneChoice::Flat);
        parts_.messages.report(tr("Cannot Show Globe"), reason);
    });
    readOnGlobe();
    for (QAction* action : std::as_const(parts_.flat_actions)) {
        connect(action, &QAction::enabledChanged, this, [this, action] {
            if (!is_withholding_ && withheld_.contains(action)) {
                withheld_[action].was_enabled = action->isEnabled();
                const bool was_withholding = std::exchange(is_withholding_, true);
                action->setEnabled(false);
                is_withholding_ = was_withholding;
            }
        });
    }
}

void SceneCommands::readOnGlobe()
{
    GlobeView* globe = &parts_.globe;
    StatusReadout* readout = &parts_.readout;
    // Not after this object: a globe that loses the focus while the window closes reports, too.
    connect(globe, &GlobeView::readingChanged, this,
            [this, globe, readout](const std::optional<RayHit>& hit) {
                if (is_globe_shown_) {
                    readout->setSource(ReadingSource::Pointer);
                    readout->setPlace(
                        hit ? std::optional(ReadPlace{
                                  .hit = *hit, .screen_pixel_m = globe->metersPerPoint(*hit)})
                            : std::nullopt);
                }
            });
    connect(globe, &GlobeView::detailChanged, readout, &StatusReadout::setDetail);
    connect(globe, &GlobeView::loadingChanged, readout, &StatusReadout::setLoading);
    connect(globe, &GlobeView::problemChanged, readout, &StatusReadout::setProblem);
}

QString SceneCommands::whyNoGlobe() const
{
    if (!parts_.view.map()) {
        return tr("Open a map first");
    }
    if (parts_.view.map()->georeference().body() == nullptr) {
        return tr(
            "Not available: the body of the topmost layer is not known. Set it with Layer › "
            "Set Body, CRS…");
    }
    if (parts_.device.state() != DeviceState::Idle) {
        return tr("Not available: a haptic device cannot touch the globe yet. Disconnect it first");
    }
    return {};
}

void SceneCommands::showChoices()
{
    const QString why_not = whyNoGlobe();
    for (QAction* action : parts_.actions.scenes->actions()) {
        const auto choice = static_cast<SceneChoice>(action->data().toInt());
        action->setChecked(choice == choice_);
        if (choice == SceneChoice::Globe) {
            action->setEnabled(why_not.isEmpty());
            const QString tip = why_not.isEmpty()
                                    ? tr("Show the topmost layer where it lies on its body")
                                    : why_not;
            action->setStatusTip(tip);
            action->setToolTip(tip);
        }
    }
}

void SceneCommands::choose(SceneChoice choice)
{
    choice_ = choice;
    setGlobeShown(choice == SceneChoice::Globe && whyNoGlobe().isEmpty());
    showChoices();
}

void SceneCommands::follow()
{
    // Removing the last layer, or a map without a body on top, leads back to the flat map.
    if (is_globe_shown_ && !whyNoGlobe().isEmpty()) {
        choose(SceneChoice::Flat);
        return;
    }
    showChoices();
    if (!is_globe_shown_) {
        return;
    }
    const std::vector<ShownLayer>& layers = parts_.view.shownLayers();
    parts_.globe.setLook(parts_.view.look());
    parts_.globe.setExaggeration(parts_.view.exaggeration());
    parts_.globe.setLayer(layers.front());
    parts_.globe.setNote(layers.size() > 1
                             //: Over the globe
                             ? tr("The globe shows the topmost layer only.")
                             : QString());
}

void SceneCommands::setGlobeShown(bool is_shown)
{
    if (is_shown == is_globe_shown_) {
        return;
    }
    is_globe_shown_ = is_shown;
    TerrainView& view = parts_.view;
    GlobeView& globe = parts_.globe;
    const bool has_focus = view.hasFocus() || globe.hasFocus();
    if (is_shown) {
        if (view.tool() != Tool::Orbit) {
            view.setTool(Tool::Pan);
        }
        globe.setTool(view.tool());
        handToGlobe();
        follow();
        view.hide();
        globe.show();
    } else {
        handToMap();
        globe.hide();
        globe.setLayer(std::nullopt);
        view.show();
    }
    if (has_focus) {
        (is_shown ? static_cast<QWidget&>(globe) : view).setFocus(Qt::OtherFocusReason);
    }
    for (QAction* action : std::as_const(parts_.flat_actions)) {
        is_shown ? withhold(*action) : release(*action);
    }
    for (QWidget* widget : std::as_const(parts_.flat_widgets)) {
        widget->setEnabled(!is_shown);
        widget->setToolTip(is_shown ? tr("Not available on the globe yet. Choose View › Scene › "
                                         "Flat Map first")
                                    : QString());
    }
    parts_.readout.setPlace(std::nullopt);
    Q_EMIT shownChanged(is_shown);
}

void SceneCommands::withhold(QAction& action)
{
    withheld_[&action] = {.was_enabled = action.isEnabled(),
                          .tool_tip = action.toolTip(),
                          .status_tip = action.statusTip()};
    //: Why an entry of the menu cannot be chosen
    const QString why = tr("Not available on the globe yet. Choose View › Scene › Flat Map first");
    const bool was_withholding = std::exchange(is_withholding_, true);
    action.setEnabled(false);
    is_withholding_ = was_withholding;
    action.setToolTip(why);
    action.setStatusTip(why);
}

void SceneCommands::release(QAction& action)
{
    if (!withheld_.contains(&action)) {
        return;
    }
    const Tips tips = withheld_.take(&action);
    action.setToolTip(tips.tool_tip);
    action.setStatusTip(tips.status_tip);
    action.setEnabled(tips.was_enabled);
}

void SceneCommands::handToGlobe()
{
    const TerrainView& view = parts_.view;
    const auto camera =
        viewCamera(view.map()->georeference(), view.cameraGoal(), view.exaggeration());
    if (camera && std::holds_alternative<GeographicPoint>(camera->target)) {
        parts_.globe.setCamera({.target = std::get<GeographicPoint>(camera->target),
                                .height_m = camera->elevation_m * view.exaggeration(),
                                .distance_m = camera->distance_m,
                                .azimuth = camera->azimuth,
                                .tilt = camera->tilt,
                                .field_of_view = camera->field_of_view});
    }
}

void SceneCommands::handToMap()
{
    TerrainView& view = parts_.view;
    if (!view.map() || parts_.globe.terrain() == nullptr ||
        parts_.globe.terrain()->map() != view.map()) {
        return; // it was never looked at
    }
    const BodyCamera& from = parts_.globe.cameraGoal();
    const auto camera = orbitCamera(view.map()->georeference(),
                                    {.target = from.target,
                                     .elevation_m = from.height_m / view.exaggeration(),
                                     .distance_m = from.distance_m,
                                     .azimuth = from.azimuth,
                                     .tilt = from.tilt,
                                     .field_of_view = from.field_of_view},
                                    view.exaggeration());
    if (camera) {
        view.setCamera(*camera);
    }
}

} // namespace marsview
