#include "ui/controllers/detached_jobs.h"

#include <chrono>
#include <thread>

namespace marsview {
namespace {

// For jobs that are about to end anyway.
constexpr std::chrono::milliseconds kEndPatience{300};

} // namespace

DetachedJobs::DetachedJobs(QObject& owner)
    : outlet_(std::make_shared<Outlet>())
{
    outlet_->owner_ = &owner;
}

DetachedJobs::~DetachedJobs()
{
    std::unique_lock lock(outlet_->mutex_);
    outlet_->owner_ = nullptr;
    outlet_->ended_.wait_for(lock, kEndPatience, [this] { return outlet_->jobs_ == 0; });
}

void DetachedJobs::run(Job job)
{
    {
        const std::lock_guard lock(outlet_->mutex_);
        ++outlet_->jobs_;
    }
    std::thread([outlet = outlet_, job = std::move(job)]() mutable {
        {
            const std::lock_guard one_at_a_time(outlet->running_);
            job(outlet);
            job = nullptr; // releases its captures before the owner can be destroyed
        }
        const std::lock_guard lock(outlet->mutex_);
        --outlet->jobs_;
        outlet->ended_.notify_all();
    }).detach();
}

} // namespace marsview
