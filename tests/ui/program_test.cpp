// The program as a separate process.

#include "tests/support/shared_data.h"
#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"

#include <QFile>
#include <QImage>
#include <QProcess>
#include <QProcessEnvironment>
#include <QTest>

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

namespace marsview {
namespace {

struct Outcome {
    int exit_code = -1;
    bool has_crashed = true;
    QString errors; // without Qt's messages about the environment
};

Outcome run(const QStringList& arguments, const QString& platform = {})
{
    QProcess process;
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    if (!platform.isEmpty()) {
        environment.insert(QStringLiteral("QT_QPA_PLATFORM"), platform);
    }
    process.setProcessEnvironment(environment);
    process.start(QStringLiteral(MARSVIEW_PROGRAM), arguments);
    const bool is_finished = process.waitForFinished(60000);
    QStringList lines;
    for (const QString& line : QString::fromUtf8(process.readAllStandardError()).split(u'\n')) {
        if (!line.isEmpty() && !line.startsWith(QStringLiteral("QStandardPaths"))) {
            lines.append(line);
        }
    }
    return {.exit_code = process.exitCode(),
            .has_crashed = !is_finished || process.exitStatus() != QProcess::NormalExit,
            .errors = lines.join(u'\n')};
}

TEST(Program, WritesAPictureOfTheWholeMapAndExits)
{
    const TestMaps maps;
    const QString picture = maps.path(QStringLiteral("picture.png"));
    const Outcome outcome = run({maps.hill(), QStringLiteral("--screenshot"), picture,
                                 QStringLiteral("--size"), QStringLiteral("900x600")});
    EXPECT_FALSE(outcome.has_crashed);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors.toStdString();
    EXPECT_EQ(outcome.errors, QString());
    const QImage image(picture);
    ASSERT_EQ(image.size(), QSize(900, 600));
    // The middle of the map area, two thirds of the window to the right of the panel, against the
    // sky in its corner.
    const QColor middle = image.pixelColor(600, 330);
    const QColor corner = image.pixelColor(896, 150);
    EXPECT_GT(middle.lightness(), corner.lightness() + 20);
}

// 2026-11: the globe is shown until the scene of the project is known, and the flat map stayed
// empty.
TEST(Program, DrawsTheFlatMapOfAProjectWithoutACamera)
{
    const TestMaps maps;
    const QString project = maps.path(QStringLiteral("flat.mvproj"));
    QFile file(project);
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(R"({"format": "MarsView project", "version": 1, "scene": "flat map", "active": 0,
                   "layers": [{"name": "mars", "band": 1, "visible": true, "file": ")" +
               QByteArray::fromStdString(test::bundledMars()) + R"("}]})");
    file.close();
    const QString picture = maps.path(QStringLiteral("picture.png"));
    const Outcome outcome = run({project, QStringLiteral("--screenshot"), picture});
    EXPECT_FALSE(outcome.has_crashed) << "or it did not end";
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors.toStdString();
    EXPECT_FALSE(QImage(picture).isNull());
}

TEST(Program, AppliesTheStyleThatIsAskedForAndRefusesUnknownOnes)
{
    const TestMaps maps;
    const auto picture_in = [&maps](const char* style) {
        const QString picture = maps.path(QString::fromLatin1(style) + QStringLiteral(".png"));
        const Outcome outcome =
            run({maps.hill(), QStringLiteral("--screenshot"), picture, QStringLiteral("--size"),
                 QStringLiteral("900x600"), QStringLiteral("-style"), QString::fromLatin1(style)});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.errors.toStdString();
        return QImage(picture);
    };
    const QImage fusion = picture_in("fusion");
    ASSERT_FALSE(fusion.isNull());
    EXPECT_NE(picture_in("windows"), fusion);
    const Outcome unknown = run({maps.hill(), QStringLiteral("-style"), QStringLiteral("plaid")});
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_TRUE(unknown.errors.startsWith(
        QStringLiteral("marsview: -style: unknown style \"plaid\". Known styles: ")))
        << unknown.errors.toStdString();
}

TEST(Program, ReportsInOneLineWhyAFileCannotBeOpened)
{
    const TestMaps maps;
    const Outcome outcome = run({QStringLiteral("/no/such/map.tif"), QStringLiteral("--screenshot"),
                                 maps.path(QStringLiteral("picture.png"))});
    EXPECT_FALSE(outcome.has_crashed);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(outcome.errors.startsWith(QStringLiteral("marsview: /no/such/map.tif: ")));
    EXPECT_EQ(outcome.errors.count(u'\n'), 0);
}

TEST(Program, ReportsInOneLineThatAPictureCannotBeWritten)
{
    const TestMaps maps;
    const Outcome outcome = run({maps.hill(), QStringLiteral("--screenshot"),
                                 QStringLiteral("/no/such/folder/picture.png")});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(
        outcome.errors.startsWith(QStringLiteral("marsview: /no/such/folder/picture.png: ")));
}

TEST(Program, SurvivesAPlatformWithoutOpenGl)
{
    const TestMaps maps;
    for (const QStringList& arguments :
         {QStringList{maps.hill()}, QStringList{maps.hill(), QStringLiteral("--screenshot"),
                                                maps.path(QStringLiteral("picture.png"))}}) {
        const Outcome outcome = run(arguments, QStringLiteral("offscreen"));
        EXPECT_FALSE(outcome.has_crashed);
        EXPECT_EQ(outcome.exit_code, 1);
        EXPECT_TRUE(outcome.errors.startsWith(QStringLiteral("marsview: ")));
    }
}

// Whether the process handles SIGTERM itself; from then on a request to end is handled.
bool handlesTerm(qint64 process)
{
    QFile status(QStringLiteral("/proc/%1/status").arg(process));
    if (!status.open(QIODevice::ReadOnly)) {
        return false;
    }
    const QList<QByteArray> lines = status.readAll().split('\n');
    return std::any_of(lines.begin(), lines.end(), [](const QByteArray& line) {
        constexpr qulonglong kTerm = 1ULL << (SIGTERM - 1);
        return line.startsWith("SigCgt:") &&
               (line.mid(7).trimmed().toULongLong(nullptr, 16) & kTerm);
    });
}

TEST(Program, EndsCleanlyOnASignal)
{
    const TestMaps maps;
    QProcess process;
    process.start(QStringLiteral(MARSVIEW_PROGRAM), {maps.hill()});
    ASSERT_TRUE(process.waitForStarted());
    ASSERT_TRUE(QTest::qWaitFor([&] { return handlesTerm(process.processId()); }, kTimeout));
    process.terminate();
    ASSERT_TRUE(process.waitForFinished(kTimeout));
    EXPECT_EQ(process.exitStatus(), QProcess::NormalExit);
    EXPECT_EQ(process.exitCode(), 0);
}

TEST(Program, AnswersWithoutADisplay)
{
    EXPECT_EQ(run({QStringLiteral("--version")}, QStringLiteral("none")).exit_code, 0);
    EXPECT_EQ(run({QStringLiteral("--help")}, QStringLiteral("none")).exit_code, 0);
    EXPECT_EQ(run({QStringLiteral("--no-such-option")}, QStringLiteral("none")).exit_code, 2);
    EXPECT_EQ(
        run({QStringLiteral("--size"), QStringLiteral("big")}, QStringLiteral("none")).exit_code,
        2);
}

TEST(Program, NamesUnknownOptionsAndSuggestsTheNearest)
{
    const Outcome outcome =
        run({QStringLiteral("--screenshto"), QStringLiteral("x.png")}, QStringLiteral("none"));
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.errors.section(u'\n', 0, 0),
              QStringLiteral("marsview: --screenshto: unknown option. Did you mean "
                             "\"--screenshot\"?"));
}

TEST(Program, PassesQtsOwnOptionsOnToQt)
{
    const TestMaps maps;
    const QString picture = maps.path(QStringLiteral("picture.png"));
    const Outcome outcome =
        run({QStringLiteral("-style"), QStringLiteral("fusion"), QStringLiteral("--geometry"),
             QStringLiteral("900x600+10+20"), QStringLiteral("-reverse"), maps.hill(),
             QStringLiteral("--screenshot"), picture});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors.toStdString();
    EXPECT_EQ(QImage(picture).size(), QSize(900, 600));
    const Outcome none =
        run({QStringLiteral("-platform"), QStringLiteral("offscreen"), maps.hill()});
    EXPECT_EQ(none.exit_code, 1) << "OpenGL is not available on that platform";
}

TEST(Program, NamesTheValueOfAnOptionThatQtDoesNotKnow)
{
    const TestMaps maps;
    const Outcome platform = run({QStringLiteral("-platform"), QStringLiteral("nosuch")});
    EXPECT_EQ(platform.exit_code, 2);
    EXPECT_TRUE(platform.errors.startsWith(
        QStringLiteral("marsview: -platform: unknown platform \"nosuch\". Known platforms: ")))
        << platform.errors.toStdString();
    EXPECT_TRUE(platform.errors.contains(QStringLiteral("xcb")));
    const QString sheet = maps.path(QStringLiteral("sheet.qss"));
    QFile file(sheet);
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write("QWidget { color: ");
    file.close();
    const Outcome style = run({QStringLiteral("-stylesheet"), sheet, maps.hill()});
    EXPECT_EQ(style.exit_code, 2);
    EXPECT_EQ(style.errors,
              QStringLiteral("marsview: -stylesheet: the file is not a valid style sheet of Qt"));
}

TEST(Program, OpensSeveralMapsTheLastOnTop)
{
    const TestMaps maps;
    const QStringList shared{QStringLiteral("--size"), QStringLiteral("900x600"),
                             QStringLiteral("--screenshot")};
    const auto pictureOf = [&](const QStringList& files, const char* name) {
        const QString picture = maps.path(QString::fromLatin1(name));
        const Outcome outcome = run(files + shared + QStringList{picture});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.errors.toStdString();
        return QImage(picture);
    };
    const QString hill = maps.hill();
    const QString moon = maps.moon();
    // With two bodies the topmost is shown; the list has both, so only the middle is compared.
    const auto middle = [](const QImage& image) { return image.copy(450, 250, 150, 100); };
    const QImage both = pictureOf({moon, QStringLiteral("file://") + hill}, "both.png");
    EXPECT_EQ(both.size(), QSize(900, 600));
    EXPECT_EQ(middle(both), middle(pictureOf({hill}, "hill.png")));
    EXPECT_NE(both, pictureOf({hill}, "hill.png")) << "two layers are open";
}

} // namespace
} // namespace marsview
