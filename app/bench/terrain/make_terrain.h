// Generates a very large, realistic map for measurements.
#pragma once

#include "app/bench/reference/computed_raster.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace marsview {

struct MakeTerrainOptions {
    std::string path;
    std::string from; // the measured map to start from
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::uint64_t seed = 1;
    RasterBlocks blocks = RasterBlocks::Tiles;
    RasterCompression compression = RasterCompression::None;
};

struct MadeTerrain {
    std::size_t octave_count = 0;
    double halving_ratio = 0.0; // DetailedHeights::halvingRatio
    double seconds = 0.0;
    std::size_t peak_memory_bytes = 0;
};

/// Reads the whole measured map and writes the larger one with the same extent, showing progress.
/// The same options give the same samples on every machine. Rejects maps with voids or with fewer
/// than 4 × 4 samples.
Result<MadeTerrain> makeTerrain(const MakeTerrainOptions& options);

} // namespace marsview
