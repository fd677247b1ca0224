// Preparing maps that are too large to be held, away from the GUI thread.
#pragma once

#include "core/base/result.h"
#include "core/base/time_left.h"
#include "core/session/dataset.h"
#include "ui/load_controller.h"
#include "ui/map_opener.h"

#include <QObject>
#include <QThreadPool>
#include <QTimer>

#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// Whether what is prepared for the one serves the other: they differ only in what is told of the
/// samples, not in the samples.
bool isPreparedAlike(const DatasetSpec& a, const DatasetSpec& b);

struct PrepareRequest {
    DatasetSpec spec;
    bool is_preview_wanted = false; // a better one than there is
};

struct PrepareProgress {
    DatasetSpec spec;
    double fraction = 0.0;
    std::optional<std::chrono::seconds> left;
    int waiting_count = 0; // of further maps
};

/// Prepares one map after the other. What is taken back or ends with the object stops at its next
/// step and can be gone on with; nothing of it is heard of afterwards. Lives in the GUI thread;
/// only the destructor may wait, for at most one step.
class MapPreparer final : public QObject {
    Q_OBJECT

public:
    explicit MapPreparer(QObject* parent = nullptr);
    ~MapPreparer() override;

    /// For maps whose preparation begins from now on.
    void setOpener(const MapOpener& opener) { opener_ = opener; }

    /// Nothing where the map is being prepared or waits for it.
    void enqueue(const PrepareRequest& request);
    /// Nothing where the map is not there.
    void remove(const DatasetSpec& spec);
    void removeAll();

    bool isBusy() const noexcept { return job_ != nullptr; }
    /// What is being prepared; nothing where there is none.
    std::optional<DatasetSpec> current() const;
    /// What is being prepared and what waits for it.
    std::vector<DatasetSpec> all() const;
    /// Is being prepared, or waits for it.
    bool has(const DatasetSpec& spec) const;

Q_SIGNALS:
    void progressed(const PrepareProgress& progress);
    /// A better preview, while it goes on.
    void previewed(const LoadedMap& map);
    // One of the following ends each, except what was taken back.
    void prepared(const DatasetSpec& spec);
    void failed(const LoadFailure& failure);
    /// Nothing is being prepared any more.
    void ended();

private:
    struct Job;

    void startNext();
    void dropCurrent();
    static Status run(Job& job);
    void finish(const std::shared_ptr<Job>& job, const Status& outcome);
    void reportProgress();

    MapOpener opener_;
    QThreadPool pool_;
    QTimer progress_timer_;
    std::shared_ptr<Job> job_; // null when idle
    TimeLeft time_left_;
    std::deque<PrepareRequest> waiting_;
};

} // namespace marsview
