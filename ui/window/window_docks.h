// The panels next to the map, and the width they may take.
#pragma once

#include <QList>
#include <QObject>

#include <array>
#include <optional>

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
/// width to the map and never become too narrow to read. In a narrow window all are tabs on one
/// side, that of the panel that was requested last, and return when the window is wide enough; in
/// one that has no room for a panel at all, the others are hidden as long. Measurements are below
/// the map, with annotations as a second tab, closed at first.
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
    /// where it was last, unless that is a button, and comes to the front of its tabs.
    void moveFocus(QWidget& map, FocusStep step);
    /// To be called whenever the window has another width.
    void fit();

    void save(QSettings& settings);
    /// Panels below the map that were open stay closed until they have something to show.
    void restore(const QSettings& settings);
    /// To be called when a panel below the map has something to show.
    void showRestored(QDockWidget& dock);
    /// Shows a panel below the map because its tool was chosen.
    void showForTool(QDockWidget& dock);
    /// Hides a panel that showForTool() has shown. To be called when another tool is chosen and the
    /// panel has nothing to show.
    void hideForTool(QDockWidget& dock);

    /// Takes the tabs of panels, which show no focus, out of the way of the Tab key.
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    struct Dock {
        QDockWidget* widget = nullptr;
        bool is_folded = false; // hidden for lack of room, not by the user
        /// The side that it left for lack of room, not by the user.
        std::optional<Qt::DockWidgetArea> left_side{};
        int turn = 0; // when it was asked for; the greater, the later
    };

    QDockWidget* makeDockBelow(const QString& title, const QString& name, QWidget* content);
    void makeDock(Dock& dock, const QString& title, const QString& name, QWidget* content);
    void userToggled(Dock& dock, bool is_visible);
    std::array<Dock*, 4> all() { return {&datasets_, &views_, &georeferencing_, &haptics_}; }
    void fold(Dock& dock, bool is_folded);
    Qt::DockWidgetArea homeOf(const Dock& dock) const;
    void moveTo(Dock& dock, Qt::DockWidgetArea side);
    void gather(const Dock& host, Qt::DockWidgetArea side);
    void moveHome();
    void userMoved(Dock& dock);
    void giveMeasurementsHeight(bool is_visible);

    QMainWindow& window_;
    Dock datasets_;
    Dock views_;
    Dock georeferencing_;
    Dock haptics_;
    // Below the map, so that they take no width.
    QDockWidget* measurements_ = nullptr;
    QDockWidget* annotations_ = nullptr;
    QList<QDockWidget*> held_back_; // of those, by restore()
    QList<QDockWidget*> for_tool_;  // of those, shown by showForTool()
    int turn_ = 0;
    bool is_fitting_ = false;
    bool has_height_ = false; // the panel of measurements, from its first showing or the settings
};

} // namespace marsview
