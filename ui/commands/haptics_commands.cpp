#include "ui/commands/haptics_commands.h"

#include "ui/controllers/haptics/haptics_controller.h"
#include "ui/controllers/session_controller.h"
#include "ui/panels/haptics_panel.h"
#include "ui/text/haptics_text.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_docks.h"
#include "ui/window/window_messages.h"

#include <QAction>
#include <QDockWidget>
#include <QListWidget>
#include <QSettings>

#include <filesystem>
#include <string>
#include <vector>

namespace marsview {
namespace {

constexpr const char* kConnected = "window.connected"; // of CrashMarker

bool hasEndedWhileConnected()
{
    const std::filesystem::path folder = CrashMarker::defaultFolder();
    const bool has_ended = CrashMarker::leftBehind(folder, kConnected).has_value();
    CrashMarker::forget(folder, kConnected);
    return has_ended;
}

} // namespace

HapticsCommands::HapticsCommands(const Parts& parts)
    : parts_(parts)
{
    HapticsController& haptics = parts_.haptics;
    if (parts_.is_remembered) {
        haptics.setSettings(hapticsSettingsFrom(QSettings()));
    }
    connect(&haptics.device(), &DeviceSession::connectionChanged, this,
            &HapticsCommands::showState);
    connect(&haptics, &HapticsController::stoppedChanged, this, &HapticsCommands::showState);
    if (parts_.is_remembered) {
        connect(&haptics.device(), &DeviceSession::connectionChanged, this,
                &HapticsCommands::markConnection);
        connect(&haptics, &HapticsController::settingsChanged, this, [&haptics] {
            QSettings settings;
            save(haptics.settings(), settings);
        });
    }
    connectRecorder();
    connectActions();
}

HapticsCommands::~HapticsCommands() = default;

void HapticsCommands::connectRecorder()
{
    TouchRecorder& recorder = parts_.haptics.recorder();
    WindowMessages& messages = parts_.messages;
    recorder.setMapsInUse([&session = parts_.session] {
        std::vector<std::string> paths;
        for (const Layer& layer : session.session().layers) {
            paths.push_back(layer.map->spec().path);
        }
        return paths;
    });
    connect(&recorder, &TouchRecorder::changed, this, &HapticsCommands::showState);
    connect(&recorder, &TouchRecorder::failed, &messages,
            [&messages](const QString& problem) { messages.report(tr("Cannot Record"), problem); });
    connect(&recorder, &TouchRecorder::recorded, &messages,
            [&messages](const QString& file, qulonglong updates, RecordingEnd end) {
                messages.show(recordedText(file, updates, end));
            });
    connect(&recorder, &TouchRecorder::ticksSaved, &messages,
            [&messages](const SavedTicks& saved) { messages.show(savedTicksText(saved)); });
    connect(&recorder, &TouchRecorder::savingFailed, &messages,
            [&messages](const QString& problem) {
                messages.report(tr("Cannot Save Diagnostic Log"), problem);
            });
}

void HapticsCommands::connectActions()
{
    const WindowActions& actions = parts_.actions;
    connect(actions.haptic_devices, &QAction::triggered, this, [this] {
        parts_.docks.reveal(*parts_.docks.haptics());
        parts_.panel.list()->setFocus();
    });
    connect(actions.record_touch, &QAction::triggered, this, [this] {
        TouchRecorder& recorder = parts_.haptics.recorder();
        recorder.isRecording() ? recorder.stop() : parts_.panel.chooseRecording();
    });
    connect(actions.replay_touch, &QAction::triggered, &parts_.panel, &HapticsPanel::chooseReplay);
    connect(actions.save_flight, &QAction::triggered, &parts_.panel,
            &HapticsPanel::chooseFlightRecord);
    connect(actions.emergency_stop, &QAction::triggered, this,
            [this] { parts_.haptics.setStopped(true); });
}

void HapticsCommands::connectToRemembered(LastDevice last)
{
    DeviceSession& device = parts_.haptics.device();
    const auto& remembered = parts_.haptics.settings().device;
    const bool has_ended = parts_.is_remembered && hasEndedWhileConnected();
    if (last == LastDevice::Leave) {
        return;
    }
    if (has_ended) {
        device.holdBackRemembered(remembered);
    } else if (!remembered.startsWith(QStringLiteral("sim:"))) {
        // A hand that moves without having been asked to would be a surprise.
        device.connectToRemembered(remembered);
    }
}

void HapticsCommands::close()
{
    parts_.haptics.device().close();
    connection_marker_.reset();
}

void HapticsCommands::markConnection()
{
    const DeviceSession& device = parts_.haptics.device();
    const bool is_connected =
        device.connection() == HapticsConnection::Connected && !device.isReplaying();
    if (!is_connected) {
        connection_marker_.reset();
    } else if (!connection_marker_) {
        connection_marker_.emplace(CrashMarker::set(CrashMarker::defaultFolder(), kConnected));
    }
}

void HapticsCommands::showState()
{
    const WindowActions& actions = parts_.actions;
    const bool is_recording = parts_.haptics.recorder().isRecording();
    actions.emergency_stop->setEnabled(parts_.haptics.device().canBeStopped());
    actions.record_touch->setEnabled(is_recording || parts_.haptics.device().isRunning());
    actions.record_touch->setText(is_recording ? tr("Stop &Recording Touch")
                                               : tr("&Record Touch…"));
    actions.save_flight->setEnabled(parts_.haptics.device().hasTicks());
    Q_EMIT changed();
}

} // namespace marsview
