#include "ui/controllers/load_controller.h"

#include "core/base/job_monitor.h"
#include "core/files/opening_job.h"

#include <chrono>
#include <exception>
#include <utility>

namespace marsview {
namespace {

constexpr std::chrono::milliseconds kProgressInterval{33};

// A job that was canceled inside a slow network read must not hold up the next one.
constexpr int kThreadCountMax = 4;

} // namespace

struct LoadController::Job {
    LoadRequest request;
    MapOpener opener;
    JobMonitor monitor;
};

LoadController::LoadController(QObject* parent)
    : QObject(parent)
{
    pool_.setMaxThreadCount(kThreadCountMax);
    progress_timer_.setInterval(kProgressInterval);
    connect(&progress_timer_, &QTimer::timeout, this, &LoadController::reportProgress);
}

LoadController::~LoadController()
{
    if (job_) {
        job_->monitor.cancel();
    }
    // Jobs post to this object, so all must end before it is destroyed. Posted results are
    // discarded with it.
    pool_.waitForDone();
}

void LoadController::start(const LoadRequest& request)
{
    abandon();
    job_ = std::make_shared<Job>();
    job_->request = request;
    job_->opener = opener_;
    Q_EMIT started(request.spec);
    progress_timer_.start();
    reportProgress();
    pool_.start([this, job = job_] {
        Result<std::shared_ptr<const Map>> outcome = run(*job);
        QMetaObject::invokeMethod(
            this, [this, job, outcome = std::move(outcome)] { finish(job, outcome); },
            Qt::QueuedConnection);
    });
}

void LoadController::cancel()
{
    if (!job_) {
        return;
    }
    const RasterSpec spec = job_->request.spec;
    abandon();
    Q_EMIT canceled(spec);
}

void LoadController::abandon()
{
    if (job_) {
        job_->monitor.cancel();
        job_.reset();
        progress_timer_.stop();
    }
}

Result<std::shared_ptr<const Map>> LoadController::run(Job& job)
{
    const LoadRequest& request = job.request;
    const OpeningJob opening(&job.monitor);
    try {
        if (request.loaded) {
            auto map = withOverrides(*request.loaded, request.spec.overrides, job.monitor);
            if (map || map.error().code != ErrorCode::Unsupported) {
                return map;
            }
        }
        return job.opener.open(request.spec, job.opener.resources, job.monitor);
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::TooLarge, request.spec.path +
                                              ": needs more memory than there is; close other "
                                              "programs or open a smaller map"};
    } catch (const std::exception& e) {
        return Error{ErrorCode::Unreadable, request.spec.path + ": " + e.what()};
    }
}

void LoadController::finish(const std::shared_ptr<Job>& job,
                            const Result<std::shared_ptr<const Map>>& outcome)
{
    if (job != job_) {
        return; // canceled, or another load was started, after this one was posted
    }
    reportProgress();
    job_.reset();
    progress_timer_.stop();
    if (outcome) {
        Q_EMIT succeeded(*outcome);
    } else {
        Q_EMIT failed({.spec = job->request.spec, .error = outcome.error()});
    }
}

void LoadController::reportProgress()
{
    Q_EMIT progressed(job_->monitor.fraction());
}

} // namespace marsview
