#include "ui/dialogs/guide_window.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QLineEdit>
#include <QListWidget>
#include <QRegularExpression>
#include <QTest>
#include <QTextBrowser>

#include <gtest/gtest.h>

namespace marsview {
namespace {

TEST(GuideWindowTest, ShowsThePagesInTheOrderOfTheContents)
{
    const QVector<GuidePage> pages = guidePagesIn(guideFolder());
    ASSERT_GE(pages.size(), 7);
    EXPECT_EQ(pages.front().file, QStringLiteral("first-ten-minutes.md"));
    EXPECT_EQ(pages.back().file, QStringLiteral("troubleshooting.md"));
    for (const GuidePage& page : pages) {
        EXPECT_FALSE(page.title.isEmpty()) << page.file.toStdString();
    }
}

TEST(GuideWindowTest, TheContentsListEveryPage)
{
    QStringList files{QStringLiteral("README.md")};
    for (const GuidePage& page : guidePagesIn(guideFolder())) {
        files.append(page.file);
    }
    files.sort();
    EXPECT_EQ(files,
              QDir(guideFolder()).entryList({QStringLiteral("*.md")}, QDir::Files, QDir::Name));
}

TEST(GuideWindowTest, EveryLinkOfTheGuideLeadsToAPage)
{
    const QRegularExpression link(QStringLiteral(R"(\]\(([^)#]+)(#[^)]*)?\))"));
    for (const GuidePage& page : guidePagesIn(guideFolder())) {
        for (auto matches = link.globalMatch(page.text); matches.hasNext();) {
            const QString target = matches.next().captured(1);
            if (!target.contains(QStringLiteral("://"))) {
                EXPECT_TRUE(QFileInfo::exists(guideFolder() + QLatin1Char('/') + target))
                    << page.file.toStdString() << ": " << target.toStdString();
            }
        }
    }
}

TEST(GuideWindowTest, ALinkOpensItsPage)
{
    GuideWindow window(guidePagesIn(guideFolder()));
    window.open(QStringLiteral("touching.md"));
    auto* text = window.findChild<QTextBrowser*>();
    EXPECT_TRUE(text->toPlainText().startsWith(QStringLiteral("Touching terrain")));
    window.open(QStringLiteral("missing.md")); // stays at its place
    EXPECT_TRUE(text->toPlainText().startsWith(QStringLiteral("Touching terrain")));
}

TEST(GuideWindowTest, SearchShowsThePageWithTheTextAndGraysOutTheOthers)
{
    GuideWindow window(
        {{QStringLiteral("a.md"), QStringLiteral("A"), QStringLiteral("# A\n\nred [b](blue.md)")},
         {QStringLiteral("b.md"), QStringLiteral("B"), QStringLiteral("# B\n\nblue and Blue")}});
    auto* field = window.findChild<QLineEdit*>();
    auto* list = window.findChild<QListWidget*>();
    QTest::keyClicks(field, QStringLiteral("blue"));
    EXPECT_EQ(list->currentRow(), 1); // the address of a link is not text
    EXPECT_EQ(list->item(0)->flags(), Qt::NoItemFlags);
    auto* text = window.findChild<QTextBrowser*>();
    EXPECT_EQ(text->textCursor().selectedText(), QStringLiteral("blue"));
    QTest::keyClick(field, Qt::Key_Return);
    EXPECT_EQ(text->textCursor().selectedText(), QStringLiteral("Blue"));
    QTest::keyClick(field, Qt::Key_Return); // from the start again
    EXPECT_EQ(text->textCursor().selectedText(), QStringLiteral("blue"));
}

TEST(GuideWindowTest, IsEmptyWithoutContents)
{
    EXPECT_TRUE(guidePagesIn(QStringLiteral("/nonexistent")).isEmpty());
}

} // namespace
} // namespace marsview
