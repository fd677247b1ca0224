#include "ui/commands/contour_tools.h"

#include "core/view/terrain_look.h"
#include "ui/controllers/session_controller.h"
#include "ui/dialogs/interval_dialog.h"
#include "ui/text/number_text.h"

#include <QAction>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMainWindow>
#include <QProgressDialog>

#include <algorithm>
#include <chrono>
#include <utility>

namespace marsview {
namespace {

constexpr int kProgressSteps = 1000;
constexpr std::chrono::milliseconds kPollInterval{100};

} // namespace

ContourTools::ContourTools(const Parts& parts, QObject* parent)
    : QObject(parent)
    , parts_(parts)
{
    pool_.setMaxThreadCount(1);
    poll_timer_.setInterval(kPollInterval);
    connect(&poll_timer_, &QTimer::timeout, this, [this] {
        if (monitor_ && progress_ != nullptr) {
            progress_->setValue(
                std::min(kProgressSteps - 1, qRound(monitor_->fraction() * kProgressSteps)));
        }
    });
    connect(&parts_.interval, &QAction::triggered, this, &ContourTools::askInterval);
    connect(&parts_.export_contours, &QAction::triggered, this, &ContourTools::askFile);
}

ContourTools::~ContourTools()
{
    if (monitor_) {
        monitor_->cancel();
    }
    pool_.waitForDone(); // posted results are discarded with this object
}

// The interval in the picture, or what would be in it.
double ContourTools::shownInterval() const
{
    const Layer* active = activeLayer(parts_.session.session());
    TerrainLook look = parts_.session.session().look;
    look.has_contours = true;
    const PictureScene& scene = parts_.scenes.shown();
    if (active == nullptr || scene.topmost() == nullptr) {
        return 0.0;
    }
    const Viewport picture = scene.viewport();
    return contourInterval(look, active->map->heightfield().range().value_or(HeightRange{}),
                           scene.facts({picture.width, picture.height}).pixel_m,
                           scene.style().exaggeration);
}

void ContourTools::askInterval()
{
    auto* dialog =
        new IntervalDialog(tr("Contour Interval"), IntervalDialog::Automatic::Allowed,
                           parts_.session.session().look.contour_interval_m, &parts_.window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &IntervalDialog::intervalChosen, &parts_.session,
            &SessionController::setContourInterval);
    dialog->open();
}

void ContourTools::askFile()
{
    const Layer* active = activeLayer(parts_.session.session());
    if (active == nullptr || isExporting()) {
        return;
    }
    auto* ask = new IntervalDialog(tr("Export Contours"), IntervalDialog::Automatic::NotAllowed,
                                   shownInterval(), &parts_.window);
    ask->setAttribute(Qt::WA_DeleteOnClose);
    const QString name = QFileInfo(QString::fromStdString(active->name)).completeBaseName();
    connect(ask, &IntervalDialog::intervalChosen, this, [this, name](double interval_m) {
        auto* dialog = new QFileDialog(&parts_.window, tr("Export Contours"));
        dialog->setAttribute(Qt::WA_DeleteOnClose);
        dialog->setAcceptMode(QFileDialog::AcceptSave);
        dialog->setNameFilters({tr("GeoPackage (*.gpkg)"), tr("Shapefile (*.shp)")});
        dialog->setDefaultSuffix(QStringLiteral("gpkg"));
        //: The name of a file of contours: %1 is the map
        dialog->selectFile(tr("%1-contours.gpkg").arg(name));
        connect(dialog, &QFileDialog::fileSelected, this,
                [this, interval_m](const QString& file) { exportTo(file, interval_m); });
        dialog->open();
    });
    ask->open();
}

void ContourTools::exportTo(const QString& file, double interval_m)
{
    const Layer* active = activeLayer(parts_.session.session());
    if (active == nullptr || isExporting()) {
        return;
    }
    monitor_ = std::make_shared<JobMonitor>();
    progress_ = new QProgressDialog(
        tr("Exporting contours to %1").arg(isolated(QFileInfo(file).fileName())), tr("Cancel"), 0,
        kProgressSteps, &parts_.window);
    progress_->setAttribute(Qt::WA_DeleteOnClose);
    progress_->setAutoClose(false);
    progress_->setAutoReset(false);
    connect(progress_, &QProgressDialog::canceled, this, [this] {
        if (monitor_) {
            monitor_->cancel();
        }
    });
    poll_timer_.start();
    pool_.start([this, monitor = monitor_, file,
                 job = ContourJob{.raster = active->map->spec(),
                                  .interval_m = interval_m,
                                  .base_m = 0.0,
                                  .path = file.toStdString()}] {
        auto report = exportContours(job, *monitor);
        QMetaObject::invokeMethod(
            this, [this, file, report = std::move(report)] { end(file, report); },
            Qt::QueuedConnection);
    });
}

void ContourTools::end(const QString& file, const Result<ContourReport>& report)
{
    poll_timer_.stop();
    monitor_.reset();
    if (progress_ != nullptr) {
        std::exchange(progress_, nullptr)->close();
    }
    if (report) {
        Q_EMIT exported(file);
    } else if (report.error().code != ErrorCode::Canceled) {
        Q_EMIT failed(QString::fromStdString(report.error().message));
    }
}

} // namespace marsview
