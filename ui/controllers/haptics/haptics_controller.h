// Haptic devices in the window: the only bridge between them, the servo loop, and the view.
#pragma once

#include "haptics/trace/replay_check.h"
#include "ui/controllers/detached_jobs.h"
#include "ui/controllers/hand_scene.h"
#include "ui/controllers/haptics/device_session.h"
#include "ui/controllers/haptics/touch_recorder.h"
#include "ui/controllers/haptics_settings.h"

#include <QObject>
#include <QString>

#include <cstddef>
#include <optional>

namespace marsview {

class TerrainView;

/// Lets a connected device touch the visible terrain: maps its workspace to it, and passes settings
/// and ground to the loop. A device that pans, zooms or turns the map moves the camera. The scene
/// is that of the view, the flat map, unless another one is set. GUI thread; must not outlive them.
class HapticsController final : public QObject {
    Q_OBJECT

public:
    HapticsController(TerrainView& view, DriverMaker make_drivers, QObject* parent = nullptr);
    /// Emits no signals.
    ~HapticsController() override;

    DeviceSession& device() noexcept { return *device_; }
    const DeviceSession& device() const noexcept { return *device_; }

    /// A recording ends with its map or with the connection.
    TouchRecorder& recorder() noexcept { return *recorder_; }

    /// Touches another scene from now on, or the flat map again if null: the force fades out, and a
    /// recording or a replay ends.
    void touchOn(HandScene* scene);
    HandScene& scene() const noexcept { return *scene_; }
    /// Replays a recording of the scene in place of the device.
    void replay(const QString& file);
    /// Why the hand has nothing to touch where it is; empty if it has, or if no map is open.
    QString whyNoTouch() const;
    /// Why the hand changes from layer to layer where they lie on top of each other; empty where
    /// they are one surface.
    QString whyApart() const;

    // Forces.

    const HapticsSettings& settings() const noexcept { return settings_; }
    /// Takes effect with the next tick. The device in it is only remembered, see
    /// DeviceSession::connectTo().
    void setSettings(const HapticsSettings& settings);
    /// The largest stiffness that the connected device renders; kStiffnessMax without a device.
    double stiffnessMax() const;
    void setContactModel(ContactModelKind kind);

    /// Disables the force from the next tick until called with false; also for devices connected
    /// later.
    void setStopped(bool is_stopped);
    bool isStopped() const noexcept { return is_stopped_; }

Q_SIGNALS:
    void sceneChanged();
    void settingsChanged();
    void stoppedChanged(bool is_stopped);

protected:
    /// Hears the keys of the emergency stop wherever they are pressed.
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void begin();
    void end();
    void releaseMap();
    void forget();
    void follow(const LoopState& state);

    void connectScene();
    void takeGround();
    void takeExaggeration();
    void chooseMap(const LoopState& state);
    std::optional<std::size_t> mapBelowHand() const;
    void setCovered(bool is_covered);
    void checkReplay();
    void reportReplay();
    QString otherSceneText(const QString& file) const;
    void takeMap(std::size_t index);
    void makeMapAgain();
    void followSight();
    void takeSight();
    void takeStrokes();
    void followHand(const LoopState& state);
    void showHand(const LoopState& state);
    void keepReplayInPicture(const LoopState& state);
    void returnCamera();
    void push();
    const WorkspaceBox& workspace() const { return device_->loop()->device().workspace; }

    HandScene* flat_scene_; // of the view
    HandScene* scene_;      // that is touched
    DeviceSession* device_;
    TouchRecorder* recorder_;
    std::optional<ReplayFit> replay_fit_; // of the recording that is replayed, once it is known
    int replay_check_ = 0;                // which of the checks counts

    HapticsSettings settings_;
    ContactModelKind model_ = kContactModelDefault;
    bool is_stopped_ = false;
    bool is_grabbing_ = false; // by a key

    double exaggeration_ = 1.0;
    // Of a replay that has moved the camera: where the camera was, and where the replay sent it.
    struct Excursion {
        SceneCamera before;
        SceneCamera sent_to;
    };
    std::optional<Excursion> excursion_;
    bool is_following_ = false;

    DetachedJobs jobs_;
};

} // namespace marsview
