// A thread that can be detached if its work hangs.
#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

namespace marsview {

/// For work that calls functions that may hang, such as device drivers. The work owns all that it
/// uses, so that the thread can be detached.
class DetachableThread {
public:
    /// `work()` begins at once; it does not throw.
    template <typename F>
    explicit DetachableThread(F work)
        : state_(std::make_shared<State>())
        , thread_([state = state_, work = std::move(work)]() mutable {
            work();
            const std::lock_guard lock(state->mutex);
            state->is_over = true;
            state->over.notify_all();
        })
    {}
    /// Waits, unless the thread was detached.
    ~DetachableThread() { join(); }
    DetachableThread(const DetachableThread&) = delete;
    DetachableThread& operator=(const DetachableThread&) = delete;

    /// Waits until the work is over; no time limit.
    void join()
    {
        if (thread_.joinable()) {
            thread_.join();
        }
    }
    /// As join(), with a time limit. False: call leave().
    bool joinWithin(std::chrono::milliseconds patience)
    {
        {
            std::unique_lock lock(state_->mutex);
            if (!state_->over.wait_for(lock, patience, [this] { return state_->is_over; })) {
                return false;
            }
        }
        join();
        return true;
    }
    /// Detaches the thread.
    void leave()
    {
        if (thread_.joinable()) {
            thread_.detach();
        }
    }

private:
    struct State {
        std::mutex mutex;
        std::condition_variable over;
        bool is_over = false;
    };
    std::shared_ptr<State> state_;
    std::thread thread_;
};

} // namespace marsview
