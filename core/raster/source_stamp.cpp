#include "core/raster/source_stamp.h"

#include "core/raster/remote_raster.h"
#include "core/raster/source_files.h"

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

// The archive, where the file is one of GDAL's names of something within it
// ("/vsizip/maps/mars.zip/mars.tif"); nothing where there is none on a disk.
std::optional<FileStatus> statusOfHolder(const std::string& file)
{
    if (!file.starts_with("/vsi")) {
        return statusOf(file);
    }
    for (std::size_t begin = file.find('/', 1); begin != std::string::npos;
         begin = file.find_first_of("/,{", begin + 1)) {
        for (std::size_t end = file.size(); end != std::string::npos && end > begin + 1;
             end = file.find_last_of("/}", end - 1)) {
            if (const auto status = statusOf(file.substr(begin + 1, end - begin - 1))) {
                return status;
            }
            if (const auto status = statusOf(file.substr(begin, end - begin))) {
                return status;
            }
        }
    }
    return std::nullopt;
}

std::int64_t nanoseconds(const timespec& time)
{
    return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

} // namespace

std::string stampTextOf(const std::vector<std::string>& files)
{
    std::string text;
    for (const std::string& file : files) {
        if (const std::optional<FileStatus> status = statusOfHolder(file)) {
            fmt::format_to(std::back_inserter(text), "{} {} {} {};", status->st_ino,
                           status->st_size, nanoseconds(status->st_mtim),
                           nanoseconds(status->st_ctim));
        }
    }
    return text;
}

SourceStamp stampOf(const std::string& path)
{
    SourceStamp stamp;
    if (remoteNameFor(path)) {
        return stamp;
    }
    stamp.files = sourceFilesOf(path);
    if (stamp.files.empty()) {
        stamp.files.push_back(path);
    }
    stamp.text = stampTextOf(stamp.files);
    return stamp;
}

bool isUntouched(const SourceStamp& then)
{
    return stampTextOf(then.files) == then.text;
}

} // namespace marsview
