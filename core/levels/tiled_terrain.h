// A map larger than memory for contact models: its resident full-resolution tiles, and an interface
// for the other heights.
#pragma once

#include "core/levels/tile_heights.h"
#include "core/tiles/tile.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace marsview {

/// Reads a sample of a resident full-resolution tile about as fast as from a map in memory; derived
/// classes provide the other heights. A TouchTerrain. For one thread at a time.
class TiledTerrain {
public:
    virtual ~TiledTerrain() = default;
    TiledTerrain(const TiledTerrain&) = delete;
    TiledTerrain& operator=(const TiledTerrain&) = delete;

    std::size_t columns() const noexcept { return columns_; }
    std::size_t rows() const noexcept { return rows_; }
    const TileHeights& heights() const noexcept { return *heights_; }

    virtual bool isVoid(std::size_t column, std::size_t row) const noexcept = 0;
    /// In meters, never NaN. Unchecked: inside the map.
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

    /// The sample, in the type of the layout; null if its tile is not resident, has voids, or is
    /// being blended. The coordinates are those of a sample, so they are not negative.
    template <typename T>
    [[gnu::always_inline]] const T* plainSample(std::int32_t column,
                                                std::int32_t row) const noexcept
    {
        const auto c = static_cast<std::uint32_t>(column);
        const auto r = static_cast<std::uint32_t>(row);
        // Nearly always it is the last sample's tile. Its address does not depend on the new
        // position, so the processor need not wait for it.
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

    /// A sample whose tile also contains the samples up to kBefore columns and rows before it and
    /// one after it; a row is `stride` samples long. Null if that is not the tile of the last
    /// sample found: each sample may still be found separately. All these samples must exist.
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

    /// A sample whose tile is not resident.
    virtual double sampleElsewhere(std::size_t column, std::size_t row) const noexcept = 0;

    /// A tile has a fixed slot among 8 × 8, which it shares with every eighth tile.
    static constexpr std::uint32_t kPlacesASide = 8;
    /// Replaces the tile in the slot; the tile must live until its slot is cleared or reused.
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

    // A tile without voids: the position of its first sample, and its address.
    struct Place {
        std::uint32_t column = kNowhere;
        std::uint32_t row = kNowhere;
        const void* samples = nullptr;
        std::size_t stride = 0;
    };
    // The slot of a sample's tile, which becomes the last one; null if it has none.
    const Place* findPlain(std::uint32_t column, std::uint32_t row) const noexcept;

    struct Held {
        std::uint64_t key = kNone;
        const Tile* tile = nullptr;
    };
    // A batch terrain fetches tiles while it is read.
    const MinMaxPyramid* bounds_; // of heights_; used by every cast
    const std::vector<std::vector<float>>* filled_maxima_m_;
    mutable Place last_; // one of the following
    mutable std::array<Place, std::size_t{kPlacesASide} * kPlacesASide> places_;
    mutable std::array<Held, std::size_t{kPlacesASide} * kPlacesASide> held_;
    std::shared_ptr<const TileHeights> heights_;
    std::size_t columns_;
    std::size_t rows_;
};

} // namespace marsview
