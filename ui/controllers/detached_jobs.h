// Work that may never end, on threads that nobody waits for.
#pragma once

#include <QObject>

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

namespace marsview {

/// Jobs of one object, each on a thread of its own, one after the other. Made, used and destroyed
/// in the owner's thread; where a job hangs while the owner goes it is left alone, and what it has
/// to tell goes nowhere. So a job must not touch the owner, nor anything else that may be gone.
class DetachedJobs {
public:
    /// The way back to the owner; copies of the pointer live as long as they like.
    class Outlet {
    public:
        /// Calls a function in the owner's thread, where there still is an owner. Any thread.
        template <typename F>
        void post(F function)
        {
            const std::lock_guard lock(mutex_);
            if (owner_ != nullptr) {
                QMetaObject::invokeMethod(owner_, std::move(function), Qt::QueuedConnection);
            }
        }

    private:
        friend class DetachedJobs;
        std::mutex running_; // held by the job that runs
        std::mutex mutex_;   // of the following
        std::condition_variable ended_;
        QObject* owner_ = nullptr;
        int jobs_ = 0;
    };
    using Job = std::function<void(const std::shared_ptr<Outlet>&)>;

    /// A member of the owner, declared after what its posted functions use.
    explicit DetachedJobs(QObject& owner);
    /// Gives jobs that are about to end anyway a moment to do so.
    ~DetachedJobs();
    DetachedJobs(const DetachedJobs&) = delete;
    DetachedJobs& operator=(const DetachedJobs&) = delete;

    void run(Job job);

private:
    std::shared_ptr<Outlet> outlet_;
};

} // namespace marsview
