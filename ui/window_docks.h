// The panels beside the map, and how much width they may take.
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
    QWidget* georeferencing = nullptr;
    QWidget* haptics = nullptr;
};

/// Datasets on the left; georeferencing, and behind it in tabs haptics, which is closed at first,
/// on the right. Docked panels leave two thirds of the width
/// to the map and are never too narrow to be read: where there is no room for all they make way,
/// first the one that was asked for longest ago, and come back with the room.
class WindowDocks final : public QObject {
    Q_OBJECT

public:
    /// Takes the contents over.
    WindowDocks(QMainWindow& window, const DockContents& contents);

    QDockWidget* datasets() const noexcept { return datasets_.widget; }
    QDockWidget* georeferencing() const noexcept { return georeferencing_.widget; }
    QDockWidget* haptics() const noexcept { return haptics_.widget; }

    /// Shows a panel, whatever has to make way.
    void reveal(QDockWidget& dock);
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

    void makeDock(Dock& dock, const QString& title, const QString& name, QWidget* content);
    void userToggled(Dock& dock, bool is_visible);
    std::array<Dock*, 3> all() { return {&datasets_, &georeferencing_, &haptics_}; }
    void fold(Dock& dock, bool is_folded);

    QMainWindow& window_;
    Dock datasets_;
    Dock georeferencing_;
    Dock haptics_;
    int turn_ = 0;
    bool is_fitting_ = false;
};

} // namespace marsview
