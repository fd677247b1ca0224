// A thread that may never end, and whoever made it goes on all the same.
#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

namespace marsview {

/// For work that calls what may hang: drivers of devices. The work owns all that it uses, so that
/// the thread can be left alone.
class LeavableThread {
public:
    /// `work()` begins at once; it does not throw.
    template <typename F>
    explicit LeavableThread(F work)
        : state_(std::make_shared<State>())
        , thread_([state = state_, work = std::move(work)]() mutable {
            work();
            const std::lock_guard lock(state->mutex);
            state->is_over = true;
            state->over.notify_all();
        })
    {}
    /// Waits, unless it was left alone.
    ~LeavableThread() { join(); }
    LeavableThread(const LeavableThread&) = delete;
    LeavableThread& operator=(const LeavableThread&) = delete;

    /// Until the work is over, however long that takes.
    void join()
    {
        if (thread_.joinable()) {
            thread_.join();
        }
    }
    /// The same for no longer than `patience`. False: leave() it.
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
    /// It goes on by itself, and nobody waits for it any more.
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
