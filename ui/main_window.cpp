#include "ui/main_window.h"

#include "core/files/file_address.h"
#include "core/session/layer_groups.h"
#include "core/vector/vector_file.h"
#include "haptics/drivers/built_in_drivers.h"
#include "ui/action_icons.h"
#include "ui/canvas/map_keys.h"
#include "ui/canvas/terrain_view.h"
#include "ui/contour_tools.h"
#include "ui/controllers/contact_sounds.h"
#include "ui/controllers/haptics/haptics_controller.h"
#include "ui/controllers/measure_controller.h"
#include "ui/controllers/recent_files.h"
#include "ui/controllers/vector_overlays.h"
#include "ui/dialogs/about_dialog.h"
#include "ui/dialogs/address_dialog.h"
#include "ui/dialogs/guide_window.h"
#include "ui/dialogs/preferences_dialog.h"
#include "ui/keys_dialog.h"
#include "ui/load_status.h"
#include "ui/main_tool_bar.h"
#include "ui/map_menu.h"
#include "ui/name_search.h"
#include "ui/overlay/map_labels.h"
#include "ui/overlay/map_overlays.h"
#include "ui/overlay/measure_marks.h"
#include "ui/panels/georeferencing_panel.h"
#include "ui/panels/haptics_panel.h"
#include "ui/panels/layers_panel.h"
#include "ui/panels/measure_panel.h"
#include "ui/picture_saver.h"
#include "ui/project/project_controller.h"
#include "ui/project/project_menu.h"
#include "ui/status_readout.h"
#include "ui/stretch_control.h"
#include "ui/text/haptics_text.h"
#include "ui/text/number_text.h"
#include "ui/text/sentence.h"
#include "ui/theme.h"
#include "ui/vector_tools.h"
#include "ui/whats_this.h"
#include "ui/widgets/coordinate_field.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/light_popup.h"
#include "ui/widgets/notice_bar.h"
#include "ui/widgets/notice_center.h"
#include "ui/window_actions.h"
#include "ui/window_docks.h"
#include "ui/window_notices.h"
#include "ui/window_place.h"

#include <QActionGroup>
#include <QClipboard>
#include <QCloseEvent>
#include <QDir>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QGridLayout>
#include <QGuiApplication>
#include <QImage>
#include <QKeyEvent>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QSettings>
#include <QStatusBar>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace marsview {
namespace {

constexpr QSize kDefaultSize{1280, 800};
constexpr int kMessageDuration = 4000;                 // ms
constexpr const char* kConnected = "window.connected"; // of CrashMarker

// A driver that ends the program shall not do so at every start.
bool hasEndedWhileConnected()
{
    const std::filesystem::path folder = CrashMarker::defaultFolder();
    const bool has_ended = CrashMarker::leftBehind(folder, kConnected).has_value();
    CrashMarker::forget(folder, kConnected);
    return has_ended;
}

// Files and addresses that can be opened.
QStringList mapsIn(const QMimeData& data)
{
    QStringList files;
    for (const QUrl& url : data.urls()) {
        if (const auto path = localPathOf(url.toString(QUrl::FullyEncoded).toStdString());
            url.isLocalFile() && path) {
            // A folder has no slash at its end.
            files.append(QDir::cleanPath(QString::fromStdString(*path)));
        } else if (problemOfAddress(url.toString()).isEmpty()) {
            files.append(url.toString());
        }
    }
    return files;
}

DriverMaker driversOf(const WindowOptions& options)
{
    return options.make_drivers ? options.make_drivers : [] { return builtInDrivers(); };
}

// A property of the application; set where a signal ends the program.
constexpr const char* kEndsBySignal = "endsBySignal";

QString folderKey()
{
    return QStringLiteral("files/folder");
}

QString overlayKey(const QAction& action)
{
    return QStringLiteral("overlays/%1").arg(action.objectName());
}

QString hintKey()
{
    return QStringLiteral("hint/isDismissed");
}

} // namespace

MainWindow::MainWindow(const WindowOptions& options, QWidget* parent)
    : QMainWindow(parent)
    , options_(options)
    , view_(new TerrainView(this))
    , overlays_(new MapOverlays(*view_))
    , controller_(new SessionController(*view_, this))
    , actions_(std::make_unique<WindowActions>(*this, *view_, controller_->undoStack()))
    , notice_bar_(new NoticeBar(this))
    , notice_center_(new NoticeCenter(*notice_bar_, this))
    , datasets_(new LayersPanel(actions_->layer, this))
    , georeferencing_(new GeoreferencingPanel(this))
    , haptics_(new HapticsController(*view_, driversOf(options), this))
    , haptics_panel_(new HapticsPanel(*haptics_, *actions_->contact_model_group, this))
    , measure_(new MeasureController(*view_, controller_->undoStack(), this))
    , measure_marks_(new MeasureMarks(*measure_, view_))
    , measure_panel_(new MeasurePanel(*measure_, this))
    , docks_(new WindowDocks(*this,
                             {.datasets = datasets_,
                              .georeferencing = georeferencing_,
                              .haptics = haptics_panel_,
                              .measurements = measure_panel_}))
    , tool_bar_(new MainToolBar(*actions_, this))
    , readout_(new StatusReadout(this))
    , load_status_(new LoadStatus(this))
    , recent_(new RecentFiles(*actions_->recent,
                              isRemembered() ? RecentFiles::Memory::Settings
                                             : RecentFiles::Memory::WindowOnly,
                              this))
    , light_popup_(new LightPopup(this))
    , picture_saver_(new PictureSaver(*view_,
                                      *overlays_,
                                      isRemembered() ? PictureSaver::Memory::Settings
                                                     : PictureSaver::Memory::WindowOnly,
                                      this))
    , stretch_(new StretchControl(*controller_, *actions_, *view_, this))
{
    if (!options_.opener.resources.tiles) {
        options_.opener.resources.tiles = std::make_shared<TileCache>(TileCacheOptions{});
    }
    standard_tile_bytes_ = options_.opener.resources.tiles->bytesMax();
    setAcceptDrops(true);
    setWindowIcon(programIcon());
    map_menu_ = new MapMenu(*view_, [this](const GroundPoint& ground) { return factsAt(ground); });
    resize(kDefaultSize);
    addToolBar(tool_bar_);
    makeCenter();
    makeStatusBar();
    actions_->panels->addAction(docks_->datasets()->toggleViewAction());
    actions_->panels->addAction(docks_->georeferencing()->toggleViewAction());
    actions_->panels->addAction(docks_->haptics()->toggleViewAction());
    actions_->panels->addAction(docks_->measurements()->toggleViewAction());
    actions_->panels->addSeparator();
    actions_->panels->addActions(overlays_->visibilityActions());
    actions_->view_menu->insertActions(actions_->panels->menuAction(), overlays_->terrainActions());
    actions_->view_menu->insertSeparator(actions_->panels->menuAction());
    setIcons(*docks_);
    for (QMenu* menu : menuBar()->findChildren<QMenu*>()) {
        menu->installEventFilter(this);
    }
    explainControls({.view = view_,
                     .overlays = overlays_,
                     .readout = readout_,
                     .load_status = load_status_,
                     .docks = docks_,
                     .actions = actions_.get()});
    connectActions();
    connectPanels();
    connectController();
    connectProject();
    connectView();
    connectNames();
    connectMeasuring();
    connectHint();
    makeNotices();
    if (isRemembered()) {
        restoreWindow();
        place_ = new WindowPlace(*this);
        place_->fit();
        haptics_->setSettings(hapticsSettingsFrom(QSettings()));
    }
    connectReadout();
    connectHaptics();
    connectSpaceMouse();
    connectSounds();
    setPreferences(isRemembered() ? preferencesFrom(QSettings()) : Preferences{});
    showSession();
    if (isRemembered() && hasEndedWhileConnected()) {
        haptics_->device().holdBackRemembered(haptics_->settings().device);
    } else {
        haptics_->device().connectToRemembered(haptics_->settings().device);
    }
    view_->setFocus();
}

MainWindow::~MainWindow()
{
    delete measure_;       // it is the view's tool
    delete sounds_;        // it listens to the view
    delete spacemouse_;    // it moves its camera
    delete haptics_panel_; // it looks at the controller
    delete haptics_;       // and that at the view
    connection_marker_.reset();
}

void MainWindow::makeCenter()
{
    auto* center = new QWidget(this);
    // Notices lie over the map: the picture does not move when they appear and disappear.
    auto* layout = new QGridLayout(center);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(view_, 0, 0);
    layout->addWidget(notice_bar_, 0, 0, Qt::AlignTop);
    notice_bar_->raise();
    connect(notice_bar_, &NoticeBar::coverChanged, this,
            [this] { overlays_->setCovered(notice_bar_->coveredHeight()); });
    setCentralWidget(center);
}

void MainWindow::makeStatusBar()
{
    statusBar()->addWidget(readout_, 1);
    statusBar()->addPermanentWidget(load_status_);
    // As high without anything going on as with it: the map keeps its size.
    load_status_->show();
    statusBar()->ensurePolished();
    statusBar()->setMinimumHeight(statusBar()->sizeHint().height());
    load_status_->hide();
}

void MainWindow::connectActions()
{
    const auto on = [this](QAction* action, auto reaction) {
        connect(action, &QAction::triggered, this, reaction);
    };
    on(actions_->open, [this] { chooseFile(); });
    on(actions_->open_folder, [this] { chooseFolder(); });
    on(actions_->open_address, [this] { chooseAddress(); });
    on(actions_->save_picture, [this] { savePicture(); });
    on(actions_->cancel_loading,
       [this] { controller_->isBusy() ? cancelLoading() : picture_saver_->cancel(); });
    on(actions_->stop_preparing, [this] { controller_->stopPreparing(); });
    on(actions_->quit, [this] { close(); });
    on(actions_->preferences, [this] { showPreferences(); });
    connect(actions_->tools, &QActionGroup::triggered, this,
            [this](QAction* action) { view_->setTool(static_cast<Tool>(action->data().toInt())); });
    on(actions_->home, [this] { view_->goHome(); });
    on(actions_->north, [this] { view_->turnNorthUp(); });
    on(actions_->go_to_place, [this] { goToPlace(); });
    on(actions_->find_name, [this] { findName(); });
    for (QAction* action : std::as_const(actions_->steps)) {
        on(action, [this, step = static_cast<NavigationStep>(action->data().toInt())] {
            view_->step(step);
        });
    }
    on(actions_->exaggerate_more, [this] { controller_->stepExaggeration(1); });
    on(actions_->exaggerate_less, [this] { controller_->stepExaggeration(-1); });
    on(actions_->toggle_visibility,
       [this](bool is_visible) { controller_->setVisible(session().active, is_visible); });
    on(actions_->layer.go_to, [this] { controller_->goTo(session().active); });
    on(actions_->layer.prepare, [this] { controller_->prepare(session().active); });
    on(actions_->layer.rename, [this] {
        docks_->reveal(*docks_->datasets());
        datasets_->editName();
    });
    on(actions_->layer.remove, [this] { controller_->remove(session().active); });
    const auto step = [this](GroupStep to) {
        if (const auto index = indexBeside(session(), session().active, to)) {
            controller_->move(session().active, *index);
        }
    };
    on(actions_->layer.move_up, [step] { step(GroupStep::Up); });
    on(actions_->layer.move_down, [step] { step(GroupStep::Down); });
    on(actions_->override_georeferencing, [this] {
        docks_->reveal(*docks_->georeferencing());
        georeferencing_->edit();
    });
    on(actions_->light, [this] { openLightPopup(); });
    on(actions_->contours, [this](bool is_checked) { controller_->setContours(is_checked); });
    connect(actions_->shading_group, &QActionGroup::triggered, this, [this](QAction* action) {
        controller_->setShading(static_cast<ShadingMode>(action->data().toInt()));
    });
    connect(actions_->ramp_group, &QActionGroup::triggered, this, [this](QAction* action) {
        controller_->setRamp(session().active, action->data().toString());
    });
    connect(actions_->contact_model_group, &QActionGroup::triggered, this, [this](QAction* action) {
        Preferences preferences = preferences_;
        preferences.contact_model = static_cast<ContactModelKind>(action->data().toInt());
        setPreferences(preferences);
    });
    on(actions_->next_panel, [this] { docks_->moveFocus(*view_, FocusStep::Next); });
    on(actions_->previous_panel, [this] { docks_->moveFocus(*view_, FocusStep::Previous); });
    on(actions_->full_screen, [this](bool is_full) {
        setWindowState(windowState().setFlag(Qt::WindowFullScreen, is_full));
    });
    on(actions_->guide, [this] { showGuide(); });
    on(actions_->keys, [this] { showKeys(); });
    on(actions_->about, [this] { showAbout(); });
}

void MainWindow::connectPanels()
{
    (new MapKeys(*view_, this))->addTo(*datasets_->list());
    connect(datasets_, &LayersPanel::activationRequested, controller_,
            &SessionController::activate);
    connect(datasets_, &LayersPanel::visibilityRequested, controller_,
            &SessionController::setVisible);
    connect(datasets_, &LayersPanel::nameRequested, controller_, &SessionController::rename);
    connect(datasets_, &LayersPanel::moveRequested, controller_, &SessionController::move);
    connect(datasets_, &LayersPanel::rampRequested, controller_, &SessionController::setRamp);
    connect(georeferencing_, &GeoreferencingPanel::overridesRequested, this,
            [this](const RasterOverrides& overrides) {
                controller_->overrideGeoreferencing(session().active, overrides);
            });
    connect(tool_bar_, &MainToolBar::exaggerationRequested, controller_,
            [this](double exaggeration) { controller_->setExaggeration(exaggeration); });
    connect(tool_bar_, &MainToolBar::exaggerationDragged, controller_, [this](double exaggeration) {
        controller_->setExaggeration(exaggeration, ChangeKind::OfDrag);
    });
    connect(tool_bar_, &MainToolBar::dragEnded, controller_, &SessionController::endDrag);
    connect(light_popup_, &LightPopup::lightChanged, controller_, &SessionController::setLight);
    connect(load_status_, &LoadStatus::cancelRequested, this, &MainWindow::cancelLoading);
    connect(load_status_, &LoadStatus::stopPreparingRequested, controller_,
            &SessionController::stopPreparing);
    connect(recent_, &RecentFiles::chosen, this, &MainWindow::open);
    connect(load_status_, &LoadStatus::cancelSavingRequested, picture_saver_,
            &PictureSaver::cancel);
    connect(picture_saver_, &PictureSaver::progressed, this,
            [this](const QString& file, double share) {
                load_status_->showSaving(file, share);
                showCancel();
            });
    const auto end_saving = [this] {
        load_status_->endSaving();
        showCancel();
    };
    connect(picture_saver_, &PictureSaver::failed, this, end_saving);
    connect(picture_saver_, &PictureSaver::saved, this, end_saving);
    connect(picture_saver_, &PictureSaver::canceled, this, end_saving);
    connect(picture_saver_, &PictureSaver::canceled, this, [this] {
        //: In the status bar, for a few seconds
        statusBar()->showMessage(tr("Saving canceled"), kMessageDuration);
    });
    connect(picture_saver_, &PictureSaver::saved, this, [this](const QString& file) {
        //: In the status bar, for a few seconds; %1 is a file
        statusBar()->showMessage(tr("Saved %1").arg(isolated(QDir::toNativeSeparators(file))),
                                 kMessageDuration);
    });
    connect(picture_saver_, &PictureSaver::failed, this,
            [this](const QString& problem) { reportFailure(tr("Cannot Save Picture"), problem); });
}

void MainWindow::connectController()
{
    connect(controller_, &SessionController::sessionChanged, this, &MainWindow::showSession);
    connect(controller_, &SessionController::loadProgressed, this,
            [this](const LoadReport& report) {
                load_status_->showReport(report);
                //: Shown in the middle of the window while the first map comes; %1 is a file
                view_->setHint(tr("Opening %1…").arg(isolated(QFileInfo(report.file).fileName())));
                showCancel();
            });
    connect(controller_, &SessionController::loadingEnded, this, [this] {
        load_status_->endLoading();
        view_->setHint({});
        showCancel();
        settleIfIdle();
    });
    connect(controller_, &SessionController::loadingCanceled, this, [this] {
        //: In the status bar, for a few seconds
        statusBar()->showMessage(tr("Loading canceled"), kMessageDuration);
    });
    connect(controller_, &SessionController::preparingProgressed, this,
            [this](const PrepareProgress& progress) {
                load_status_->showPreparing(progress);
                actions_->stop_preparing->setEnabled(true);
            });
    connect(controller_, &SessionController::preparingEnded, this, [this] {
        load_status_->endPreparing();
        actions_->stop_preparing->setEnabled(false);
        settleIfIdle();
    });
    connect(controller_, &SessionController::preparationChanged, this,
            &MainWindow::showPreparation);
    connect(controller_, &SessionController::opened, this, [this](const QString& file) {
        recent_->add(file);
        if (isAddress(file)) {
            return;
        }
        last_folder_ = QFileInfo(file).absolutePath();
        if (isRemembered()) {
            QSettings().setValue(folderKey(), last_folder_);
        }
    });
    connect(controller_, &SessionController::failed, this,
            [this](const QString& problem) { reportFailure(tr("Cannot Open Map"), problem); });
    connect(controller_, &SessionController::overrideFailed, this,
            [this](LayerId id, const QString& problem) {
                controller_->activate(id);
                docks_->reveal(*docks_->georeferencing());
                georeferencing_->showFailure(problem);
            });
}

void MainWindow::connectProject()
{
    project_ = new ProjectController(
        *controller_, *measure_, *view_,
        {.bundled = options_.bundled_maps, .autosave_folder = options_.autosave_folder}, this);
    project_menu_ = new ProjectMenu(
        {.window = *this,
         .file_menu = *actions_->file,
         .session = *controller_,
         .project = *project_,
         .notices = *notice_center_,
         .memory = isRemembered() ? RecentFiles::Memory::Settings : RecentFiles::Memory::WindowOnly,
         .has_questions = options_.questions == WindowOptions::Questions::Ask},
        this);
    connect(project_, &ProjectController::changed, this, &MainWindow::showTitle);
    connect(project_, &ProjectController::failed, this,
            [this](const QString& problem) { reportFailure(tr("Project"), problem); });
    connect(project_, &ProjectController::saved, this, [this](const QString& file) {
        //: In the status bar, for a few seconds; %1 is a file
        statusBar()->showMessage(tr("Saved %1").arg(isolated(QDir::toNativeSeparators(file))),
                                 kMessageDuration);
    });
}

void MainWindow::connectNames()
{
    contour_tools_ = new ContourTools({.window = *this,
                                       .session = *controller_,
                                       .view = *view_,
                                       .interval = *actions_->contour_interval,
                                       .export_contours = *actions_->export_contours},
                                      this);
    connect(contour_tools_, &ContourTools::exported, this, [this](const QString& file) {
        //: In the status bar, for a few seconds; %1 is a file
        statusBar()->showMessage(tr("Saved %1").arg(isolated(QDir::toNativeSeparators(file))),
                                 kMessageDuration);
    });
    connect(contour_tools_, &ContourTools::failed, this, [this](const QString& problem) {
        reportFailure(tr("Cannot Export Contours"), problem);
    });
    vector_tools_ = new VectorTools({.window = *this,
                                     .session = *controller_,
                                     .view = *view_,
                                     .notices = *notice_center_,
                                     .open = *actions_->open_vector,
                                     .files = *actions_->vector_files},
                                    this);
    connect(vector_tools_, &VectorTools::opened, this, [this](const QString& message) {
        statusBar()->showMessage(message, kMessageDuration);
    });
    connect(vector_tools_, &VectorTools::failed, this, [this](const QString& problem) {
        reportFailure(tr("Cannot Open Vector File"), problem);
    });
    name_search_ = new NameSearch({.window = *this,
                                   .view = *view_,
                                   .overlays = *overlays_,
                                   .field = tool_bar_->searchField(),
                                   .open_names = *actions_->open_names,
                                   .is_remembered = isRemembered()},
                                  this);
    const auto show_names = [this] {
        overlays_->labels()->setNames(name_search_->namesOnMap().names);
    };
    connect(name_search_, &NameSearch::changed, this, show_names);
    show_names();
    connect(name_search_, &NameSearch::opened, this, [this](const QString& message) {
        statusBar()->showMessage(message, kMessageDuration);
    });
    connect(name_search_, &NameSearch::failed, this,
            [this](const QString& problem) { reportFailure(tr("Cannot Open Names"), problem); });
}

void MainWindow::connectView()
{
    connect(view_, &TerrainView::ready, this, &MainWindow::settleIfIdle, Qt::QueuedConnection);
    connect(view_, &TerrainView::unavailable, this,
            [this](const QString& reason) { reportFailure(tr("Cannot Draw"), reason); });
    connect(view_, &TerrainView::toolChanged, this, [this](Tool tool) {
        actions_->showTool(tool, measure_->kind());
        if (tool == Tool::Measure) {
            docks_->measurements()->show();
        }
    });
    connect(view_, &TerrainView::exaggerationChanged, tool_bar_, &MainToolBar::showExaggeration);
    connect(view_, &TerrainView::mapShown, this, &MainWindow::showActive);
    connect(view_, &TerrainView::pictureCompleted, this, &MainWindow::settleIfIdle);
    connect(view_, &TerrainView::pictureCompleted, this, &MainWindow::showPreparation);
    connect(view_, &TerrainView::detailChanged, readout_, &StatusReadout::setDetail);
    connect(view_, &TerrainView::loadingChanged, readout_, &StatusReadout::setLoading);
    connect(view_, &TerrainView::problemChanged, readout_, &StatusReadout::setProblem);
    connect(view_, &TerrainView::problemChanged, this, &MainWindow::showPreparation);
}

// For people who have not dismissed it yet.
void MainWindow::connectHint()
{
    if (!isRemembered() || QSettings().value(hintKey(), false).toBool()) {
        return;
    }
    connect(overlays_, &MapOverlays::hintDismissed, this,
            [] { QSettings().setValue(hintKey(), true); });
    overlays_->offerHint();
}

PlaceFacts MainWindow::factsAt(const GroundPoint& ground) const
{
    const std::shared_ptr<const Map>& map = view_->ground().maps()[ground.index].map;
    const auto& layers = session().layers;
    const auto layer = std::find_if(layers.begin(), layers.end(),
                                    [&](const Layer& known) { return known.map == map; });
    PlaceFacts facts = placeFacts(
        *map, layer != layers.end() ? QString::fromStdString(layer->name) : QString(), ground.grid,
        {.format = preferences_.coordinates, .unit = preferences_.height_unit});
    constexpr double kReachPoints = 6.0;
    const ScenePoint place = view_->ground().maps()[ground.index].frame.toScene(
        ground.grid, ground.height_m * view_->exaggeration());
    const double point_m =
        view_->devicePixelRatioF() * metersPerPixel(view_->camera(), view_->viewport(), place);
    for (const VectorOverlays::Hit& hit :
         vector_tools_->overlays().featuresAt(place, kReachPoints * point_m)) {
        facts.facts.push_back({.name = tr("Vector file"), .value = hit.file});
        for (const auto& [name, value] : hit.attributes) {
            facts.facts.push_back({.name = name, .value = value});
        }
    }
    return facts;
}

// Children of the window alone: the view loses the focus while the window is being destroyed.
void MainWindow::connectReadout()
{
    connect(view_, &TerrainView::pointerMoved, readout_,
            [view = view_, readout = readout_](const std::optional<RayHit>& hit) {
                readout->setSource(view->readingSource());
                readout->setPlace(
                    hit ? std::optional(
                              ReadPlace{.hit = *hit, .screen_pixel_m = view->metersPerPoint(*hit)})
                        : std::nullopt);
            });
    connect(readout_, &StatusReadout::focusChanged, view_, &TerrainView::setReadElsewhere);
    connect(readout_, &StatusReadout::formatChosen, this, [this](const CoordinateFormat& format) {
        Preferences preferences = preferences_;
        preferences.coordinates = format;
        setPreferences(preferences);
    });
    readout_->setCopyAction(actions_->copy_coordinates);
    connect(actions_->copy_coordinates, &QAction::triggered, this, [this] { copyCoordinates(); });
    connect(actions_->coordinate_format, &QMenu::aboutToShow, this, [this] {
        actions_->coordinate_format->clear();
        readout_->fillMenu(*actions_->coordinate_format);
    });
}

void MainWindow::markConnection()
{
    const bool is_connected = haptics_->device().connection() == HapticsConnection::Connected &&
                              !haptics_->device().isReplaying();
    if (!is_connected) {
        connection_marker_.reset();
    } else if (!connection_marker_) {
        connection_marker_.emplace(CrashMarker::set(CrashMarker::defaultFolder(), kConnected));
    }
}

void MainWindow::connectHaptics()
{
    haptics_->recorder().setMapsInUse([this] {
        std::vector<std::string> paths;
        for (const Layer& layer : session().layers) {
            paths.push_back(layer.map->spec().path);
        }
        return paths;
    });
    connect(&haptics_->device(), &DeviceSession::connectionChanged, this, &MainWindow::showHaptics);
    connect(&haptics_->device(), &DeviceSession::connectionChanged, this, [this] {
        if (isRemembered()) {
            markConnection();
        }
    });
    connect(&haptics_->recorder(), &TouchRecorder::changed, this, &MainWindow::showHaptics);
    connect(haptics_, &HapticsController::settingsChanged, this, [this] {
        if (isRemembered()) {
            QSettings settings;
            save(haptics_->settings(), settings);
        }
    });
    connect(haptics_, &HapticsController::stoppedChanged, this, &MainWindow::showHaptics);
    connect(&haptics_->recorder(), &TouchRecorder::failed, this,
            [this](const QString& problem) { reportFailure(tr("Cannot Record"), problem); });
    connect(&haptics_->recorder(), &TouchRecorder::recorded, this,
            [this](const QString& file, qulonglong updates, RecordingEnd end) {
                statusBar()->showMessage(recordedText(file, updates, end), kMessageDuration);
            });
    connect(actions_->haptic_devices, &QAction::triggered, this, [this] {
        docks_->reveal(*docks_->haptics());
        haptics_panel_->list()->setFocus();
    });
    connect(actions_->record_touch, &QAction::triggered, this, [this] {
        haptics_->recorder().isRecording() ? haptics_->recorder().stop()
                                           : haptics_panel_->chooseRecording();
    });
    connect(actions_->replay_touch, &QAction::triggered, haptics_panel_,
            &HapticsPanel::chooseReplay);
    connect(actions_->save_flight, &QAction::triggered, haptics_panel_,
            &HapticsPanel::chooseFlightRecord);
    connect(&haptics_->recorder(), &TouchRecorder::ticksSaved, this,
            [this](const SavedTicks& saved) {
                statusBar()->showMessage(savedTicksText(saved), kMessageDuration);
            });
    connect(&haptics_->recorder(), &TouchRecorder::savingFailed, this,
            [this](const QString& problem) {
                reportFailure(tr("Cannot Save Diagnostic Log"), problem);
            });
    connect(actions_->emergency_stop, &QAction::triggered, this,
            [this] { haptics_->setStopped(true); });
}

void MainWindow::makeNotices()
{
    notices_ =
        new WindowNotices({.center = *notice_center_,
                           .session = *controller_,
                           .view = *view_,
                           .haptics = *haptics_,
                           .fetched_tiles = options_.opener.resources.fetched_tiles},
                          {.show_fact =
                               [this](const QString& notice) {
                                   docks_->reveal(*docks_->georeferencing());
                                   georeferencing_->showNotice(notice);
                               },
                           .show_haptics = [this] { docks_->reveal(*docks_->haptics()); },
                           .save_diagnostic_log = [this] { haptics_panel_->chooseFlightRecord(); }},
                          this);
}

void MainWindow::connectMeasuring()
{
    connect(actions_->measure_kinds, &QActionGroup::triggered, this, [this](QAction* action) {
        measure_->begin(static_cast<MeasurementKind>(action->data().toInt()));
        view_->setFocus();
    });
    connect(measure_, &MeasureController::kindChanged, this,
            [this](MeasurementKind kind) { actions_->showTool(view_->tool(), kind); });
    connect(actions_->add_point, &QAction::triggered, this, &MainWindow::addMeasuredPoint);
    connect(actions_->finish_measurement, &QAction::triggered, measure_,
            &MeasureController::finish);
    connect(actions_->remove_measurement, &QAction::triggered, measure_,
            [this] { measure_->remove(measure_->state().current); });
    connect(actions_->remove_measurements, &QAction::triggered, measure_,
            &MeasureController::removeAll);
    const auto enable = [this] {
        const MeasureItem* item = measure_->current();
        actions_->finish_measurement->setEnabled(item != nullptr && !item->is_finished);
        actions_->remove_measurement->setEnabled(item != nullptr);
        actions_->remove_measurements->setEnabled(!measure_->state().items.empty());
    };
    connect(measure_, &MeasureController::changed, this, enable);
    enable();
    actions_->measure->addAction(docks_->measurements()->toggleViewAction());
    measure_marks_->setObstacles(overlays_->plates());
    measure_marks_->lower();
    overlays_->labels()->lower(); // names give way to measurements
    picture_saver_->setMarks(*measure_marks_);
}

void MainWindow::connectSpaceMouse()
{
    spacemouse_ = new SpaceMouseController(*view_, options_.spacemouse, this);
    connect(spacemouse_, &SpaceMouseController::connected, this, [this](const QString& name) {
        //: In the status bar, for a few seconds; %1 is a device
        statusBar()->showMessage(tr("%1 moves the camera").arg(name), kMessageDuration);
    });
    connect(spacemouse_, &SpaceMouseController::disconnected, this, [this](const QString& name) {
        //: In the status bar, for a few seconds; %1 is a device
        statusBar()->showMessage(tr("%1 was unplugged").arg(name), kMessageDuration);
    });
}

// A sound that failed is off at the next start too. A failure is reported only to a user who has
// just switched the sound on.
void MainWindow::connectSounds()
{
    sounds_ = new ContactSounds(*view_, options_.open_sound, this);
    const QString key = QStringLiteral("haptics/sound");
    const auto remember = [this, key](bool is_on) {
        if (isRemembered()) {
            QSettings().setValue(key, is_on);
        }
    };
    QAction* action = actions_->contact_sound;
    connect(action, &QAction::triggered, this, [this, remember](bool is_on) {
        is_sound_remembered_ = false;
        sounds_->setOn(is_on);
        if (!is_on) {
            remember(false);
        }
    });
    connect(sounds_, &ContactSounds::opened, this, [remember] { remember(true); });
    connect(sounds_, &ContactSounds::failed, this, [this, remember](const QString& why) {
        remember(false);
        if (!is_sound_remembered_) {
            reportFailure(tr("Cannot Play Sound"), asSentence(why));
        }
        is_sound_remembered_ = false;
    });
    connect(sounds_, &ContactSounds::onChanged, action, &QAction::setChecked);
    is_sound_remembered_ = isRemembered() && QSettings().value(key, false).toBool();
    sounds_->setOn(is_sound_remembered_);
}

void MainWindow::showHaptics()
{
    actions_->emergency_stop->setEnabled(haptics_->device().canBeStopped());
    actions_->record_touch->setEnabled(haptics_->recorder().isRecording() ||
                                       haptics_->device().isRunning());
    actions_->record_touch->setText(haptics_->recorder().isRecording() ? tr("Stop &Recording Touch")
                                                                       : tr("&Record Touch…"));
    actions_->save_flight->setEnabled(haptics_->device().hasTicks());
    showPreparation();
}

void MainWindow::restoreWindow()
{
    const QSettings settings;
    restoreGeometry(settings.value(QStringLiteral("window/geometry")).toByteArray());
    docks_->restore(settings);
    for (QAction* action : overlays_->visibilityActions() + overlays_->terrainActions()) {
        action->setChecked(settings.value(overlayKey(*action), action->isChecked()).toBool());
    }
    last_folder_ = settings.value(folderKey()).toString();
}

void MainWindow::open(const QString& file)
{
    openAll({file});
}

void MainWindow::openAll(const QStringList& files)
{
    QStringList maps;
    QStringList vector_files;
    for (const QString& file : files) {
        (!isAddress(file) && isVectorFile(file.toStdString()) ? vector_files : maps).append(file);
    }
    if (!maps.isEmpty()) {
        openMaps(maps);
    }
    vector_tools_->open(vector_files);
}

void MainWindow::openMaps(QStringList maps)
{
    const auto project = std::find_if(maps.begin(), maps.end(), [](const QString& file) {
        return isProjectPath(file.toStdString()) && !isAddress(file);
    });
    if (project == maps.end()) {
        controller_->open(maps);
        return;
    }
    const QString file = *project;
    maps.erase(project);
    project_menu_->open(file, maps);
}

void MainWindow::openSample(const QString& file)
{
    controller_->openSample(file);
}

void MainWindow::cancelLoading()
{
    controller_->cancel();
}

QStringList MainWindow::rasterFilters()
{
    return {tr("Elevation maps and projects (*.mvproj *.tif *.tiff *.lbl *.img *.cub *.hgt *.dem "
               "*.asc *.flt *.hdr *.bil "
               "*.nc *.cdf *.dt0 *.dt1 *.dt2 *.vrt *.xml *.zip)"),
            tr("All files (*)")};
}

void MainWindow::chooseFile()
{
    auto* dialog = new QFileDialog(this, tr("Open Map"), last_folder_);
    dialog->setFileMode(QFileDialog::ExistingFiles);
    dialog->setNameFilters(rasterFilters());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::filesSelected, this, &MainWindow::openAll);
    dialog->open();
}

void MainWindow::chooseFolder()
{
    auto* dialog = new QFileDialog(this, tr("Open Folder of Rasters"), last_folder_);
    dialog->setFileMode(QFileDialog::Directory);
    // Most dialogs of desktops hide the files of a folder; people choose it by its files.
    dialog->setOption(QFileDialog::DontUseNativeDialog);
    dialog->setOption(QFileDialog::ShowDirsOnly, false);
    dialog->setNameFilters(rasterFilters());
    //: On a button: open all rasters in a folder as one map
    dialog->setLabelText(QFileDialog::Accept, tr("Open Folder"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::filesSelected, controller_, &SessionController::open);
    dialog->open();
}

void MainWindow::chooseAddress()
{
    QStringList history;
    for (const QString& file : recent_->files()) {
        if (isAddress(file)) {
            history.append(file);
        }
    }
    auto* dialog = new AddressDialog(history, this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &AddressDialog::addressChosen, this, &MainWindow::open);
    dialog->open();
}

void MainWindow::showSession()
{
    actions_->showSession(session());
    datasets_->setSession(session());
    light_popup_->setLight(session().look.light_azimuth, session().look.light_altitude);
    const std::vector<const Layer*> shown = shownLayers(session());
    tool_bar_->setExaggerationEnabled(!shown.empty());
    if (!shown.empty()) {
        tool_bar_->setExaggerationRange(
            exaggerationRange(suitableExaggeration(*shown.front()->map)));
        tool_bar_->showExaggeration(exaggerationOf(session()));
    }
    overlays_->setSession(session());
    measure_->setSession(session());
    vector_tools_->setSession(session());
    showActive();
    settleIfIdle();
}

// Everything that is shown about the active layer.
void MainWindow::showActive()
{
    const Layer* active = activeLayer(session());
    const auto map = active != nullptr ? active->map : nullptr;
    const QString file = map ? QString::fromStdString(map->spec().path) : QString();
    setWindowFilePath(project_->file().isEmpty() ? file : project_->file());
    showTitle();
    georeferencing_->setMap(map);
    showPreparation();
    // Positions are on what the view shows, heights are those of the active layer if it is there.
    const std::vector<const Layer*> shown = shownLayers(session());
    const bool is_shown = std::find(shown.begin(), shown.end(), active) != shown.end();
    const auto& scene = view_->map();
    const bool is_scene_current = std::any_of(
        shown.begin(), shown.end(), [&](const Layer* layer) { return layer->map == scene; });
    readout_->setMaps(shown.empty() ? nullptr : scene,
                      is_shown && is_scene_current ? map : nullptr);
}

// The project, or the active layer of a session that was never saved.
void MainWindow::showTitle()
{
    QString title = project_menu_->title();
    if (const Layer* active = activeLayer(session()); title.isEmpty() && active != nullptr) {
        title = isolated(QString::fromStdString(active->name)) + QStringLiteral("[*]");
    }
    //: Window title: %1 is a project or a layer
    setWindowTitle(title.isEmpty() ? tr("MarsView") : tr("%1 — MarsView").arg(title));
    setWindowModified(!title.isEmpty() && project_->isModified());
}

void MainWindow::showPreparation()
{
    const PreparationState state = controller_->preparationOf(session().active).state;
    actions_->layer.prepare->setEnabled(state == PreparationState::Stopped ||
                                        state == PreparationState::Failed);
    notices_->update();
}

void MainWindow::reportFailure(const QString& title, const QString& problem)
{
    Q_EMIT openFailed(problem);
    if (options_.failures == WindowOptions::Failures::InDialogs) {
        auto* box =
            new QMessageBox(QMessageBox::Warning, title, isolated(problem), QMessageBox::Ok, this);
        box->setAttribute(Qt::WA_DeleteOnClose);
        box->setTextFormat(Qt::PlainText);
        box->setWindowModality(Qt::WindowModal);
        box->show();
    }
}

void MainWindow::showCancel()
{
    actions_->cancel_loading->setEnabled(controller_->isBusy() || picture_saver_->isSaving());
    actions_->cancel_loading->setText(picture_saver_->isSaving() && !controller_->isBusy()
                                          ? tr("&Cancel Saving")
                                          : tr("&Cancel Loading"));
    actions_->save_picture->setEnabled(!picture_saver_->isSaving());
}

void MainWindow::savePicture()
{
    const Layer* active = activeLayer(session());
    picture_saver_->start(active != nullptr
                              ? QFileInfo(QString::fromStdString(active->name)).completeBaseName()
                              : tr("map"));
}

void MainWindow::findName()
{
    QLineEdit& field = tool_bar_->searchField();
    if (!field.isVisible()) {
        goToPlace();
        return;
    }
    field.setFocus(Qt::ShortcutFocusReason);
    field.selectAll();
}

void MainWindow::goToPlace()
{
    if (!view_->map()) {
        return;
    }
    auto* dialog =
        new GoToDialog(view_->map(), preferences_, last_place_, name_search_->namesOnMap(), this);
    connect(dialog, &GoToDialog::nameChosen, this, [this, dialog](const PlaceName& place) {
        last_place_ = dialog->entry();
        name_search_->goTo(place);
    });
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &GoToDialog::placeChosen, this, [this, dialog](GridPoint grid) {
        last_place_ = dialog->entry();
        view_->goTo(grid);
        overlays_->markPlace(grid);
    });
    dialog->open();
}

void MainWindow::addMeasuredPoint()
{
    if (!view_->map()) {
        return;
    }
    auto* dialog =
        new GoToDialog(view_->map(), preferences_, last_place_, name_search_->namesOnMap(), this);
    dialog->setTexts(tr("Add Point"), tr("&Add"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &GoToDialog::nameChosen, this, [this, dialog](const PlaceName& place) {
        last_place_ = dialog->entry();
        if (const auto grid = view_->map()->georeference().toGrid(place.position)) {
            measure_->addPointAt(*grid);
        }
    });
    connect(dialog, &GoToDialog::placeChosen, this, [this, dialog](GridPoint grid) {
        last_place_ = dialog->entry();
        measure_->addPointAt(grid);
    });
    dialog->open();
}

void MainWindow::copyCoordinates()
{
    const QString text = readout_->plainPosition();
    if (!text.isEmpty()) {
        QGuiApplication::clipboard()->setText(text);
        readout_->coordinateField()->showCopied();
    }
}

void MainWindow::copyCoordinates(GridPoint grid)
{
    if (!view_->map()) {
        return;
    }
    const Map& map = *view_->map();
    const double height_m = map.heightfield().heightNow(grid);
    QGuiApplication::clipboard()->setText(plainPositionText(
        preferences_.coordinates, map, grid,
        view_->metersPerPoint(
            {.grid = grid, .height_m = std::isfinite(height_m) ? height_m : 0.0})));
    readout_->coordinateField()->showCopied();
}

void MainWindow::showPreferences()
{
    auto* dialog = new PreferencesDialog(
        preferences_,
        {.folder = options_.opener.resources.folder, .tile_bytes = standard_tile_bytes_}, this);
    const Layer* active = activeLayer(session());
    dialog->setBody(active != nullptr ? active->map->info().body : nullptr);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &PreferencesDialog::preferencesChanged, this, &MainWindow::setPreferences);
    dialog->open();
}

void MainWindow::setPreferences(const Preferences& preferences)
{
    preferences_ = preferences;
    applyTheme(preferences.theme);
    readout_->setFormat(preferences.coordinates);
    readout_->setHeightUnit(preferences.height_unit);
    datasets_->setHeightUnit(preferences.height_unit);
    georeferencing_->setHeightUnit(preferences.height_unit);
    overlays_->setHeightUnit(preferences.height_unit);
    overlays_->labels()->setCoordinateFormat(preferences.coordinates);
    stretch_->setHeightUnit(preferences.height_unit);
    measure_marks_->setHeightUnit(preferences.height_unit);
    measure_panel_->setHeightUnit(preferences.height_unit);
    georeferencing_->setCoordinateFormat(preferences.coordinates);
    view_->setAntialiasing(preferences.has_antialiasing);
    view_->setFrameTarget(std::chrono::milliseconds(1000 / preferences.frames_per_s));
    view_->setContactModel(preferences.contact_model);
    haptics_->setContactModel(preferences.contact_model);
    MapOpener opener = options_.opener;
    opener.resources = resourcesFor(opener.resources, preferences);
    opener.resources.tiles->setBytesMax(
        preferences.tile_memory_mb > 0 && !qEnvironmentVariableIsSet("MARSVIEW_CACHE_MB")
            ? static_cast<std::size_t>(preferences.tile_memory_mb) << 20
            : standard_tile_bytes_);
    const auto& fetched = opener.resources.fetched_tiles;
    if (fetched && !opener.resources.folder.empty()) {
        fetched->setFolder(fetchedTilesFolder(opener.resources.folder));
        fetched->setBytesMax(fetchedBytesMax(preferences));
    }
    controller_->setOpener(opener);
    actions_->showContactModel(preferences.contact_model);
    if (isRemembered()) {
        QSettings settings;
        save(preferences, settings);
    }
}

void MainWindow::showAbout()
{
    QString driver;
    if (view_->context() != nullptr) {
        view_->makeCurrent();
        const auto* name =
            reinterpret_cast<const char*>(view_->context()->functions()->glGetString(GL_RENDERER));
        driver = QString::fromLatin1(name);
        view_->doneCurrent();
    }
    auto* dialog = new AboutDialog(driver, this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

void MainWindow::showGuide()
{
    if (guide_ == nullptr) {
        guide_ = new GuideWindow(guidePagesIn(guideFolder()), this);
    }
    guide_->show();
    guide_->raise();
    guide_->activateWindow();
}

void MainWindow::showKeys()
{
    auto* dialog = new KeysDialog(*menuBar(), this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->show();
}

void MainWindow::openLightPopup()
{
    light_popup_->openBelow(tool_bar_->lightAnchor());
}

void MainWindow::settleIfIdle()
{
    if (view_->isReady() && !controller_->isBusy() && !controller_->isPreparing() &&
        (shownLayers(session()).empty() || view_->isPictureComplete())) {
        Q_EMIT settled();
    }
}

void MainWindow::closeEvent(QCloseEvent* event)
{
    const bool is_ended_by_signal = QCoreApplication::instance()->property(kEndsBySignal).toBool();
    if (is_ended_by_signal) {
        project_->autosaveNow();
    } else if (!is_closing_ && project_menu_->hasQuestion()) {
        event->ignore();
        project_menu_->saveThen([this] {
            is_closing_ = true;
            close();
        });
        return;
    } else {
        project_->discardAutosave();
    }
    haptics_->device().close();
    connection_marker_.reset();
    controller_->stopAll();
    if (isRemembered()) {
        QSettings settings;
        setWindowState(windowState().setFlag(Qt::WindowFullScreen, false)); // not the next time
        settings.setValue(QStringLiteral("window/geometry"), saveGeometry());
        docks_->save(settings);
        for (const QAction* action : overlays_->visibilityActions() + overlays_->terrainActions()) {
            settings.setValue(overlayKey(*action), action->isChecked());
        }
    }
    QMainWindow::closeEvent(event);
}

void MainWindow::changeEvent(QEvent* event)
{
    QMainWindow::changeEvent(event);
    if (event->type() == QEvent::WindowStateChange && actions_) {
        actions_->full_screen->setChecked(isFullScreen());
    }
}

// While a menu is open the map keeps the focus, and its plain letters would be taken for shortcuts
// before the menu gets them: Alt+F, O would choose a tool instead of opening a map.
bool MainWindow::eventFilter(QObject* watched, QEvent* event)
{
    if (event->type() == QEvent::ShortcutOverride && qobject_cast<QMenu*>(watched) != nullptr &&
        static_cast<QKeyEvent*>(event)->modifiers() == Qt::NoModifier) {
        event->accept();
        return true;
    }
    return QMainWindow::eventFilter(watched, event);
}

// Nothing else took the key.
void MainWindow::keyPressEvent(QKeyEvent* event)
{
    if (event->key() != Qt::Key_Escape || event->modifiers() != Qt::NoModifier) {
        QMainWindow::keyPressEvent(event);
    } else if (isFullScreen()) {
        actions_->full_screen->trigger();
    } else if (overlays_->isPlaceMarked()) {
        overlays_->clearMark();
    } else if (overlays_->isHintOffered()) {
        overlays_->dismissHint();
    } else {
        QMainWindow::keyPressEvent(event);
    }
}

void MainWindow::resizeEvent(QResizeEvent* event)
{
    QMainWindow::resizeEvent(event);
    docks_->fit();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event)
{
    if (!mapsIn(*event->mimeData()).isEmpty()) {
        event->acceptProposedAction();
    }
}

void MainWindow::dropEvent(QDropEvent* event)
{
    const QStringList files = mapsIn(*event->mimeData());
    if (!files.isEmpty()) {
        event->acceptProposedAction();
        openAll(files);
    }
}

} // namespace marsview
