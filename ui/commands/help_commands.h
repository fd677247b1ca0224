// The Help menu: the user guide, the list of keys, the program's versions.
#pragma once

#include <QObject>

class QMainWindow;

namespace marsview {

class GuideWindow;
class TerrainView;
struct WindowActions;

/// GUI thread; must not outlive its parts.
class HelpCommands final : public QObject {
    Q_OBJECT

public:
    HelpCommands(QMainWindow& window, TerrainView& view, const WindowActions& actions);

    void showGuide();
    void showKeys();
    void showAbout();

private:
    QMainWindow& window_;
    TerrainView& view_;
    GuideWindow* guide_ = nullptr; // once it was asked for
};

} // namespace marsview
