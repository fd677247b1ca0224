// Rows of overview pixels at the borders of parts, which several parts share a row of tiles of.
#pragma once

#include "core/base/result.h"
#include "core/base/scratch_bytes.h"
#include "core/prepare/checkpoint_file.h"
#include "core/prepare/overview_builder.h"
#include "core/prepare/parts/part_rows.h"
#include "core/prepare/tile_row_writer.h"
#include "core/raster/sample_type.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace marsview {

/// The pixels of one part, or while joining of several, in rows of tiles of overviews that no part
/// has alone.
class OverviewEdges {
public:
    /// Large rows lie where `scratch` says, which outlives the object.
    OverviewEdges(SampleType type, std::size_t tile_rows, const ScratchPlace* scratch)
        : type_(type)
        , tile_rows_(tile_rows)
        , scratch_(scratch)
    {}

    /// After the raster's row of tiles `tile_row` of the part was added to `overviews`: writes the
    /// rows of tiles that it completes and that are the part's alone, and keeps the pixels of those
    /// that end here and are not.
    Status addRow(const OverviewBuilder& overviews,
                  std::size_t tile_row,
                  const PartRows& part,
                  TileRowWriter& writer);

    void save(CheckpointWriter& to) const;
    /// Adds the pixels that the next part saved, and writes the rows of tiles that are now
    /// complete. Damaged if they cannot be read.
    Status merge(CheckpointReader& next, TileRowWriter& writer);
    /// The rows of tiles, by level and number, that merge() has written.
    const std::vector<std::pair<std::size_t, std::size_t>>& written() const { return written_; }

private:
    struct Pixels {
        std::uint64_t columns = 0;
        std::uint64_t rows_all = 0; // of the row of tiles
        std::uint64_t rows = 0;     // so far
        ScratchBytes samples;
        ScratchBytes valid; // empty without mask
    };
    Result<Pixels> pixelsFor(std::uint64_t columns,
                             std::uint64_t rows_all,
                             std::uint64_t rows,
                             bool has_mask) const;

    SampleType type_;
    std::size_t tile_rows_;
    const ScratchPlace* scratch_;
    std::map<std::pair<std::uint64_t, std::uint64_t>, Pixels> pixels_; // by level and row of tiles
    std::vector<std::pair<std::size_t, std::size_t>> written_;
};

} // namespace marsview
