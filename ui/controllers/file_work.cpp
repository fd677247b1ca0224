#include "ui/controllers/file_work.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace marsview {
namespace {

using namespace std::chrono_literals;

constexpr auto kPollInterval = 150ms;
constexpr qint64 kMomentMs = 300; // no progress of shorter jobs

} // namespace

FileWork::FileWork(QObject* parent)
    : QObject(parent)
{
    timer_.setInterval(kPollInterval);
    connect(&timer_, &QTimer::timeout, this, &FileWork::report);
}

std::shared_ptr<JobMonitor>
FileWork::begin(const QObject& owner, const QString& text, const QString& file)
{
    Job job{.owner = &owner,
            .text = text,
            .file = file,
            .monitor = std::make_shared<JobMonitor>(),
            .since = {}};
    job.since.start();
    jobs_.push_back(job);
    timer_.start();
    return job.monitor;
}

void FileWork::end(const std::shared_ptr<JobMonitor>& monitor)
{
    std::erase_if(jobs_, [&monitor](const Job& job) { return job.monitor == monitor; });
    if (jobs_.empty()) {
        timer_.stop();
        if (std::exchange(is_reported_, false)) {
            Q_EMIT ended();
        }
        Q_EMIT idle();
    }
}

void FileWork::cancel()
{
    for (const Job& job : jobs_) {
        job.monitor->cancel();
    }
}

void FileWork::cancelOf(const QObject& owner)
{
    for (const Job& job : jobs_) {
        if (job.owner == &owner) {
            job.monitor->cancel();
        }
    }
}

void FileWork::report()
{
    if (!jobs_.empty() && jobs_.front().since.elapsed() >= kMomentMs) {
        const Job job = jobs_.front();
        is_reported_ = true;
        Q_EMIT progressed(job.text, job.file, job.monitor->fraction());
    }
}

} // namespace marsview
