// A map larger than memory as contact models see it: its full-resolution tiles at hand, and a way
// to the heights that are not.
#pragma once

#include "core/levels/tile_heights.h"
#include "core/tiles/tile.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace marsview {

/// Reads a sample of a full-resolution tile at hand about as fast as a map in memory is read; what
/// else there is, is for those who derive from it. A TouchTerrain. For one thread at a time.
class TiledTerrain {
public:
    virtual ~TiledTerrain() = default;
    TiledTerrain(const TiledTerrain&) = delete;
    TiledTerrain& operator=(const TiledTerrain&) = delete;

    std::size_t columns() const noexcept { return columns_; }
    std::size_t rows() const noexcept { return rows_; }
    const TileHeights& heights() const noexcept { return *heights_; }

    virtual bool isVoid(std::size_t column, std::size_t row) const noexcept = 0;
    /// In metres, never NaN. Unchecked: inside the map.
    double sample(std::size_t column, std::size_t row) const noexcept
    {
        if (const Tile* tile = tileAtHand(column, row)) {
            return heights_->sample(*tile, column % kTileSide, row % kTileSide);
        }
        return sampleElsewhere(column, row);
    }
    std::size_t levelCount() const noexcept { return bounds_->levelCount(); }
    double maximum(std::size_t level, std::size_t column, std::size_t row) const noexcept
    {
        return static_cast<double>(
            filled_maxima_m_->empty()
                ? bounds_->bounds(level, column, row).maximum_m
                : (*filled_maxima_m_)[level][row * bounds_->columns(level) + column]);
    }

    /// The sample, of the type of the layout; null where its tile is not at hand, has voids, or is
    /// not felt as it is. The coordinates are those of a sample, so none is negative.
    template <typename T>
    [[gnu::always_inline]] const T* plainSample(std::int32_t column,
                                                std::int32_t row) const noexcept
    {
        const auto c = static_cast<std::uint32_t>(column);
        const auto r = static_cast<std::uint32_t>(row);
        // Nearly always it is the tile of the last one: where that lies does not depend on where
        // this one is, so the processor need not wait for it.
        const Place* place = &last_;
        if (((c - last_.column) | (r - last_.row)) >= kTileSide) [[unlikely]] {
            place = findPlain(c, r);
            if (place == nullptr) {
                return nullptr;
            }
        }
        return static_cast<const T*>(place->samples) +
               ((r - place->row) * place->stride + (c - place->column));
    }

    /// A sample in whose tile are those kBefore columns and rows before it, and those one behind
    /// it, too; a row is `stride` samples long. Null where that is not the tile of the last sample
    /// that was found: each may still be found for itself. There are such samples.
    template <typename T, std::uint32_t kBefore>
    [[gnu::always_inline]] const T*
    plainPatch(std::int32_t column, std::int32_t row, std::ptrdiff_t& stride) const noexcept
    {
        constexpr auto kLast = static_cast<std::uint32_t>(kTileSide) - 1;
        const std::uint32_t c = static_cast<std::uint32_t>(column) - last_.column;
        const std::uint32_t r = static_cast<std::uint32_t>(row) - last_.row;
        if ((c - kBefore < kLast - kBefore) & (r - kBefore < kLast - kBefore)) [[likely]] {
            stride = static_cast<std::ptrdiff_t>(last_.stride);
            return static_cast<const T*>(last_.samples) + (r * last_.stride + c);
        }
        return nullptr;
    }

protected:
    explicit TiledTerrain(std::shared_ptr<const TileHeights> heights);

    /// A sample whose tile is not at hand.
    virtual double sampleElsewhere(std::size_t column, std::size_t row) const noexcept = 0;

    /// A tile has a place of its own among 8 × 8, which it shares with every eighth.
    static constexpr std::uint32_t kPlacesASide = 8;
    /// Takes the place of what was there; the tile lives until the place is cleared or taken.
    void setAtHand(const Tile& tile) const noexcept;
    void clearPlace(std::uint32_t tile_column, std::uint32_t tile_row) const noexcept;
    void clearPlaces() const noexcept;
    static constexpr std::size_t placeOf(std::uint32_t tile_column, std::uint32_t tile_row) noexcept
    {
        return (tile_row % kPlacesASide) * kPlacesASide + tile_column % kPlacesASide;
    }

    const Tile* tileAtHand(std::size_t column, std::size_t row) const noexcept
    {
        const auto c = static_cast<std::uint32_t>(column / kTileSide);
        const auto r = static_cast<std::uint32_t>(row / kTileSide);
        const Held& held = held_[placeOf(c, r)];
        return held.key == keyOf(c, r) ? held.tile : nullptr;
    }

private:
    static constexpr std::uint64_t kNone = ~std::uint64_t{0};
    static constexpr std::uint64_t keyOf(std::uint32_t tile_column, std::uint32_t tile_row) noexcept
    {
        return std::uint64_t{tile_row} << 32U | tile_column;
    }

    static constexpr std::uint32_t kNowhere = ~std::uint32_t{0} - 0xFFFF; // far from any sample

    // A tile without voids: where its first sample is, and where that is kept.
    struct Place {
        std::uint32_t column = kNowhere;
        std::uint32_t row = kNowhere;
        const void* samples = nullptr;
        std::size_t stride = 0;
    };
    // The place of a sample's tile, which is the last one from now on; null where it has none.
    const Place* findPlain(std::uint32_t column, std::uint32_t row) const noexcept;

    struct Held {
        std::uint64_t key = kNone;
        const Tile* tile = nullptr;
    };
    // A batch terrain fetches tiles while it is read.
    const MinMaxPyramid* bounds_; // of heights_; every cast asks them
    const std::vector<std::vector<float>>* filled_maxima_m_;
    mutable Place last_; // one of the following
    mutable std::array<Place, std::size_t{kPlacesASide} * kPlacesASide> places_;
    mutable std::array<Held, std::size_t{kPlacesASide} * kPlacesASide> held_;
    std::shared_ptr<const TileHeights> heights_;
    std::size_t columns_;
    std::size_t rows_;
};

} // namespace marsview
