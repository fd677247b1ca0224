// The heights of the nodes that are drawn, at the driver's.
#pragma once

#include "core/terrain/node_heights.h"
#include "ui/render/lru_slots.h"
#include "ui/render/opengl/gl_objects.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace marsview {

/// One texture of squares of 33 × 33 heights, in meters over the map's base. Filled on demand
/// from the tiles in memory, in microseconds a node; incomplete nodes are filled again.
class HeightAtlas {
public:
    using Place = NodeSlots::Place;

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
    void send(const Place& place);

    NodeSlots slots_;
    GlTexture texture_;
    std::array<float, kNodeSide * kNodeSide> heights_{};
};

} // namespace marsview
