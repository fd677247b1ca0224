#include "ui/commands/sound_command.h"

#include "ui/controllers/contact_sounds.h"
#include "ui/controllers/haptics/haptics_controller.h"
#include "ui/text/sentence.h"
#include "ui/window/window_messages.h"

#include <QAction>
#include <QSettings>

namespace marsview {
namespace {

QString soundKey()
{
    return QStringLiteral("haptics/sound");
}

} // namespace

SoundCommand::SoundCommand(const Parts& parts)
    : parts_(parts)
    , sounds_(new ContactSounds(parts.haptics.scene(), parts.open_sound, this))
    , is_on_by_settings_(parts.is_remembered && QSettings().value(soundKey(), false).toBool())
{
    connect(&parts_.action, &QAction::triggered, this, [this](bool is_on) {
        is_on_by_settings_ = false;
        sounds_->setOn(is_on);
        if (!is_on) {
            remember(false);
        }
    });
    connect(&parts_.haptics, &HapticsController::sceneChanged, this,
            [this] { sounds_->setScene(parts_.haptics.scene()); });
    connect(sounds_, &ContactSounds::opened, this, [this] { remember(true); });
    connect(sounds_, &ContactSounds::failed, this, [this](const QString& why) {
        remember(false);
        if (!is_on_by_settings_) {
            parts_.messages.report(tr("Cannot Play Sound"), asSentence(why));
        }
        is_on_by_settings_ = false;
    });
    connect(sounds_, &ContactSounds::onChanged, &parts_.action, &QAction::setChecked);
    sounds_->setOn(is_on_by_settings_);
}

void SoundCommand::remember(bool is_on) const
{
    if (parts_.is_remembered) {
        QSettings().setValue(soundKey(), is_on);
    }
}

} // namespace marsview
