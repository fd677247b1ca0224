// The samples of a map near where it ends, blended into the maps below it.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/session/body_terrain.h"
#include "core/session/session.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace marsview {

/// A map ends at its border and at its voids: at samples that lie on the border of the grid or are
/// corners of a triangle with a void. Less than n cells from the nearest of these, d cells away,
/// the height of a sample becomes b + w (h - b), with h its own height, b the height straight below
/// it of the maps below, and w = t² (3 - 2 t) for t = d / n. At the ends the two surfaces meet.
/// Where no map lies below, samples keep their heights, and the blending fades out towards these
/// places in the same way: w becomes 1 - (1 - w) v, with v for the distance to the nearest of them.
///
/// Only the samples that change are stored, 10 bytes each, by squares of kSide × kSide samples.
/// Immutable; any thread.
class FeatherBand {
public:
    static constexpr std::size_t kSide = 256;
    /// The most that may change.
    static constexpr std::size_t kSamplesMax = std::size_t{1} << 24;

    struct Square {
        std::vector<std::uint16_t> places; // row · kSide + column, ascending
        std::vector<float> heights_m;      // rounded from double
        std::vector<float> raised_m;       // by how much: heights_m less those of the map

        /// The index of a sample in these, if it changes.
        std::optional<std::size_t> find(std::size_t column, std::size_t row) const;
    };

    /// `below` are the maps below `map`, the uppermost first, as they are shown. `cells` is at most
    /// kFeatherCellsMax. Maps in tiles are read as far as needed. On all cores: not for the GUI
    /// thread. Errors: TooLarge beyond kSamplesMax, Canceled, and why a tile cannot be read.
    static Result<FeatherBand> build(const BodyTerrain& map,
                                     std::span<const BodyTerrain> below,
                                     std::size_t cells,
                                     JobMonitor& monitor);

    /// Of samples.
    std::size_t size() const noexcept { return size_; }
    /// Null where no sample of the square changes.
    const Square* square(std::size_t column, std::size_t row) const;
    /// By how much the height of a sample changes; nothing if it does not belong to the band.
    std::optional<float> raised(std::size_t column, std::size_t row) const;
    /// Calls `visit(column, row, square)` for all squares with samples, in no order.
    template <typename F>
    void eachSquare(F&& visit) const
    {
        for (const auto& [index, square] : squares_) {
            visit(index % square_columns_, index / square_columns_, square);
        }
    }

private:
    FeatherBand() = default;

    std::size_t square_columns_ = 0;
    std::size_t size_ = 0;
    std::unordered_map<std::size_t, Square> squares_; // by row · square_columns_ + column
};

} // namespace marsview
