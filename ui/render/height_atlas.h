// The heights of the nodes that are drawn, at the driver's.
#pragma once

#include "core/terrain/node_heights.h"
#include "core/view/detail_selection.h"
#include "ui/render/gl_objects.h"
#include "ui/render/lru_slots.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace marsview {

/// A node of one of the maps.
struct LayerNode {
    std::uint32_t layer = 0; // a number that is never used for another map
    DetailNode node;
    bool operator==(const LayerNode&) const = default;
};

struct LayerNodeHash {
    std::size_t operator()(const LayerNode& key) const noexcept
    {
        std::uint64_t h = key.layer * 0x9E3779B97F4A7C15ULL + key.node.level;
        h = (h ^ (h >> 29)) * 0xBF58476D1CE4E5B9ULL + key.node.column;
        h = (h ^ (h >> 32)) * 0x94D049BB133111EBULL + key.node.row;
        return static_cast<std::size_t>(h ^ (h >> 31));
    }
};

/// One texture of squares of 33 × 33 heights, in meters over the map's base. Filled on demand
/// from the tiles in memory, in microseconds a node; incomplete nodes are filled again.
class HeightAtlas {
public:
    struct Place {
        int x = 0;
        int y = 0;
    };

    /// `slot_columns` × `slot_rows` squares.
    HeightAtlas(std::size_t slot_columns, std::size_t slot_rows);

    /// Places handed out from now on are kept until the next call.
    void beginRound() { slots_.beginRound(); }
    /// The position of the node's heights. Empty if this round fills the atlas. Tiles that
    /// its heights lack are added to `missing`; `generation` changes when some have arrived.
    std::optional<Place> place(const LayerNode& node,
                               const DrawnSurface& surface,
                               std::uint64_t generation,
                               std::vector<TileId>& missing);

    void bind(GLenum unit) const;

private:
    // What a slot was filled with.
    struct Content {
        NodeState state = NodeState::Complete;
        std::uint64_t generation = 0;
        std::vector<TileId> missing;
    };

    void send(const Place& place);

    LruSlots<LayerNode, LayerNodeHash> slots_;
    std::vector<Content> contents_;
    std::size_t slot_columns_;
    GlTexture texture_;
    std::array<float, kNodeSide * kNodeSide> heights_{};
};

} // namespace marsview
