// Builds the overviews of maps that are too large for memory, away from the GUI thread.
#pragma once

#include "core/base/result.h"
#include "core/base/time_left.h"
#include "core/session/map.h"
#include "ui/controllers/load_controller.h"
#include "ui/controllers/map_opener.h"

#include <QObject>
#include <QThreadPool>
#include <QTimer>

#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// Whether the overviews of one serve the other: the samples are the same, whatever the overrides
/// say about them.
bool isPreparedAlike(const RasterSpec& a, const RasterSpec& b);

struct PrepareRequest {
    RasterSpec spec;
    bool is_preview_wanted = false; // a better one than is shown
};

struct PrepareProgress {
    RasterSpec spec;
    double fraction = 0.0;
    std::optional<std::chrono::seconds> left;
    int waiting_count = 0; // of further maps
};

/// Builds the overviews of one map at a time. A map that is removed, or destroyed with this object,
/// stops at its next step and can be resumed; it emits no signal afterwards. Lives in the GUI
/// thread; only the destructor may wait, for at most one step.
class MapPreparer final : public QObject {
    Q_OBJECT

public:
    explicit MapPreparer(QObject* parent = nullptr);
    ~MapPreparer() override;

    /// For maps that are started from now on.
    void setOpener(const MapOpener& opener) { opener_ = opener; }

    /// Without effect if the map is in progress or waits already.
    void enqueue(const PrepareRequest& request);
    /// Without effect if the map is neither in progress nor waits.
    void remove(const RasterSpec& spec);
    void removeAll();

    bool isBusy() const noexcept { return job_ != nullptr; }
    /// The map in progress, if any.
    std::optional<RasterSpec> current() const;
    /// The map in progress and those that wait.
    std::vector<RasterSpec> all() const;
    /// The map is in progress or waits.
    bool has(const RasterSpec& spec) const;

Q_SIGNALS:
    void progressed(const PrepareProgress& progress);
    /// A better preview, while overviews are being built.
    void previewed(const std::shared_ptr<const Map>& map);
    // One of the following ends each map, except those that were removed.
    void prepared(const RasterSpec& spec);
    void failed(const LoadFailure& failure);
    /// No map is in progress any more.
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
