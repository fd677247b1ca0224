#include "core/prepare/parts/overview_edges.h"

#include "core/tiles/tile.h"

#include <algorithm>

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
        const std::size_t row_bytes = rows.columns * sampleBytes(type_);
        const auto* samples = reinterpret_cast<const std::uint8_t*>(rows.samples);
        Pixels pixels{.columns = rows.columns,
                      .rows_all = rows.rows,
                      .samples = {samples + from * row_bytes, samples + to * row_bytes},
                      .valid = {}};
        if (rows.valid != nullptr) {
            pixels.valid.assign(rows.valid + from * rows.columns, rows.valid + to * rows.columns);
        }
        pixels_[{k, row}] = std::move(pixels);
    }
    return Done{};
}

void OverviewEdges::save(CheckpointWriter& to) const
{
    to.put(static_cast<std::uint64_t>(pixels_.size()));
    for (const auto& [place, pixels] : pixels_) {
        to.put(place.first);
        to.put(place.second);
        to.put(pixels.columns);
        to.put(pixels.rows_all);
        to.putArray(pixels.samples);
        to.putArray(pixels.valid);
    }
}

bool OverviewEdges::restore(CheckpointReader& from)
{
    std::uint64_t count = 0;
    if (!from.get(count)) {
        return false;
    }
    for (std::uint64_t i = 0; i < count; ++i) {
        std::pair<std::uint64_t, std::uint64_t> place;
        Pixels pixels;
        if (!from.get(place.first) || !from.get(place.second) || !from.get(pixels.columns) ||
            !from.get(pixels.rows_all) || !from.getAny(pixels.samples) ||
            !from.getAny(pixels.valid) || pixels.columns == 0) {
            return false;
        }
        pixels_[place] = std::move(pixels);
    }
    return true;
}

Status OverviewEdges::merge(const OverviewEdges& next, TileRowWriter& writer)
{
    const std::size_t sample_bytes = sampleBytes(type_);
    for (const auto& [place, added] : next.pixels_) {
        const auto at = pixels_.try_emplace(place, added);
        Pixels& pixels = at.first->second;
        if (!at.second) {
            pixels.samples.insert(pixels.samples.end(), added.samples.begin(), added.samples.end());
            pixels.valid.insert(pixels.valid.end(), added.valid.begin(), added.valid.end());
        }
        if (pixels.rows(sample_bytes) < pixels.rows_all) {
            continue;
        }
        const OverviewBuilder::Rows rows{
            .samples = reinterpret_cast<const std::byte*>(pixels.samples.data()),
            .valid = pixels.valid.empty() ? nullptr : pixels.valid.data(),
            .columns = pixels.columns,
            .rows = pixels.rows_all};
        if (Status written = writer.writeLevelRow(place.first, rows, place.second); !written) {
            return written;
        }
        written_.emplace_back(place.first, place.second);
        pixels_.erase(at.first);
    }
    return Done{};
}

} // namespace marsview
