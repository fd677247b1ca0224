// Copies of unsaved projects, for the next start after a crash or a power failure.
#pragma once

#include "core/annotations/annotation_log.h"
#include "core/base/file_lock.h"
#include "core/session/project.h"
#include "ui/project/project_state.h"

#include <QObject>
#include <QString>
#include <QThreadPool>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <vector>

namespace marsview {

/// A copy that a program left behind which did not end properly.
struct LeftoverProject {
    std::filesystem::path copy;
    std::filesystem::path file; // of the project; empty if it was never saved
    Project project;            // its paths are absolute; without its annotations

    std::filesystem::path log; // of the annotations; empty if there are none
    std::uint64_t log_bytes = 0;
    std::vector<std::uint32_t> log_layers; // numbers in the log, of the layers of the project
};

/// Writes copies of one window's project, one at a time, on a thread of its own. A copy is a
/// project file, and next to it a log of the annotations (`AnnotationLog`), to which changes are
/// appended: one changed note costs one line, whatever the number of annotations. The project file
/// states how much of the log belongs to it, and replaces the one before as a whole once the log is
/// on the disk. GUI thread.
class ProjectAutosave final : public QObject {
    Q_OBJECT

public:
    /// Copies are files in `folder`, which is created. Without a folder nothing is written.
    explicit ProjectAutosave(std::filesystem::path folder, QObject* parent = nullptr);
    /// Waits for the copy that is being written. It stays until it is removed by discard().
    ~ProjectAutosave() override;

    /// Replaces the copy. Of states that arrive while one is being written, the last one is next.
    /// `then` is called once a copy with this state, or with a later one, is on the disk.
    void write(ProjectState state, std::function<void()> then = {});
    /// Removes the copy, once it is written if it is being written: the project was saved, or the
    /// user does not want to keep its changes.
    void discard();
    /// Waits until the copy is written.
    void wait();

    /// Copies of programs that do not run any more, the latest first. Damaged ones are skipped.
    std::vector<LeftoverProject> leftovers() const;
    /// Copies of other programs that still run, or whose end the system has not completed: it frees
    /// the memory of a program first, and its locks last.
    std::set<std::filesystem::path> copiesInUse() const;
    /// With the annotations. Reads their log, which takes seconds for a million. Any thread.
    static Result<Project> wholeProject(const LeftoverProject& leftover, JobMonitor& monitor);
    /// Removes such a copy.
    static void remove(const LeftoverProject& leftover);

Q_SIGNALS:
    /// A copy was written.
    void copied();

private:
    struct Job;

    void removeCopy();
    bool begin();
    void start();
    void finish();
    void removeLogsWithoutCopy(const std::set<std::filesystem::path>& known) const;

    std::filesystem::path folder_;
    std::filesystem::path copy_;   // empty before the first one
    std::optional<FileLock> lock_; // shows other programs that this one is running
    int logs_ = 0;                 // how many there have been
    std::shared_ptr<Job> job_;     // that runs
    bool is_discarding_ = false;   // when it has run
    // Items are released in this thread: it changes blocks of them in place that nobody shares.
    std::shared_ptr<const ProjectState> written_; // that the log has; null: none
    std::shared_ptr<const ProjectState> writing_;
    std::shared_ptr<const ProjectState> next_;
    std::vector<std::function<void()>> after_writing_; // callbacks of that state
    std::vector<std::function<void()>> after_next_;
    std::optional<AnnotationLog> log_;
    QThreadPool pool_;
};

} // namespace marsview
