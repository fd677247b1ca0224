// The window: puts the map, the panels, the toolbar and the dialogs together.
#pragma once

#include "haptics/device/crash_marker.h"
#include "haptics/sound/sound_player.h"
#include "ui/controllers/device_finder.h"
#include "ui/controllers/preferences.h"
#include "ui/controllers/session_controller.h"
#include "ui/controllers/spacemouse_controller.h"
#include "ui/dialogs/go_to_dialog.h"
#include "ui/text/place_facts.h"

#include <QMainWindow>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace marsview {

class LayersPanel;
class GeoreferencingPanel;
class ContactSounds;
class ContourTools;
class GuideWindow;
class HapticsController;
class HapticsPanel;
class LightPopup;
class LoadStatus;
class MeasureController;
class MeasureMarks;
class MeasurePanel;
class MapOverlays;
class MainToolBar;
class MapMenu;
class NameSearch;
class NoticeBar;
class NoticeCenter;
class PictureSaver;
class VectorTools;
class ProjectController;
class ProjectMenu;
class RecentFiles;
class StatusReadout;
class StretchControl;
class TerrainView;
class WindowDocks;
class WindowNotices;
class WindowPlace;
struct GroundPoint;
struct WindowActions;

/// How a window behaves beyond showing maps.
struct WindowOptions {
    /// Size, place, docks, recent files and preferences are taken from, and left for, the next
    /// window; or all of it is as on the first day.
    enum class Geometry { Remembered, Fixed } geometry = Geometry::Remembered;
    /// Where failures are reported besides the signal.
    enum class Failures { InDialogs, BySignalOnly } failures = Failures::InDialogs;
    /// Whether the user is asked before unsaved changes are lost, and about what a crash left
    /// behind.
    enum class Questions { None, Ask } questions = Questions::None;
    /// Where copies of unsaved projects go; empty for none.
    std::filesystem::path autosave_folder{};
    /// The folder of the maps that come with the program.
    std::filesystem::path bundled_maps{};
    /// How maps are read, and the resources they share unless preferences override them.
    MapOpener opener{};
    /// Of haptic devices; empty for those that come with the program.
    DriverMaker make_drivers{};
    SpaceMouseOptions spacemouse{};
    /// Opens the output of contact sounds.
    std::function<Result<SoundPlayer>()> open_sound = &SoundPlayer::open;
};

class MainWindow final : public QMainWindow {
    Q_OBJECT

public:
    explicit MainWindow(const WindowOptions& options = {}, QWidget* parent = nullptr);
    ~MainWindow() override;

    /// Loads the map of that file as a layer on top, or replaces the session by that project. A
    /// file that cannot be opened changes nothing. May be called before the window is shown.
    void open(const QString& file);
    /// The same for several: maps lie on top of each other and of the first project, and vector
    /// files are drawn over them.
    void openAll(const QStringList& files);
    /// As a map to look at until the user opens one.
    void openSample(const QString& file);
    /// Cancels the load in progress.
    void cancelLoading();
    /// Asks for files, then opens them.
    void chooseFile();
    void chooseFolder();
    /// Asks for an address, then opens it.
    void chooseAddress();

    TerrainView* view() const noexcept { return view_; }
    StatusReadout* readout() const noexcept { return readout_; }
    LayersPanel* datasetPanel() const noexcept { return datasets_; }
    GeoreferencingPanel* georeferencingPanel() const noexcept { return georeferencing_; }
    HapticsPanel* hapticsPanel() const noexcept { return haptics_panel_; }
    MeasureController* measuring() const noexcept { return measure_; }
    MeasurePanel* measurePanel() const noexcept { return measure_panel_; }
    VectorTools& vectorTools() const noexcept { return *vector_tools_; }
    HapticsController& haptics() noexcept { return *haptics_; }
    const SpaceMouseController& spacemouse() const noexcept { return *spacemouse_; }
    WindowDocks* docks() const noexcept { return docks_; }
    MapOverlays* overlays() const noexcept { return overlays_; }
    MapMenu* mapMenu() const noexcept { return map_menu_; }
    RecentFiles* recentFiles() const noexcept { return recent_; }
    const WindowActions& actionSet() const noexcept { return *actions_; }
    SessionController& controller() noexcept { return *controller_; }
    ProjectController& project() noexcept { return *project_; }
    ProjectMenu& projectMenu() noexcept { return *project_menu_; }
    StretchControl& stretch() noexcept { return *stretch_; }
    ContourTools& contourTools() noexcept { return *contour_tools_; }
    NameSearch& nameSearch() noexcept { return *name_search_; }
    MainToolBar* toolBar() const noexcept { return tool_bar_; }
    const Session& session() const noexcept { return controller_->session(); }
    QUndoStack& undoStack() noexcept { return controller_->undoStack(); }
    const LoadController& loader() const noexcept { return controller_->loader(); }
    const Preferences& preferences() const noexcept { return preferences_; }

    /// Takes effect at once; remembered when the window is.
    void setPreferences(const Preferences& preferences);
    /// Asks for a name or a coordinate.
    void goToPlace();
    void addMeasuredPoint();
    /// Focuses the search field, or asks for a name where the toolbar has no room for it.
    void findName();
    /// Puts the position that the status bar shows on the clipboard.
    void copyCoordinates();
    /// The same for a place of the scene's grid.
    void copyCoordinates(GridPoint grid);
    void showPreferences();
    void showAbout();
    void showGuide();
    void showKeys();

Q_SIGNALS:
    /// Nothing is loading or being prepared, and the picture shows all there is, or there is
    /// nothing to load.
    void settled();
    /// "FILE: WHY", or why nothing can be drawn.
    void openFailed(const QString& problem);

protected:
    void closeEvent(QCloseEvent* event) override;
    void changeEvent(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

private:
    bool isRemembered() const noexcept
    {
        return options_.geometry == WindowOptions::Geometry::Remembered;
    }
    void makeCenter();
    void makeStatusBar();
    void connectActions();
    void connectPanels();
    void connectController();
    void connectProject();
    void connectNames();
    void showTitle();
    void connectView();
    void connectHint();
    PlaceFacts factsAt(const GroundPoint& ground) const;
    void connectHaptics();
    void connectMeasuring();
    void connectSpaceMouse();
    void connectSounds();
    void makeNotices();
    void showHaptics();
    void markConnection();
    void restoreWindow();
    void connectReadout();
    void openMaps(QStringList maps);
    void showSession();
    void showActive();
    void showPreparation();
    void reportFailure(const QString& title, const QString& problem);
    static QStringList rasterFilters();
    void savePicture();
    void showCancel();
    void openLightPopup();
    void settleIfIdle();

    WindowOptions options_;
    std::size_t standard_tile_bytes_ = 0;
    Preferences preferences_;
    TerrainView* view_ = nullptr;
    MapOverlays* overlays_ = nullptr;
    MapMenu* map_menu_ = nullptr;
    SessionController* controller_ = nullptr;
    std::unique_ptr<WindowActions> actions_;
    NoticeBar* notice_bar_ = nullptr;
    NoticeCenter* notice_center_ = nullptr;
    ProjectController* project_ = nullptr;
    ProjectMenu* project_menu_ = nullptr;
    bool is_closing_ = false; // the user has answered
    WindowNotices* notices_ = nullptr;
    LayersPanel* datasets_ = nullptr;
    GeoreferencingPanel* georeferencing_ = nullptr;
    HapticsController* haptics_ = nullptr;
    std::optional<CrashMarker> connection_marker_; // while a device is connected
    HapticsPanel* haptics_panel_ = nullptr;
    SpaceMouseController* spacemouse_ = nullptr;
    ContactSounds* sounds_ = nullptr;
    bool is_sound_remembered_ = false; // switched on by the settings, not by the user
    MeasureController* measure_ = nullptr;
    MeasureMarks* measure_marks_ = nullptr;
    MeasurePanel* measure_panel_ = nullptr;
    VectorTools* vector_tools_ = nullptr;
    WindowDocks* docks_ = nullptr;
    WindowPlace* place_ = nullptr; // only where the window is remembered
    MainToolBar* tool_bar_ = nullptr;
    StatusReadout* readout_ = nullptr;
    LoadStatus* load_status_ = nullptr;
    RecentFiles* recent_ = nullptr;
    LightPopup* light_popup_ = nullptr;
    PictureSaver* picture_saver_ = nullptr;
    StretchControl* stretch_ = nullptr;
    NameSearch* name_search_ = nullptr;
    ContourTools* contour_tools_ = nullptr;
    GuideWindow* guide_ = nullptr; // once it was asked for
    GoToEntry last_place_;
    QString last_folder_;
};

} // namespace marsview
