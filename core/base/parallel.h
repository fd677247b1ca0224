// Distributes work over the processor's cores.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>

namespace marsview {

/// Calls `work(begin, end)` for parts that together make up [0, count), on as many threads as the
/// machine has cores, but no more than `threads_max`, and returns when all is done. Each part has
/// at most `grain` (> 0) items; parts are taken in ascending order. `work` must not throw. Not for
/// the servo thread.
void parallelRanges(std::size_t count,
                    std::size_t grain,
                    const std::function<void(std::size_t begin, std::size_t end)>& work,
                    std::size_t threads_max = std::numeric_limits<std::size_t>::max());

} // namespace marsview
