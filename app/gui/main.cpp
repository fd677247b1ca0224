// The program with the window: reads the command line and creates the parts.

#include "app/gui/end_by_signal.h"
#include "app/gui/window_arguments.h"
#include "core/files/open_probe.h"
#include "core/session/map_resources.h"
#include "core/session/sample_map.h"
#include "ui/commands/window_commands.h"
#include "ui/controllers/preferences.h"
#include "ui/graphics_check.h"
#include "ui/main_window.h"
#include "ui/picture_taker.h"
#include "ui/project/project_menu.h"
#include "ui/text/language.h"
#include "ui/widgets/line_style.h"

#include <QApplication>
#include <QFileInfo>
#include <QMessageBox>
#include <QSettings>
#include <QStandardPaths>
#include <QStringList>
#include <QStyleFactory>
#include <QSurfaceFormat>
#include <QTimer>
#include <QTranslator>
#include <QWidget>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <vector>

namespace {

constexpr int kFailed = 1;
constexpr int kUsage = 2;

void printProblem(const QString& problem)
{
    std::fprintf(stderr, "marsview: %s\n", problem.toUtf8().constData());
}

// The platforms of Qt that the user asks for, by option or by Qt's environment variable.
QStringList wantedPlatforms(int argc, char** argv)
{
    QString platforms = qEnvironmentVariable("QT_QPA_PLATFORM");
    for (int i = 1; i < argc; ++i) {
        const QString word = QString::fromLocal8Bit(argv[i]);
        const QString name = word.section(QLatin1Char('='), 0, 0);
        if (name == QStringLiteral("-platform") || name == QStringLiteral("--platform")) {
            platforms = word != name   ? word.section(QLatin1Char('='), 1)
                        : i + 1 < argc ? QString::fromLocal8Bit(argv[i + 1])
                                       : QString();
        }
    }
    QStringList names;
    for (const QString& platform : platforms.split(QLatin1Char(';'), Qt::SkipEmptyParts)) {
        names.append(platform.section(QLatin1Char(':'), 0, 0)); // its parameters follow
    }
    return names;
}

// For reportFatalOnly().
QStringList wanted_platforms;

// Without a display Qt aborts with its own advice. During startup, only our message is printed.
void reportFatalOnly(QtMsgType type, const QMessageLogContext&, const QString& text)
{
    if (type == QtFatalMsg) {
        const QString known = text.section(QStringLiteral("Available platform plugins are: "), 1)
                                  .section(QLatin1Char('.'), 0, 0);
        for (const QString& platform : wanted_platforms) {
            if (!known.isEmpty() && !known.split(QStringLiteral(", ")).contains(platform)) {
                printProblem(
                    QStringLiteral("-platform: unknown platform \"%1\". Known platforms: %2")
                        .arg(platform, known));
                std::_Exit(kUsage);
            }
        }
        std::fputs(
            "marsview: cannot open a display; start in a desktop session, or under "
            "xvfb-run\n",
            stderr);
        std::_Exit(kFailed);
    }
}

// Passes only Qt's own options to Qt, which removes them from `arguments`.
std::unique_ptr<QApplication> makeApplication(int& argc, char** argv)
{
    wanted_platforms = wantedPlatforms(argc, argv);
    const QtMessageHandler handler = qInstallMessageHandler(reportFatalOnly);
    auto application = std::make_unique<QApplication>(argc, argv);
    qInstallMessageHandler(handler);
    return application;
}

// Qt reads the style sheet for the first widget, and only warns.
bool checkStyleSheet()
{
    if (qApp->styleSheet().isEmpty()) {
        return true;
    }
    static bool is_refused = false;
    const QtMessageHandler handler =
        qInstallMessageHandler([](QtMsgType, const QMessageLogContext&, const QString& text) {
            is_refused = is_refused || text.contains(QStringLiteral("parse application"));
        });
    QWidget().ensurePolished();
    qInstallMessageHandler(handler);
    if (is_refused) {
        printProblem(QStringLiteral("-stylesheet: the file is not a valid style sheet of Qt"));
    }
    return !is_refused;
}

// The style that the user asks for, by option or by Qt's environment variable, which Qt ignores if
// it names an unknown style. False if the option does.
bool applyStyle(const std::string& option)
{
    const QStringList known = QStyleFactory::keys();
    const QString style = !option.empty() ? QString::fromStdString(option)
                                          : qEnvironmentVariable("QT_STYLE_OVERRIDE");
    if (known.contains(style, Qt::CaseInsensitive)) {
        QApplication::setStyle(new marsview::LineStyle(style));
    } else if (!option.empty()) {
        printProblem(QStringLiteral("-style: unknown style \"%1\". Known styles: %2")
                         .arg(style, known.join(QStringLiteral(", "))));
        return false;
    }
    return true;
}

int runWindow(QApplication& application, const marsview::WindowArguments& options)
{
    using marsview::WindowOptions;
    const bool is_screenshot = !options.screenshot.empty();
    const auto [problem, format] = marsview::checkGraphics();
    if (!problem.isEmpty()) {
        printProblem(problem);
        const QString platform = QGuiApplication::platformName();
        const bool has_display =
            platform != QStringLiteral("offscreen") && platform != QStringLiteral("minimal");
        if (!is_screenshot && has_display) {
            QMessageBox::critical(nullptr, QStringLiteral("MarsView"), problem);
        }
        return kFailed;
    }
    QSurfaceFormat::setDefaultFormat(format);
    WindowOptions window_options;
    window_options.opener.resources = marsview::defaultMapResources();
    const QString sample = QString::fromStdString(
        marsview::sampleMapFor(QCoreApplication::applicationDirPath().toStdString()).string());
    if (!sample.isEmpty()) {
        window_options.bundled_maps = QFileInfo(sample).absolutePath().toStdString();
    }
    if (!is_screenshot) {
        window_options.questions = WindowOptions::Questions::Ask;
        window_options.autosave_folder =
            (QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) +
             QStringLiteral("/autosave"))
                .toStdString();
    }
    if (is_screenshot) {
        window_options.geometry = WindowOptions::Geometry::Fixed;
        window_options.failures = WindowOptions::Failures::BySignalOnly;
    }
    const marsview::EndBySignal end_by_signal; // outlives the window, which takes time to close
    marsview::MainWindow window(window_options);
    if (const auto& extent = options.geometry.extent) {
        window.resize(extent->width, extent->height);
    }
    if (const auto& place = options.geometry.place) {
        window.move(place->x, place->y);
    }
    if (!options.maps.empty()) {
        QStringList maps;
        for (const std::string& map : options.maps) {
            maps.append(QString::fromStdString(map));
        }
        window.openAtStart(maps);
    } else if (!sample.isEmpty()) {
        window.openSample(sample);
    }
    if (is_screenshot) {
        auto* taker =
            new marsview::PictureTaker(window, QString::fromStdString(options.screenshot), &window);
        QObject::connect(
            taker, &marsview::PictureTaker::finished, &application,
            [](const QString& failure) {
                if (!failure.isEmpty()) {
                    printProblem(failure);
                }
                QCoreApplication::exit(failure.isEmpty() ? 0 : kFailed);
            },
            Qt::QueuedConnection);
    }
    window.show();
    if (!is_screenshot) {
        window.commands().project_menu.offerRecovery();
    }
    return QApplication::exec();
}

} // namespace

int main(int argc, char** argv)
{
    try {
        const std::vector<std::string> given(argv + std::min(argc, 1), argv + argc);
        const marsview::Result<marsview::WindowArguments> arguments =
            marsview::parseWindowArguments(given, MARSVIEW_VERSION);
        if (!arguments) {
            std::fprintf(stderr, "marsview: %s\nRun marsview --help for usage.\n",
                         arguments.error().message.c_str());
            return kUsage;
        }
        if (arguments->answer) {
            std::fputs(arguments->answer->c_str(), stdout);
            return std::fflush(stdout) == 0 ? EXIT_SUCCESS : kFailed;
        }
        marsview::prestartProbes();
        // These must outlive the application.
        std::vector<std::string> words{argc > 0 ? argv[0] : "marsview"};
        words.insert(words.end(), arguments->for_qt.begin(), arguments->for_qt.end());
        std::vector<char*> pointers;
        for (std::string& word : words) {
            pointers.push_back(word.data());
        }
        pointers.push_back(nullptr);
        int count = static_cast<int>(words.size());
        const std::unique_ptr<QApplication> application = makeApplication(count, pointers.data());
        if (count > 1) {
            std::fprintf(stderr, "marsview: %s: not an option of this Qt version\n", pointers[1]);
            return kUsage;
        }
        if (!applyStyle(arguments->style) || !checkStyleSheet()) {
            return kUsage;
        }
        QCoreApplication::setOrganizationName(QStringLiteral("MarsView"));
        QCoreApplication::setApplicationName(QStringLiteral("MarsView"));
        QCoreApplication::setApplicationVersion(QStringLiteral(MARSVIEW_VERSION));
        const QString language =
            marsview::languageFor(marsview::preferencesFrom(QSettings()).language);
        marsview::useNumbersOf(language);
        const auto translators = marsview::translateTo(language);
        QGuiApplication::setDesktopFileName(QStringLiteral("org.marsview.MarsView"));
        return runWindow(*application, *arguments);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "marsview: %s\n", e.what());
        return kFailed;
    }
}
