// Loading maps away from the GUI thread.
#pragma once

#include "core/base/result.h"
#include "core/session/map.h"
#include "ui/controllers/map_opener.h"

#include <QObject>
#include <QThreadPool>
#include <QTimer>

#include <memory>

namespace marsview {

/// What to load.
struct LoadRequest {
    RasterSpec spec;
    /// The same file as it is loaded already: where nothing has to be read again, its samples are
    /// used. May be null.
    std::shared_ptr<const Map> loaded;
};

struct LoadFailure {
    RasterSpec spec;
    Error error;
};

/// Runs one load at a time. A map that is too large to be held, and not prepared, is loaded as a
/// preview. Starting another one, canceling, and destroying the controller end the
/// one that runs; nothing of it is heard of afterwards, whatever the moment. Lives in the GUI
/// thread; only the destructor may wait, for at most one step of reading.
class LoadController final : public QObject {
    Q_OBJECT

public:
    explicit LoadController(QObject* parent = nullptr);
    ~LoadController() override;

    /// For loads that are started from now on.
    void setOpener(const MapOpener& opener) { opener_ = opener; }

    void start(const LoadRequest& request);
    /// Empty if nothing is being loaded.
    void cancel();
    bool isLoading() const noexcept { return job_ != nullptr; }

Q_SIGNALS:
    void started(const RasterSpec& spec);
    /// `fraction` is in [0, 1].
    void progressed(double fraction);
    // One of the following ends each load, except one that gave way to another start().
    void succeeded(const std::shared_ptr<const Map>& map);
    void failed(const LoadFailure& failure);
    void canceled(const RasterSpec& spec);

private:
    struct Job;

    void abandon();
    static Result<std::shared_ptr<const Map>> run(Job& job);
    void finish(const std::shared_ptr<Job>& job, const Result<std::shared_ptr<const Map>>& outcome);
    void reportProgress();

    MapOpener opener_;
    QThreadPool pool_;
    QTimer progress_timer_;
    std::shared_ptr<Job> job_; // null when idle
};

} // namespace marsview
