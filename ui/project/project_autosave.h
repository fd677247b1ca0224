// Copies of unsaved projects, for the next start after a crash or a power failure.
#pragma once

#include "core/base/file_lock.h"
#include "core/session/project.h"

#include <QObject>
#include <QString>
#include <QThreadPool>

#include <filesystem>
#include <optional>
#include <vector>

namespace marsview {

/// A copy that a program left behind which did not end properly.
struct LeftoverProject {
    std::filesystem::path copy;
    std::filesystem::path file; // of the project; empty if it was never saved
    Project project;            // its paths are absolute
};

/// Writes copies of one window's project, one at a time, on a thread of its own. GUI thread.
class ProjectAutosave final : public QObject {
    Q_OBJECT

public:
    /// Copies are files in `folder`, which is created. Without a folder nothing is written.
    explicit ProjectAutosave(std::filesystem::path folder, QObject* parent = nullptr);
    /// Waits for the copy that is being written. It stays until it is removed by discard().
    ~ProjectAutosave() override;

    /// Replaces the copy. `file` is the path of the project, empty if it was never saved.
    void write(const Project& project, const std::filesystem::path& file);
    /// Removes the copy: the project was saved, or the user does not want to keep its changes.
    void discard();
    /// Waits until the copy is written.
    void wait() { pool_.waitForDone(); }

    /// Copies of programs that do not run any more, the latest first. Damaged ones are skipped.
    std::vector<LeftoverProject> leftovers() const;
    /// Removes such a copy.
    static void remove(const LeftoverProject& leftover);

private:
    bool begin();

    std::filesystem::path folder_;
    std::filesystem::path copy_;   // empty before the first one
    std::optional<FileLock> lock_; // shows other programs that this one is running
    QThreadPool pool_;
};

} // namespace marsview
