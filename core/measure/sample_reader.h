// Elevations of single samples for measuring, from memory, tiles or a file.
#pragma once

#include "core/base/result.h"
#include "core/raster/open_raster.h"
#include "core/terrain/heightfield.h"
#include "core/tiles/tile_source.h"

#include <cstddef>
#include <memory>
#include <optional>

namespace marsview {

/// Reads samples where they are, and waits for them. For one thread at a time, not the GUI thread.
class SampleReader {
public:
    virtual ~SampleReader() = default;
    SampleReader(const SampleReader&) = delete;
    SampleReader& operator=(const SampleReader&) = delete;

    /// In meters; NaN if void, and if the sample could not be read, which failure() then explains.
    /// Unchecked: column and row lie on the raster and are multiples of step() or the last ones.
    virtual double sample(std::size_t column, std::size_t row) = 0;

    /// The distance between the samples that can be read: 1, or a power of two.
    std::size_t step() const noexcept { return step_; }
    /// The first read that failed.
    const std::optional<Error>& failure() const noexcept { return failure_; }

protected:
    explicit SampleReader(std::size_t step)
        : step_(step)
    {}
    void fail(const Error& error)
    {
        if (!failure_) {
            failure_ = error;
        }
    }

private:
    std::size_t step_;
    std::optional<Error> failure_;
};

/// Samples of a map in memory or in tiles: every 2^level-th of them. On a tiled map only the tiles
/// of that level are read. Levels beyond the coarsest become the coarsest.
std::unique_ptr<SampleReader> readSamples(const Heightfield& heightfield, std::size_t level = 0);

/// Every sample of a file, read in windows as needed, so that a raster of any size needs little
/// memory. `raster` must outlive the reader. `tiles`, if any, are those of the file and are read
/// instead of it; damaged tiles are errors.
std::unique_ptr<SampleReader> readSamples(OpenRaster& raster,
                                          std::shared_ptr<const TileSource> tiles);

} // namespace marsview
