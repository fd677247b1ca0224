#include "app/console/machine.h"

#include <fstream>
#include <sstream>
#include <string_view>
#include <sys/resource.h>
#include <system_error>

namespace marsview {
namespace {

// The value of the name in a file of "name: value" lines; empty if missing.
std::string valueIn(const char* path, std::string_view name)
{
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with(name)) {
            const std::size_t colon = line.find(':');
            const std::size_t begin = line.find_first_not_of(" \t", colon + 1);
            return colon == std::string::npos || begin == std::string::npos ? std::string()
                                                                            : line.substr(begin);
        }
    }
    return {};
}

} // namespace

std::string processorName()
{
    const std::string name = valueIn("/proc/cpuinfo", "model name");
    return name.empty() ? "unknown" : name;
}

std::chrono::duration<double, std::milli> processorTime()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto span = [](const timeval& time) {
        return std::chrono::seconds(time.tv_sec) + std::chrono::microseconds(time.tv_usec);
    };
    return span(usage.ru_utime) + span(usage.ru_stime);
}

std::size_t peakMemoryBytes()
{
    std::istringstream value(valueIn("/proc/self/status", "VmHWM"));
    std::size_t kibibytes = 0;
    value >> kibibytes;
    return kibibytes * 1024;
}

void forgetPeakMemory()
{
    std::ofstream("/proc/self/clear_refs") << "5\n"; // proc(5): resets VmHWM
}

std::filesystem::path programFolder()
{
    std::error_code error;
    return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

} // namespace marsview
