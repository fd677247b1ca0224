#include "ui/views/fly_through_tools.h"

#include "ui/controllers/measure_controller.h"
#include "ui/controllers/session_controller.h"

#include <QAction>
#include <QDir>
#include <QFileInfo>
#include <QStandardPaths>
#include <QToolButton>

#include <utility>

namespace marsview {

FlyThroughTools::FlyThroughTools(const Parts& parts, QObject* parent)
    : QObject(parent)
    , parts_(parts)
    , recorder_(parts.scenes)
{
    connect(&parts_.open, &QAction::triggered, this, &FlyThroughTools::open);
    refresh_timer_.setSingleShot(true);
    refresh_timer_.setInterval(0);
    connect(&refresh_timer_, &QTimer::timeout, this, [this] {
        if (dialog_ != nullptr) {
            dialog_->refresh();
        }
    });
    const auto refresh_soon = [this] { refresh_timer_.start(); };
    connect(&parts_.session, &SessionController::sessionChanged, this, refresh_soon);
    connect(&parts_.measuring, &MeasureController::changed, this, refresh_soon);
    for (const PictureScene* scene : {&parts_.scenes.flat, &parts_.scenes.globe}) {
        connect(scene, &PictureScene::layersChanged, this, refresh_soon);
    }
    connect(&recorder_, &FlyThroughRecorder::saved, this,
            [this](const QString& file) { folder_ = QFileInfo(file).absolutePath(); });
}

FlyThroughTools::~FlyThroughTools()
{
    delete dialog_; // it asks this object
}

void FlyThroughTools::open()
{
    if (dialog_ == nullptr) {
        dialog_ = new FlyThroughDialog(
            {.scenes = parts_.scenes,
             .session = [this]() -> const Session& { return parts_.session.session(); },
             .lines = [this] { return lines(); },
             .folder = [this] { return folder(); }},
            &parts_.window);
        dialog_->setAttribute(Qt::WA_DeleteOnClose);
        refresh_timer_.stop(); // it has just read everything
        connect(
            dialog_, &FlyThroughDialog::recordRequested, this,
            [this](const CameraPath& path, const QString& file, const RecordingOptions& options) {
                if (!recorder_.isRecording()) {
                    recorder_.start(path, file, options);
                }
            });
    }
    dialog_->show();
    dialog_->raise();
    dialog_->activateWindow();
    dialog_->playButton()->setFocus();
}

std::vector<FlightLine> FlyThroughTools::lines() const
{
    std::vector<FlightLine> lines;
    for (const MeasureItem& item : parts_.measuring.state().items) {
        std::vector<ScenePoint> points = parts_.measuring.pathOf(item);
        if (points.size() >= 2 && length(points.front() - points.back()) > 0.0) {
            lines.push_back({.name = item.name, .points = std::move(points)});
        }
    }
    return lines;
}

QString FlyThroughTools::folder() const
{
    if (!folder_.isEmpty()) {
        return folder_;
    }
    const QString movies = QStandardPaths::writableLocation(QStandardPaths::MoviesLocation);
    return QFileInfo(movies).isDir() ? movies : QDir::homePath();
}

} // namespace marsview
