// The program with the window: reads the command line and puts the parts together.

#include "app/gui/sample_map.h"
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
#include <exception>
#include <string>

namespace {

constexpr int kFailed = 1;
constexpr int kUsage = 2;

struct Options {
    std::string map;
    std::string screenshot;
    QSize size;

    bool isScreenshot() const { return !screenshot.empty(); }
};

// The text of a size such as "1280x800"; invalid where it is none.
QSize sizeFrom(const std::string& text)
{
    int width = 0;
    int height = 0;
    int end = 0;
    const bool is_size = std::sscanf(text.c_str(), "%5dx%5d%n", &width, &height, &end) == 2 &&
                         static_cast<std::size_t>(end) == text.size() && width >= 320 &&
                         height >= 240 && width <= 16384 && height <= 16384;
    return is_size ? QSize(width, height) : QSize();
}

void printProblem(const QString& problem)
{
    std::fprintf(stderr, "marsview: %s\n", problem.toUtf8().constData());
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
    if (options.isScreenshot()) {
        window_options = {.geometry = WindowOptions::Geometry::Fixed,
                          .failures = WindowOptions::Failures::BySignalOnly};
    }
    marsview::MainWindow window(window_options);
    if (options.size.isValid()) {
        window.resize(options.size);
    }
    const QString map = options.map.empty()
                            ? marsview::sampleMapFor(QCoreApplication::applicationDirPath())
                            : QString::fromStdString(options.map);
    if (!map.isEmpty()) {
        window.open(map);
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
        parser.add_option("DEM", options.map,
                          "the map to open: any elevation raster that GDAL reads");
        parser
            .add_option("--screenshot", options.screenshot,
                        "write a picture of the window once the map is drawn, and exit")
            ->option_text("FILE");
        parser.add_option("--size", size, "the size of the window in pixels")->option_text("WxH");
        parser.set_version_flag("--version", std::string("marsview ") + MARSVIEW_VERSION);
        try {
            parser.parse(argc, argv);
            options.size = sizeFrom(size);
            if (!size.empty() && !options.size.isValid()) {
                throw CLI::ValidationError("--size",
                                           "\"" + size + "\" is no size such as 1280x800");
            }
        } catch (const CLI::ParseError& e) {
            return parser.exit(e) == 0 ? 0 : kUsage;
        }
        int qt_argc = 1; // ours are not Qt's
        QApplication application(qt_argc, argv);
        QCoreApplication::setOrganizationName(QStringLiteral("MarsView"));
        QCoreApplication::setApplicationName(QStringLiteral("MarsView"));
        QCoreApplication::setApplicationVersion(QStringLiteral(MARSVIEW_VERSION));
        if (QLocale().language() == QLocale::C) {
            QLocale::setDefault(QLocale(QLocale::English)); // digits in groups
        }
        return runWindow(application, options);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "marsview: %s\n", e.what());
        return kFailed;
    }
}
