// The walls between a map on its body and the maps below it: where it ends, its edge is a step.
#pragma once

#include "core/body/body_grid.h"
#include "core/body/body_locator.h"
#include "core/terrain/block_means.h"
#include "core/terrain/heightfield.h"
#include "core/view/detail_selection.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

namespace marsview {

/// A map under the walls of another one, on the same ellipsoid.
struct LowerMap {
    std::shared_ptr<const BodyLocator> locator;
    std::shared_ptr<const Heightfield> heightfield;
};

/// A corner of a wall, on the rim of a map. As sent to the driver.
struct WallCorner {
    float column = 0.0F;  // in cells of the node
    float row = 0.0F;     // likewise
    float lower_m = 0.0F; // elevation of the map below
    float sag_m = 0.0F;   // how far its triangle there lies off the ellipsoid, at elevation 0
    float is_top = 0.0F;  // 1 at the wall's upper end, 0 at the lower one
};

/// Where no map is below a corner: the wall ends at the rim.
inline constexpr float kNoLowerM = -1e30F;

/// Whether data of a map ends in a node or at its edge.
bool mayEnd(const BodyGrid& grid, const BlockMeans& means, const DetailNode& node);

/// Walls along the edges of a map's triangles, where data ends and a lower map has data. Made for a
/// node when it is drawn, and kept. For one thread at a time.
class MapWalls {
public:
    /// Two triangles a piece of wall: three corners each, by their indices. Pieces share corners.
    struct Walls {
        std::vector<WallCorner> corners;
        std::vector<std::uint16_t> triangles;
    };
    /// By the quadrants of the node.
    using NodeWalls = std::array<Walls, kQuadrantCount>;

    /// The uppermost lower map first.
    MapWalls(std::shared_ptr<const Heightfield> heightfield,
             std::shared_ptr<const BodyGrid> grid,
             std::vector<LowerMap> lower);

    /// The walls of a node, valid until the next call, along triangles of so many samples a side, a
    /// power of two not above a cell of the node. `generation` changes when tiles of any of these
    /// maps have arrived; for tiles, the finest ones in memory are used. `means` is the map's.
    const NodeWalls&
    of(const DetailNode& node, std::size_t step, const BlockMeans& means, std::uint64_t generation);

private:
    struct Key {
        DetailNode node;
        std::size_t step = 1;
        bool operator==(const Key&) const = default;
    };
    struct KeyHash {
        std::size_t operator()(const Key& key) const noexcept;
    };
    struct Kept {
        NodeWalls walls;
        std::uint64_t generation = 0;
        bool is_final = true; // whatever tiles arrive
    };
    class Outline;
    class Ground;

    void build(const Key& key, const BlockMeans& means, Kept& kept) const;

    std::shared_ptr<const Heightfield> heightfield_;
    std::shared_ptr<const BodyGrid> grid_;
    std::vector<LowerMap> lower_;
    std::unordered_map<Key, Kept, KeyHash> kept_;
    std::size_t corner_count_ = 0; // of all of them
};

} // namespace marsview
