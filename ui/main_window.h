// The window: puts the map, the panels, the toolbar and the dialogs together.
#pragma once

#include "ui/controllers/preferences.h"
#include "ui/controllers/session_controller.h"
#include "ui/window/window_options.h"

#include <QMainWindow>

#include <memory>

namespace marsview {

class AnnotationController;
class AnnotationMarks;
class AnnotationPanel;
class GeoreferencingPanel;
class GlobeOverlays;
class GlobePictures;
class GlobeView;
class HapticsController;
class HapticsPanel;
class LayersPanel;
class LightPopup;
class LoadStatus;
class FlatPictures;
class MainToolBar;
class MapOverlays;
class MeasureController;
class MeasureMarks;
class MeasurePanel;
class NoticeBar;
class NoticeCenter;
class PictureSaver;
class SavedViewsPanel;
class StatusReadout;
class StretchControl;
class TerrainView;
class WindowDocks;
class WindowPlace;
struct WindowActions;
struct WindowCommands;

/// The composition of the window: it makes the parts, places them, and joins them by its commands.
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
    /// The same for the files that the program is started with. Opening these maps is not undone.
    void openAtStart(const QStringList& files);
    /// As a map to look at until the user opens one.
    void openSample(const QString& file);

    TerrainView* view() const noexcept { return view_; }
    GlobeView* globe() const noexcept { return globe_; }
    StatusReadout* readout() const noexcept { return readout_; }
    LayersPanel* datasetPanel() const noexcept { return datasets_; }
    GeoreferencingPanel* georeferencingPanel() const noexcept { return georeferencing_; }
    HapticsPanel* hapticsPanel() const noexcept { return haptics_panel_; }
    MeasureController* measuring() const noexcept { return measure_; }
    MeasurePanel* measurePanel() const noexcept { return measure_panel_; }
    AnnotationController* annotating() const noexcept { return annotate_; }
    AnnotationPanel* annotationPanel() const noexcept { return annotation_panel_; }
    SavedViewsPanel* savedViewsPanel() const noexcept { return views_panel_; }
    HapticsController& haptics() noexcept { return *haptics_; }
    WindowDocks* docks() const noexcept { return docks_; }
    MapOverlays* overlays() const noexcept { return overlays_; }
    WindowCommands& commands() noexcept { return *commands_; }
    const WindowActions& actionSet() const noexcept { return *actions_; }
    SessionController& controller() noexcept { return *controller_; }
    StretchControl& stretch() noexcept { return *stretch_; }
    MainToolBar* toolBar() const noexcept { return tool_bar_; }
    const Session& session() const noexcept { return controller_->session(); }
    QUndoStack& undoStack() noexcept { return controller_->undoStack(); }
    const LoadController& loader() const noexcept { return controller_->loader(); }
    const Preferences& preferences() const noexcept;
    /// Takes effect at once; remembered when the window is.
    void setPreferences(const Preferences& preferences);

    /// Nothing is loading or being prepared, and the picture shows all there is, or there is
    /// nothing to load.
    bool isSettled() const;

Q_SIGNALS:
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
    void makeCenter();
    void makeStatusBar();
    void fillViewMenus();
    void makePictures();
    void makeCommands();
    void connectSession();
    void placeMarks();
    void snapToEachOther();
    void showSession();
    void showActive();
    void showTitle();
    void showPreparation();

    WindowOptions options_;
    TerrainView* view_ = nullptr;
    GlobeView* globe_ = nullptr;
    MapOverlays* overlays_ = nullptr;
    GlobeOverlays* globe_overlays_ = nullptr;
    SessionController* controller_ = nullptr;
    std::unique_ptr<WindowActions> actions_;
    NoticeBar* notice_bar_ = nullptr;
    NoticeCenter* notice_center_ = nullptr;
    WindowMessages messages_;
    bool is_closing_ = false; // the user has answered
    LayersPanel* datasets_ = nullptr;
    GeoreferencingPanel* georeferencing_ = nullptr;
    HapticsController* haptics_ = nullptr;
    HapticsPanel* haptics_panel_ = nullptr;
    MeasureController* measure_ = nullptr;
    MeasureMarks* measure_marks_ = nullptr;
    MeasurePanel* measure_panel_ = nullptr;
    AnnotationController* annotate_ = nullptr;
    AnnotationMarks* annotation_marks_ = nullptr;
    AnnotationPanel* annotation_panel_ = nullptr;
    SavedViewsPanel* views_panel_ = nullptr;
    WindowDocks* docks_ = nullptr;
    WindowPlace* place_ = nullptr; // only where the window is remembered
    MainToolBar* tool_bar_ = nullptr;
    StatusReadout* readout_ = nullptr;
    LoadStatus* load_status_ = nullptr;
    LightPopup* light_popup_ = nullptr;
    FlatPictures* flat_pictures_ = nullptr;   // a child of the view
    GlobePictures* globe_pictures_ = nullptr; // a child of the globe
    PictureSaver* picture_saver_ = nullptr;
    StretchControl* stretch_ = nullptr;
    std::unique_ptr<WindowCommands> commands_; // goes before the parts that it joins
};

} // namespace marsview
