// What has been fetched of files that are read by address.
#pragma once

#include <cstdint>

namespace marsview {

struct NetworkStatistics {
    std::uint64_t request_count = 0;
    std::uint64_t downloaded_bytes = 0; // content, without what the protocol adds
};

/// Counting begins with the first call. Any thread.
void countNetworkUse();
/// Since counting began.
NetworkStatistics networkStatistics();

} // namespace marsview
