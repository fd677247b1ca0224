// Haptic devices in the window: the only bridge between them, the servo loop, and the view.
#pragma once

#include "haptics/interaction/hand_view.h"
#include "haptics/loop/servo_loop.h"
#include "haptics/trace/replay_check.h"
#include "haptics/trace/session_recorder.h"
#include "ui/controllers/detached_jobs.h"
#include "ui/controllers/device_finder.h"
#include "ui/controllers/hand_map.h"
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

/// Connects one device at a time and lets it touch what the view shows: the device reaches what is
/// in sight, and a hand that pulls, zooms or turns the map moves the view's camera. The servo loop
/// runs while a device is connected and a map is shown. Lives in the GUI thread, which waits for a
/// device only while its force fades out, some milliseconds; must not outlive the view.
class HapticsController final : public QObject {
    Q_OBJECT

public:
    HapticsController(TerrainView& view, DriverMaker make_drivers, QObject* parent = nullptr);
    /// Without a word: nothing is told any more.
    ~HapticsController() override;

    // Devices.

    /// What was found last, usable ones first, without what has no place in a window; see
    /// devicesChanged().
    const std::vector<FoundDevice>& devices() const noexcept { return devices_; }
    void findDevices();
    bool isFinding() const noexcept { return finder_->isFinding(); }
    /// Looks for devices every few seconds while nothing is connected, and connects anew to one
    /// that was lost and is there again.
    void setLooking(bool is_looking);
    /// Tells the files of all maps that are open, shown or not: nothing is recorded over them.
    void setMapsInUse(std::function<std::vector<std::string>()> paths)
    {
        maps_in_use_ = std::move(paths);
    }

    /// In place of what is connected. Where that is a device and `uri` a recording, the device is
    /// connected again when the recording has ended.
    void connectTo(const QString& uri);
    /// The device of the settings. Where it is not there nobody is bothered; it is connected when
    /// it is found.
    void connectToRemembered();
    /// Instead: tells that the program ended unexpectedly while it was connected.
    void holdBackRemembered();
    /// And forgets it; the end of a recording that is replayed makes no device forgotten.
    void disconnectDevice();
    /// The same, but it is connected again at the next start.
    void close();
    HapticsConnection connection() const noexcept { return connection_; }
    /// Whether a recording is connected in place of a device.
    bool isReplaying() const;
    /// How much of it has been played back, 0 to 1.
    double replayedShare() const { return loop_ ? loop_->playedShare() : 0.0; }
    /// Ends the replay. The device whose place it took is connected again, and the camera returns
    /// as at the recording's own end. Does nothing unless isReplaying().
    void stopReplay();
    /// Whether it is an arm that can be told where it is.
    bool canBeSetAtRest() const;
    /// Connects it anew: it is in its rest position now. Somebody stands beside it and sees that.
    void setAtRest();
    /// The recording that was replayed to its end last, until something else is connected than the
    /// device whose place it took; empty for none.
    QString replayedToItsEnd() const;
    /// Starts that replay again.
    void replayAgain();
    /// Of what is connected or being opened.
    const QString& uri() const noexcept { return uri_; }
    /// Nothing unless connected.
    const ServoLoop* loop() const noexcept { return loop_.get(); }
    /// Why the last device or recording was refused, or is no longer connected, or what does not
    /// suit a recording that is replayed; empty where all is well. Sentences for people.
    const QString& problem() const noexcept { return problem_; }
    /// The same, but empty where it can wait until somebody looks for it.
    QString notice() const { return is_quiet_ ? QString() : problem_; }

    // What is felt.

    const HapticsSettings& settings() const noexcept { return settings_; }
    /// Takes effect with the next tick. The device in it is only remembered, see connectTo().
    void setSettings(const HapticsSettings& settings);
    /// What the device that is connected stands; kStiffnessMax where there is none.
    double stiffnessMax() const;
    void setContactModel(ContactModelKind kind);

    /// Lets go of everything with the next tick, until it is taken back; also for devices that are
    /// connected later.
    void setStopped(bool is_stopped);
    /// Whether there is something to be stopped: a device that is connected, is being opened, or
    /// will be as soon as it is there.
    bool canBeStopped() const noexcept
    {
        return connection_ != HapticsConnection::None || !wanted_uri_.isEmpty();
    }
    bool isStopped() const noexcept { return is_stopped_; }

    // Recording.

    /// Of what is touched from now on, also in the middle of a touch, until the map, its
    /// exaggeration or the contact model is another, or the device is disconnected. Needs a loop
    /// that runs; recordingFailed() follows where it cannot begin. The file begins with the first
    /// update of a contact model of its own, so that `trace --goals` gives the same proxies to the
    /// bit; the hand feels nothing of the change.
    Status startRecording(const QString& file);
    void stopRecording(RecordingEnd end = RecordingEnd::AsWanted);
    bool isRecording() const noexcept { return recorder_ != nullptr; }
    const QString& recordingFile() const noexcept { return recording_file_; }
    bool canRecord() const noexcept { return loop_ != nullptr && loop_->isRunning(); }

    // The last seconds, whatever happened in them.

    /// Whether lastTicks() has any, or will in a moment.
    bool hasTicks() const;
    /// The last ten seconds or so of the device that is connected, or else was; where it was lost
    /// and came back, after those of before. Takes a millisecond or two.
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
    QTimer look_timer_; // runs only while nothing is connected and somebody looks
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
    bool is_quiet_ = false; // nobody has asked for the device this time
    HapticsSettings settings_;
    ContactModelKind model_ = kContactModelDefault;
    bool is_stopped_ = false;
    bool is_grabbing_ = false; // by a key

    double exaggeration_ = 1.0;
    std::unique_ptr<HandMap> hand_map_; // null where nothing is shown
    LoopSettings loop_settings_;
    // Of a replay that has moved the camera: where the camera was, and where the replay sent it.
    struct Excursion {
        OrbitCamera before;
        OrbitCamera sent_to;
    };
    std::optional<Excursion> excursion_;
    HandView hand_view_; // that loop_settings_.frame_number is of
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
