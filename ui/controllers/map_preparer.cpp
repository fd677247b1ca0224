#include "ui/controllers/map_preparer.h"

#include "core/base/job_monitor.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace marsview {
namespace {

constexpr std::chrono::milliseconds kReportInterval{100};

// Seconds against the minutes that overviews take.
DecimationLimits betterPreview()
{
    DecimationLimits limits;
    limits.time_max = std::chrono::seconds(6);
    return limits;
}

} // namespace

bool isPreparedAlike(const RasterSpec& a, const RasterSpec& b)
{
    return a.path == b.path && a.band == b.band && a.overrides.nodata == b.overrides.nodata;
}

struct MapPreparer::Job {
    PrepareRequest request;
    MapOpener opener;
    JobMonitor previewing; // not part of the progress that is reported
    JobMonitor monitor;
    std::function<void(const std::shared_ptr<const Map>&)> tell_preview;

    void cancel()
    {
        previewing.cancel();
        monitor.cancel();
    }
};

MapPreparer::MapPreparer(QObject* parent)
    : QObject(parent)
{
    // One at a time: a map that is restarted right after it was stopped waits until the stopped
    // attempt has closed its files.
    pool_.setMaxThreadCount(1);
    progress_timer_.setInterval(kReportInterval);
    connect(&progress_timer_, &QTimer::timeout, this, &MapPreparer::reportProgress);
}

MapPreparer::~MapPreparer()
{
    if (job_) {
        job_->cancel();
    }
    // Jobs post to this object: none may be left when it is destroyed.
    pool_.waitForDone();
}

void MapPreparer::enqueue(const PrepareRequest& request)
{
    if (has(request.spec)) {
        return;
    }
    waiting_.push_back(request);
    startNext();
}

void MapPreparer::remove(const RasterSpec& spec)
{
    std::erase_if(waiting_, [&spec](const PrepareRequest& request) {
        return isPreparedAlike(request.spec, spec);
    });
    if (job_ && isPreparedAlike(job_->request.spec, spec)) {
        dropCurrent();
        startNext();
    }
}

void MapPreparer::removeAll()
{
    waiting_.clear();
    if (job_) {
        dropCurrent();
        startNext();
    }
}

std::optional<RasterSpec> MapPreparer::current() const
{
    return job_ ? std::optional(job_->request.spec) : std::nullopt;
}

std::vector<RasterSpec> MapPreparer::all() const
{
    std::vector<RasterSpec> specs;
    if (job_) {
        specs.push_back(job_->request.spec);
    }
    for (const PrepareRequest& request : waiting_) {
        specs.push_back(request.spec);
    }
    return specs;
}

bool MapPreparer::has(const RasterSpec& spec) const
{
    const std::vector<RasterSpec> specs = all();
    return std::any_of(specs.begin(), specs.end(),
                       [&spec](const RasterSpec& other) { return isPreparedAlike(other, spec); });
}

// ended() follows for whatever reason nothing is in progress any more.
void MapPreparer::startNext()
{
    if (job_) {
        return;
    }
    if (waiting_.empty()) {
        progress_timer_.stop();
        Q_EMIT ended();
        return;
    }
    job_ = std::make_shared<Job>();
    job_->request = std::move(waiting_.front());
    waiting_.pop_front();
    job_->opener = opener_;
    const std::weak_ptr<Job> of = job_;
    job_->tell_preview = [this, of](const std::shared_ptr<const Map>& map) {
        QMetaObject::invokeMethod(
            this,
            [this, of, map] {
                if (const auto job = of.lock(); job && job == job_) {
                    Q_EMIT previewed(map);
                }
            },
            Qt::QueuedConnection);
    };
    time_left_ = {};
    progress_timer_.start();
    reportProgress();
    pool_.start([this, job = job_] {
        Status outcome = run(*job);
        QMetaObject::invokeMethod(
            this, [this, job, outcome = std::move(outcome)] { finish(job, outcome); },
            Qt::QueuedConnection);
    });
}

void MapPreparer::dropCurrent()
{
    if (job_) {
        job_->cancel();
        job_.reset();
    }
}

Status MapPreparer::run(Job& job)
{
    const RasterSpec& spec = job.request.spec;
    try {
        if (job.request.is_preview_wanted && !job.monitor.isCanceled()) {
            if (const auto preview = job.opener.preview(spec, betterPreview(), job.previewing)) {
                job.tell_preview(*preview);
            }
        }
        if (job.monitor.isCanceled()) {
            return Error{ErrorCode::Canceled, spec.path + ": building overviews was canceled"};
        }
        return job.opener.prepare(spec, job.opener.resources, job.monitor);
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::TooLarge,
                     spec.path + ": not enough memory to build overviews; close other programs"};
    } catch (const std::exception& e) {
        return Error{ErrorCode::Unreadable, spec.path + ": " + e.what()};
    }
}

void MapPreparer::finish(const std::shared_ptr<Job>& job, const Status& outcome)
{
    if (job != job_) {
        return; // removed after this was posted
    }
    job_.reset();
    const RasterSpec spec = job->request.spec;
    if (outcome) {
        Q_EMIT prepared(spec);
    } else {
        Q_EMIT failed({.spec = spec, .error = outcome.error()});
    }
    startNext();
}

void MapPreparer::reportProgress()
{
    if (!job_) {
        return;
    }
    const double fraction = job_->monitor.fraction();
    time_left_.report(fraction, std::chrono::steady_clock::now().time_since_epoch());
    Q_EMIT progressed({.spec = job_->request.spec,
                       .fraction = fraction,
                       .left = time_left_.left(),
                       .waiting_count = static_cast<int>(waiting_.size())});
}

} // namespace marsview
