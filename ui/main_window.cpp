#include "ui/main_window.h"

#include "haptics/drivers/built_in_drivers.h"
#include "ui/canvas/terrain_view.h"
#include "ui/commands/picture_saver.h"
#include "ui/commands/stretch_control.h"
#include "ui/commands/window_commands.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/controllers/haptics/haptics_controller.h"
#include "ui/controllers/measure_controller.h"
#include "ui/controllers/vector_overlays.h"
#include "ui/dialogs/light_popup.h"
#include "ui/drawing/name_field.h"
#include "ui/globe/globe_view.h"
#include "ui/overlay/annotation_marks.h"
#include "ui/overlay/globe_overlays.h"
#include "ui/overlay/map_labels.h"
#include "ui/overlay/map_overlays.h"
#include "ui/overlay/measure_marks.h"
#include "ui/overlay/place_mark.h"
#include "ui/panels/annotation_panel.h"
#include "ui/panels/georeferencing_panel.h"
#include "ui/panels/haptics_panel.h"
#include "ui/panels/layer_model.h"
#include "ui/panels/layers_panel.h"
#include "ui/panels/measure_panel.h"
#include "ui/pictures/flat_pictures.h"
#include "ui/pictures/globe_pictures.h"
#include "ui/text/number_text.h"
#include "ui/views/saved_views_panel.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/notice_bar.h"
#include "ui/widgets/notice_center.h"
#include "ui/window/action_icons.h"
#include "ui/window/load_status.h"
#include "ui/window/main_tool_bar.h"
#include "ui/window/status_readout.h"
#include "ui/window/theme.h"
#include "ui/window/whats_this.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_docks.h"
#include "ui/window/window_memory.h"
#include "ui/window/window_place.h"

#include <QAbstractSpinBox>
#include <QActionGroup>
#include <QCloseEvent>
#include <QComboBox>
#include <QCoreApplication>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QFrame>
#include <QGridLayout>
#include <QKeyEvent>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QMenuBar>
#include <QMimeData>
#include <QPalette>
#include <QSettings>
#include <QStatusBar>

#include <algorithm>
#include <vector>

namespace marsview {
namespace {

constexpr QSize kDefaultSize{1280, 800};

DriverMaker driversOf(const WindowOptions& options)
{
    return options.make_drivers ? options.make_drivers : [] { return builtInDrivers(); };
}

WindowOptions withTileCache(WindowOptions options)
{
    if (!options.opener.resources.tiles) {
        options.opener.resources.tiles = std::make_shared<TileCache>(TileCacheOptions{});
    }
    return options;
}

// A property of the application; set where a signal ends the program.
constexpr const char* kEndsBySignal = "endsBySignal";

// The active layer, or the topmost of the picture if the active one is not in it.
const Layer* titleLayer(const Session& session)
{
    const Layer* active = activeLayer(session);
    const std::vector<const Layer*> shown = shownLayers(session);
    const bool is_shown = std::find(shown.begin(), shown.end(), active) != shown.end();
    return is_shown || shown.empty() ? active : shown.front();
}

bool isEntry(const QWidget& focus)
{
    return qobject_cast<const QLineEdit*>(&focus) != nullptr ||
           qobject_cast<const QAbstractSpinBox*>(&focus) != nullptr ||
           qobject_cast<const QComboBox*>(&focus) != nullptr;
}

// Around the map, while files are dragged over the window.
class DropFrame final : public QFrame {
public:
    DropFrame(QWidget& window, QWidget& center)
        : QFrame(&center)
    {
        setObjectName(QStringLiteral("dropFrame"));
        setFrameStyle(QFrame::Box | QFrame::Plain);
        setLineWidth(kWidth);
        setAttribute(Qt::WA_TransparentForMouseEvents);
        hide();
        window.installEventFilter(this);
    }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override
    {
        if (event->type() == QEvent::DragEnter) {
            setVisible(!filesIn(*static_cast<QDragEnterEvent*>(event)->mimeData()).isEmpty());
            setGeometry(parentWidget()->rect());
            QPalette colors = palette();
            colors.setColor(QPalette::WindowText, colors.color(QPalette::Highlight));
            setPalette(colors);
            raise();
        } else if (event->type() == QEvent::DragLeave || event->type() == QEvent::Drop) {
            hide();
        }
        return QFrame::eventFilter(watched, event);
    }

private:
    static constexpr int kWidth = 4;
};

// The style comes before the first widget.
QWidget* withLineStyle(QWidget* parent)
{
    useLineStyle();
    return parent;
}

} // namespace

MainWindow::MainWindow(const WindowOptions& options, QWidget* parent)
    : QMainWindow(withLineStyle(parent))
    , options_(withTileCache(options))
    , view_(new TerrainView(this))
    , globe_(new GlobeView(this))
    , overlays_(new MapOverlays(*view_))
    , controller_(new SessionController(*view_, this))
    , actions_(std::make_unique<WindowActions>(*this, *view_, controller_->undoStack()))
    , notice_bar_(new NoticeBar(this))
    , notice_center_(new NoticeCenter(*notice_bar_, this))
    , messages_(*this, *notice_center_, options_.failures)
    , datasets_(new LayersPanel(actions_->layer, this))
    , georeferencing_(new GeoreferencingPanel(this))
    , haptics_(new HapticsController(*view_, driversOf(options), this))
    , haptics_panel_(new HapticsPanel(*haptics_, *actions_->contact_model_group, this))
    , measure_(new MeasureController(*view_, controller_->undoStack(), this))
    , measure_marks_(new MeasureMarks(*measure_, view_))
    , measure_panel_(new MeasurePanel(*measure_, this))
    , annotate_(new AnnotationController(*view_, controller_->undoStack(), this))
    , annotation_marks_(new AnnotationMarks(*annotate_, view_))
    , annotation_panel_(new AnnotationPanel(
          *annotate_, *actions_->import_annotations, *actions_->export_annotations, this))
    , views_panel_(new SavedViewsPanel(this))
    , docks_(new WindowDocks(*this,
                             {.datasets = datasets_,
                              .views = views_panel_,
                              .georeferencing = georeferencing_,
                              .haptics = haptics_panel_,
                              .measurements = measure_panel_,
                              .annotations = annotation_panel_}))
    , tool_bar_(new MainToolBar(*actions_, this))
    , readout_(new StatusReadout(this))
    , load_status_(new LoadStatus(this))
    , light_popup_(new LightPopup(this))
    , stretch_(new StretchControl(*controller_, *actions_, *view_, this))
{
    setAcceptDrops(true);
    setWindowIcon(programIcon());
    resize(kDefaultSize);
    addToolBar(tool_bar_);
    makeCenter();
    makePictures();
    makeStatusBar();
    fillViewMenus();
    explainControls({.view = view_,
                     .overlays = overlays_,
                     .globe = globe_,
                     .globe_overlays = globe_overlays_,
                     .notices = notice_bar_,
                     .readout = readout_,
                     .load_status = load_status_,
                     .docks = docks_,
                     .actions = actions_.get()});
    connect(&messages_, &WindowMessages::reported, this, &MainWindow::openFailed);
    connect(actions_->quit, &QAction::triggered, this, &MainWindow::close);
    makeCommands();
    connectSession();
    placeMarks();
    snapToEachOther();
    if (options_.isRemembered()) {
        offerHintOnce(*overlays_);
        restoreWindow(*this, *docks_, *overlays_);
        place_ = new WindowPlace(*this);
        place_->fit();
    }
    commands_->preferences.set(options_.isRemembered() ? preferencesFrom(QSettings())
                                                       : options_.preferences);
    showSession();
    commands_->haptics.connectToRemembered(preferences().reconnects_device
                                               ? HapticsCommands::LastDevice::Connect
                                               : HapticsCommands::LastDevice::Leave);
    view_->setFocus();
}

MainWindow::~MainWindow()
{
    hide(); // a cell that is edited is committed as long as its controller is there
    commands_.reset();
    delete measure_; // they are the view's tools
    delete annotate_;
    delete haptics_panel_; // it looks at the controller
    delete haptics_;       // and that at the view
}

void MainWindow::makeCenter()
{
    auto* center = new QWidget(this);
    // Notices lie over the map: the picture does not move when they appear and disappear.
    auto* layout = new QGridLayout(center);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(view_, 0, 0);
    layout->addWidget(globe_, 0, 0);
    globe_->hide();
    globe_overlays_ = new GlobeOverlays(*globe_, *overlays_); // a child of the globe
    layout->addWidget(notice_bar_, 0, 0, Qt::AlignTop);
    notice_bar_->raise();
    connect(notice_bar_, &NoticeBar::coverChanged, this,
            [this] { overlays_->setCovered(notice_bar_->coveredHeight()); });
    setCentralWidget(center);
    new DropFrame(*this, *center); // owned by it
}

void MainWindow::makePictures()
{
    flat_pictures_ = new FlatPictures(*view_, *overlays_);
    globe_pictures_ = new GlobePictures(*globe_, *globe_overlays_);
    picture_saver_ = new PictureSaver(
        {.flat = *flat_pictures_, .globe = *globe_pictures_, .globe_view = *globe_},
        options_.isRemembered() ? PictureSaver::Memory::Settings : PictureSaver::Memory::WindowOnly,
        this);
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

void MainWindow::fillViewMenus()
{
    actions_->panels->addAction(docks_->datasets()->toggleViewAction());
    actions_->panels->addAction(docks_->views()->toggleViewAction());
    actions_->panels->addAction(docks_->georeferencing()->toggleViewAction());
    actions_->panels->addAction(docks_->haptics()->toggleViewAction());
    actions_->panels->addAction(docks_->measurements()->toggleViewAction());
    actions_->panels->addAction(docks_->annotations()->toggleViewAction());
    actions_->panels->addSeparator();
    actions_->panels->addActions(overlays_->visibilityActions());
    actions_->view_menu->insertActions(actions_->panels->menuAction(), overlays_->terrainActions());
    actions_->view_menu->insertSeparator(actions_->panels->menuAction());
    setIcons(*docks_);
    menuBar()->installEventFilter(this);
    for (QMenu* menu : menuBar()->findChildren<QMenu*>()) {
        menu->installEventFilter(this);
    }
}

void MainWindow::makeCommands()
{
    const WindowParts parts{
        .window = *this,
        .actions = *actions_,
        .messages = messages_,
        .notices = *notice_center_,
        .session = *controller_,
        .view = *view_,
        .globe = *globe_,
        .overlays = *overlays_,
        .haptics = *haptics_,
        .measuring = *measure_,
        .annotating = *annotate_,
        .measure_marks = *measure_marks_,
        .annotation_marks = *annotation_marks_,
        .pictures = *picture_saver_,
        .scenes = {.flat = *flat_pictures_, .globe = *globe_pictures_, .globe_view = *globe_},
        .stretch = *stretch_,
        .docks = *docks_,
        .layers = *datasets_,
        .georeferencing = *georeferencing_,
        .haptics_panel = *haptics_panel_,
        .measure_panel = *measure_panel_,
        .annotation_panel = *annotation_panel_,
        .views_panel = *views_panel_,
        .tool_bar = *tool_bar_,
        .light = *light_popup_,
        .readout = *readout_,
        .load_status = *load_status_};
    commands_ = std::make_unique<WindowCommands>(parts, options_);
    commands_->views.menu()->installEventFilter(this);
    connect(&commands_->progress, &WorkProgress::settled, this, &MainWindow::settled);
    connect(&commands_->scene, &SceneCommands::shownChanged, this, &MainWindow::showActive);
}

// What the window shows of the session, and when it may have changed.
void MainWindow::connectSession()
{
    connect(controller_, &SessionController::sessionChanged, this, &MainWindow::showSession);
    connect(&commands_->project, &ProjectController::changed, this, &MainWindow::showTitle);
    connect(view_, &TerrainView::mapShown, this, &MainWindow::showActive);
    connect(view_, &TerrainView::exaggerationChanged, tool_bar_, &MainToolBar::showExaggeration);
    connect(controller_, &SessionController::preparationChanged, this,
            &MainWindow::showPreparation);
    connect(view_, &TerrainView::pictureCompleted, this, &MainWindow::showPreparation);
    connect(view_, &TerrainView::problemChanged, this, &MainWindow::showPreparation);
    connect(&commands_->haptics, &HapticsCommands::changed, this, &MainWindow::showPreparation);
    WindowNotices* notices = &commands_->notices;
    connect(globe_, &GlobeView::unplacedChanged, notices, [this, notices] {
        datasets_->model()->setUnplaced(globe_->unplacedLayers());
        notices->setUnplaced(globe_->unplacedLayers());
    });
}

void MainWindow::placeMarks()
{
    auto* name_field = new NameField(*annotate_, *view_);
    for (DrawnMarks* marks :
         {static_cast<DrawnMarks*>(measure_marks_), static_cast<DrawnMarks*>(annotation_marks_)}) {
        marks->setObstacles(overlays_->plates()
                            << overlays_->placeMark() << notice_bar_ << name_field);
        marks->lower();
    }
    annotation_marks_->setNeighbor(*measure_marks_);
    annotation_marks_->giveWayToNeighbor();
    measure_marks_->setNeighbor(*annotation_marks_);
    overlays_->labels()->lower(); // names give way to measurements and annotations
    overlays_->labels()->keepClearOf(*measure_marks_);
    overlays_->labels()->keepClearOf(*annotation_marks_);
    flat_pictures_->addMarks(*annotation_marks_);
    flat_pictures_->addMarks(*measure_marks_);
    globe_overlays_->addMarks(*new MeasureMarks(*measure_, globe_),
                              *new AnnotationMarks(*annotate_, globe_),
                              {notice_bar_, new NameField(*annotate_, *globe_)});
}

// Points of one kind snap to those of both.
void MainWindow::snapToEachOther()
{
    const auto to_measurements = [this](QPointF position, double reach) {
        return measure_->vertexNear(position, reach);
    };
    const auto to_annotations = [this](QPointF position, double reach) {
        return annotate_->vertexNear(position, reach);
    };
    const auto to_vector_files = [this](QPointF position, double reach) {
        return commands_->vector_files.overlays().vertexNear(position, reach);
    };
    measure_->addSnap(to_measurements);
    measure_->addSnap(to_annotations);
    measure_->addSnap(to_vector_files);
    annotate_->addSnap(to_annotations);
    annotate_->addSnap(to_measurements);
    annotate_->addSnap(to_vector_files);
}

void MainWindow::open(const QString& file)
{
    openAll({file});
}

void MainWindow::openAll(const QStringList& files)
{
    commands_->files.open(files);
}

void MainWindow::openAtStart(const QStringList& files)
{
    commands_->files.openAtStart(files);
}

void MainWindow::openSample(const QString& file)
{
    controller_->openSample(file);
}

bool MainWindow::isSettled() const
{
    return commands_->progress.isIdle();
}

const Preferences& MainWindow::preferences() const noexcept
{
    return commands_->preferences.preferences();
}

void MainWindow::setPreferences(const Preferences& preferences)
{
    commands_->preferences.set(preferences);
}

void MainWindow::showSession()
{
    commands_->layers.showSession();
    overlays_->setSession(session());
    measure_->setSession(session());
    annotate_->setSession(session());
    commands_->vector_files.setSession(session());
    showActive();
    commands_->progress.settleIfIdle();
}

// Everything that is shown about the active layer.
void MainWindow::showActive()
{
    const Layer* active = activeLayer(session());
    const auto map = active != nullptr ? active->map : nullptr;
    const QString file = map ? QString::fromStdString(map->spec().path) : QString();
    setWindowFilePath(commands_->project.file().isEmpty() ? file : commands_->project.file());
    showTitle();
    georeferencing_->setMap(map, active != nullptr && controller_->isNodataAssumed(*active));
    showPreparation();
    // Positions are on what the view shows, heights are those of the active layer if it is there.
    const std::vector<const Layer*> shown = shownLayers(session());
    const bool is_shown = std::find(shown.begin(), shown.end(), active) != shown.end();
    const auto& scene = view_->map();
    const bool is_scene_current = std::any_of(
        shown.begin(), shown.end(), [&](const Layer* layer) { return layer->map == scene; });
    // The globe shows the topmost layer alone.
    const bool is_active_read = is_shown && is_scene_current && globe_->isHidden();
    readout_->setMaps(shown.empty() ? nullptr : scene, is_active_read ? map : nullptr);
}

// The project, or a layer of a session that was never saved.
void MainWindow::showTitle()
{
    QString title = commands_->project_menu.title();
    if (const Layer* named = titleLayer(session()); title.isEmpty() && named != nullptr) {
        title = isolated(QString::fromStdString(named->name)) + QStringLiteral("[*]");
    }
    //: Window title: %1 is a project or a layer
    setWindowTitle(title.isEmpty() ? tr("MarsView") : tr("%1 — MarsView").arg(title));
    setWindowModified(!title.isEmpty() && commands_->project.isModified());
}

void MainWindow::showPreparation()
{
    const PreparationState state = controller_->preparationOf(session().active).state;
    actions_->layer.prepare->setEnabled(state == PreparationState::Stopped ||
                                        state == PreparationState::Failed);
    commands_->notices.update();
}

void MainWindow::closeEvent(QCloseEvent* event)
{
    const bool is_ended_by_signal = QCoreApplication::instance()->property(kEndsBySignal).toBool();
    if (is_ended_by_signal) {
        commands_->project.autosaveNow();
    } else if (!is_closing_ && commands_->project_menu.hasQuestion()) {
        event->ignore();
        commands_->project_menu.saveThen([this] {
            is_closing_ = true;
            close();
        });
        return;
    } else {
        commands_->project.discardAutosave();
    }
    commands_->haptics.close();
    controller_->stopAll();
    if (options_.isRemembered()) {
        saveWindow(*this, *docks_, *overlays_);
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
// before the menu gets them: Alt+F, O would choose a tool instead of opening a map. A menu passes
// arrows on to the menu bar.
bool MainWindow::eventFilter(QObject* watched, QEvent* event)
{
    const bool is_menu =
        qobject_cast<QMenu*>(watched) != nullptr || qobject_cast<QMenuBar*>(watched) != nullptr;
    if (event->type() == QEvent::ShortcutOverride && is_menu &&
        static_cast<QKeyEvent*>(event)->modifiers() == Qt::NoModifier) {
        event->accept();
        return true;
    }
    return QMainWindow::eventFilter(watched, event);
}

// Nothing else took the key. Outside the map, Esc leaves a field or panel, and nothing on the map;
// it leaves full screen, too, unless something was being entered.
void MainWindow::keyPressEvent(QKeyEvent* event)
{
    if (event->key() != Qt::Key_Escape || event->modifiers() != Qt::NoModifier) {
        QMainWindow::keyPressEvent(event);
        return;
    }
    const QWidget* focus = focusWidget();
    QWidget* map = globe_->isHidden() ? static_cast<QWidget*>(view_) : globe_;
    const bool is_elsewhere = focus != nullptr && focus != map && !map->isAncestorOf(focus);
    if (is_elsewhere) {
        map->setFocus(Qt::ShortcutFocusReason);
    }
    if (is_elsewhere && (!isFullScreen() || isEntry(*focus))) {
        return;
    }
    if (isFullScreen()) {
        actions_->full_screen->trigger();
    } else if (commands_->places.features().hasFeature()) {
        commands_->places.features().clear();
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
    if (!filesIn(*event->mimeData()).isEmpty()) {
        event->acceptProposedAction();
    }
}

void MainWindow::dropEvent(QDropEvent* event)
{
    const QStringList files = filesIn(*event->mimeData());
    if (!files.isEmpty()) {
        event->acceptProposedAction();
        openAll(files);
    }
}

} // namespace marsview
