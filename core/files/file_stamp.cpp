#include "core/files/file_stamp.h"

#include <cstdint>
#include <fmt/format.h>
#include <iterator>
#include <optional>
#include <sys/stat.h>

namespace marsview {
namespace {

using FileStatus = struct stat;

std::optional<FileStatus> statusOf(const std::string& file)
{
    FileStatus status{};
    return stat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode) ? std::optional(status)
                                                                       : std::nullopt;
}

std::int64_t nanoseconds(const timespec& time)
{
    return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

} // namespace

std::string fileHolding(const std::string& name)
{
    if (!name.starts_with("/vsi")) {
        return statusOf(name) ? name : std::string();
    }
    for (std::size_t begin = name.find('/', 1); begin != std::string::npos;
         begin = name.find_first_of("/,{", begin + 1)) {
        for (std::size_t end = name.size(); end != std::string::npos && end > begin + 1;
             end = name.find_last_of("/}", end - 1)) {
            for (const std::size_t first : {begin + 1, begin}) {
                std::string file = name.substr(first, end - first);
                if (statusOf(file)) {
                    return file;
                }
            }
        }
    }
    return {};
}

std::string stampTextOf(const std::vector<std::string>& files)
{
    std::string text;
    for (const std::string& file : files) {
        if (const std::optional<FileStatus> status = statusOf(fileHolding(file))) {
            fmt::format_to(std::back_inserter(text), "{} {} {} {};", status->st_ino,
                           status->st_size, nanoseconds(status->st_mtim),
                           nanoseconds(status->st_ctim));
        }
    }
    return text;
}

} // namespace marsview
