// Marks the work of the servo thread within a tick, so that its allocations can be counted.
#pragma once

#include <atomic>
#include <cstdint>

namespace marsview {

/// During its lifetime its thread is in a tick. Programs and tests that link `allocation_count`
/// have an operator new and delete that count the calls in that time.
class RtScope {
public:
    RtScope() noexcept { ++depth(); }
    ~RtScope() { --depth(); }
    RtScope(const RtScope&) = delete;
    RtScope& operator=(const RtScope&) = delete;

    static bool isActive() noexcept { return depth() > 0; }
    /// Calls of operator new and operator delete in all scopes so far. Any thread.
    static std::uint64_t allocationCount() noexcept
    {
        return allocations().load(std::memory_order_relaxed);
    }
    /// For allocation_count only.
    static void countAllocation() noexcept
    {
        if (isActive()) {
            allocations().fetch_add(1, std::memory_order_relaxed);
        }
    }

private:
    static int& depth() noexcept
    {
        thread_local int value = 0;
        return value;
    }
    static std::atomic<std::uint64_t>& allocations() noexcept
    {
        static constinit std::atomic<std::uint64_t> value{0};
        return value;
    }
};

} // namespace marsview
