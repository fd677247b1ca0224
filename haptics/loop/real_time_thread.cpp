#include "haptics/loop/real_time_thread.h"

#include "core/base/check.h"
#include "haptics/loop/page_lock.h"
#include "haptics/loop/realtime_kit.h"

#include <cerrno>
#include <cstring>
#include <ctime>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>

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

// Pages are locked as they are touched: locking all that is only reserved, the stacks of all
// threads for instance, would touch it.
std::string refusalOfLocking()
{
#if defined(MCL_ONFAULT)
    if (mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0) {
        return {};
    }
    return reason(errno) + "; ask for it with ulimit -l or CAP_IPC_LOCK";
#else
    return "this system cannot lock pages as they are touched";
#endif
}

// Deeper calls than this one find their pages there.
[[gnu::noinline]] void touchStack(std::size_t bytes)
{
    constexpr std::size_t kPage = 4096;
    volatile char page[kPage]; // NOLINT(modernize-avoid-c-arrays): a page of the stack
    page[0] = 0;
    if (bytes > kPage) {
        touchStack(bytes - kPage);
    }
    page[kPage - 1] = page[0]; // not a tail call
}

struct Faults {
    std::uint64_t minor = 0;
    std::uint64_t major = 0;
};

Faults faultsOfThisThread() noexcept
{
    rusage usage{};
    getrusage(RUSAGE_THREAD, &usage);
    return {static_cast<std::uint64_t>(usage.ru_minflt),
            static_cast<std::uint64_t>(usage.ru_majflt)};
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

void RealTimeThread::start(const RealTimeOptions& options, std::shared_ptr<void> self, Tick tick)
{
    MARSVIEW_CHECK(options.period.count() > 0);
    self_ = std::move(self);
    published_ = std::make_unique<SeqLock<LoopStatistics>>();
    thread_ = std::thread([this, options, tick] { run(options, self_.get(), tick); });
}

RealTimeThread::~RealTimeThread()
{
    stop();
    join();
}

void RealTimeThread::join()
{
    if (thread_.joinable()) {
        thread_.join();
    }
}

void RealTimeThread::run(const RealTimeOptions& options, void* self, Tick tick)
{
    grants_.scheduling_refusal = refusalOfScheduling(options.priority);
    if (!grants_.hasScheduling() && options.asks_realtime_kit) {
        const std::string refusal = askRealtimeKit(options.priority);
        grants_.scheduling_refusal =
            refusal.empty() ? std::string() : grants_.scheduling_refusal + "; " + refusal;
    }
    grants_.locking_refusal = options.locks_memory ? refusalOfLocking() : "not asked for";
    touchProgram();
    has_grants_.store(true, std::memory_order_release);
    touchStack(options.stack_bytes_touched);

    Faults before = faultsOfThisThread();
    LoopTurn turn;
    turn.deadline = now() + options.period;
    LoopTime last_begin{};
    for (std::uint64_t number = 0; !is_stopping_.load(std::memory_order_relaxed); ++number) {
        sleepUntil(turn.deadline);
        if (number == options.uncounted_turns) {
            statistics_ = {};
            before = faultsOfThisThread();
        }
        turn.begin = now();
        const double dt_s =
            number == 0 ? 0.0 : std::chrono::duration<double>(turn.begin - last_begin).count();
        last_begin = turn.begin;
        const LoopOutcome outcome =
            tick(self, {.number = number, .deadline = turn.deadline, .dt_s = dt_s});
        turn.end = now();
        turn.deadline = statistics_.add(turn, options.period);
        // Between turns, where there is time: a microsecond.
        constexpr std::uint64_t kPublishEvery = 128;
        if (outcome == LoopOutcome::Stop || number % kPublishEvery == kPublishEvery - 1) {
            const Faults after = faultsOfThisThread();
            statistics_.minor_faults = after.minor - before.minor;
            statistics_.major_faults = after.major - before.major;
            published_->write(statistics_);
            has_published_.store(true, std::memory_order_release);
        }
        if (outcome == LoopOutcome::Stop) {
            return;
        }
    }
    const Faults after = faultsOfThisThread();
    statistics_.minor_faults = after.minor - before.minor;
    statistics_.major_faults = after.major - before.major;
}

} // namespace marsview
