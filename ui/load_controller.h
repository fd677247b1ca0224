// Loading maps away from the GUI thread.
#pragma once

#include "core/base/result.h"
#include "core/session/dataset.h"
#include "core/session/loaded_map.h"

#include <QObject>
#include <QThreadPool>
#include <QTimer>

#include <memory>

namespace marsview {

/// What to load.
struct LoadRequest {
    DatasetSpec spec;
    /// The same file as it is loaded already: where nothing has to be read again, its samples are
    /// used. May be null.
    std::shared_ptr<const Dataset> loaded;
};

enum class LoadStage { Reading, Preparing };

struct LoadProgress {
    LoadStage stage = LoadStage::Reading;
    double fraction = 0.0; // of the whole, both stages together
};

struct LoadFailure {
    DatasetSpec spec;
    Error error;
};

/// Runs one load at a time. Starting another one, cancelling, and destroying the controller end the
/// one that runs; nothing of it is heard of afterwards, whatever the moment. Lives in the GUI
/// thread; only the destructor may wait, for at most one step of reading.
class LoadController final : public QObject {
    Q_OBJECT

public:
    explicit LoadController(QObject* parent = nullptr);
    ~LoadController() override;

    void start(const LoadRequest& request);
    /// Nothing where nothing is loading.
    void cancel();
    bool isLoading() const noexcept { return job_ != nullptr; }

Q_SIGNALS:
    void started(const DatasetSpec& spec);
    void progressed(const LoadProgress& progress);
    // One of the following ends each load, except one that gave way to another start().
    void succeeded(const LoadedMap& map);
    void failed(const LoadFailure& failure);
    void cancelled(const DatasetSpec& spec);

private:
    struct Job;

    void abandon();
    static Result<LoadedMap> run(Job& job);
    void finish(const std::shared_ptr<Job>& job, const Result<LoadedMap>& outcome);
    void reportProgress();

    QThreadPool pool_;
    QTimer progress_timer_;
    std::shared_ptr<Job> job_; // null when idle
};

} // namespace marsview
