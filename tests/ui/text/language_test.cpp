#include "ui/text/coordinate_text.h"
#include "ui/text/language.h"

#include <QCoreApplication>
#include <QLocale>
#include <QTranslator>

#include <gtest/gtest.h>

namespace marsview {
namespace {

class LanguageTest : public testing::Test {
protected:
    void SetUp() override
    {
        if (languages().size() == 1) {
            GTEST_SKIP() << "built without Qt's LinguistTools";
        }
    }
};

TEST_F(LanguageTest, IsThePreferredOneIfThereIsSuch)
{
    EXPECT_EQ(languageFor(QStringLiteral("de")), QStringLiteral("de"));
    EXPECT_EQ(languageFor(QStringLiteral("de-AT")), QStringLiteral("de"));
    EXPECT_EQ(languageFor(QStringLiteral("en")), QStringLiteral("en"));
    // Otherwise one that the system asks for, or English.
    const QString other = languageFor(QStringLiteral("tlh"));
    EXPECT_EQ(other, languageFor(QString()));
    EXPECT_TRUE(other == QStringLiteral("en") || other == QStringLiteral("de"));
}

TEST_F(LanguageTest, TranslatesTextsAndPluralsWhileItIsInstalled)
{
    const auto title = [] {
        return QCoreApplication::translate("marsview::PreferencesDialog", "Preferences");
    };
    const auto maps = [](int count) {
        return QCoreApplication::translate("marsview::LargeMapsPage", "%n maps, %1", nullptr,
                                           count);
    };
    EXPECT_EQ(title(), QStringLiteral("Preferences"));
    {
        const auto german = translateTo(QStringLiteral("de"));
        EXPECT_EQ(title(), QStringLiteral("Einstellungen"));
        EXPECT_EQ(maps(1), QStringLiteral("1 Karte, %1"));
        EXPECT_EQ(maps(2), QStringLiteral("2 Karten, %1"));
    }
    EXPECT_EQ(title(), QStringLiteral("Preferences"));
}

TEST_F(LanguageTest, WritesNumbersAsInTheLanguageUnlessTheRegionDoes)
{
    const QLocale before;
    QLocale::setDefault(QLocale::c());
    useNumbersOf(QStringLiteral("de"));
    EXPECT_EQ(QLocale().toString(1234.5, 'f', 1), QStringLiteral("1.234,5"));
    QLocale::setDefault(QLocale(QLocale::German, QLocale::Switzerland));
    useNumbersOf(QStringLiteral("de"));
    EXPECT_EQ(QLocale().territory(), QLocale::Switzerland);
    QLocale::setDefault(before);
}

TEST_F(LanguageTest, ReadsTheLettersOfDirectionsThatItWrites)
{
    const QString german = QStringLiteral("18,65 N 226,2 O");
    EXPECT_EQ(withPlainDirections(german), german);
    const auto translator = translateTo(QStringLiteral("de"));
    EXPECT_EQ(withPlainDirections(german), QStringLiteral("18,65 N 226,2 E"));
    EXPECT_EQ(withPlainDirections(QStringLiteral("18° 39′ s, 226°o")),
              QStringLiteral("18° 39′ s, 226°E"));
    EXPECT_EQ(withPlainDirections(QStringLiteral("Olympus")), QStringLiteral("Olympus"));
}

} // namespace
} // namespace marsview
