#include "core/prepare/disk_room.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <system_error>

namespace marsview {
namespace {

namespace fs = std::filesystem;

// The needed size is rounded up and the free space down, so that the two texts always differ.
std::string sizeText(double bytes, double (*rounded)(double))
{
    const double megabytes = bytes / 1e6;
    return megabytes < 1000.0 ? fmt::format("{:.0f} MB", rounded(megabytes))
                              : fmt::format("{:.1f} GB", rounded(megabytes / 100.0) / 10.0);
}

} // namespace

Status checkRoom(const RoomWanted& wanted)
{
    std::error_code failure;
    const fs::path folder = fs::absolute(wanted.path).parent_path();
    const fs::space_info space = fs::space(folder, failure);
    if (failure) {
        return Done{}; // writing reports the error
    }
    const std::uint64_t missing = wanted.bytes - std::min(wanted.written, wanted.bytes);
    if (space.available >= missing) {
        return Done{};
    }
    return Error{
        ErrorCode::TooLarge,
        fmt::format("{}: needs up to {}, but {} has only {} free; free some or choose another "
                    "folder",
                    wanted.path,
                    sizeText(static_cast<double>(missing), [](double x) { return std::ceil(x); }),
                    folder.string(), sizeText(static_cast<double>(space.available), [](double x) {
                        return std::floor(x);
                    }))};
}

std::uint64_t bytesOnDisk(const std::string& path)
{
    std::error_code failure;
    const std::uintmax_t bytes = fs::file_size(path, failure);
    return failure ? 0 : bytes;
}

} // namespace marsview
