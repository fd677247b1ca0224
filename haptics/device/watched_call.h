// Calls that may never return.
#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <type_traits>
#include <utility>

namespace marsview {

/// Runs `work` on its own thread and waits for the result. Empty if that takes longer than
/// `patience`: the thread is then abandoned and destroys a late result itself, so `work` owns all
/// that it uses. What `work` owns is destroyed before its result is returned, so that no thread
/// still holds a device that its caller closes next. `work` does not throw.
template <typename F>
auto callWatched(std::chrono::milliseconds patience, F work)
    -> std::optional<std::invoke_result_t<F&>>
{
    using Outcome = std::invoke_result_t<F&>;
    struct State {
        explicit State(F w)
            : work(std::in_place, std::move(w))
        {}
        std::optional<F> work;
        std::mutex mutex;
        std::condition_variable done;
        std::optional<Outcome> outcome;
        bool is_abandoned = false;
    };
    const auto state = std::make_shared<State>(std::move(work));
    std::thread([state] {
        std::optional<Outcome> outcome = (*state->work)();
        state->work.reset();
        const std::lock_guard lock(state->mutex);
        if (!state->is_abandoned) {
            state->outcome = std::move(outcome);
            state->done.notify_one();
        }
    }).detach();
    std::unique_lock lock(state->mutex);
    if (!state->done.wait_for(lock, patience, [&] { return state->outcome.has_value(); })) {
        state->is_abandoned = true;
        return std::nullopt;
    }
    return std::move(state->outcome);
}

} // namespace marsview
