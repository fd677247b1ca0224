// The Measure menu, and the tool that is chosen in it.
#pragma once

#include <QObject>

namespace marsview {

class MeasureController;
class TerrainView;
class WindowDocks;
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
    };

    explicit MeasureCommands(const Parts& parts);

private:
    void showPanel();
    void showState();

    Parts parts_;
};

} // namespace marsview
