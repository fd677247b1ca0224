#include "ui/dialogs/preferences_dialog.h"

#include "ui/text/language.h"
#include "ui/text/number_text.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QGroupBox>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QTabWidget>
#include <QVBoxLayout>

#include <algorithm>

namespace marsview {

PreferencesDialog::PreferencesDialog(const Preferences& preferences,
                                     const LargeMapDefaults& standard,
                                     QWidget* parent)
    : QDialog(parent)
    , before_(preferences)
    , language_(new QComboBox(this))
    , restart_note_(new QLabel(tr("Takes effect when MarsView is started again"), this))
    , theme_(new QComboBox(this))
    , height_unit_(new QComboBox(this))
    , frame_rate_(new QComboBox(this))
    , antialiasing_(new QCheckBox(tr("&Anti-aliasing"), this))
    , coordinates_(new CoordinatesPage(this))
    , large_maps_(new LargeMapsPage(standard, this))
    , pages_(new QTabWidget(this))
{
    setWindowTitle(tr("Preferences"));
    //: A language: that of the desktop
    language_->addItem(tr("Follow system", "language"), QString());
    for (const Language& language : languages()) {
        language_->addItem(language.name, language.code);
    }
    language_->setAccessibleName(tr("Language"));
    language_->setObjectName(QStringLiteral("language"));
    language_->setToolTip(restart_note_->text());
    restart_note_->setObjectName(QStringLiteral("restartNote"));
    //: A theme: as light or dark as the desktop
    theme_->addItem(tr("Follow system"), static_cast<int>(Theme::System));
    theme_->addItem(tr("Light"), static_cast<int>(Theme::Light));
    theme_->addItem(tr("Dark"), static_cast<int>(Theme::Dark));
    theme_->setAccessibleName(tr("Theme"));
    theme_->setObjectName(QStringLiteral("theme"));
    height_unit_->setObjectName(QStringLiteral("elevationUnit"));
    height_unit_->addItem(tr("Meters"), static_cast<int>(HeightUnit::Meters));
    height_unit_->addItem(tr("Feet"), static_cast<int>(HeightUnit::Feet));
    height_unit_->setAccessibleName(tr("Elevation unit"));
    for (const int rate : {20, 30, 60}) {
        //: Frames per second
        frame_rate_->addItem(leftToRight(tr("%n fps", nullptr, rate)), rate);
    }
    frame_rate_->setAccessibleName(tr("Frame rate while moving"));
    frame_rate_->setToolTip(
        tr("A higher rate makes motion smoother and the terrain coarser while it moves"));
    antialiasing_->setAccessibleName(tr("Anti-aliasing"));
    antialiasing_->setToolTip(tr("Smooth edges when the picture is at rest"));

    auto* general = new QWidget(this);
    auto* groups = new QVBoxLayout(general);
    const auto add_group = [general, groups](const QString& title) {
        auto* group = new QGroupBox(title, general);
        groups->addWidget(group);
        return new QFormLayout(group);
    };
    //: A group of the preferences
    QFormLayout* appearance = add_group(tr("Appearance"));
    appearance->addRow(tr("&Language"), language_);
    appearance->addRow(QString(), restart_note_);
    appearance->addRow(tr("&Theme"), theme_);
    appearance->addRow(tr("&Elevation unit"), height_unit_);
    //: A group of the preferences: the picture of the terrain
    QFormLayout* picture = add_group(tr("Map view"));
    picture->addRow(tr("&Frame rate while moving"), frame_rate_);
    picture->addRow(QString(), antialiasing_);
    //: A group of the preferences
    QFormLayout* haptics = add_group(tr("Haptics"));
    reconnects_ = new QCheckBox(tr("Connect the last &device at the start"), this);
    reconnects_->setObjectName(QStringLiteral("reconnectsDevice"));
    reconnects_->setToolTip(
        tr("The device that was connected when MarsView was closed. The "
           "simulated hand is never connected by itself"));
    haptics->addRow(QString(), reconnects_);
    //: A group of the preferences
    QFormLayout* memory = add_group(tr("Memory"));
    memory->addRow(tr("Tiles of &large maps"), large_maps_->memoryField());
    groups->addStretch(1);
    auto* buttons =
        new QDialogButtonBox(QDialogButtonBox::Close | QDialogButtonBox::RestoreDefaults, this);
    // Qt's own German text is the name of preferences.
    buttons->button(QDialogButtonBox::RestoreDefaults)->setText(tr("Restore &Defaults"));
    // The Enter key must not discard the user's choices.
    buttons->button(QDialogButtonBox::RestoreDefaults)->setAutoDefault(false);
    buttons->button(QDialogButtonBox::Close)->setDefault(true);
    pages_->setFocusPolicy(Qt::NoFocus); // its tabs have the focus
    pages_->setAccessibleName(tr("Pages of the preferences"));
    //: A page of the preferences
    pages_->addTab(general, tr("&General"));
    //: A page of the preferences
    pages_->addTab(coordinates_, tr("&Coordinates"));
    //: A page of the preferences: files that are kept on disk
    pages_->addTab(large_maps_, tr("&Storage"));
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(pages_);
    layout->addWidget(buttons);
    fill(preferences);
    restart_note_->hide();
    connect(language_, &QComboBox::currentIndexChanged, this,
            [this, first = language_->currentIndex()](int chosen) {
                restart_note_->setVisible(chosen != first);
            });

    const auto notify = [this] { Q_EMIT preferencesChanged(this->preferences()); };
    for (QComboBox* box : {language_, theme_, height_unit_, frame_rate_}) {
        connect(box, &QComboBox::currentIndexChanged, this, notify);
    }
    connect(antialiasing_, &QCheckBox::toggled, this, notify);
    connect(reconnects_, &QCheckBox::toggled, this, notify);
    connect(coordinates_, &CoordinatesPage::changed, this, notify);
    connect(large_maps_, &LargeMapsPage::changed, this, notify);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(buttons->button(QDialogButtonBox::RestoreDefaults), &QPushButton::clicked, this,
            [this, notify] {
                fill(Preferences{});
                notify(); // a change of only the folder emits no signal
            });
}

void PreferencesDialog::fill(const Preferences& preferences)
{
    language_->setCurrentIndex(std::max(0, language_->findData(preferences.language)));
    theme_->setCurrentIndex(theme_->findData(static_cast<int>(preferences.theme)));
    height_unit_->setCurrentIndex(
        height_unit_->findData(static_cast<int>(preferences.height_unit)));
    frame_rate_->setCurrentIndex(frame_rate_->findData(preferences.frames_per_s));
    antialiasing_->setChecked(preferences.has_antialiasing);
    reconnects_->setChecked(preferences.reconnects_device);
    coordinates_->fill(preferences.coordinates);
    large_maps_->fill(preferences);
}

Preferences PreferencesDialog::preferences() const
{
    Preferences preferences = before_;
    preferences.language = language_->currentData().toString();
    preferences.theme = static_cast<Theme>(theme_->currentData().toInt());
    preferences.height_unit = static_cast<HeightUnit>(height_unit_->currentData().toInt());
    preferences.has_antialiasing = antialiasing_->isChecked();
    preferences.reconnects_device = reconnects_->isChecked();
    preferences.frames_per_s = frame_rate_->currentData().toInt();
    preferences.coordinates = coordinates_->format();
    large_maps_->apply(preferences);
    return preferences;
}

} // namespace marsview
