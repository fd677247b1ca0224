#include "tests/ui/color_contrast.h"
#include "tests/ui/test_map.h"
#include "ui/controllers/preferences.h"
#include "ui/dialogs/preferences_dialog.h"
#include "ui/window/theme.h"

#include <QAbstractButton>
#include <QApplication>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QLabel>
#include <QSettings>
#include <QTemporaryDir>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

TEST(Theme, KeepsEveryTextReadable)
{
    using P = QPalette;
    for (const P& palette : {lightPalette(), darkPalette()}) {
        for (const auto& [text, ground] : {std::pair{P::WindowText, P::Window},
                                           {P::Text, P::Base},
                                           {P::Text, P::AlternateBase},
                                           {P::ButtonText, P::Button},
                                           {P::HighlightedText, P::Highlight},
                                           {P::ToolTipText, P::ToolTipBase},
                                           {P::Link, P::Base},
                                           {P::PlaceholderText, P::Base},
                                           {P::PlaceholderText, P::Window}}) {
            EXPECT_GE(contrast(palette.color(P::Active, text), palette.color(P::Active, ground)),
                      4.0)
                << text << " on " << ground;
        }
        for (const auto& [text, ground] : {std::pair{P::WindowText, P::Window},
                                           {P::Text, P::Base},
                                           {P::ButtonText, P::Button}}) {
            EXPECT_GE(
                contrast(palette.color(P::Disabled, text), palette.color(P::Disabled, ground)), 3.0)
                << "disabled " << text << " on " << ground;
            // Still distinguishable from enabled text.
            EXPECT_GE(contrast(palette.color(P::Disabled, text), palette.color(P::Active, text)),
                      1.8);
        }
        // The focus frame against its background.
        EXPECT_GE(contrast(palette.color(P::Highlight), palette.color(P::Window)), 3.0);
    }
}

TEST(Theme, IsDarkIfNamedSo)
{
    applyTheme(Theme::Dark);
    EXPECT_LT(luminance(QApplication::palette().color(QPalette::Window)), 0.1);
    applyTheme(Theme::Light);
    EXPECT_GT(luminance(QApplication::palette().color(QPalette::Window)), 0.7);
    applyTheme(Theme::System);
}

// The icons of other styles are dark on dark.
TEST(Theme, ComesBeforeTheDialogsOfTheWindow)
{
    QApplication::setStyle(QStringLiteral("Fusion")); // as at the program's start
    const MainWindow window(testWindowOptions());
    const QList<QDialogButtonBox*> boxes = window.findChildren<QDialogButtonBox*>();
    EXPECT_FALSE(boxes.isEmpty());
    for (const QDialogButtonBox* box : boxes) {
        for (const QAbstractButton* button : box->buttons()) {
            EXPECT_TRUE(button->icon().isNull()) << button->text().toStdString();
        }
    }
}

TEST(Preferences, ComeBackAsTheyWereSaved)
{
    const QTemporaryDir folder;
    QSettings settings(folder.filePath(QStringLiteral("s.ini")), QSettings::IniFormat);
    EXPECT_EQ(preferencesFrom(settings), Preferences{});
    for (const Theme theme : {Theme::System, Theme::Light, Theme::Dark}) {
        for (const int rate : {20, 30, 60}) {
            const Preferences preferences{.theme = theme,
                                          .height_unit = HeightUnit::Feet,
                                          .has_antialiasing = rate == 20,
                                          .frames_per_s = rate,
                                          .contact_model = ContactModelKind::VirtualProxy};
            save(preferences, settings);
            settings.sync();
            const QSettings again(settings.fileName(), QSettings::IniFormat);
            EXPECT_EQ(preferencesFrom(again), preferences);
        }
    }
}

TEST(Preferences, AreTheDefaultsIfTheFileIsInvalid)
{
    const QTemporaryDir folder;
    QSettings settings(folder.filePath(QStringLiteral("s.ini")), QSettings::IniFormat);
    settings.setValue(QStringLiteral("preferences/theme"), QStringLiteral("plaid"));
    settings.setValue(QStringLiteral("preferences/framesPerSecond"), -3);
    settings.setValue(QStringLiteral("preferences/contactModel"), QStringLiteral("telepathy"));
    EXPECT_EQ(preferencesFrom(settings), Preferences{});
}

TEST(Preferences, SayThatAnotherLanguageComesWithTheNextStart)
{
    PreferencesDialog dialog({}, {}, nullptr);
    dialog.show();
    auto* language = dialog.findChild<QComboBox*>(QStringLiteral("language"));
    const auto* note = dialog.findChild<QLabel*>(QStringLiteral("restartNote"));
    ASSERT_TRUE(language != nullptr && note != nullptr);
    EXPECT_FALSE(note->isVisible());
    const int first = language->currentIndex();
    language->setCurrentIndex(first + 1);
    EXPECT_TRUE(note->isVisible());
    language->setCurrentIndex(first);
    EXPECT_FALSE(note->isVisible());
}

} // namespace
} // namespace marsview
