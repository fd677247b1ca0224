// Information about the machine and this process, for benchmark results.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>

namespace marsview {

/// "Intel(R) Xeon(R) …"; "unknown" if the system does not report it.
std::string processorName();

/// Processor time of all threads of this process so far, including system time.
std::chrono::duration<double, std::milli> processorTime();

/// The peak memory of this process since the last call of forgetPeakMemory(), in bytes; 0 if the
/// system does not report it.
std::size_t peakMemoryBytes();
/// Resets the peak, if the system supports that.
void forgetPeakMemory();

/// The folder of this executable; empty if the system does not report it.
std::filesystem::path programFolder();

} // namespace marsview
