// The haptic device of the window, from its search to its loss, and the servo loop around it.
#pragma once

#include "haptics/loop/servo_loop.h"
#include "ui/controllers/device_finder.h"
#include "ui/controllers/haptics/device_state.h"

#include <QObject>
#include <QString>
#include <QTimer>

#include <memory>
#include <vector>

namespace marsview {

enum class HapticsConnection { None, Opening, Connected };

/// Connects one device at a time; a recording is replayed as a device. The servo loop exists while
/// one is connected, and runs while its settings have a map. GUI thread, which waits for a device
/// only during its force ramp-down, some milliseconds. device_state.h has the states.
class DeviceSession final : public QObject {
    Q_OBJECT

public:
    explicit DeviceSession(DriverMaker make_drivers, QObject* parent = nullptr);

    // Devices.

    /// The devices found last, usable ones first, without those only for the command line; see
    /// devicesChanged().
    const std::vector<FoundDevice>& devices() const noexcept { return devices_; }
    void findDevices();
    bool isFinding() const noexcept { return finder_->isFinding(); }
    /// Searches for devices every few seconds while none is connected, and reconnects to one that
    /// was lost and is found again.
    void setLooking(bool is_looking);

    /// Replaces the current connection. If that is a device and `uri` a recording, the device is
    /// connected again when the recording has ended.
    void connectTo(const QString& uri);
    /// Connects to the device of the settings. If it is missing, no notice appears; it is connected
    /// when it is found. Does nothing for an empty URI.
    void connectToRemembered(const QString& uri);
    /// Instead of connectToRemembered(): reports that the program ended unexpectedly while that
    /// device was connected.
    void holdBackRemembered(const QString& uri);
    /// Emits forgotten(), unless a recording is replayed.
    void disconnectDevice();
    /// The same, but the device is to be connected again at the next start.
    void close();
    DeviceState state() const noexcept { return transitions_.state(); }
    HapticsConnection connection() const noexcept;
    /// Of the device that is connected or being opened.
    const QString& uri() const noexcept { return uri_; }
    /// By which that device is connected at the next start.
    QString rememberedUri() const;
    /// Whether the device is a simulated one.
    bool isSimulated() const;
    /// Whether the last device went without being asked to.
    bool isLost() const noexcept { return isAfterLoss(state()); }
    /// Whether a device is connected, is being opened, or will be connected when it is found.
    bool canBeStopped() const noexcept;
    /// Whether the device is calibrated by setting its home position.
    bool canBeSetAtRest() const;
    /// Reconnects the device and takes its current position as the home position. The user must
    /// have placed it there.
    void setAtRest();
    /// Why the last device or recording was refused or disconnected, or why a replayed recording
    /// does not match the maps. Sentences for people; empty without a problem.
    const QString& problem() const noexcept { return problem_; }
    /// The same, but empty if only the panel should show it.
    const QString& notice() const noexcept { return notice_; }
    void setProblem(const QString& problem);

    // Recordings in place of a device.

    bool isReplaying() const noexcept { return state() == DeviceState::Replaying; }
    /// The file that is replayed; empty unless isReplaying().
    QString replayedFile() const;
    /// How much of it has been played back, 0 to 1.
    double replayedShare() const { return loop_ ? loop_->playedShare() : 0.0; }
    /// Ends the replay. The device that it replaced is connected again. Does nothing unless
    /// isReplaying(). `problem` says why it had to end.
    void stopReplay(const QString& problem = {});
    /// The recording that was replayed to its end last, until something else is connected than the
    /// device whose place it took; empty for none.
    QString replayedToItsEnd() const;
    /// Starts that replay again.
    void replayAgain();

    // The loop.

    /// Null unless connected.
    ServoLoop* loop() noexcept { return loop_.get(); }
    const ServoLoop* loop() const noexcept { return loop_.get(); }
    bool isRunning() const noexcept { return loop_ != nullptr && loop_->isRunning(); }
    /// What the next push() passes to the loop. Defaults after ended().
    LoopSettings& settings() noexcept { return settings_; }
    const LoopSettings& settings() const noexcept { return settings_; }
    /// Applies all settings at once. Does nothing without a loop.
    void push();
    /// Whether lastTicks() has any, or will in a moment.
    bool hasTicks() const;
    /// About the last ten seconds of the device that is, or was, connected. After a reconnection
    /// they follow those of the earlier connection. Takes 1 to 2 ms.
    std::vector<TickRecord> lastTicks() const;

Q_SIGNALS:
    void devicesChanged();
    /// connection(), problem(), notice(), or the capabilities of the device.
    void connectionChanged();
    /// There is a loop, which does not run yet. connectionChanged() follows.
    void opened();
    /// The connection or its opening is about to end; a loop that runs still does.
    void ending();
    /// There is no loop any more.
    void ended();
    /// The user has disconnected the device. connectionChanged() follows.
    void forgotten();
    void runningChanged();
    /// A recording was replayed to its end.
    void replayEnded(const QString& file);
    /// The button that sets points was pressed with the stylus at a place of the scene
    /// (LoopSettings::is_placing), and released.
    void pointPressed(const ScenePoint& place);
    void pointReleased();
    /// Some sixty times a second while the loop runs.
    void polled(const LoopState& state);

private:
    void takeDevices(const std::vector<FoundDevice>& devices);
    void open(const QString& uri, DeviceEvent event);
    void start();
    void refuse(const QString& problem, bool is_absent);
    void poll();
    void finish(const LoopState& last);
    void endLoop();
    void resume(const QString& problem, const QString& notice);
    void report(const QString& problem, const QString& notice);
    void look();

    DeviceFinder* finder_;
    std::vector<FoundDevice> devices_;
    QTimer look_timer_; // runs only while no device is connected
    bool is_looking_ = false;

    DeviceTransitions transitions_;
    QString uri_;
    QString awaited_uri_; // connected when it is found, or when the recording has ended
    QString replay_uri_;  // of the recording that was replayed to its end
    QString problem_;
    QString notice_;

    QTimer poll_timer_; // runs only while the loop does
    std::unique_ptr<ServoLoop> loop_;
    LoopSettings settings_;
    std::vector<TickRecord> kept_ticks_; // of the last loop
};

} // namespace marsview
