#include "ui/commands/view_commands.h"

#include "ui/canvas/map_keys.h"
#include "ui/canvas/terrain_view.h"
#include "ui/globe/globe_view.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_docks.h"
#include "ui/window/window_messages.h"

#include <QAbstractItemView>
#include <QAction>
#include <QActionGroup>
#include <QDockWidget>
#include <QMainWindow>

#include <utility>

namespace marsview {
namespace {

// A key counts as the gesture with the same effect.
MapAction actionOf(NavigationStep step)
{
    switch (step) {
    case NavigationStep::PanLeft:
    case NavigationStep::PanRight:
    case NavigationStep::PanAway:
    case NavigationStep::PanNearer:
        return MapAction::Pan;
    case NavigationStep::ZoomIn:
    case NavigationStep::ZoomOut:
        return MapAction::Zoom;
    case NavigationStep::TurnLeft:
    case NavigationStep::TurnRight:
    case NavigationStep::TiltUp:
    case NavigationStep::TiltDown:
        return MapAction::Orbit;
    }
    return MapAction::None;
}

} // namespace

ViewCommands::ViewCommands(const Parts& parts)
    : parts_(parts)
{
    TerrainView* view = &parts_.view;
    const WindowActions& actions = parts_.actions;
    auto* keys = new MapKeys(*view, this);
    for (const QDockWidget* panel : parts_.window.findChildren<QDockWidget*>()) {
        for (QAbstractItemView* list : panel->findChildren<QAbstractItemView*>()) {
            if (list->window() == panel->window()) { // not the list of a combo box
                keys->addTo(*list);
            }
        }
    }
    connect(actions.tools, &QActionGroup::triggered, view,
            [view](QAction* action) { view->setTool(static_cast<Tool>(action->data().toInt())); });
    GlobeView* globe = &parts_.globe;
    connect(actions.home, &QAction::triggered, view,
            [view, globe] { globe->isHidden() ? view->goHome() : globe->goHome(); });
    connect(actions.north, &QAction::triggered, view,
            [view, globe] { globe->isHidden() ? view->turnNorthUp() : globe->turnNorthUp(); });
    for (QAction* action : std::as_const(actions.steps)) {
        connect(action, &QAction::triggered, view,
                [view, globe, step = static_cast<NavigationStep>(action->data().toInt())] {
                    if (globe->isHidden()) {
                        view->step(step);
                        Q_EMIT view->gestureMade(actionOf(step));
                    } else {
                        globe->step(step);
                        Q_EMIT globe->gestureMade(actionOf(step));
                    }
                });
    }
    connect(actions.next_panel, &QAction::triggered, this,
            [this] { parts_.docks.moveFocus(shownMap(), FocusStep::Next); });
    connect(actions.previous_panel, &QAction::triggered, this,
            [this] { parts_.docks.moveFocus(shownMap(), FocusStep::Previous); });
    connect(actions.full_screen, &QAction::triggered, this, [this](bool is_full) {
        QMainWindow& window = parts_.window;
        window.setWindowState(window.windowState().setFlag(Qt::WindowFullScreen, is_full));
    });
    connect(view, &TerrainView::unavailable, this,
            [this](const QString& reason) { parts_.messages.report(tr("Cannot Draw"), reason); });
}

QWidget& ViewCommands::shownMap()
{
    return parts_.globe.isHidden() ? static_cast<QWidget&>(parts_.view) : parts_.globe;
}

} // namespace marsview
