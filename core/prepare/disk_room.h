// Checks for free disk space before hours of work.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <string>

namespace marsview {

struct RoomWanted {
    std::string path;          // of the file to write
    std::uint64_t bytes = 0;   // at most
    std::uint64_t written = 0; // of these, by an interrupted attempt
};

/// TooLarge, with both numbers, if the disk has less space. Succeeds if the free space is unknown.
Status checkRoom(const RoomWanted& wanted);

/// Bytes of a file; 0 if it does not exist.
std::uint64_t bytesOnDisk(const std::string& path);

} // namespace marsview
