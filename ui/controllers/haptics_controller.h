// Haptic devices in the window: the only bridge between them, the servo loop, and the view.
#pragma once

#include "haptics/interaction/hand_view.h"
#include "haptics/loop/servo_loop.h"
#include "haptics/terrain/touch_map.h"
#include "haptics/trace/replay_check.h"
#include "haptics/trace/session_recorder.h"
#include "ui/controllers/detached_jobs.h"
#include "ui/controllers/device_finder.h"
#include "ui/controllers/haptics_settings.h"
#include "ui/text/recording_report.h"

#include <QObject>
#include <QString>
#include <QTimer>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace marsview {

class TerrainView;

enum class HapticsConnection { None, Opening, Connected };

/// Connects one device at a time and maps its workspace to the visible terrain. A device that pans,
/// zooms or turns the map moves the view's camera. The servo loop runs while a device is connected
/// and a map is shown. GUI thread, which waits for a device only during its force ramp-down, some
/// milliseconds; must not outlive the view.
class HapticsController final : public QObject {
    Q_OBJECT

public:
    HapticsController(TerrainView& view, DriverMaker make_drivers, QObject* parent = nullptr);
    /// Emits no signals.
    ~HapticsController() override;

    // Devices.

    /// The devices found last, usable ones first, without those only for the command line; see
    /// devicesChanged().
    const std::vector<FoundDevice>& devices() const noexcept { return devices_; }
    void findDevices();
    bool isFinding() const noexcept { return finder_->isFinding(); }
    /// Searches for devices every few seconds while none is connected, and reconnects to one that
    /// was lost and is found again.
    void setLooking(bool is_looking);
    /// `paths` returns the files of all open maps, shown or not; recordings never overwrite them.
    void setMapsInUse(std::function<std::vector<std::string>()> paths)
    {
        maps_in_use_ = std::move(paths);
    }

    /// Replaces the current connection. If that is a device and `uri` a recording, the device is
    /// connected again when the recording has ended.
    void connectTo(const QString& uri);
    /// Connects to the device of the settings. If it is missing, no notice appears; it is connected
    /// when it is found.
    void connectToRemembered();
    /// Instead of connectToRemembered(): reports that the program ended unexpectedly while that
    /// device was connected.
    void holdBackRemembered();
    /// Also removes the device from the settings, unless a recording is replayed.
    void disconnectDevice();
    /// The same, but it is connected again at the next start.
    void close();
    HapticsConnection connection() const noexcept { return connection_; }
    /// Whether a recording is connected in place of a device.
    bool isReplaying() const;
    /// How much of it has been played back, 0 to 1.
    double replayedShare() const { return loop_ ? loop_->playedShare() : 0.0; }
    /// Ends the replay. The device that it replaced is connected again, and the camera returns as
    /// at the end of the recording. Does nothing unless isReplaying().
    void stopReplay();
    /// Whether the device is calibrated by setting its home position.
    bool canBeSetAtRest() const;
    /// Reconnects the device and takes its current position as the home position. The user must
    /// have placed it there.
    void setAtRest();
    /// The recording that was replayed to its end last, until something else is connected than the
    /// device whose place it took; empty for none.
    QString replayedToItsEnd() const;
    /// Starts that replay again.
    void replayAgain();
    /// Of the device that is connected or being opened.
    const QString& uri() const noexcept { return uri_; }
    /// Null unless connected.
    const ServoLoop* loop() const noexcept { return loop_.get(); }
    /// Why the last device or recording was refused or disconnected, or why a replayed recording
    /// does not match the maps. Sentences for people; empty without a problem.
    const QString& problem() const noexcept { return problem_; }
    /// The same, but empty if only the panel should show it.
    QString notice() const { return is_quiet_ ? QString() : problem_; }

    // Forces.

    const HapticsSettings& settings() const noexcept { return settings_; }
    /// Takes effect with the next tick. The device in it is only remembered, see connectTo().
    void setSettings(const HapticsSettings& settings);
    /// The largest stiffness that the connected device renders; kStiffnessMax without a device.
    double stiffnessMax() const;
    void setContactModel(ContactModelKind kind);

    /// Disables the force from the next tick until called with false; also for devices connected
    /// later.
    void setStopped(bool is_stopped);
    /// Whether a device is connected, is being opened, or will be connected when it is found.
    bool canBeStopped() const noexcept
    {
        return connection_ != HapticsConnection::None || !wanted_uri_.isEmpty();
    }
    bool isStopped() const noexcept { return is_stopped_; }

    // Recording.

    /// Records from now on, also in the middle of a touch, until the map, its exaggeration or the
    /// contact model changes, or the device is disconnected. Needs a running loop;
    /// recordingFailed() follows if the recording cannot begin. The file begins with the first
    /// update of a new contact model, so that `trace --goals` reproduces the proxies bit for bit;
    /// the force is continuous.
    Status startRecording(const QString& file);
    void stopRecording(RecordingEnd end = RecordingEnd::AsWanted);
    bool isRecording() const noexcept { return recorder_ != nullptr; }
    const QString& recordingFile() const noexcept { return recording_file_; }
    bool canRecord() const noexcept { return loop_ != nullptr && loop_->isRunning(); }

    // The diagnostic log of the last seconds.

    /// Whether lastTicks() has any, or will in a moment.
    bool hasTicks() const;
    /// About the last ten seconds of the device that is, or was, connected. After a reconnection
    /// they follow those of the earlier connection. Takes 1 to 2 ms.
    std::vector<TickRecord> lastTicks() const;
    /// On another thread; ticksSaved() or savingFailed() follows.
    void saveTicks(std::vector<TickRecord> ticks, const QString& file);
    /// Whether the last device went without being asked to.
    bool isLost() const noexcept { return is_lost_; }

Q_SIGNALS:
    void devicesChanged();
    /// connection(), problem() or stiffnessMax().
    void connectionChanged();
    void settingsChanged();
    void stoppedChanged(bool is_stopped);
    /// isRecording(), canRecord().
    void recordingChanged();
    /// "FILE: WHY" of what could not be written.
    void recordingFailed(const QString& problem);
    /// A recording of so many updates is complete.
    void recorded(const QString& file, qulonglong updates, marsview::RecordingEnd end);
    void ticksSaved(const SavedTicks& saved);
    /// "FILE: WHY".
    void savingFailed(const QString& problem);
    /// A recording was replayed to its end.
    void replayEnded(const QString& file);
    /// Some sixty times a second while the loop runs.
    void polled(const LoopState& state);

protected:
    /// Hears the keys of the emergency stop wherever they are pressed.
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void start(std::unique_ptr<HapticDevice> device);
    void takeDevices(const std::vector<FoundDevice>& devices);
    void poll();
    void finishLost(const LoopState& state);
    void resumeInterrupted(const QString& problem);
    void keepTicks();
    void setProblem(const QString& problem);

    Status checkWritable(const QString& file) const;

    void takeGround();
    void takeExaggeration();
    void chooseMap(const LoopState& state);
    void checkReplay();
    void tellReplay();
    void setMap(std::size_t index);
    void makeMapAgain();
    void takeSight();
    void takeBounds();
    void takeFit(const LoopState& state);
    void takeStrokes();
    void followHand(const LoopState& state);
    void showHand(const LoopState& state);
    void keepReplayInPicture(const LoopState& state);
    void returnCamera();
    void push();

    TerrainView& view_;
    std::function<std::vector<std::string>()> maps_in_use_;
    DeviceFinder* finder_ = nullptr;
    std::vector<FoundDevice> devices_;
    QTimer look_timer_; // runs only while no device is connected and is_looking_
    bool is_looking_ = false;
    QString wanted_uri_;                  // of a device that was lost
    QString interrupted_uri_;             // of one that a recording has taken the place of
    bool is_coming_back_ = false;         // that one is being connected again
    QString replay_uri_;                  // of the recording that was replayed to its end
    std::optional<ReplayFit> replay_fit_; // of the recording that is replayed, once it is known
    int replay_check_ = 0;                // which of the checks counts
    bool was_wanted_gone_ = false;

    HapticsConnection connection_ = HapticsConnection::None;
    QString uri_;
    QString problem_;
    bool is_quiet_ = false; // the device is connected automatically, not by the user
    HapticsSettings settings_;
    ContactModelKind model_ = kContactModelDefault;
    bool is_stopped_ = false;
    bool is_grabbing_ = false; // by a key

    double exaggeration_ = 1.0;
    std::unique_ptr<TouchMap> hand_map_; // null without a map in the picture
    LoopSettings loop_settings_;
    // Of a replay that has moved the camera: where the camera was, and where the replay sent it.
    struct Excursion {
        OrbitCamera before;
        OrbitCamera sent_to;
    };
    std::optional<Excursion> excursion_;
    HandView hand_view_;     // that loop_settings_.frame_number is of
    bool is_fitted_ = false; // loop_settings_.fit is that of hand_view_
    bool is_following_ = false;

    std::vector<TickRecord> kept_ticks_; // of the last loop
    bool is_lost_ = false;

    QTimer poll_timer_; // runs only while the loop does
    std::unique_ptr<ServoLoop> loop_;
    std::unique_ptr<SessionRecorder> recorder_; // before the loop ends
    QString recording_file_;
    DetachedJobs jobs_;
};

} // namespace marsview
