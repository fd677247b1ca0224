#include "core/raster/tile_checksums.h"

#include "core/base/check.h"

#include <libdeflate.h>

namespace marsview {

TileChecksums::TileChecksums(const TileLayout& layout)
{
    std::size_t count = 0;
    const auto add = [&](TileKind kind, std::size_t level) {
        levels_.push_back({count, layout.tileColumns(kind, level)});
        count += layout.tileColumns(kind, level) * layout.tileRows(kind, level);
    };
    add(TileKind::Samples, 0);
    for (std::size_t level = 1; level <= layout.mean_levels; ++level) {
        add(TileKind::Means, level);
    }
    values_.resize(count);
}

std::size_t TileChecksums::countFor(const TileLayout& layout)
{
    std::size_t count =
        layout.tileColumns(TileKind::Samples, 0) * layout.tileRows(TileKind::Samples, 0);
    for (std::size_t level = 1; level <= layout.mean_levels; ++level) {
        count +=
            layout.tileColumns(TileKind::Means, level) * layout.tileRows(TileKind::Means, level);
    }
    return count;
}

std::size_t TileChecksums::numberOf(const TileId& id) const
{
    MARSVIEW_CHECK(covers(id) && id.level < levels_.size());
    const Level& level = levels_[id.level];
    return level.first + id.row * level.tile_columns + id.column;
}

std::uint32_t sampleChecksum(const SampleGrid& samples)
{
    return sampleChecksum(samples, {0, 0, samples.columns(), samples.rows()});
}

std::uint32_t sampleChecksum(const SampleGrid& samples, const GridWindow& part)
{
    MARSVIEW_CHECK(part.column + part.columns <= samples.columns() &&
                   part.row + part.rows <= samples.rows());
    return samples.visit([&](auto values) {
        std::uint32_t checksum = 0;
        for (std::size_t row = part.row; row < part.row + part.rows; ++row) {
            const auto whole = std::as_bytes(std::span(values.row(row)));
            const std::size_t sample = sizeof(values(0, 0));
            checksum = libdeflate_crc32(checksum, whole.data() + part.column * sample,
                                        part.columns * sample);
        }
        return checksum;
    });
}

} // namespace marsview
