#include "core/tiles/tile_checksums.h"

#include "core/base/check.h"
#include "core/base/deflate.h"

#include <new>
#include <utility>

namespace marsview {
namespace {

TileKind kindAt(std::size_t level)
{
    return level == 0 ? TileKind::Samples : TileKind::Means;
}

std::size_t countBelow(const TileLayout& layout, std::size_t end_level)
{
    std::size_t count = 0;
    for (std::size_t level = 0; level < end_level; ++level) {
        count += layout.tileColumns(kindAt(level), level) * layout.tileRows(kindAt(level), level);
    }
    return count;
}

} // namespace

TileChecksums::TileChecksums(const TileLayout& layout)
    : count_(countFor(layout))
{
    for (std::size_t level = 0; level <= layout.mean_levels; ++level) {
        levels_.push_back({countBelow(layout, level), layout.tileColumns(kindAt(level), level)});
    }
    auto values =
        ScratchBytes::create(count_ * sizeof(std::uint32_t), ScratchBytes::Content::Zeros);
    if (!values) {
        throw std::bad_alloc();
    }
    values_ = std::move(values).value();
}

std::size_t TileChecksums::countFor(const TileLayout& layout)
{
    return countBelow(layout, layout.mean_levels + 1);
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
            checksum =
                crc32Of(whole.subspan(part.column * sample, part.columns * sample), checksum);
        }
        return checksum;
    });
}

} // namespace marsview
