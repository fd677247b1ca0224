// Blends tiles that arrive under the hand into the surface at a bounded rate.
#pragma once

#include "core/geo/frames.h"
#include "core/tiles/tile.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace marsview {

/// Samples of the map, inclusive bounds.
struct SampleBox {
    std::size_t left = 0;
    std::size_t right = 0;
    std::size_t upper = 0;
    std::size_t lower = 0;
};

/// The samples of the tiles around a hand, up to so many tiles away. Around the body, those beyond
/// the last column are among the first, and the other way around.
class SamplesNear {
public:
    SamplesNear(const TileLayout& layout, GridPoint hand, std::size_t tiles, bool wraps) noexcept;

    bool doOverlap(const SampleBox& box) const noexcept;

private:
    SampleBox here_;
    SampleBox beyond_; // the same as here_ if there is nothing
};

inline bool doOverlap(const SampleBox& a, const SampleBox& b) noexcept
{
    return a.left <= b.right && b.left <= a.right && a.upper <= b.lower && b.upper <= a.lower;
}

/// The weights of newly arrived tiles near the hand, from 0 (as if the tile were missing) to 1. A
/// weight grows such that no height changes faster than the rate; overlapping tiles are blended one
/// after the other, the finer first. All other tiles have a weight of 1.
///
/// Heights change at most at `rate_m_per_s`, so the force on a hand at rest changes at most at the
/// stiffness times the rate, times the exaggeration and the scale from the scene to the workspace.
/// A small value for the servo thread: does not allocate.
class ClipmapBlend {
public:
    /// Nine tiles at level 0 and four, at most nine, at each level above, assuming that earlier
    /// tiles have been blended before more arrive. Further tiles take effect at once, and are
    /// counted.
    static constexpr std::size_t kTilesMax = 96;

    /// Adds a tile that has arrived; `difference_m` as in Clipmap::Slot, finite. A tile
    /// without a difference gets the full weight at once.
    void add(const TileLayout& layout, const TileId& tile, double difference_m) noexcept;
    /// Adds a tile with its weight in another blend, in [0, 1). The weight does not change.
    void put(const TileLayout& layout, const TileId& tile, double weight) noexcept;
    /// Tiles for which `keep(tile, reach)` is false get the full weight at once.
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
    /// Advances the weights: `seconds` >= 0, `rate_m_per_s` > 0. Both are finite.
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
    /// In [0, 1]; 1 for tiles that are not being blended.
    double weight(const TileId& tile) const noexcept;
    /// Number of tiles that took effect at once because there were too many.
    std::uint64_t overflowCount() const noexcept { return overflow_count_; }

    /// The samples of the map that a tile affects.
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
