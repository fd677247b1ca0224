// How tiles that arrive under the hand are made felt: not at once, but at a bounded rate.
#pragma once

#include "core/tiles/tile.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace marsview {

/// Samples of the map, ends included.
struct SampleBox {
    std::size_t left = 0;
    std::size_t right = 0;
    std::size_t upper = 0;
    std::size_t lower = 0;
};

inline bool doOverlap(const SampleBox& a, const SampleBox& b) noexcept
{
    return a.left <= b.right && b.left <= a.right && a.upper <= b.lower && b.upper <= a.lower;
}

/// The weights of tiles that have arrived near the hand and are not yet felt in full: from 0, as if
/// the tile were not there, to 1. A weight grows such that no height changes faster than the rate;
/// one tile after the other where they lie upon each other, the finer first. All others have a
/// weight of 1.
///
/// Heights change by at most `rate_m_per_s`, so a hand that holds still feels a force that changes
/// by at most the stiffness times the rate, times the exaggeration and the scale from the scene to
/// the hand's workspace. A small value for the servo thread: allocates nothing.
class WindowBlend {
public:
    /// Nine tiles at level 0 and four, at most nine, at each level above, of those that arrive
    /// before the ones before them are felt. What does not fit is felt at once, and counted.
    static constexpr std::size_t kTilesMax = 96;

    /// A tile that has arrived; `difference_m` as in ResidentWindow::Slot, finite. One that makes
    /// no difference is felt in full.
    void add(const TileLayout& layout, const TileId& tile, double difference_m) noexcept;
    /// A tile with the weight that it had in another blend, in [0, 1). It keeps it.
    void put(const TileLayout& layout, const TileId& tile, double weight) noexcept;
    /// What `keep(tile, reach)` does not want is felt in full, at once.
    template <typename Keep>
    void keepOnly(Keep&& keep) noexcept
    {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            if (keep(tiles_[i].id, tiles_[i].reach)) {
                tiles_[kept++] = tiles_[i];
            }
        }
        count_ = kept;
    }
    void clear() noexcept { count_ = 0; }
    /// Time goes on: `seconds` >= 0, `rate_m_per_s` > 0. Both are finite.
    void advance(double seconds, double rate_m_per_s) noexcept;
    template <typename F>
    void eachTile(F&& function) const noexcept
    {
        for (std::size_t i = 0; i < count_; ++i) {
            function(tiles_[i].id, tiles_[i].weight);
        }
    }

    bool isEmpty() const noexcept { return count_ == 0; }
    std::size_t count() const noexcept { return count_; }
    bool has(const TileId& tile) const noexcept { return find(tile) != nullptr; }
    /// In [0, 1]; 1 for tiles that are not blended.
    double weight(const TileId& tile) const noexcept;
    /// Of tiles that were felt at once because there were too many.
    std::uint64_t overflowCount() const noexcept { return overflow_count_; }

    /// The samples of the map that a tile has a say in.
    static SampleBox reach(const TileLayout& layout, const TileId& tile) noexcept;

private:
    struct Blended {
        TileId id;
        double difference_m;
        double weight;
        SampleBox reach;
    };
    const Blended* find(const TileId& tile) const noexcept;

    std::array<Blended, kTilesMax> tiles_;
    std::size_t count_ = 0;
    std::uint64_t overflow_count_ = 0;
};

} // namespace marsview
