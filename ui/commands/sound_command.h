// Switching the sound of contact on and off.
#pragma once

#include "haptics/sound/sound_player.h"

#include <QObject>

#include <functional>

class QAction;

namespace marsview {

class ContactSounds;
class HapticsController;
class WindowMessages;

/// A sound that failed is off at the next start too. A failure is reported only to a user who has
/// just switched the sound on. GUI thread; must not outlive its parts.
class SoundCommand final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        QAction& action; // checkable
        HapticsController& haptics;
        WindowMessages& messages;
        std::function<Result<SoundPlayer>()> open_sound;
        bool is_remembered = false; // for later windows
    };

    explicit SoundCommand(const Parts& parts);

private:
    void remember(bool is_on) const;

    Parts parts_;
    ContactSounds* sounds_ = nullptr;
    bool is_on_by_settings_ = false; // not by the user
};

} // namespace marsview
