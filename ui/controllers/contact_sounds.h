// The sound of what the stylus in the view touches, a device's or the mouse's.
#pragma once

#include "haptics/sound/contact_listener.h"
#include "haptics/sound/sound_player.h"

#include <QObject>
#include <QString>
#include <QTimer>

#include <functional>
#include <memory>
#include <optional>

namespace marsview {

class HandScene;

/// Off until it is switched on. Plays from the GUI thread's timer, which runs only while something
/// is touched or fades out; the output is opened on a separate thread. Must not outlive the scene.
class ContactSounds final : public QObject {
    Q_OBJECT

public:
    /// Opens an output; any thread.
    using OpenPlayer = std::function<Result<SoundPlayer>()>;

    explicit ContactSounds(HandScene& scene,
                           OpenPlayer open = &SoundPlayer::open,
                           QObject* parent = nullptr);
    ~ContactSounds() override;

    /// Another scene is shown.
    void setScene(HandScene& scene);
    void setOn(bool is_on);
    bool isOn() const noexcept { return is_on_; }
    /// The output is open.
    bool isReady() const noexcept { return player_.has_value(); }
    /// The last sound requested.
    const SoundState& sound() const noexcept { return sound_; }
    /// Null until it is open: for tests with an output into memory.
    SoundPlayer* player() noexcept { return player_ ? &*player_ : nullptr; }

Q_SIGNALS:
    void onChanged(bool is_on);
    /// The output is open.
    void opened();
    /// No output is available; `why` is a sentence. Sound is off again.
    void failed(const QString& why);

private:
    struct Opening;

    void connectScene();
    void open();
    void take(Result<SoundPlayer> player);
    void listenAnew();
    void takeSight();
    void play();
    ContactMoment moment() const;

    HandScene* scene_;
    OpenPlayer open_;
    std::shared_ptr<Opening> opening_; // what the opening thread knows of this object
    bool is_on_ = false;
    std::optional<SoundPlayer> player_;
    std::optional<ContactListener> listener_;
    WorkspaceFrame frame_; // of a hand that reaches all that is seen
    SoundState sound_;
    QTimer timer_;
};

} // namespace marsview
