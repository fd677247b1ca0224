#include "ui/panels/haptics_panel.h"

#include "ui/panels/limit_slider.h"
#include "ui/panels/loop_times.h"
#include "ui/text/haptics_text.h"
#include "ui/text/number_text.h"
#include "ui/text/sentence.h"
#include "ui/widgets/caption.h"
#include "ui/widgets/progress_value.h"
#include "ui/widgets/scroll_area.h"

#include <QAction>
#include <QActionGroup>
#include <QBoxLayout>
#include <QCheckBox>
#include <QComboBox>
#include <QDateTime>
#include <QEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QScrollArea>
#include <QSlider>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

namespace marsview {
namespace {

constexpr int kForceSteps = 200;   // of the meter
constexpr int kReplaySteps = 1000; // of the progress
constexpr int kStiffnessStep = 10; // N/m
constexpr int kShareStep = 5;      // %

constexpr int kGroupGap = 8; // between groups, in addition to that between their lines

constexpr int kUriRole = Qt::UserRole;
constexpr int kUsableRole = Qt::UserRole + 1;
constexpr int kReasonRole = Qt::UserRole + 2; // why it cannot be used

QLabel* makeText(QWidget* parent, const QString& name)
{
    auto* label = new QLabel(parent);
    label->setWordWrap(true);
    label->setAccessibleName(name);
    return label;
}

} // namespace

HapticsPanel::HapticsPanel(HapticsController& controller,
                           QActionGroup& contact_models,
                           QWidget* parent)
    : QWidget(parent)
    , controller_(controller)
    , device_(controller.device())
    , model_actions_(contact_models)
{
    QScrollArea* scroll = makeScrollArea(this);
    scroll->setFocusPolicy(Qt::NoFocus); // its controls scroll into sight
    auto* content = new QWidget(scroll);
    auto* layout = new QVBoxLayout(content);
    layout->setContentsMargins(6, 6, 6, 6);
    layout->setSpacing(4);
    // The stop button must be found at once, so texts that appear and disappear are below it.
    makeStop(*layout);
    makeDevices(*layout);
    makeForce(*layout);
    makeRecording(*layout);
    layout->addSpacing(kGroupGap);
    times_ = new LoopTimes(this);
    layout->addWidget(times_);
    layout->addStretch(1);
    scroll->setWidget(content);
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->addWidget(scroll);

    connect(&device_, &DeviceSession::devicesChanged, this, &HapticsPanel::showDevices);
    connect(&device_, &DeviceSession::connectionChanged, this, &HapticsPanel::showConnection);
    connect(&controller_, &HapticsController::settingsChanged, this, &HapticsPanel::showSettings);
    connect(&controller_, &HapticsController::stoppedChanged, this, &HapticsPanel::showStopped);
    connect(&controller_.recorder(), &TouchRecorder::changed, this, &HapticsPanel::showRecording);
    connect(&device_, &DeviceSession::polled, this, &HapticsPanel::showState);
    connect(&device_, &DeviceSession::replayEnded, recording_,
            [this](const QString& file) { recording_->setText(replayEndText(file)); });
    connect(&controller_.recorder(), &TouchRecorder::failed, recording_, &QLabel::setText);
    connect(&controller_.recorder(), &TouchRecorder::savingFailed, recording_, &QLabel::setText);
    connect(&controller_.recorder(), &TouchRecorder::ticksSaved, recording_,
            [this](const SavedTicks& saved) { recording_->setText(savedTicksText(saved)); });
    connect(&controller_.recorder(), &TouchRecorder::recorded, this,
            [this](const QString& file, qulonglong updates, RecordingEnd end) {
                recording_->setText(recordedText(file, updates, end));
            });
    showDevices();
    showConnection();
    showSettings();
    showStopped();
    showRecording();
}

void HapticsPanel::makeDevices(QBoxLayout& layout)
{
    list_ = new QListWidget(this);
    list_->setAccessibleName(tr("Haptic devices"));
    list_->setObjectName(QStringLiteral("hapticDevices"));
    list_->setWordWrap(true);
    list_->setTextElideMode(Qt::ElideNone);
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    list_->setResizeMode(QListView::Adjust);
    list_->setSpacing(2);
    connect(list_, &QListWidget::currentItemChanged, this, &HapticsPanel::showChoice);
    connect(list_, &QListWidget::itemActivated, this, [this](QListWidgetItem* item) {
        if (item->data(kUsableRole).toBool()) {
            device_.connectTo(item->data(kUriRole).toString());
        }
    });
    layout.addWidget(list_);
    connect_ = new QPushButton(this);
    connect_->setObjectName(QStringLiteral("connectDevice"));
    connect(connect_, &QPushButton::clicked, this, &HapticsPanel::toggleConnection);
    layout.addWidget(connect_);
    status_ = makeText(this, tr("Connection"));
    status_->setObjectName(QStringLiteral("hapticStatus"));
    status_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    layout.addWidget(status_);
    layout.addSpacing(kGroupGap);
}

void HapticsPanel::makeStop(QBoxLayout& layout)
{
    stop_ = new QPushButton(this);
    stop_->setObjectName(QStringLiteral("emergencyStop"));
    QFont bold = stop_->font();
    bold.setBold(true);
    stop_->setFont(bold);
    stop_->setMinimumHeight(fontMetrics().height() * 5 / 2);
    connect(stop_, &QPushButton::clicked, this,
            [this] { controller_.setStopped(!controller_.isStopped()); });
    layout.addWidget(stop_);
    layout.addSpacing(kGroupGap);
}

void HapticsPanel::makeForce(QBoxLayout& layout)
{
    force_ = new QProgressBar(this);
    force_->setObjectName(QStringLiteral("force"));
    force_->setAccessibleName(tr("Force on the stylus"));
    force_->setRange(0, kForceSteps);
    layout.addWidget(force_);
    reason_ = makeText(this, tr("Touch state"));
    reason_->setObjectName(QStringLiteral("forceOffReason"));
    // As high with one line as with two, so that the widgets below do not move.
    reason_->setMinimumHeight(fontMetrics().height() * 2);
    reason_->setAlignment(Qt::AlignLeading | Qt::AlignTop);
    rest_ = new QPushButton(tr("Set Home Position"), this);
    rest_->setObjectName(QStringLiteral("restPosition"));
    rest_->setToolTip(
        tr("Move the arm to its home position first; positions are measured from there"));
    rest_->hide();
    connect(rest_, &QPushButton::clicked, &device_, &DeviceSession::setAtRest);
    layout.addWidget(reason_);
    layout.addWidget(rest_);
    makeSliders(layout);
    QLabel* caption = makeCaption(tr("Contact &model"), this);
    layout.addWidget(caption);
    models_ = new QComboBox(this);
    models_->setObjectName(QStringLiteral("contactModel"));
    models_->setAccessibleName(tr("Contact model"));
    models_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    models_->setMinimumContentsLength(6);
    caption->setBuddy(models_);
    for (const QAction* action : model_actions_.actions()) {
        models_->addItem(action->text().remove(QLatin1Char('&')));
        models_->setItemData(models_->count() - 1, action->statusTip(), Qt::ToolTipRole);
        connect(action, &QAction::toggled, this, &HapticsPanel::showSettings);
    }
    connect(models_, &QComboBox::activated, this,
            [this](int index) { model_actions_.actions().at(index)->trigger(); });
    layout.addWidget(models_);
    walls_ = new QCheckBox(tr("&Walls at the edges"), this);
    walls_->setObjectName(QStringLiteral("walls"));
    walls_->setToolTip(tr("Keep the stylus where the device works best"));
    connect(walls_, &QCheckBox::toggled, this, [this](bool has_walls) {
        if (!is_filling_) {
            HapticsSettings settings = controller_.settings();
            settings.has_walls = has_walls;
            controller_.setSettings(settings);
        }
    });
    layout.addWidget(walls_);
    layout.addSpacing(kGroupGap);
}

void HapticsPanel::makeSliders(QBoxLayout& layout)
{
    const auto add_slider = [&](QSlider* slider, QLabel*& value, const QString& text) {
        QLabel* caption = makeCaption(text, this);
        value = new QLabel(this);
        slider->setAccessibleName(QString(text).remove(QLatin1Char('&')));
        caption->setBuddy(slider);
        layout.addLayout(makeCaptionLine(caption, value));
        layout.addWidget(slider);
    };
    stiffness_ = new LimitSlider(this);
    stiffness_->setObjectName(QStringLiteral("stiffness"));
    add_slider(stiffness_, stiffness_text_, tr("Surface st&iffness"));
    stiffness_->setRange(static_cast<int>(kStiffnessMin) / kStiffnessStep,
                         static_cast<int>(kStiffnessMax) / kStiffnessStep);
    stiffness_->setSingleStep(1);
    stiffness_->setPageStep(5);
    connect(stiffness_, &QSlider::valueChanged, this, [this](int value) {
        if (!is_filling_) {
            HapticsSettings settings = controller_.settings();
            settings.stiffness_n_per_m = value * kStiffnessStep;
            controller_.setSettings(settings);
        }
    });
    stiffness_limit_ = makeCaption({}, this);
    stiffness_limit_->setObjectName(QStringLiteral("stiffnessLimit"));
    stiffness_limit_->setAccessibleName(tr("Limit of the stiffness"));
    stiffness_limit_->setWordWrap(true);
    layout.addWidget(stiffness_limit_);
    share_ = new QSlider(Qt::Horizontal, this);
    share_->setObjectName(QStringLiteral("forceScale"));
    add_slider(share_, share_text_, tr("F&orce scale"));
    share_->setRange(0, 100 / kShareStep);
    share_->setPageStep(5);
    connect(share_, &QSlider::valueChanged, this, [this](int value) {
        if (!is_filling_) {
            HapticsSettings settings = controller_.settings();
            settings.force_share = value * kShareStep / 100.0;
            controller_.setSettings(settings);
        }
    });
}

void HapticsPanel::makeRecording(QBoxLayout& layout)
{
    auto* line = new QHBoxLayout;
    record_ = new QPushButton(this);
    record_->setObjectName(QStringLiteral("record"));
    record_->setToolTip(tr("Record the motion of the stylus on this map in a file"));
    connect(record_, &QPushButton::clicked, this, [this] {
        controller_.recorder().isRecording() ? controller_.recorder().stop() : chooseRecording();
    });
    replay_ = new QPushButton(this);
    replay_->setObjectName(QStringLiteral("replay"));
    connect(replay_, &QPushButton::clicked, this,
            [this] { device_.isReplaying() ? device_.stopReplay() : chooseReplay(); });
    for (QPushButton* button : {record_, replay_}) {
        button->setMinimumWidth(0);
        button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
        line->addWidget(button);
    }
    layout.addLayout(line);
    replayed_ = new QProgressBar(this);
    replayed_->setObjectName(QStringLiteral("replayProgress"));
    replayed_->setAccessibleName(tr("Replayed"));
    replayed_->setRange(0, kReplaySteps);
    flight_ = new QPushButton(tr("Save Diagnostic &Log…"), this);
    flight_->setObjectName(QStringLiteral("saveFlight"));
    flight_->setToolTip(
        tr("Save the last ten seconds of the device, tick by tick, for troubleshooting"));
    connect(flight_, &QPushButton::clicked, this, &HapticsPanel::chooseFlightRecord);
    layout.addWidget(flight_);
    layout.addWidget(replayed_);
    recording_ = makeText(this, tr("Recording"));
    recording_->setObjectName(QStringLiteral("recording"));
    layout.addWidget(recording_);
}

void HapticsPanel::showEvent(QShowEvent* event)
{
    QWidget::showEvent(event);
    fitList();
    device_.setLooking(true);
    device_.findDevices(); // once also while one is connected
    showConnection();
}

void HapticsPanel::hideEvent(QHideEvent* event)
{
    QWidget::hideEvent(event);
    device_.setLooking(false);
}

// Colors of our own go by the palette.
void HapticsPanel::changeEvent(QEvent* event)
{
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange && stop_ != nullptr) {
        showDevices();
        showStopped();
    }
}

void HapticsPanel::showDevices()
{
    const QString before = chosenUri();
    const QScopedValueRollback filling(is_filling_, true);
    list_->clear();
    for (const FoundDevice& device : device_.devices()) {
        const QString uri = QString::fromStdString(device.uri);
        const QString name = device.name.empty() ? uri : deviceName(device.name);
        const QString reason = asSentence(device.reason);
        auto* item = new QListWidgetItem(name, list_);
        item->setData(kUriRole, uri);
        item->setData(kUsableRole, device.isUsable());
        item->setData(kReasonRole, reason);
        item->setData(Qt::AccessibleTextRole,
                      reason.isEmpty() ? name
                                       //: A device that cannot be used, read aloud; %2 says why
                                       : tr("%1, not available: %2").arg(name, reason));
        QStringList tip{uri};
        if (!reason.isEmpty()) {
            tip.prepend(reason);
        }
        if (!device.details.empty()) {
            //: %1 is what the system reported
            tip.append(tr("Details: %1").arg(QString::fromStdString(device.details)));
        }
        item->setToolTip(tip.join(QLatin1Char('\n')));
        if (!device.isUsable()) {
            item->setForeground(palette().color(QPalette::PlaceholderText));
        }
        if (uri == (before.isEmpty() ? device_.uri() : before)) {
            list_->setCurrentItem(item);
        }
    }
    if (list_->currentItem() == nullptr) {
        for (int i = 0; i < list_->count(); ++i) {
            if (list_->item(i)->data(kUsableRole).toBool()) {
                list_->setCurrentRow(i);
                break;
            }
        }
    }
    fitList();
    markConnected();
    showChoice();
}

// As high as its devices need, within limits.
void HapticsPanel::fitList()
{
    list_->doItemsLayout();
    int height = 2 * list_->frameWidth() + 2 * list_->spacing();
    for (int i = 0; i < list_->count(); ++i) {
        height += list_->visualItemRect(list_->item(i)).height() + 2 * list_->spacing();
    }
    const int line = fontMetrics().height();
    list_->setFixedHeight(std::clamp(height, 3 * line, 9 * line));
}

QString HapticsPanel::chosenUri() const
{
    const QListWidgetItem* item = list_->currentItem();
    return item != nullptr ? item->data(kUriRole).toString() : QString();
}

void HapticsPanel::toggleConnection()
{
    if (device_.connection() != HapticsConnection::None) {
        device_.disconnectDevice();
    } else if (!chosenUri().isEmpty()) {
        device_.connectTo(chosenUri());
    }
}

void HapticsPanel::showConnectButton()
{
    const QListWidgetItem* item = list_->currentItem();
    switch (device_.connection()) {
    case HapticsConnection::None:
        connect_->setText(tr("&Connect"));
        connect_->setEnabled(item != nullptr && item->data(kUsableRole).toBool());
        break;
    case HapticsConnection::Opening:
        connect_->setText(tr("&Cancel"));
        connect_->setEnabled(true);
        break;
    case HapticsConnection::Connected:
        connect_->setText(tr("Dis&connect"));
        connect_->setEnabled(true);
        break;
    }
}

// What the button does to the selected device, and why it may be disabled.
void HapticsPanel::showChoice()
{
    showConnectButton();
    if (device_.connection() == HapticsConnection::None) {
        const QListWidgetItem* item = list_->currentItem();
        const QString reason = item != nullptr ? item->data(kReasonRole).toString() : QString();
        status_->setText(!device_.problem().isEmpty() ? device_.problem()
                         : !reason.isEmpty()          ? reason
                                                      : tr("No device is connected."));
    }
}

// The device that is connected stands out, and is the current one when it comes.
void HapticsPanel::markConnected()
{
    const bool is_connected = device_.connection() == HapticsConnection::Connected;
    for (int i = 0; i < list_->count(); ++i) {
        QListWidgetItem* item = list_->item(i);
        const bool is_it = is_connected && item->data(kUriRole).toString() == device_.uri();
        QFont font = item->font();
        if (is_it && !font.bold()) {
            list_->setCurrentItem(item);
        }
        font.setBold(is_it);
        item->setFont(font);
    }
}

void HapticsPanel::showConnection()
{
    markConnected();
    showChoice();
    // Without a device there is nothing to measure.
    const bool is_connected = device_.connection() == HapticsConnection::Connected;
    for (QWidget* part : std::initializer_list<QWidget*>{force_, reason_, times_}) {
        part->setVisible(is_connected);
    }
    switch (device_.connection()) {
    case HapticsConnection::None:
        break;
    case HapticsConnection::Opening:
        //: %1 names a device
        status_->setText(tr("Connecting to %1…").arg(device_.uri()));
        break;
    case HapticsConnection::Connected: {
        if (device_.isReplaying()) {
            if (!controller_.recorder().isRecording()) {
                recording_->clear(); // what it says is of an earlier replay or recording
            }
            status_->setText(
                !device_.problem().isEmpty()
                    ? device_.problem()
                    //: %1 is a file
                    : tr("Replaying %1").arg(QFileInfo(device_.replayedFile()).fileName()));
            break;
        }
        const DeviceCapabilities& device = device_.loop()->device();
        //: %1 is a device, %2 a force
        status_->setText(
            tr("%1, up to %2")
                .arg(isolated(deviceName(device.name)),
                     //: A force in newtons
                     leftToRight(tr("%1 N").arg(shortNumberText(device.force_n_peak, 2)))));
        break;
    }
    }
    showNoState();
    showSettings();
    showStopped();
    showRecording();
}

void HapticsPanel::showSettings()
{
    const QScopedValueRollback filling(is_filling_, true);
    const HapticsSettings& settings = controller_.settings();
    showStiffness();
    share_->setValue(static_cast<int>(std::lround(settings.force_share * 100.0 / kShareStep)));
    share_->setToolTip(tr("Share of the computed force that the device renders"));
    share_text_->setText(leftToRight(tr("%1 %").arg(numberText(settings.force_share * 100.0, 0))));
    walls_->setChecked(settings.has_walls);
    const QList<QAction*> models = model_actions_.actions();
    for (int i = 0; i < models.size(); ++i) {
        if (models[i]->isChecked()) {
            models_->setCurrentIndex(i);
        }
    }
}

// What was chosen, whatever the device stands: another device may stand more.
void HapticsPanel::showStiffness()
{
    const double chosen = controller_.settings().stiffness_n_per_m;
    const double most = controller_.stiffnessMax();
    const auto text = [](double n_per_m) {
        //: Newtons per meter
        return leftToRight(tr("%1 N/m").arg(numberText(n_per_m, 0)));
    };
    stiffness_->setValue(static_cast<int>(std::lround(chosen / kStiffnessStep)));
    stiffness_->setLimit(most < kStiffnessMax
                             ? std::optional(static_cast<int>(most) / kStiffnessStep)
                             : std::nullopt);
    stiffness_text_->setText(text(chosen));
    stiffness_->setToolTip(most < kStiffnessMax
                               //: %1 is a stiffness in newtons per meter
                               ? tr("The mark is the limit of the device: %1").arg(text(most))
                               : tr("Surface stiffness"));
    stiffness_limit_->setText(most < chosen
                                  //: Below a slider that is set to more; %1 is a stiffness in
                                  //: newtons per meter
                                  ? tr("Limited to %1").arg(text(most))
                                  //: Below a slider; %1 is a stiffness in newtons per meter
                                  : tr("Device limit: %1").arg(text(most)));
    stiffness_limit_->setVisible(most < kStiffnessMax); // not by value: nothing moves in a drag
}

void HapticsPanel::showStopped()
{
    const bool is_stopped = controller_.isStopped();
    const bool is_of_use = is_stopped || device_.canBeStopped();
    stop_->setEnabled(is_of_use);
    stop_->setText(is_stopped ? tr("Resume Forces") : tr("Emergency &Stop"));
    stop_->setToolTip(is_stopped
                          ? tr("Switch forces on again; they ramp up smoothly")
                          : tr("Switch all forces off at once (Ctrl+. or Pause, in any window)"));
    // Red as such buttons are everywhere, with white text, in every palette.
    QPalette colors = palette();
    if (is_of_use && !is_stopped) {
        colors.setColor(QPalette::Button, QColor(150, 20, 20));
        colors.setColor(QPalette::ButtonText, Qt::white);
    }
    stop_->setPalette(colors);
}

void HapticsPanel::showNoState()
{
    if (!device_.isRunning()) {
        showValue(*force_, 0);
        force_->setFormat(forceText(0.0, kForceNMax));
        const QString why = controller_.whyNoTouch();
        reason_->setText(device_.loop() == nullptr ? QString()
                         : why.isEmpty()           ? forceOffText(ForceOffReason::NoTouch)
                                                   : why);
        rest_->hide();
        times_->clear();
    }
}

void HapticsPanel::showState(const LoopState& state)
{
    if (!isVisible()) {
        return;
    }
    const bool is_replay = device_.isReplaying();
    const double most_n = is_replay ? kForceNMax : device_.loop()->device().force_n_peak;
    // The force of a stalled loop is unknown.
    const double force_n =
        state.reason == ForceOffReason::LoopStalled ? 0.0 : length(state.force_n);
    showValue(*force_,
              most_n > 0.0
                  ? static_cast<int>(std::lround(std::min(1.0, force_n / most_n) * kForceSteps))
                  : 0);
    //: %1 is a force, like "0.45 N"
    const QString text_n = forceText(force_n, most_n); // as over the map
    force_->setFormat(state.is_force_recorded ? tr("%1 when recorded").arg(text_n)
                      : is_replay             ? tr("No force recorded")
                                              : text_n);
    if (is_replay) {
        showValue(*replayed_,
                  static_cast<int>(std::lround(device_.replayedShare() * kReplaySteps)));
    }
    const std::string trouble =
        state.reason == ForceOffReason::DeviceUnready ? device_.loop()->trouble() : std::string();
    const QString reason = trouble.empty()
                               ? forceOffText(state.reason)
                               //: %1 is the device's error
                               : tr("Force off: %1").arg(QString::fromStdString(trouble));
    const QString why_not = controller_.whyNoTouch();
    const QString text = !reason.isEmpty()    ? reason
                         : is_replay          ? tr("Replaying")
                         : !why_not.isEmpty() ? why_not
                         : state.is_at_edge   ? tr("At the edge of the map")
                                              : modeText(state.mode, state.contact.is_in_contact);
    if (text != reason_->text()) {
        reason_->setText(text);
    }
    reason_->setToolTip(controller_.whyApart());
    rest_->setVisible(state.reason == ForceOffReason::DeviceUnready && device_.canBeSetAtRest());
    if (times_->isDue()) {
        times_->showLoop(device_.loop()->statistics(), device_.loop()->grants());
    }
}

void HapticsPanel::showRecording()
{
    record_->setText(controller_.recorder().isRecording() ? tr("S&top") : tr("&Record…"));
    record_->setEnabled(controller_.recorder().isRecording() || device_.isRunning());
    flight_->setEnabled(device_.hasTicks());
    const bool is_replay = device_.isReplaying();
    replay_->setText(is_replay ? tr("Stop Re&play") : tr("Re&play…"));
    replay_->setToolTip(is_replay ? tr("End the replay; the camera returns to where it was")
                                  : tr("Play back a recording on this map in place of a device"));
    replayed_->setVisible(is_replay);
    if (controller_.recorder().isRecording()) {
        //: %1 is a file
        recording_->setText(
            tr("Recording into %1").arg(QFileInfo(controller_.recorder().file()).fileName()));
    }
    showNoState();
}

void HapticsPanel::chooseRecording()
{
    auto* dialog = new QFileDialog(this, tr("Record Touch"), folder_);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setNameFilters({tr("Touch recording (*.csv)")});
    dialog->setDefaultSuffix(QStringLiteral("csv"));
    dialog->selectFile(tr("touch") + QStringLiteral(".csv"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& file) {
        folder_ = QFileInfo(file).absolutePath();
        (void)controller_.recorder().start(file); // failed() reports errors
    });
    dialog->open();
}

void HapticsPanel::chooseFlightRecord()
{
    // Copied now: these ticks would be overwritten while the user chooses a file name.
    std::vector<TickRecord> ticks = device_.lastTicks();
    if (ticks.empty()) {
        recording_->setText(tr("Nothing to save yet"));
        return;
    }
    auto* dialog = new QFileDialog(this, tr("Save Diagnostic Log"), folder_);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setNameFilters({tr("Diagnostic log (*.csv)")});
    dialog->setDefaultSuffix(QStringLiteral("csv"));
    const QString time = QDateTime::currentDateTime().toString(QStringLiteral("yyyy-MM-dd-HHmmss"));
    dialog->selectFile(tr("log") + QLatin1Char('-') + time + QStringLiteral(".csv"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::fileSelected, this,
            [this, ticks = std::move(ticks)](const QString& file) {
                folder_ = QFileInfo(file).absolutePath();
                controller_.recorder().saveTicks(ticks, file);
            });
    dialog->open();
}

void HapticsPanel::chooseReplay()
{
    auto* dialog = new QFileDialog(this, tr("Replay Touch"), folder_);
    dialog->setFileMode(QFileDialog::ExistingFile);
    dialog->setNameFilters({tr("Touch recording (*.csv)"), tr("All files (*)")});
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& file) {
        folder_ = QFileInfo(file).absolutePath();
        controller_.replay(file);
    });
    dialog->open();
}

} // namespace marsview
