#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace marsview {

void parallelRanges(std::size_t count,
                    std::size_t grain,
                    const std::function<void(std::size_t begin, std::size_t end)>& work,
                    std::size_t threads_max)
{
    std::atomic<std::size_t> next{0};
    const auto take_parts = [&] {
        for (std::size_t begin = next.fetch_add(grain); begin < count;
             begin = next.fetch_add(grain)) {
            work(begin, std::min(begin + grain, count));
        }
    };
    const std::size_t parts = (count + grain - 1) / grain;
    const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
    std::vector<std::jthread> helpers;
    for (std::size_t i = 1; i < std::min({parts, cores, threads_max}); ++i) {
        helpers.emplace_back(take_parts);
    }
    take_parts();
}

} // namespace marsview
