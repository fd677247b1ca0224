// Work that may never end, on detached threads.
#pragma once

#include <QObject>

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

namespace marsview {

/// Jobs of one object, each on its own thread, one after the other. Created, used and destroyed in
/// the owner's thread. A job that hangs while the owner is destroyed keeps running, and its results
/// are discarded. So a job must not access the owner, nor anything else that may be destroyed.
class DetachedJobs {
public:
    /// The way back to the owner; copies of the pointer live as long as they like.
    class Outlet {
    public:
        /// Calls a function in the owner's thread, if the owner still exists. Any thread.
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
