// The program with the window: reads the command line and puts the parts together.

#include "app/gui/end_by_signal.h"
#include "core/session/open_map.h"
#include "core/session/sample_map.h"
#include "ui/graphics_check.h"
#include "ui/main_window.h"
#include "ui/picture_taker.h"

#include <QApplication>
#include <QLocale>
#include <QMessageBox>
#include <QSurfaceFormat>
#include <QTimer>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>

namespace {

constexpr int kFailed = 1;
constexpr int kUsage = 2;

struct Options {
    std::string map;
    bool is_map_given = false;
    std::string screenshot;
    QSize size;

    bool isScreenshot() const { return !screenshot.empty(); }
};

constexpr int kWidthMin = 320;
constexpr int kHeightMin = 240;
constexpr int kSideMax = 8192; // what every driver of OpenGL 3.3 draws

// The text of a size such as "1280x800"; invalid where it is none.
QSize sizeFrom(const std::string& text)
{
    int width = 0;
    int height = 0;
    int end = 0;
    const bool is_size = std::sscanf(text.c_str(), "%5dx%5d%n", &width, &height, &end) == 2 &&
                         static_cast<std::size_t>(end) == text.size() && width >= kWidthMin &&
                         height >= kHeightMin && width <= kSideMax && height <= kSideMax;
    return is_size ? QSize(width, height) : QSize();
}

void printProblem(const QString& problem)
{
    std::fprintf(stderr, "marsview: %s\n", problem.toUtf8().constData());
}

// Qt stops the program with an advice of its own where it finds no display. While it starts, only
// ours is to be read.
void reportFatalOnly(QtMsgType type, const QMessageLogContext&, const QString&)
{
    if (type == QtFatalMsg) {
        std::fputs(
            "marsview: no display can be opened; start in a desktop session, or under "
            "xvfb-run\n",
            stderr);
        std::_Exit(kFailed);
    }
}

// Ours are not Qt's: it gets the program's name alone.
std::unique_ptr<QApplication> makeApplication(int& argc, char** argv)
{
    argc = 1;
    const QtMessageHandler handler = qInstallMessageHandler(reportFatalOnly);
    auto application = std::make_unique<QApplication>(argc, argv);
    qInstallMessageHandler(handler);
    return application;
}

int runWindow(QApplication& application, const Options& options)
{
    using marsview::WindowOptions;
    const auto [problem, format] = marsview::checkGraphics();
    if (!problem.isEmpty()) {
        printProblem(problem);
        const QString platform = QGuiApplication::platformName();
        const bool has_display =
            platform != QStringLiteral("offscreen") && platform != QStringLiteral("minimal");
        if (!options.isScreenshot() && has_display) {
            QMessageBox::critical(nullptr, QStringLiteral("MarsView"), problem);
        }
        return kFailed;
    }
    QSurfaceFormat::setDefaultFormat(format);
    WindowOptions window_options;
    window_options.opener.resources = marsview::defaultMapResources();
    if (options.isScreenshot()) {
        window_options.geometry = WindowOptions::Geometry::Fixed;
        window_options.failures = WindowOptions::Failures::BySignalOnly;
    }
    const marsview::EndBySignal end_by_signal; // outlives the window, which takes time to close
    marsview::MainWindow window(window_options);
    if (options.size.isValid()) {
        window.resize(options.size);
    }
    const QString sample = QString::fromStdString(
        marsview::sampleMapFor(QCoreApplication::applicationDirPath().toStdString()).string());
    if (options.is_map_given) {
        window.open(QString::fromStdString(options.map));
    } else if (!sample.isEmpty()) {
        window.openSample(sample);
    }
    if (options.isScreenshot()) {
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
    return QApplication::exec();
}

} // namespace

int main(int argc, char** argv)
{
    try {
        CLI::App parser{"Explore topographic maps of planets and moons in a window.", "marsview"};
        Options options;
        std::string size;
        const CLI::Option* map = parser.add_option(
            "DEM", options.map, "the map to open: any elevation raster that GDAL reads");
        const CLI::Option* screenshot =
            parser
                .add_option("--screenshot", options.screenshot,
                            "write a picture of the window once the map is drawn, and exit")
                ->option_text("FILE");
        parser
            .add_option("--size", size,
                        "the size of the window in pixels, from 320x240 to 8192x8192")
            ->option_text("WxH");
        parser.set_version_flag("--version", std::string("marsview ") + MARSVIEW_VERSION);
        try {
            parser.parse(argc, argv);
            options.size = sizeFrom(size);
            options.is_map_given = map->count() > 0;
            if (!size.empty() && !options.size.isValid()) {
                throw CLI::ValidationError("--size",
                                           "\"" + size + "\" is no size from 320x240 to 8192x8192");
            }
            if (screenshot->count() > 0 && options.screenshot.empty()) {
                throw CLI::ValidationError("--screenshot", "the name of the picture is empty");
            }
        } catch (const CLI::ParseError& e) {
            if (e.get_exit_code() == 0) {
                return parser.exit(e); // help or version
            }
            std::fprintf(stderr, "marsview: %s\nRun marsview --help for what it understands.\n",
                         e.what());
            return kUsage;
        }
        const std::unique_ptr<QApplication> application = makeApplication(argc, argv);
        QCoreApplication::setOrganizationName(QStringLiteral("MarsView"));
        QCoreApplication::setApplicationName(QStringLiteral("MarsView"));
        QCoreApplication::setApplicationVersion(QStringLiteral(MARSVIEW_VERSION));
        if (QLocale().language() == QLocale::C) {
            QLocale::setDefault(QLocale(QLocale::English)); // digits in groups
        }
        QGuiApplication::setDesktopFileName(QStringLiteral("org.marsview.MarsView"));
        return runWindow(*application, options);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "marsview: %s\n", e.what());
        return kFailed;
    }
}
