// Statistics of network reads.
#pragma once

#include <cstdint>

namespace marsview {

struct NetworkStatistics {
    std::uint64_t request_count = 0;
    std::uint64_t downloaded_bytes = 0; // content, without protocol overhead
};

/// Starts counting on the first call. Any thread.
void countNetworkUse();
/// Since counting began.
NetworkStatistics networkStatistics();

} // namespace marsview
