// What a recording is told of the ground below the hand.
#pragma once

#include "haptics/sync/spsc_queue.h"
#include "haptics/terrain/ground_record.h"
#include "haptics/terrain/servo_map.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace marsview {

/// Tells only what has changed since it last told. The servo thread's; nothing here allocates or
/// waits.
class GroundLog {
public:
    /// 268 ticks of the most that one can have to tell. A recorder looks every 20 ms.
    using Queue = SpscQueue<GroundRecord, 1U << 15>;

    /// What comes next is told from the beginning.
    void forget() noexcept { *this = {}; }
    /// After a tick over `map`, and of it; `was_told` says whether the model was told that its
    /// terrain has changed. How many records that were put; nothing where there is no room for
    /// them.
    std::optional<std::uint32_t> tell(const ServoMap& map, bool was_told, Queue& queue) noexcept;

private:
    static constexpr std::size_t kMax = // in a tick
        2 + ResidentTerrain::kLevelsMax + WindowBlend::kTilesMax;

    std::uint64_t serial_ = 0;
    std::uint64_t map_id_ = 0;
    std::array<ShownTiles, ResidentTerrain::kLevelsMax> shown_{};
    bool is_blending_ = false;
};

} // namespace marsview
