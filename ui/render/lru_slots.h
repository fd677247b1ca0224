// The slots of a store of fixed size, with least-recently-used eviction.
#pragma once

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

} // namespace marsview
