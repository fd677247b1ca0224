// Page faults of the calling thread.
#pragma once

#include <cstdint>
#include <sys/resource.h>

namespace marsview {

/// Since the thread began.
struct ThreadFaults {
    std::uint64_t minor = 0; // without disk read
    std::uint64_t major = 0; // with disk read
};

inline ThreadFaults faultsOfThisThread() noexcept
{
    rusage usage{};
    getrusage(RUSAGE_THREAD, &usage);
    return {static_cast<std::uint64_t>(usage.ru_minflt),
            static_cast<std::uint64_t>(usage.ru_majflt)};
}

} // namespace marsview
