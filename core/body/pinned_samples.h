// Samples of a map in tiles that stay in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace marsview {

/// A BodyMesh over a terrain with these has the same heights there whichever tiles are in memory,
/// so triangles between them can be stored and joined with other maps. Immutable; any thread, the
/// servo thread included. 32 to 64 bytes per sample.
class PinnedSamples {
public:
    struct Sample {
        std::uint32_t column; // of the positions
        std::uint32_t row;
        double height_m;
    };
    /// Of a map with so many columns; each sample once.
    PinnedSamples(std::size_t columns, std::span<const Sample> samples);

    std::size_t size() const noexcept { return size_; }
    /// In meters; null for other samples. Looks at one to kRunMax places of a table.
    const double* find(std::size_t column, std::size_t row) const noexcept
    {
        if (column - first_column_ > last_column_ - first_column_ ||
            row - first_row_ > last_row_ - first_row_) {
            return nullptr;
        }
        const std::uint64_t key = row * columns_ + column;
        for (std::size_t at = placeOf(key);; ++at) {
            const Place& place = places_[at];
            if (place.key == key) {
                return &place.height_m;
            }
            if (place.key == kNone) {
                return nullptr;
            }
        }
    }

    static constexpr std::size_t kRunMax = 32;

private:
    static constexpr std::uint64_t kNone = ~std::uint64_t{0};
    struct Place {
        std::uint64_t key = kNone;
        double height_m = 0.0;
    };

    // Fibonacci hashing: the samples of a row go to places far apart.
    std::size_t placeOf(std::uint64_t key) const noexcept
    {
        return static_cast<std::size_t>(key * 0x9E3779B97F4A7C15U >> shift_);
    }
    bool fill(std::span<const Sample> samples);

    std::uint64_t columns_;
    std::size_t size_;
    std::size_t first_column_ = 0; // all samples are between these
    std::size_t last_column_ = 0;
    std::size_t first_row_ = 0;
    std::size_t last_row_ = 0;
    unsigned shift_ = 0;
    std::vector<Place> places_; // the last ones are never reached from another
};

} // namespace marsview
