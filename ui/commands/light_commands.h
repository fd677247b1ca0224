// The light: of the view, or of a sun that stands over a place of the body.
#pragma once

#include <QObject>

namespace marsview {

class GlobeView;
class LightPopup;
class MainToolBar;
class SceneCommands;
class SessionController;
struct WindowActions;

/// Opens the popup of the light, and passes what is chosen there to the session. GUI thread; must
/// not outlive its parts.
class LightCommands final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        const WindowActions& actions;
        SessionController& session;
        GlobeView& globe;
        SceneCommands& scene;
        MainToolBar& tool_bar;
        LightPopup& popup;
    };

    explicit LightCommands(const Parts& parts);

private:
    void showInPopup();
    void fixOnBody();

    Parts parts_;
};

} // namespace marsview
