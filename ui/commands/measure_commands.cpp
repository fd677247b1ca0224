#include "ui/commands/measure_commands.h"

#include "ui/canvas/terrain_view.h"
#include "ui/controllers/measure_controller.h"
#include "ui/panels/measure_panel.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_docks.h"
#include "ui/window/window_messages.h"

#include <QAction>
#include <QActionGroup>
#include <QDockWidget>
#include <QMenu>

namespace marsview {

MeasureCommands::MeasureCommands(const Parts& parts)
    : parts_(parts)
{
    WindowActions& actions = parts_.actions;
    MeasureController& measuring = parts_.measuring;
    connect(actions.measure_kinds, &QActionGroup::triggered, this, [this](QAction* action) {
        parts_.measuring.begin(static_cast<MeasurementKind>(action->data().toInt()));
        showPanel(); // the tool may have been chosen before
        parts_.view.setFocus();
    });
    connect(&measuring, &MeasureController::kindChanged, this,
            [this](MeasurementKind kind) { parts_.actions.showTool(parts_.view.tool(), kind); });
    connect(&parts_.view, &TerrainView::toolChanged, this, [this](Tool tool) {
        parts_.actions.showTool(tool, parts_.measuring.kind());
        if (tool == Tool::Measure) {
            showPanel();
        } else if (parts_.measuring.state().items.empty()) {
            parts_.docks.hideForTool(*parts_.docks.measurements());
        }
    });
    connect(actions.finish_measurement, &QAction::triggered, &measuring,
            &MeasureController::finish);
    connect(actions.remove_measurement, &QAction::triggered, &measuring,
            [&measuring] { measuring.remove(measuring.state().current); });
    connect(actions.remove_measurements, &QAction::triggered, &measuring,
            &MeasureController::removeAll);
    connect(&measuring, &MeasureController::changed, this, &MeasureCommands::showState);
    connect(&parts_.panel, &MeasurePanel::saved, &parts_.messages, &WindowMessages::showSaved);
    connect(&parts_.panel, &MeasurePanel::failed, &parts_.messages, &WindowMessages::report);
    actions.measure->addAction(parts_.docks.measurements()->toggleViewAction());
    showState();
}

void MeasureCommands::showPanel()
{
    parts_.docks.showForTool(*parts_.docks.measurements());
}

void MeasureCommands::showState()
{
    const MeasureItem* item = parts_.measuring.current();
    parts_.actions.finish_measurement->setEnabled(item != nullptr && !item->is_finished);
    parts_.actions.remove_measurement->setEnabled(item != nullptr);
    const bool has_items = !parts_.measuring.state().items.empty();
    parts_.actions.remove_measurements->setEnabled(has_items);
    if (has_items) {
        parts_.docks.showRestored(*parts_.docks.measurements());
    }
}

} // namespace marsview
