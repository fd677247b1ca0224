// The Measure menu, and the tool that is chosen in it.
#pragma once

#include <QObject>

namespace marsview {

class MeasureController;
class MeasurePanel;
class TerrainView;
class WindowDocks;
class WindowMessages;
struct WindowActions;

/// GUI thread; must not outlive its parts.
class MeasureCommands final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        WindowActions& actions;
        MeasureController& measuring;
        TerrainView& view;
        WindowDocks& docks;
        MeasurePanel& panel;
        WindowMessages& messages;
    };

    explicit MeasureCommands(const Parts& parts);

private:
    void showPanel();
    void showState();

    Parts parts_;
};

} // namespace marsview
