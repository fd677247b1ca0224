#include "core/prepare/parts/overview_edges.h"

#include "core/tiles/tile.h"

#include <algorithm>
#include <cstring>

namespace marsview {

Status OverviewEdges::addRow(const OverviewBuilder& overviews,
                             std::size_t tile_row,
                             const PartRows& part,
                             TileRowWriter& writer)
{
    for (std::size_t k = 1; k <= std::min(overviews.levelCount(), OverviewBuilder::kStreamedLevels);
         ++k) {
        const std::size_t row = tile_row >> k;
        const std::size_t first = row << k;
        const std::size_t end = std::min((row + 1) << k, tile_rows_);
        const bool is_complete = tile_row + 1 == end;
        if (!is_complete && tile_row + 1 != part.end) {
            continue;
        }
        const OverviewBuilder::Rows rows = overviews.rowsOf(k, tile_row);
        if (part.hasMeans(k, row, tile_rows_)) {
            if (Status written = writer.writeLevelRow(k, rows, row); !written) {
                return written;
            }
            continue;
        }
        const std::size_t side = kTileSide >> k; // rows of pixels in a row of tiles of the raster
        const std::size_t from = (std::max(first, part.first) - first) * side;
        const std::size_t to = std::min((tile_row + 1 - first) * side, rows.rows);
        auto pixels = pixelsFor(rows.columns, rows.rows, to - from, rows.valid != nullptr);
        if (!pixels) {
            return std::move(pixels).error();
        }
        const std::size_t row_bytes = rows.columns * sampleBytes(type_);
        for (std::size_t row_of_pixels = from; row_of_pixels < to; ++row_of_pixels) {
            std::memcpy(pixels->samples.data() + (row_of_pixels - from) * row_bytes,
                        rows.samples + row_of_pixels * row_bytes, row_bytes);
            if (rows.valid != nullptr) {
                std::memcpy(pixels->valid.data() + (row_of_pixels - from) * rows.columns,
                            rows.valid + row_of_pixels * rows.columns, rows.columns);
            }
            rows.release();
            pixels->samples.release();
            pixels->valid.release();
        }
        pixels->rows = to - from;
        pixels_[{k, row}] = std::move(pixels).value();
    }
    return Done{};
}

Result<OverviewEdges::Pixels> OverviewEdges::pixelsFor(std::uint64_t columns,
                                                       std::uint64_t rows_all,
                                                       std::uint64_t rows,
                                                       bool has_mask) const
{
    Pixels pixels{.columns = columns, .rows_all = rows_all, .rows = 0, .samples = {}, .valid = {}};
    constexpr auto kContent = ScratchBytes::Content::Zeros;
    auto samples = ScratchBytes::create(rows * columns * sampleBytes(type_), kContent, scratch_);
    auto valid = ScratchBytes::create(has_mask ? rows * columns : 0, kContent, scratch_);
    if (!samples || !valid) {
        return samples ? std::move(valid).error() : std::move(samples).error();
    }
    pixels.samples = std::move(samples).value();
    pixels.valid = std::move(valid).value();
    return pixels;
}

void OverviewEdges::save(CheckpointWriter& to) const
{
    to.put(static_cast<std::uint64_t>(pixels_.size()));
    for (const auto& [place, pixels] : pixels_) {
        to.put(place.first);
        to.put(place.second);
        to.put(pixels.columns);
        to.put(pixels.rows_all);
        to.put(pixels.rows);
        to.put(static_cast<std::uint8_t>(pixels.valid.size() > 0 ? 1 : 0));
        to.putScratch(pixels.samples, pixels.samples.size());
        to.putScratch(pixels.valid, pixels.valid.size());
    }
}

Status OverviewEdges::merge(CheckpointReader& next, TileRowWriter& writer)
{
    const Error unreadable{ErrorCode::Damaged, "is damaged"};
    std::uint64_t count = 0;
    if (!next.get(count)) {
        return unreadable;
    }
    for (std::uint64_t i = 0; i < count; ++i) {
        std::pair<std::uint64_t, std::uint64_t> place;
        std::uint64_t columns = 0;
        std::uint64_t rows_all = 0;
        std::uint64_t rows_added = 0;
        std::uint8_t has_mask = 0;
        if (!next.get(place.first) || !next.get(place.second) || !next.get(columns) ||
            !next.get(rows_all) || !next.get(rows_added) || !next.get(has_mask) || columns == 0) {
            return unreadable;
        }
        auto at = pixels_.find(place);
        if (at == pixels_.end()) {
            auto made = pixelsFor(columns, rows_all, rows_all, has_mask != 0);
            if (!made) {
                return std::move(made).error();
            }
            at = pixels_.emplace(place, std::move(made).value()).first;
        }
        Pixels& pixels = at->second;
        const std::size_t row_bytes = columns * sampleBytes(type_);
        if (columns != pixels.columns || rows_added > pixels.rows_all - pixels.rows ||
            !next.getScratch(pixels.samples, pixels.rows * row_bytes, rows_added * row_bytes) ||
            (has_mask != 0 &&
             !next.getScratch(pixels.valid, pixels.rows * columns, rows_added * columns))) {
            return unreadable;
        }
        pixels.rows += rows_added;
        if (pixels.rows < pixels.rows_all) {
            continue;
        }
        const OverviewBuilder::Rows rows{
            .samples = pixels.samples.data(),
            .valid = reinterpret_cast<const std::uint8_t*>(pixels.valid.data()),
            .columns = columns,
            .rows = rows_all,
            .samples_in = &pixels.samples,
            .valid_in = &pixels.valid};
        if (Status written = writer.writeLevelRow(place.first, rows, place.second); !written) {
            return written;
        }
        written_.emplace_back(place.first, place.second);
        pixels_.erase(at);
    }
    return Done{};
}

} // namespace marsview
