// The project of a window: its file, whether it has unsaved changes, autosave.
#pragma once

#include "core/session/project.h"
#include "ui/project/project_autosave.h"

#include <QObject>
#include <QString>
#include <QStringList>
#include <QThreadPool>
#include <QTimer>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace marsview {

class AnnotationController;
class FileWork;
class MeasureController;
class SessionController;
class TerrainView;

struct ProjectOptions {
    std::filesystem::path bundled{};         // the maps that come with the program
    std::filesystem::path autosave_folder{}; // empty: no autosave
    int autosave_delay_ms = 5000;            // after a change
};

/// A project file that was read.
struct ReadProject {
    QString file;
    Project project;
};

/// Reads and writes the project of the session, the measurements and the annotations. Every change
/// that can be undone is a change of the project; cameras and scene are saved too, but are not
/// changes. Files are read and written in the background, one at a time, with progress, and can be
/// canceled.
/// Lives in the GUI thread; all that it is made of outlives its last call.
class ProjectController final : public QObject {
    Q_OBJECT

public:
    ProjectController(SessionController& session,
                      MeasureController& measuring,
                      AnnotationController& annotating,
                      TerrainView& view,
                      FileWork& work,
                      const ProjectOptions& options,
                      QObject* parent = nullptr);
    /// Waits for what is being written.
    ~ProjectController() override;

    /// The path of the project file; empty if it was never saved.
    const QString& file() const noexcept { return file_; }
    /// Whether closing would lose something, or it is still being saved. A session that was never
    /// saved and in which maps were only opened is not modified.
    bool isModified() const;
    /// The scene of the window, which is not this object's. Without it, projects have the flat map.
    struct Scene {
        std::function<SceneChoice()> choice;
        std::function<std::optional<ViewCamera>()> globe_camera;
        std::function<void(SceneChoice, const std::optional<ViewCamera>&)> show;
    };
    void setScene(Scene scene) { scene_ = std::move(scene); }
    /// The session, the measurements and the camera as they would be saved.
    Project project() const;

    /// Replaces the session by an empty one.
    void startNew();
    /// Reads a project file for open(). Calls `then` with it, or emits failed() and calls
    /// `otherwise`; neither if reading is canceled.
    void read(const QString& file,
              const std::function<void(const ReadProject&)>& then,
              const std::function<void()>& otherwise = {});
    /// Replaces the session by that of the file.
    void open(const ReadProject& read);
    /// To file(), which is not empty, as the project is now. Emits saved() and calls `then` once it
    /// is on the disk, or emits failed(). Measurements and annotations are then also written next
    /// to it as GeoPackages for other programs; these are never read.
    void save(const std::function<void()>& then = {});
    /// To another file, which becomes file(). Adds the extension if there is none.
    void saveAs(const QString& file, const std::function<void()>& then = {});
    /// A project file is being written.
    bool isSaving() const noexcept { return saving_ > 0; }
    /// A project file is being read.
    bool isReading() const noexcept { return !readings_.empty(); }

    /// The copies that crashes left behind, the latest first.
    std::vector<LeftoverProject> leftovers() const { return autosave_.leftovers(); }
    /// The first of them; empty if there is none.
    std::optional<LeftoverProject> leftover() const;
    /// Copies that other programs have locked; see ProjectAutosave.
    std::set<std::filesystem::path> copiesInUse() const { return autosave_.copiesInUse(); }
    /// Reads such a copy and replaces the session by it, with unsaved changes. Removes the copy
    /// once there is another one. Emits failed() if its annotations cannot be read.
    void recover(const LeftoverProject& leftover);
    /// Removes the copy: the project was saved, or its changes are not to be kept.
    void discardAutosave() { autosave_.discard(); }
    /// Writes the copy now and waits for it.
    void autosaveNow();

    /// The project file or the GeoPackages next to it are being written.
    bool isWriting() const noexcept { return writing_ > 0; }

Q_SIGNALS:
    /// file() or isModified().
    void changed();
    void opened(const QString& file);
    void saved(const QString& file);
    /// Saving has ended: the project and the GeoPackages that it wrote.
    void written(const QStringList& files);
    /// "FILE: WHY"
    void failed(const QString& problem);
    /// isSaving() or isReading() has ended.
    void idle();

private:
    struct Saving;
    struct SavedScene {
        SceneChoice choice = SceneChoice::Automatic;
        std::optional<ViewCamera> globe_camera;
    };

    void readSoon(const QString& file,
                  const std::function<Result<Project>(JobMonitor&)>& read,
                  const std::function<void(const ReadProject&)>& then,
                  const std::function<void()>& otherwise = {});
    void takeSaved(const QString& path, const Status& status, const std::function<void()>& then);
    // The outcome of writing the files next to a project.
    struct Companions {
        std::optional<Error> measurements;
        std::optional<Error> annotations;
        std::vector<std::filesystem::path> files; // that are written
    };
    void reportCompanions(const QString& path, const Companions& companions);
    ProjectState state() const;
    void replace(const Project& project, const QString& file);
    bool isNothingToKeep() const;
    void noteOpened();
    void noteChange();
    void showCamera();

    SessionController& session_;
    MeasureController& measuring_;
    AnnotationController& annotating_;
    TerrainView& view_;
    ProjectOptions options_;
    QString file_;
    bool is_recovered_ = false; // unsaved, although there is no step of undo
    bool is_replacing_ = false;
    std::map<std::string, std::string> others_; // members for other versions
    std::optional<ProjectCamera> camera_;       // to be set when the maps are there
    std::optional<SavedScene> pending_scene_;   // likewise
    Scene scene_;
    ProjectAutosave autosave_;
    QTimer autosave_timer_;
    FileWork& work_;
    std::vector<std::shared_ptr<JobMonitor>> readings_;
    int saving_ = 0;   // project files
    int writing_ = 0;  // the files next to them as well
    QThreadPool pool_; // of one thread: a later save overwrites an earlier one
};

/// The camera of the view in map coordinates of the topmost map. Empty without a map.
std::optional<ProjectCamera> projectCamera(const TerrainView& view);

} // namespace marsview
