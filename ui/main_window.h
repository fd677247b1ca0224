// The window: menus, toolbar, map, panels and status bar, and what happens between them.
#pragma once

#include "ui/load_controller.h"
#include "ui/loaded_map.h"

#include <QMainWindow>
#include <QUndoStack>

#include <optional>

class QAction;
class QDockWidget;
class QLabel;
class QProgressBar;
class QSlider;
class QToolButton;

namespace marsview {

class GeoreferencingPanel;
class NoticeBar;
class StatusReadout;
class TerrainView;

/// How a window behaves beyond showing maps.
struct WindowOptions {
    /// Size, place and docks are taken from, and left for, the next window.
    enum class Geometry { Remembered, Fixed } geometry = Geometry::Remembered;
    /// Where failures are told besides the signal.
    enum class Failures { InDialogs, BySignalOnly } failures = Failures::InDialogs;
};

class MainWindow final : public QMainWindow {
    Q_OBJECT

public:
    explicit MainWindow(WindowOptions options = {}, QWidget* parent = nullptr);
    ~MainWindow() override;

    /// Loads the map of that file and shows it in place of the present one, which stays if the file
    /// cannot be opened. May be called before the window is shown.
    void open(const QString& file);
    /// Stops what is loading.
    void cancelLoading();
    /// Asks for a file, then opens it.
    void chooseFile();

    TerrainView* view() const noexcept { return view_; }
    StatusReadout* readout() const noexcept { return readout_; }
    GeoreferencingPanel* georeferencingPanel() const noexcept { return panel_; }
    QUndoStack& undoStack() noexcept { return undo_stack_; }
    const LoadController& loader() const noexcept { return *loader_; }
    /// The map that was loaded last; the picture follows within a few frames.
    const LoadedMap& map() const noexcept { return map_; }

Q_SIGNALS:
    /// Nothing is loading and the picture shows all there is, or there is nothing to load.
    void settled();
    /// "FILE: WHY", or why nothing can be drawn.
    void openFailed(const QString& problem);

protected:
    void closeEvent(QCloseEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

private:
    // What the load under way was started for.
    enum class Purpose { Open, Override, UndoStep };

    void makeActions();
    void makeToolBar();
    void makeDocks();
    void makeStatusBar();
    void connectLoader();
    void connectView();
    void restoreWindow();
    void fitDockToWidth();

    void startLoad(Purpose purpose, const DatasetSpec& spec);
    void requestOverrides(Purpose purpose, const RasterOverrides& overrides);
    void acceptMap(const LoadedMap& map);
    void rejectLoad();
    void settleUndoStack();
    void reportFailure(const QString& title, const QString& problem);
    void savePicture();
    void showExaggeration(double exaggeration);
    void showAbout();
    void showKeys();
    void settleIfIdle();

    WindowOptions options_;
    TerrainView* view_ = nullptr;
    NoticeBar* notices_ = nullptr;
    StatusReadout* readout_ = nullptr;
    GeoreferencingPanel* panel_ = nullptr;
    QDockWidget* georeferencing_dock_ = nullptr;
    QSlider* exaggeration_slider_ = nullptr;
    QLabel* exaggeration_label_ = nullptr;
    QLabel* progress_label_ = nullptr;
    QProgressBar* progress_bar_ = nullptr;
    QToolButton* cancel_button_ = nullptr;
    QAction* open_action_ = nullptr;
    QAction* cancel_action_ = nullptr;
    QAction* save_picture_action_ = nullptr;
    QAction* home_action_ = nullptr;
    QAction* north_action_ = nullptr;
    QAction* exaggerate_action_ = nullptr;
    QAction* flatten_action_ = nullptr;
    QList<QAction*> map_actions_; // of use only while a map is open

    LoadedMap map_;
    QUndoStack undo_stack_;
    bool is_dock_folded_ = false; // away while the window is too narrow for it
    int applied_index_ = 0;       // of the undo stack, for the map in effect
    bool is_settling_ = false;
    std::optional<RenderLimits> render_limits_; // known once there is a graphics context
    QString waiting_file_;                      // to be opened then
    Purpose purpose_ = Purpose::Open;
    LoadController* loader_ = nullptr;
};

} // namespace marsview
