// Reports to a recording which terrain is below the hand.
#pragma once

#include "core/body/layered_mesh.h"
#include "haptics/sync/spsc_queue.h"
#include "haptics/terrain/ground_record.h"
#include "haptics/terrain/servo_map.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace marsview {

/// Reports only changes since the last report. Servo thread only; does not allocate or wait.
class GroundLog {
public:
    /// Room for 214 ticks with the maximum number of records where one map is in tiles, and for 33
    /// where eight are. A recorder polls every 20 ms.
    using Queue = SpscQueue<GroundRecord, 1U << 15>;

    /// The next report starts from the beginning.
    void forget() noexcept { *this = {}; }
    /// Call after a tick over `map`. `was_notified` says whether the contact model was notified of
    /// a terrain change. Returns the number of records put into the queue; empty if there was no
    /// room.
    std::optional<std::uint32_t>
    record(const ServoMap& map, bool was_notified, Queue& queue) noexcept;

private:
    using ShownLevels = std::array<ShownTiles, ResidentTerrain::kLevelsMax>;

    std::uint64_t serial_ = 0;
    std::uint64_t map_id_ = 0;
    std::array<ShownLevels, LayeredMesh::kTiledMax> shown_{}; // by ServoMap::tiles
    bool is_blending_ = false;
};

} // namespace marsview
