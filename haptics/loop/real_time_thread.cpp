#include "haptics/loop/real_time_thread.h"

#include "core/base/check.h"
#include "haptics/loop/realtime_kit.h"
#include "haptics/loop/thread_faults.h"
#include "haptics/sync/page_lock.h"

#include <cstddef>
#include <cstring>
#include <ctime>
#include <pthread.h>
#include <sched.h>

namespace marsview {
namespace {

std::string reason(int error)
{
    return std::strerror(error); // NOLINT(concurrency-mt-unsafe): glibc's is
}

std::string refusalOfScheduling(int priority)
{
    sched_param parameters{};
    parameters.sched_priority = priority;
    const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
    return error == 0 ? std::string()
                      : reason(error) + "; ask for it with ulimit -r or CAP_SYS_NICE";
}

// Deeper calls then find their pages resident.
[[gnu::noinline]] void touchStack(std::size_t bytes)
{
    constexpr std::size_t kPage = 4096;
    volatile char page[kPage]; // NOLINT(modernize-avoid-c-arrays): a page of the stack
    page[0] = 0;
    if (bytes > kPage) {
        touchStack(bytes - kPage);
    }
    page[kPage - 1] = page[0]; // prevents a tail call
}

// The part of this thread's stack that deeper calls use.
MemoryRange stackBelow(std::size_t bytes) noexcept
{
    const auto* here = static_cast<const std::byte*>(__builtin_frame_address(0));
    return {here - bytes, bytes};
}

LoopTime now() noexcept
{
    return std::chrono::steady_clock::now();
}

// The steady clock is CLOCK_MONOTONIC.
void sleepUntil(LoopTime time) noexcept
{
    const auto ns = time.time_since_epoch().count();
    constexpr std::int64_t kSecond = 1'000'000'000;
    const timespec until{ns / kSecond, ns % kSecond};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
    }
}

} // namespace

void RealTimeThread::start(const RealTimeOptions& options,
                           const std::shared_ptr<void>& self,
                           Tick tick)
{
    MARSVIEW_CHECK(options.period.count() > 0);
    thread_.emplace(
        [options, self, tick, shared = shared_] { run(options, self.get(), tick, *shared); });
}

RealTimeThread::~RealTimeThread()
{
    stop();
}

void RealTimeThread::run(const RealTimeOptions& options, void* self, Tick tick, Shared& shared)
{
    RealTimeGrants& grants = shared.grants;
    LoopStatistics& statistics = shared.statistics;
    grants.scheduling_refusal = refusalOfScheduling(options.priority);
    if (!grants.hasScheduling() && options.asks_realtime_kit) {
        const std::string refusal = askRealtimeKit(options.priority);
        grants.scheduling_refusal =
            refusal.empty() ? std::string() : grants.scheduling_refusal + "; " + refusal;
    }
    touchStack(options.stack_bytes_touched);
    std::optional<ProcessLock> lock;
    if (options.locks_memory) {
        std::vector<MemoryRange> memory = options.memory;
        memory.push_back(stackBelow(options.stack_bytes_touched));
        grants.locking_refusal = lock.emplace(memory).refusal();
    } else {
        grants.locking_refusal = "not requested";
    }
    touchProgram();
    shared.has_grants.store(true, std::memory_order_release);

    ThreadFaults before = faultsOfThisThread();
    const auto countFaults = [&]() noexcept {
        const ThreadFaults after = faultsOfThisThread();
        statistics.minor_faults = after.minor - before.minor;
        statistics.major_faults = after.major - before.major;
    };
    LoopTurn turn;
    turn.deadline = now() + options.period;
    LoopTime last_begin{};
    for (std::uint64_t number = 0; !shared.is_stopping.load(std::memory_order_relaxed); ++number) {
        if (options.lead.count() > 0) {
            sleepUntil(turn.deadline - options.lead);
            if (now() < turn.deadline - options.lead / 2) { // otherwise it would delay the turn
                tick(self, {.number = number, .deadline = turn.deadline, .is_preparation = true});
            }
        }
        sleepUntil(turn.deadline);
        if (number == options.uncounted_turns) {
            statistics = {};
            before = faultsOfThisThread();
        }
        turn.begin = now();
        const double dt_s =
            number == 0 ? 0.0 : std::chrono::duration<double>(turn.begin - last_begin).count();
        last_begin = turn.begin;
        const LoopOutcome outcome =
            tick(self, {.number = number, .deadline = turn.deadline, .dt_s = dt_s});
        turn.end = now();
        turn.deadline = statistics.add(turn, options.period);
        // Between turns, where there is time: takes a microsecond.
        constexpr std::uint64_t kPublishEvery = 128;
        if (outcome == LoopOutcome::Stop || number % kPublishEvery == kPublishEvery - 1) {
            countFaults();
            shared.published.write(statistics);
            shared.has_published.store(true, std::memory_order_release);
        }
        if (outcome == LoopOutcome::Stop) {
            return;
        }
    }
    countFaults();
}

} // namespace marsview
