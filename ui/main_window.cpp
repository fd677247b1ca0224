#include "ui/main_window.h"

#include "core/view/exaggeration.h"
#include "ui/georeferencing_panel.h"
#include "ui/notice_bar.h"
#include "ui/override_command.h"
#include "ui/status_readout.h"
#include "ui/terrain_view.h"

#include <QCloseEvent>
#include <QCoreApplication>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QImage>
#include <QLabel>
#include <QLocale>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QProgressBar>
#include <QSettings>
#include <QSlider>
#include <QStatusBar>
#include <QStyle>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>

#include <array>
#include <cmath>

namespace marsview {
namespace {

constexpr int kStateVersion = 1; // of saveState(); raise when docks or toolbars change meaning
constexpr QSize kDefaultSize{1280, 800};
constexpr int kDockWidth = 300;

// Docks leave two thirds of the width to the map, but are never too narrow to be read; where both
// cannot be, the map has the window.
constexpr int kDockShareOfWidth = 3;
constexpr int kDockWidthMin = 240;

// The slider spans ×0.001, for degrees against metres, to ×100 in round steps of about 1.5.
constexpr int kSliderStepsDown = 18;
constexpr int kSliderStepsUp = 12;

struct StepAction {
    NavigationStep step;
    const char* text;
    Qt::Key key;
};

// Keys act while the map has the focus, so that fields keep their arrows and letters.
constexpr std::array kStepActions{
    StepAction{NavigationStep::ZoomIn, QT_TRANSLATE_NOOP("MainWindow", "Zoom In"), Qt::Key_PageUp},
    StepAction{NavigationStep::ZoomOut, QT_TRANSLATE_NOOP("MainWindow", "Zoom Out"),
               Qt::Key_PageDown},
    StepAction{NavigationStep::PanLeft, QT_TRANSLATE_NOOP("MainWindow", "Pan Left"), Qt::Key_Left},
    StepAction{NavigationStep::PanRight, QT_TRANSLATE_NOOP("MainWindow", "Pan Right"),
               Qt::Key_Right},
    StepAction{NavigationStep::PanAway, QT_TRANSLATE_NOOP("MainWindow", "Pan Forward"), Qt::Key_Up},
    StepAction{NavigationStep::PanNearer, QT_TRANSLATE_NOOP("MainWindow", "Pan Back"),
               Qt::Key_Down},
    StepAction{NavigationStep::TurnLeft, QT_TRANSLATE_NOOP("MainWindow", "Turn Left"), Qt::Key_Q},
    StepAction{NavigationStep::TurnRight, QT_TRANSLATE_NOOP("MainWindow", "Turn Right"), Qt::Key_E},
    StepAction{NavigationStep::TiltUp, QT_TRANSLATE_NOOP("MainWindow", "Tilt Up"), Qt::Key_R},
    StepAction{NavigationStep::TiltDown, QT_TRANSLATE_NOOP("MainWindow", "Tilt Down"), Qt::Key_F},
};

QString exaggerationText(double exaggeration)
{
    //: Vertical exaggeration: a factor
    return QCoreApplication::translate("MainWindow", "×%1")
        .arg(QLocale().toString(exaggeration, 'g', 3));
}

QStringList noticesOf(const RasterInfo& info)
{
    QStringList notices;
    for (const std::string& notice : info.notices) {
        QString sentence = QString::fromStdString(notice);
        sentence[0] = sentence[0].toUpper();
        notices.append(sentence);
    }
    return notices;
}

// The first local file of what is dragged; empty where there is none.
QString localFileOf(const QMimeData& data)
{
    for (const QUrl& url : data.urls()) {
        if (url.isLocalFile()) {
            return url.toLocalFile();
        }
    }
    return {};
}

} // namespace

MainWindow::MainWindow(WindowOptions options, QWidget* parent)
    : QMainWindow(parent)
    , options_(options)
    , view_(new TerrainView(this))
    , notices_(new NoticeBar(this))
    , panel_(new GeoreferencingPanel(this))
    , loader_(new LoadController(this))
{
    setWindowTitle(tr("MarsView"));
    setAcceptDrops(true);
    resize(kDefaultSize);
    auto* centre = new QWidget(this);
    auto* layout = new QVBoxLayout(centre);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(notices_);
    layout->addWidget(view_, 1);
    setCentralWidget(centre);
    makeDocks();
    makeActions();
    makeToolBar();
    makeStatusBar();
    connectLoader();
    connectView();
    if (options_.geometry == WindowOptions::Geometry::Remembered) {
        restoreWindow();
    }
    view_->setFocus();
}

MainWindow::~MainWindow() = default;

void MainWindow::makeActions()
{
    QMenu* file = menuBar()->addMenu(tr("&File"));
    open_action_ = file->addAction(tr("&Open…"), this, &MainWindow::chooseFile);
    open_action_->setShortcut(QKeySequence::Open);
    open_action_->setIcon(style()->standardIcon(QStyle::SP_DialogOpenButton));
    save_picture_action_ = file->addAction(tr("Save &Picture…"), this, &MainWindow::savePicture);
    save_picture_action_->setShortcut(QKeySequence(Qt::CTRL | Qt::Key_P));
    save_picture_action_->setIcon(style()->standardIcon(QStyle::SP_DialogSaveButton));
    cancel_action_ = file->addAction(tr("&Cancel Loading"), this, &MainWindow::cancelLoading);
    cancel_action_->setShortcut(Qt::Key_Escape);
    cancel_action_->setEnabled(false);
    file->addSeparator();
    QAction* quit = file->addAction(tr("&Quit"), this, &QWidget::close);
    quit->setShortcut(QKeySequence::Quit);
    quit->setMenuRole(QAction::QuitRole);

    QMenu* edit = menuBar()->addMenu(tr("&Edit"));
    QAction* undo = undo_stack_.createUndoAction(this, tr("&Undo"));
    undo->setShortcut(QKeySequence::Undo);
    edit->addAction(undo);
    QAction* redo = undo_stack_.createRedoAction(this, tr("&Redo"));
    redo->setShortcut(QKeySequence::Redo);
    edit->addAction(redo);
    edit->addSeparator();
    QAction* override_georeferencing =
        edit->addAction(tr("Override &Georeferencing…"), this, [this] {
            georeferencing_dock_->show();
            georeferencing_dock_->raise();
            panel_->edit();
        });

    QMenu* view_menu = menuBar()->addMenu(tr("&View"));
    const auto add_key = [this](QAction* action, const QList<QKeySequence>& keys) {
        action->setShortcuts(keys);
        action->setShortcutContext(Qt::WidgetShortcut);
        view_->addAction(action);
        map_actions_.append(action);
    };
    home_action_ = view_menu->addAction(tr("&Home"), view_, &TerrainView::goHome);
    home_action_->setToolTip(tr("Show the whole map from the south"));
    add_key(home_action_, {Qt::Key_Home});
    north_action_ = view_menu->addAction(tr("&North Up"), view_, &TerrainView::turnNorthUp);
    north_action_->setToolTip(tr("Turn north to the top"));
    add_key(north_action_, {Qt::Key_N});
    view_menu->addSeparator();
    for (const StepAction& entry : kStepActions) {
        QAction* action = view_menu->addAction(tr(entry.text), this,
                                               [this, step = entry.step] { view_->step(step); });
        add_key(action, {entry.key});
    }
    view_menu->addSeparator();
    exaggerate_action_ = view_menu->addAction(tr("E&xaggerate More"), this, [this] {
        view_->setExaggeration(steppedExaggeration(view_->exaggeration(), 1));
    });
    add_key(exaggerate_action_, {Qt::Key_Plus, Qt::Key_Equal});
    flatten_action_ = view_menu->addAction(tr("Exaggerate &Less"), this, [this] {
        view_->setExaggeration(steppedExaggeration(view_->exaggeration(), -1));
    });
    add_key(flatten_action_, {Qt::Key_Minus});
    view_menu->addSeparator();
    view_menu->addAction(georeferencing_dock_->toggleViewAction());

    QMenu* help = menuBar()->addMenu(tr("&Help"));
    help->addAction(tr("&Keys and Mouse"), this, &MainWindow::showKeys)
        ->setShortcut(QKeySequence::HelpContents);
    QAction* about = help->addAction(tr("&About MarsView"), this, &MainWindow::showAbout);
    about->setMenuRole(QAction::AboutRole);

    map_actions_ += {save_picture_action_, override_georeferencing};
    for (QAction* action : map_actions_) {
        action->setEnabled(false);
    }
}

void MainWindow::makeToolBar()
{
    QToolBar* bar = addToolBar(tr("Main Toolbar"));
    bar->setObjectName(QStringLiteral("mainToolBar"));
    bar->setToolButtonStyle(Qt::ToolButtonTextOnly);
    bar->setMovable(false);
    bar->addAction(open_action_);
    bar->addAction(save_picture_action_);
    bar->addSeparator();
    bar->addAction(home_action_);
    bar->addAction(north_action_);
    bar->addSeparator();
    auto* caption = new QLabel(tr("Exaggeration"), bar);
    caption->setContentsMargins(6, 0, 6, 0);
    bar->addWidget(caption);
    exaggeration_slider_ = new QSlider(Qt::Horizontal, bar);
    exaggeration_slider_->setAccessibleName(tr("Vertical exaggeration"));
    exaggeration_slider_->setToolTip(tr("How much heights are stretched (+ and −)"));
    exaggeration_slider_->setRange(-kSliderStepsDown, kSliderStepsUp);
    exaggeration_slider_->setPageStep(2);
    exaggeration_slider_->setMaximumWidth(160);
    exaggeration_slider_->setEnabled(false);
    bar->addWidget(exaggeration_slider_);
    exaggeration_label_ = new QLabel(bar);
    exaggeration_label_->setContentsMargins(6, 0, 6, 0);
    exaggeration_label_->setMinimumWidth(
        fontMetrics().horizontalAdvance(QStringLiteral("×0.0001")) + 12);
    bar->addWidget(exaggeration_label_);
    // Steps count from ×1, so a position means the same on every map.
    connect(exaggeration_slider_, &QSlider::valueChanged, this,
            [this](int steps) { view_->setExaggeration(steppedExaggeration(1.0, steps)); });
}

void MainWindow::makeDocks()
{
    georeferencing_dock_ = new QDockWidget(tr("Georeferencing"), this);
    georeferencing_dock_->setObjectName(QStringLiteral("georeferencingDock"));
    georeferencing_dock_->setAllowedAreas(Qt::LeftDockWidgetArea | Qt::RightDockWidgetArea);
    georeferencing_dock_->setWidget(panel_);
    georeferencing_dock_->setMinimumWidth(kDockWidthMin);
    addDockWidget(Qt::RightDockWidgetArea, georeferencing_dock_);
    resizeDocks({georeferencing_dock_}, {kDockWidth}, Qt::Horizontal);
    connect(panel_, &GeoreferencingPanel::overridesRequested, this,
            [this](const RasterOverrides& overrides) {
                requestOverrides(Purpose::Override, overrides);
            });
    connect(notices_, &NoticeBar::detailsRequested, this, [this] {
        georeferencing_dock_->show();
        georeferencing_dock_->raise();
    });
}

void MainWindow::makeStatusBar()
{
    readout_ = new StatusReadout(this);
    statusBar()->addWidget(readout_, 1);
    progress_label_ = new QLabel(this);
    progress_bar_ = new QProgressBar(this);
    progress_bar_->setAccessibleName(tr("Progress of loading"));
    progress_bar_->setRange(0, 100);
    progress_bar_->setMaximumWidth(160);
    cancel_button_ = new QToolButton(this);
    cancel_button_->setObjectName(QStringLiteral("cancelLoading"));
    cancel_button_->setText(tr("Cancel"));
    cancel_button_->setAccessibleName(tr("Cancel Loading"));
    connect(cancel_button_, &QToolButton::clicked, this, &MainWindow::cancelLoading);
    for (QWidget* widget :
         std::initializer_list<QWidget*>{progress_label_, progress_bar_, cancel_button_}) {
        statusBar()->addPermanentWidget(widget);
        widget->hide();
    }
}

void MainWindow::connectLoader()
{
    const auto show_progress = [this](bool is_loading) {
        progress_label_->setVisible(is_loading);
        progress_bar_->setVisible(is_loading);
        cancel_button_->setVisible(is_loading);
        cancel_action_->setEnabled(is_loading);
    };
    connect(loader_, &LoadController::started, this,
            [show_progress](const DatasetSpec&) { show_progress(true); });
    connect(loader_, &LoadController::progressed, this, [this](const LoadProgress& progress) {
        progress_bar_->setValue(static_cast<int>(std::lround(progress.fraction * 100.0)));
        progress_label_->setText(progress.stage == LoadStage::Reading ? tr("Reading")
                                                                      : tr("Preparing"));
    });
    connect(loader_, &LoadController::succeeded, this, [this, show_progress](const LoadedMap& map) {
        show_progress(false);
        acceptMap(map);
    });
    connect(loader_, &LoadController::failed, this,
            [this, show_progress](const LoadFailure& failure) {
                show_progress(false);
                rejectLoad();
                reportFailure(tr("Cannot Open Map"), QString::fromStdString(failure.error.message));
            });
    connect(loader_, &LoadController::cancelled, this, [this, show_progress](const DatasetSpec&) {
        show_progress(false);
        rejectLoad();
        //: In the status bar, for a few seconds
        statusBar()->showMessage(tr("Loading was cancelled"), 4000);
    });
}

void MainWindow::connectView()
{
    connect(view_, &TerrainView::ready, this, [this](const RenderLimits& limits) {
        render_limits_ = limits;
        if (!waiting_file_.isEmpty()) {
            open(std::exchange(waiting_file_, {}));
        } else {
            settleIfIdle();
        }
    });
    connect(view_, &TerrainView::unavailable, this,
            [this](const QString& reason) { reportFailure(tr("Cannot Draw"), reason); });
    connect(view_, &TerrainView::pointerMoved, readout_, &StatusReadout::setHit);
    connect(view_, &TerrainView::exaggerationChanged, this, &MainWindow::showExaggeration);
    connect(view_, &TerrainView::mapShown, this,
            [this](const LoadedMap& map) { readout_->setDataset(map.dataset); });
    connect(view_, &TerrainView::pictureCompleted, this, &MainWindow::settleIfIdle);
}

void MainWindow::restoreWindow()
{
    const QSettings settings;
    restoreGeometry(settings.value(QStringLiteral("window/geometry")).toByteArray());
    restoreState(settings.value(QStringLiteral("window/state")).toByteArray(), kStateVersion);
}

void MainWindow::open(const QString& file)
{
    if (!render_limits_) {
        waiting_file_ = file;
        return;
    }
    DatasetSpec spec;
    spec.path = file.toStdString();
    startLoad(Purpose::Open, spec);
}

void MainWindow::cancelLoading()
{
    loader_->cancel();
}

void MainWindow::chooseFile()
{
    const QString folder =
        map_ ? QFileInfo(QString::fromStdString(map_.dataset->spec().path)).path() : QString();
    auto* dialog = new QFileDialog(this, tr("Open Map"), folder);
    dialog->setFileMode(QFileDialog::ExistingFile);
    dialog->setNameFilters({tr("Elevation maps (*.tif *.tiff *.lbl *.img *.cub *.hgt *.dem *.asc "
                               "*.flt *.hdr *.bil *.nc *.cdf *.dt0 *.dt1 *.dt2 *.vrt *.xml *.zip)"),
                            tr("All files (*)")});
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::fileSelected, this, &MainWindow::open);
    dialog->open();
}

void MainWindow::startLoad(Purpose purpose, const DatasetSpec& spec)
{
    if (purpose != Purpose::UndoStep) {
        settleUndoStack(); // a step that was under way gives way and does not take effect
    }
    purpose_ = purpose;
    const bool is_same_file = map_ && purpose != Purpose::Open;
    loader_->start(
        {.spec = spec, .limits = *render_limits_, .loaded = is_same_file ? map_.dataset : nullptr});
}

void MainWindow::requestOverrides(Purpose purpose, const RasterOverrides& overrides)
{
    if (map_ && !is_settling_) {
        DatasetSpec spec = map_.dataset->spec();
        spec.overrides = overrides;
        startLoad(purpose, spec);
    }
}

void MainWindow::acceptMap(const LoadedMap& map)
{
    const DatasetSpec before = map_ ? map_.dataset->spec() : DatasetSpec{};
    map_ = map;
    switch (purpose_) {
    case Purpose::Open:
        undo_stack_.clear();
        break;
    case Purpose::Override:
        undo_stack_.push(new OverrideCommand(
            before.overrides, map.dataset->spec().overrides,
            [this](const RasterOverrides& o) { requestOverrides(Purpose::UndoStep, o); }));
        break;
    case Purpose::UndoStep:
        break;
    }
    applied_index_ = undo_stack_.index();
    const QString file = QString::fromStdString(map.dataset->spec().path);
    setWindowFilePath(file);
    //: Window title: %1 is a file name
    setWindowTitle(tr("%1 — MarsView").arg(QFileInfo(file).fileName()));
    panel_->setDataset(map.dataset);
    notices_->setNotices(noticesOf(map.dataset->info()));
    for (QAction* action : std::as_const(map_actions_)) {
        action->setEnabled(true);
    }
    exaggeration_slider_->setEnabled(true);
    view_->setMap(map);
}

// The map in effect is the one from before.
void MainWindow::rejectLoad()
{
    settleUndoStack();
    settleIfIdle();
}

void MainWindow::settleUndoStack()
{
    is_settling_ = true;
    undo_stack_.setIndex(applied_index_);
    is_settling_ = false;
}

void MainWindow::reportFailure(const QString& title, const QString& problem)
{
    Q_EMIT openFailed(problem);
    if (options_.failures == WindowOptions::Failures::InDialogs) {
        auto* box = new QMessageBox(QMessageBox::Warning, title, problem, QMessageBox::Ok, this);
        box->setAttribute(Qt::WA_DeleteOnClose);
        box->setTextFormat(Qt::PlainText);
        box->setWindowModality(Qt::WindowModal);
        box->show();
    }
}

void MainWindow::savePicture()
{
    const QImage picture = view_->grabFramebuffer();
    auto* dialog = new QFileDialog(this, tr("Save Picture"));
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setNameFilters({tr("PNG picture (*.png)"), tr("JPEG picture (*.jpg *.jpeg)")});
    dialog->setDefaultSuffix(QStringLiteral("png"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::fileSelected, this, [this, picture](const QString& file) {
        if (!picture.save(file)) {
            reportFailure(tr("Cannot Save Picture"),
                          tr("%1: the picture cannot be written; choose another folder or a name "
                             "that ends in .png")
                              .arg(file));
        }
    });
    dialog->open();
}

void MainWindow::showExaggeration(double exaggeration)
{
    exaggeration_label_->setText(exaggerationText(exaggeration));
    int steps = 0;
    while (steps < kSliderStepsUp && steppedExaggeration(1.0, steps + 1) <= exaggeration * 1.001) {
        ++steps;
    }
    while (steps > -kSliderStepsDown && steppedExaggeration(1.0, steps) > exaggeration * 1.001) {
        --steps;
    }
    const QSignalBlocker blocker(exaggeration_slider_);
    exaggeration_slider_->setValue(steps);
}

void MainWindow::showAbout()
{
    QMessageBox::about(
        this, tr("About MarsView"),
        tr("<h3>MarsView %1</h3><p>Explore very large topographic maps by sight and by touch.</p>")
            .arg(QCoreApplication::applicationVersion()));
}

void MainWindow::showKeys()
{
    auto* dialog = new QDialog(this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setWindowTitle(tr("Keys and Mouse"));
    auto* form = new QFormLayout;
    form->setHorizontalSpacing(24);
    const std::array<std::array<QString, 2>, 6> mouse{{
        {tr("Left drag, Shift+drag"), tr("Pan")},
        {tr("Right or middle drag"), tr("Turn and tilt")},
        {tr("Wheel"), tr("Zoom to the pointer")},
        {tr("Ctrl+wheel"), tr("Zoom finely")},
        {tr("Double click"), tr("Fly there")},
        {tr("Drop a file"), tr("Open it")},
    }};
    for (const auto& line : mouse) {
        form->addRow(line[0], new QLabel(line[1], dialog));
    }
    for (const QAction* action : view_->actions()) {
        form->addRow(QKeySequence::listToString({action->shortcut()}, QKeySequence::NativeText),
                     new QLabel(action->text().remove(QLatin1Char('&')), dialog));
    }
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, dialog);
    connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
    auto* layout = new QVBoxLayout(dialog);
    layout->addLayout(form);
    layout->addWidget(buttons);
    dialog->show();
}

void MainWindow::settleIfIdle()
{
    if (render_limits_ && waiting_file_.isEmpty() && !loader_->isLoading() &&
        (!map_ || view_->isPictureComplete())) {
        Q_EMIT settled();
    }
}

void MainWindow::closeEvent(QCloseEvent* event)
{
    loader_->cancel();
    if (options_.geometry == WindowOptions::Geometry::Remembered) {
        QSettings settings;
        settings.setValue(QStringLiteral("window/geometry"), saveGeometry());
        settings.setValue(QStringLiteral("window/state"), saveState(kStateVersion));
    }
    QMainWindow::closeEvent(event);
}

void MainWindow::resizeEvent(QResizeEvent* event)
{
    QMainWindow::resizeEvent(event);
    fitDockToWidth();
}

void MainWindow::fitDockToWidth()
{
    const int width_max = width() / kDockShareOfWidth;
    const bool is_too_narrow = width_max < kDockWidthMin && !georeferencing_dock_->isFloating();
    if (is_too_narrow && georeferencing_dock_->isVisible()) {
        is_dock_folded_ = true;
        georeferencing_dock_->hide();
    } else if (!is_too_narrow && is_dock_folded_) {
        is_dock_folded_ = false;
        georeferencing_dock_->show();
        resizeDocks({georeferencing_dock_}, {std::min(kDockWidth, width_max)}, Qt::Horizontal);
    }
    georeferencing_dock_->setMaximumWidth(std::max(kDockWidthMin, width_max));
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event)
{
    if (!localFileOf(*event->mimeData()).isEmpty()) {
        event->acceptProposedAction();
    }
}

void MainWindow::dropEvent(QDropEvent* event)
{
    const QString file = localFileOf(*event->mimeData());
    if (!file.isEmpty()) {
        event->acceptProposedAction();
        open(file);
    }
}

} // namespace marsview
