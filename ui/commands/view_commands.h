// The commands on the view: tools, steps of the camera, moving between map and panels, full screen.
#pragma once

#include <QObject>

class QMainWindow;
class QWidget;

namespace marsview {

class GlobeView;
class TerrainView;
class WindowDocks;
class WindowMessages;
struct WindowActions;

/// GUI thread; must not outlive its parts.
class ViewCommands final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        /// The lists and tables of its panels take the keys of the map too.
        QMainWindow& window;
        const WindowActions& actions;
        TerrainView& view;
        GlobeView& globe;
        WindowDocks& docks;
        WindowMessages& messages;
    };

    explicit ViewCommands(const Parts& parts);

private:
    QWidget& shownMap();

    Parts parts_;
};

} // namespace marsview
