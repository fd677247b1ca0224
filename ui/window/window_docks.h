// The panels next to the map, and the width they may take.
#pragma once

#include <QObject>

#include <array>

class QDockWidget;
class QMainWindow;
class QSettings;
class QWidget;

namespace marsview {

/// What the docks hold.
struct DockContents {
    QWidget* datasets = nullptr;
    QWidget* views = nullptr;
    QWidget* georeferencing = nullptr;
    QWidget* haptics = nullptr;
    QWidget* measurements = nullptr;
    QWidget* annotations = nullptr;
};

enum class FocusStep { Next, Previous };

/// Layers on the left, with saved views as a second tab, closed at first; georeferencing on the
/// right, with haptics as a second tab, closed at first. Docked panels leave two thirds of the
/// width to the map and never become too narrow to read. In a narrow window, panels are hidden, the
/// least recently requested first; they return when the window is wide enough. Measurements are
/// below the map, with annotations as a second tab, closed at first.
class WindowDocks final : public QObject {
    Q_OBJECT

public:
    /// Takes the contents over.
    WindowDocks(QMainWindow& window, const DockContents& contents);

    QDockWidget* datasets() const noexcept { return datasets_.widget; }
    QDockWidget* views() const noexcept { return views_.widget; }
    QDockWidget* georeferencing() const noexcept { return georeferencing_.widget; }
    QDockWidget* haptics() const noexcept { return haptics_.widget; }
    QDockWidget* measurements() const noexcept { return measurements_; }
    QDockWidget* annotations() const noexcept { return annotations_; }

    /// Shows a panel, whatever has to make way.
    void reveal(QDockWidget& dock);
    /// Moves the keyboard focus among the map and the open panels, in a circle: map, layers,
    /// saved views, georeferencing, haptics, measurements, annotations. A panel gets the focus
    /// where it was last, and comes to the front of its tabs.
    void moveFocus(QWidget& map, FocusStep step);
    /// To be called whenever the window has another width.
    void fit();

    void save(QSettings& settings);
    void restore(const QSettings& settings);

private:
    struct Dock {
        QDockWidget* widget = nullptr;
        bool is_folded = false; // away for want of room, not by the user
        int turn = 0;           // when it was asked for; the greater, the later
    };

    QDockWidget* makeDockBelow(const QString& title, const QString& name, QWidget* content);
    void makeDock(Dock& dock, const QString& title, const QString& name, QWidget* content);
    void userToggled(Dock& dock, bool is_visible);
    std::array<Dock*, 4> all() { return {&datasets_, &views_, &georeferencing_, &haptics_}; }
    void fold(Dock& dock, bool is_folded);

    QMainWindow& window_;
    Dock datasets_;
    Dock views_;
    Dock georeferencing_;
    Dock haptics_;
    // Below the map, so that they take no width.
    QDockWidget* measurements_ = nullptr;
    QDockWidget* annotations_ = nullptr;
    int turn_ = 0;
    bool is_fitting_ = false;
};

} // namespace marsview
