// What measurements say about the machine and about this process.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>

namespace marsview {

/// "Intel(R) Xeon(R) …"; "unknown" where the system does not say.
std::string processorName();

/// Processor time of all threads of this process so far, the system's on its behalf included.
std::chrono::duration<double, std::milli> processorTime();

/// The most memory that this process has held since the last call of forgetPeakMemory(), bytes; 0
/// where the system does not say.
std::size_t peakMemoryBytes();
/// The peak counts from now on, where the system can.
void forgetPeakMemory();

/// The folder in which this executable lies; empty where the system does not say.
std::filesystem::path programFolder();

} // namespace marsview
