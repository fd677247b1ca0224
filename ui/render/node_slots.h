// Which nodes are in a texture of squares, and where.
#pragma once

#include "core/terrain/node_heights.h"
#include "core/view/detail_selection.h"
#include "ui/render/lru_slots.h"

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

/// Squares of kNodeSide × kNodeSide texels. Filled on demand; incomplete ones are filled again when
/// tiles have arrived, and all when what they are made for changes.
class NodeSlots {
public:
    /// The first texel of a square.
    struct Place {
        int x = 0;
        int y = 0;
    };
    /// What a square is made for.
    struct Stamp {
        std::uint64_t generation = 0; // of the tiles
        double exaggeration = 1.0;
    };

    NodeSlots(std::size_t columns, std::size_t rows)
        : slots_(columns * rows)
        , contents_(slots_.size())
        , columns_(columns)
    {}

    /// Places handed out from now on are kept until the next call.
    void beginRound() { slots_.beginRound(); }

    /// The node's place. Empty if this round fills the texture. `fill(place, missing)` sends the
    /// node's texels and returns their state; what it lacks is added to `missing`.
    template <typename F>
    std::optional<Place>
    place(const LayerNode& node, const Stamp& stamp, std::vector<TileId>& missing, F&& fill)
    {
        std::optional<std::size_t> slot = slots_.find(node);
        const bool is_known = slot.has_value();
        if (!is_known) {
            slot = slots_.assign(node);
            if (!slot) {
                return std::nullopt;
            }
        }
        const Place place{static_cast<int>(*slot % columns_ * kNodeSide),
                          static_cast<int>(*slot / columns_ * kNodeSide)};
        Content& content = contents_[*slot];
        if (!is_known || content.stamp.exaggeration != stamp.exaggeration ||
            (content.state == NodeState::Coarser && content.stamp.generation != stamp.generation)) {
            content.missing.clear();
            content.stamp = stamp;
            content.state = fill(place, content.missing);
        }
        if (content.state == NodeState::Coarser) {
            missing.insert(missing.end(), content.missing.begin(), content.missing.end());
        }
        return place;
    }

private:
    struct Content {
        NodeState state = NodeState::Complete;
        Stamp stamp;
        std::vector<TileId> missing;
    };

    LruSlots<LayerNode, LayerNodeHash> slots_;
    std::vector<Content> contents_;
    std::size_t columns_;
};

} // namespace marsview
