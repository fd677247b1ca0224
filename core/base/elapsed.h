// Measures how long a job takes.
#pragma once

#include <chrono>

namespace marsview {

inline double secondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace marsview
