#include "ui/project/project_controller.h"

#include "core/annotations/annotation_files.h"
#include "ui/canvas/terrain_view.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/controllers/file_work.h"
#include "ui/controllers/measure_controller.h"
#include "ui/controllers/session_controller.h"

#include <QDir>
#include <QFileInfo>

#include <algorithm>
#include <utility>

namespace marsview {

std::optional<ProjectCamera> projectCamera(const TerrainView& view)
{
    if (!view.map()) {
        return std::nullopt;
    }
    const OrbitCamera& camera = view.cameraGoal();
    const Georeference& georeference = view.map()->georeference();
    const MapPoint target = georeference.toMap(georeference.sceneFrame().toGrid(camera.target));
    return ProjectCamera{.x = target.x,
                         .y = target.y,
                         .elevation_m = camera.target.z / view.exaggeration(),
                         .distance_m = camera.distance_m,
                         .azimuth = camera.azimuth,
                         .tilt = camera.tilt,
                         .field_of_view = camera.field_of_view};
}

ProjectController::ProjectController(SessionController& session,
                                     MeasureController& measuring,
                                     AnnotationController& annotating,
                                     TerrainView& view,
                                     FileWork& work,
                                     const ProjectOptions& options,
                                     QObject* parent)
    : QObject(parent)
    , session_(session)
    , measuring_(measuring)
    , annotating_(annotating)
    , view_(view)
    , options_(options)
    , autosave_(options.autosave_folder)
    , work_(work)
{
    pool_.setMaxThreadCount(1);
    autosave_timer_.setSingleShot(true);
    autosave_timer_.setInterval(options.autosave_delay_ms);
    connect(&autosave_timer_, &QTimer::timeout, this, [this] {
        if (isModified()) {
            autosave_.write(state());
        }
    });
    connect(&session_.undoStack(), &QUndoStack::indexChanged, this, &ProjectController::noteChange);
    connect(&session_.undoStack(), &QUndoStack::cleanChanged, this, &ProjectController::noteChange);
    // Changes of one drag are one step.
    connect(&session_, &SessionController::sessionChanged, this, &ProjectController::noteChange);
    connect(&session_, &SessionController::opened, this, &ProjectController::noteOpened);
    connect(&session_, &SessionController::loadingEnded, this, &ProjectController::showCamera);
    connect(&view_, &TerrainView::mapShown, this, &ProjectController::showCamera);
}

bool ProjectController::isModified() const
{
    return is_recovered_ || isSaving() || (!session_.undoStack().isClean() && !isNothingToKeep());
}

// Everything was undone or removed, or only the sample map was changed, and no project file was
// opened or saved.
bool ProjectController::isNothingToKeep() const
{
    const Session& session = session_.session();
    const bool has_own_layers = std::any_of(session.layers.begin(), session.layers.end(),
                                            [](const Layer& layer) { return !layer.is_sample; });
    return file_.isEmpty() && (session_.undoStack().index() == 0 ||
                               (!has_own_layers && session.missing.empty() &&
                                session.overlays.empty() && session.views.empty() &&
                                measuring_.saved().empty() && annotating_.state().items.empty()));
}

// Opening maps can be repeated as easily: opening them alone does not lead to a question.
void ProjectController::noteOpened()
{
    QUndoStack& stack = session_.undoStack();
    if (file_.isEmpty() && !is_recovered_ && stack.cleanIndex() == stack.index() - 1) {
        stack.setClean();
    }
}

Project ProjectController::project() const
{
    return wholeProject(state());
}

ProjectState ProjectController::state() const
{
    ProjectState state{.project = projectOf(session_.session()),
                       .layers = projectOrder(session_.session()),
                       .annotations = annotating_.state().items,
                       .file = file_.toStdString()};
    state.project.measurements = measuring_.saved();
    state.project.camera = camera_ ? camera_ : projectCamera(view_);
    if (pending_scene_) {
        state.project.scene = pending_scene_->choice;
        state.project.globe_camera = pending_scene_->globe_camera;
    } else if (scene_.choice) {
        state.project.scene = scene_.choice();
        state.project.globe_camera = scene_.globe_camera();
    }
    state.project.others = others_;
    return state;
}

void ProjectController::noteChange()
{
    if (is_replacing_) {
        return;
    }
    if (isModified()) {
        if (!autosave_timer_.isActive()) {
            autosave_timer_.start();
        }
    } else {
        autosave_timer_.stop();
        autosave_.discard();
    }
    Q_EMIT changed();
}

void ProjectController::replace(const Project& project, const QString& file)
{
    is_replacing_ = true;
    autosave_timer_.stop();
    autosave_.discard();
    file_ = file;
    is_recovered_ = false;
    others_ = project.others;
    camera_ = project.camera;
    pending_scene_ = SavedScene{.choice = project.scene, .globe_camera = project.globe_camera};
    session_.openProject(project);
    measuring_.open(project.measurements, projectOrder(session_.session()));
    annotating_.open(project.annotations, projectOrder(session_.session()));
    is_replacing_ = false;
    Q_EMIT changed();
}

void ProjectController::startNew()
{
    replace({}, {});
}

void ProjectController::read(const QString& file,
                             const std::function<void(const ReadProject&)>& then,
                             const std::function<void()>& otherwise)
{
    const QString path = QFileInfo(file).absoluteFilePath();
    readSoon(
        path,
        [path = path.toStdString(), bundled = options_.bundled](JobMonitor& monitor) {
            return readProject(path, bundled, monitor);
        },
        then, otherwise);
}

// On the pool's thread.
void ProjectController::readSoon(const QString& file,
                                 const std::function<Result<Project>(JobMonitor&)>& read,
                                 const std::function<void(const ReadProject&)>& then,
                                 const std::function<void()>& otherwise)
{
    const QString text = file.isEmpty()
                             //: In the status bar, of a project that was never saved
                             ? tr("Reading the project")
                             //: In the status bar: %1 is a file
                             : tr("Reading %1").arg(QFileInfo(file).fileName());
    const auto monitor = work_.begin(*this, text, file);
    readings_.push_back(monitor);
    pool_.start([this, file, monitor, read, then, otherwise] {
        const auto project = std::make_shared<const Result<Project>>(read(*monitor));
        QMetaObject::invokeMethod(
            this,
            [this, file, monitor, then, otherwise, project] {
                std::erase(readings_, monitor);
                if (*project) {
                    then({.file = file, .project = **project});
                } else if (project->error().code != ErrorCode::Canceled) {
                    Q_EMIT failed(QString::fromStdString(project->error().message));
                    if (otherwise) {
                        otherwise();
                    }
                }
                work_.end(monitor);
                Q_EMIT idle();
            },
            Qt::QueuedConnection);
    });
}

void ProjectController::open(const ReadProject& read)
{
    replace(read.project, read.file);
    Q_EMIT opened(read.file);
}

void ProjectController::save(const std::function<void()>& then)
{
    saveAs(file_, then);
}

// What the files of one save are made of. Runs on the pool's thread.
struct ProjectController::Saving {
    std::shared_ptr<const ProjectState> state;
    std::vector<NamedMeasurement> measurements;
    std::filesystem::path path;
    std::filesystem::path bundled;
    std::shared_ptr<JobMonitor> monitor;

    std::filesystem::path companionFile(const char* ending) const
    {
        return path.parent_path() / (path.stem().string() + ending);
    }
    // Files for other programs.
    Companions writeCompanions(std::vector<Annotation> annotations) const
    {
        Companions companions;
        const auto write = [&](const std::vector<FeatureCollection>& features,
                               const std::string& file) -> std::optional<Error> {
            if (features.empty()) {
                return std::nullopt;
            }
            if (const auto done = writeCollections(features, file, *monitor); !done) {
                return done.error();
            }
            const auto files = collectionPaths(features, file);
            companions.files.insert(companions.files.end(), files.begin(), files.end());
            return std::nullopt;
        };
        companions.measurements =
            write(measurementFeatures(measurements), companionFile("-measurements.gpkg").string());
        companions.annotations = write(annotationFeatures(annotations, FeatureLayers::ByShape),
                                       companionFile("-annotations.gpkg").string());
        return companions;
    }
};

void ProjectController::saveAs(const QString& file, const std::function<void()>& then)
{
    QString path = QFileInfo(file).absoluteFilePath();
    if (QFileInfo(path).suffix().isEmpty()) {
        path += QStringLiteral(".mvproj");
    }
    //: In the status bar: %1 is a file
    const QString text = tr("Writing %1").arg(QFileInfo(path).fileName());
    ++saving_;
    ++writing_;
    // Later changes count from this save. If it fails, no state counts as saved.
    session_.undoStack().setClean();
    Saving saving{.state = std::make_shared<const ProjectState>(state()),
                  .measurements = measuring_.named(),
                  .path = path.toStdString(),
                  .bundled = options_.bundled,
                  .monitor = work_.begin(*this, text, path)};
    pool_.start([this, path, then, saving = std::move(saving)]() mutable {
        constexpr double kProjectShare = 0.5; // of the time
        Project project = wholeProject(*saving.state);
        Status status = Done{};
        {
            const JobPart part(*saving.monitor, 0.0, kProjectShare);
            status = writeProject(project, saving.path, saving.bundled, *saving.monitor);
        }
        const bool is_saved = static_cast<bool>(status);
        QMetaObject::invokeMethod(
            this,
            [this, path, status, then, state = std::move(saving.state)] {
                takeSaved(path, status, then);
            },
            Qt::QueuedConnection);
        Companions companions;
        if (is_saved) {
            const JobPart part(*saving.monitor, kProjectShare, 1.0);
            std::vector<Annotation> annotations;
            annotations.reserve(project.annotations.size());
            for (ProjectAnnotation& drawn : project.annotations) {
                annotations.push_back(std::move(drawn.annotation));
            }
            project = {};
            companions = saving.writeCompanions(std::move(annotations));
        }
        QMetaObject::invokeMethod(
            this,
            [this, path, is_saved, companions, monitor = saving.monitor] {
                --writing_;
                work_.end(monitor);
                if (is_saved) {
                    reportCompanions(path, companions);
                }
            },
            Qt::QueuedConnection);
    });
}

void ProjectController::takeSaved(const QString& path,
                                  const Status& status,
                                  const std::function<void()>& then)
{
    --saving_;
    if (status) {
        file_ = path;
        is_recovered_ = false;
    } else {
        session_.undoStack().resetClean();
    }
    noteChange();
    if (status) {
        Q_EMIT saved(path);
        if (then) {
            then();
        }
    } else if (status.error().code != ErrorCode::Canceled) {
        Q_EMIT failed(QString::fromStdString(status.error().message));
    }
    Q_EMIT idle();
}

ProjectController::~ProjectController()
{
    for (const auto& monitor : readings_) {
        monitor->cancel();
    }
    pool_.waitForDone(); // posted results are discarded with this object
}

void ProjectController::reportCompanions(const QString& path, const Companions& companions)
{
    QStringList files{path};
    for (const std::filesystem::path& file : companions.files) {
        files.append(QString::fromStdString(file.string()));
    }
    Q_EMIT written(files);
    if (companions.measurements && companions.measurements->code != ErrorCode::Canceled) {
        Q_EMIT failed(tr("The project is saved, but not the GeoPackage of its measurements: %1")
                          .arg(QString::fromStdString(companions.measurements->message)));
    }
    if (companions.annotations && companions.annotations->code != ErrorCode::Canceled) {
        Q_EMIT failed(tr("The project is saved, but not the GeoPackage of its annotations: %1")
                          .arg(QString::fromStdString(companions.annotations->message)));
    }
}

std::optional<LeftoverProject> ProjectController::leftover() const
{
    auto leftovers = autosave_.leftovers();
    return leftovers.empty() ? std::nullopt : std::optional(std::move(leftovers.front()));
}

void ProjectController::recover(const LeftoverProject& leftover)
{
    readSoon(
        QString::fromStdString(leftover.file.string()),
        [leftover](JobMonitor& monitor) {
            return ProjectAutosave::wholeProject(leftover, monitor);
        },
        [this, leftover](const ReadProject& read) {
            replace(read.project, read.file);
            is_recovered_ = true;
            autosave_.write(state(), [leftover] { ProjectAutosave::remove(leftover); });
            Q_EMIT changed();
        });
}

void ProjectController::autosaveNow()
{
    autosave_timer_.stop();
    if (isModified()) {
        autosave_.write(state());
        autosave_.wait();
    }
}

// Once the maps are loaded: which of them is on top decides what the camera's coordinates mean.
void ProjectController::showCamera()
{
    if ((!camera_ && !pending_scene_) || session_.isBusy() || !view_.map()) {
        return;
    }
    const auto shown = shownLayers(session_.session());
    if (shown.empty() || shown.front()->map != view_.map()) {
        return;
    }
    const auto& missing = session_.session().missing;
    if (std::any_of(missing.begin(), missing.end(), [&](const MissingLayer& layer) {
            return layer.record.is_visible && layer.id < shown.front()->id;
        })) {
        return; // the coordinates may be those of a layer that is yet to be located
    }
    if (const auto camera = std::exchange(camera_, std::nullopt)) {
        const Georeference& georeference = view_.map()->georeference();
        const GridPoint grid = georeference.toGrid(MapPoint{camera->x, camera->y});
        view_.setCamera({.target = georeference.sceneFrame().toScene(
                             grid, camera->elevation_m * view_.exaggeration()),
                         .distance_m = camera->distance_m,
                         .azimuth = camera->azimuth,
                         .tilt = camera->tilt,
                         .field_of_view = camera->field_of_view});
    }
    const auto scene = std::exchange(pending_scene_, std::nullopt);
    if (scene && scene_.show) {
        scene_.show(scene->choice, scene->globe_camera);
    }
}

} // namespace marsview
