// Runs this program again, so that the peak memory of one job can be measured.
#pragma once

#include "core/base/result.h"

#include <cstddef>
#include <string>
#include <vector>

namespace marsview {

struct ChildOutput {
    std::string out;
    double seconds = 0.0;
    std::size_t peak_memory_bytes = 0; // peak resident memory
};

/// Runs this executable with the arguments and waits for it. Returns the child's error message if
/// it failed, or Canceled if it was interrupted.
Result<ChildOutput> runSelf(const std::vector<std::string>& arguments);

} // namespace marsview
