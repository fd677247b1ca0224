// Running this program once more, so that what it holds at most is what one job holds.
#pragma once

#include "core/base/result.h"

#include <cstddef>
#include <string>
#include <vector>

namespace marsview {

struct ChildOutput {
    std::string out;
    double seconds = 0.0;
    std::size_t peak_memory_bytes = 0; // the most that was resident
};

/// Runs this executable with the arguments and waits for it. An Error with what it said where it
/// failed; Cancelled where it was interrupted.
Result<ChildOutput> runSelf(const std::vector<std::string>& arguments);

} // namespace marsview
