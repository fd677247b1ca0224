// Whether what is to be written fits on its disk, before hours are spent on it.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <string>

namespace marsview {

struct RoomWanted {
    std::string path;          // of the file to write
    std::uint64_t bytes = 0;   // at most
    std::uint64_t written = 0; // of them, by an attempt that was stopped
};

/// TooLarge, with both numbers, where the disk has less. Fine where it does not tell.
Status checkRoom(const RoomWanted& wanted);

/// Bytes of a file; 0 where there is none.
std::uint64_t bytesOnDisk(const std::string& path);

} // namespace marsview
