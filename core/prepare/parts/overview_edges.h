// Rows of overview pixels at the borders of parts, which several parts share a row of tiles of.
#pragma once

#include "core/base/result.h"
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

/// The pixels of one part, in rows of tiles of overviews that it does not have alone.
class OverviewEdges {
public:
    OverviewEdges(SampleType type, std::size_t tile_rows)
        : type_(type)
        , tile_rows_(tile_rows)
    {}

    /// After the raster's row of tiles `tile_row` of the part was added to `overviews`: writes the
    /// rows of tiles that it completes and that are the part's alone, and keeps the pixels of those
    /// that end here and are not.
    Status addRow(const OverviewBuilder& overviews,
                  std::size_t tile_row,
                  const PartRows& part,
                  TileRowWriter& writer);

    void save(CheckpointWriter& to) const;
    bool restore(CheckpointReader& from);

    /// Adds the pixels of the next part, and writes the rows of tiles that are now complete.
    Status merge(const OverviewEdges& next, TileRowWriter& writer);
    /// The rows of tiles, by level and number, that merge() has written.
    const std::vector<std::pair<std::size_t, std::size_t>>& written() const { return written_; }

private:
    struct Pixels {
        std::uint64_t columns = 0;
        std::uint64_t rows_all = 0; // of the row of tiles
        std::vector<std::uint8_t> samples;
        std::vector<std::uint8_t> valid; // empty without mask
        std::size_t rows(std::size_t sample_bytes) const
        {
            return samples.size() / (columns * sample_bytes);
        }
    };

    SampleType type_;
    std::size_t tile_rows_;
    std::map<std::pair<std::uint64_t, std::uint64_t>, Pixels> pixels_; // by level and row of tiles
    std::vector<std::pair<std::size_t, std::size_t>> written_;
};

} // namespace marsview
