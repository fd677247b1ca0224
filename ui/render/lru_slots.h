// The slots of a store of fixed size, with least-recently-used eviction; which nodes are in a
// texture of squares, and where.
#pragma once

#include "core/terrain/node_heights.h"
#include "core/view/detail_selection.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace marsview {

/// Assigns slots 0 … count - 1 to keys. When all are taken, the key that was used the longest ago
/// loses its slot, unless that was in the present round.
template <typename Key, typename Hash>
class LruSlots {
public:
    explicit LruSlots(std::size_t count)
        : slots_(count)
    {}

    std::size_t size() const noexcept { return slots_.size(); }

    /// Slots used from now on are safe until the next call.
    void beginRound() noexcept
    {
        ++round_;
        used_count_ = 0;
    }
    /// Slots used since then.
    std::size_t usedCount() const noexcept { return used_count_; }

    /// The key's slot, which counts as used in this round. Empty if it has none.
    std::optional<std::size_t> find(const Key& key)
    {
        const auto known = places_.find(key);
        if (known == places_.end()) {
            return std::nullopt;
        }
        Slot& slot = slots_[known->second];
        used_count_ += slot.last_round != round_ ? 1 : 0;
        slot.last_round = round_;
        return known->second;
    }

    /// A slot for a key that has none. Empty if all are in use in this round.
    std::optional<std::size_t> assign(const Key& key)
    {
        std::size_t oldest = 0;
        for (std::size_t i = 1; i < slots_.size(); ++i) {
            if (slots_[i].last_round < slots_[oldest].last_round) {
                oldest = i;
            }
        }
        Slot& slot = slots_[oldest];
        if (slot.last_round == round_) {
            return std::nullopt;
        }
        if (slot.key) {
            places_.erase(*slot.key);
        }
        slot = {.key = key, .last_round = round_};
        ++used_count_;
        places_[key] = oldest;
        return oldest;
    }

    void clear()
    {
        places_.clear();
        slots_.assign(slots_.size(), Slot{});
    }

private:
    struct Slot {
        std::optional<Key> key;
        std::uint64_t last_round = 0;
    };

    std::vector<Slot> slots_;
    std::unordered_map<Key, std::size_t, Hash> places_;
    std::uint64_t round_ = 1;
    std::size_t used_count_ = 0;
};

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
