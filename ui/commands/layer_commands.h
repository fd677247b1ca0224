// The commands on layers and on their look: menus, the panels of layers and of georeferencing, the
// exaggeration in the toolbar.
#pragma once

#include <QObject>

namespace marsview {

class GeoreferencingPanel;
class LayersPanel;
class MainToolBar;
class SessionController;
class WindowDocks;
struct WindowActions;

/// Passes them to the session, and shows the session in their controls. GUI thread; must not
/// outlive its parts.
class LayerCommands final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        WindowActions& actions;
        SessionController& session;
        WindowDocks& docks;
        LayersPanel& layers;
        GeoreferencingPanel& georeferencing;
        MainToolBar& tool_bar;
    };

    explicit LayerCommands(const Parts& parts);

    /// Call when the session changed.
    void showSession();

private:
    void connectActions();
    void connectLook();
    void connectPanels();

    Parts parts_;
};

} // namespace marsview
