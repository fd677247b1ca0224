#include "core/measure/sample_reader.h"

#include "core/measure/constants.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <limits>
#include <unordered_map>
#include <utility>

namespace marsview {
namespace {

// For samples in memory: the last that has more than the outermost samples.
std::size_t coarsestLevel(const Heightfield& heightfield)
{
    if (heightfield.isTiled()) {
        return heightfield.tiles()->layout().topLevel();
    }
    const std::size_t cells = std::min(heightfield.columns(), heightfield.rows()) - 1;
    return static_cast<std::size_t>(std::bit_width(cells)) - 1;
}

class HeldSamples final : public SampleReader {
public:
    HeldSamples(const Heightfield& heightfield, std::size_t level)
        : SampleReader(std::size_t{1} << level)
        , heightfield_(heightfield)
    {}

    double sample(std::size_t column, std::size_t row) override
    {
        return heightfield_.sample(column, row);
    }

private:
    Heightfield heightfield_;
};

// One tile after another: a measurement stays in a tile for many samples.
class TiledLevel final : public SampleReader {
public:
    TiledLevel(const Heightfield& heightfield, std::size_t level)
        : SampleReader(std::size_t{1} << level)
        , tiles_(heightfield.tiles())
        , scale_(heightfield.scale())
        , level_(level)
    {}

    double sample(std::size_t column, std::size_t row) override
    {
        const std::size_t step = std::size_t{1} << level_;
        // The last sample of a level is the last one of the raster.
        const std::size_t i = (column + step - 1) / step;
        const std::size_t j = (row + step - 1) / step;
        const TileId id{.kind = TileKind::Samples,
                        .level = static_cast<std::uint8_t>(level_),
                        .column = static_cast<std::uint32_t>(i / kTileSide),
                        .row = static_cast<std::uint32_t>(j / kTileSide)};
        const Tile* tile = tileOf(id);
        if (tile == nullptr || tile->samples.isVoid(i % kTileSide, j % kTileSide)) {
            return kNoMeasure;
        }
        return scale_.height(tile->samples.raw(i % kTileSide, j % kTileSide));
    }

private:
    // Enough for a row of cells across the tiles of a chunk of columns (terrain_area.cpp), and for
    // a path that zigzags between two tiles.
    static constexpr std::size_t kTilesMax = 64;

    const Tile* tileOf(const TileId& id)
    {
        if (last_ != nullptr && last_id_ == id) {
            return last_.get();
        }
        auto at = used_.find(id);
        if (at == used_.end()) {
            auto tile = tiles_->raster().get(id);
            if (!tile) {
                fail(tile.error());
                return nullptr;
            }
            if (used_.size() >= kTilesMax) {
                used_.clear();
            }
            at = used_.emplace(id, std::move(tile).value()).first;
        }
        last_id_ = id;
        last_ = at->second;
        return last_.get();
    }

    std::shared_ptr<const TiledSamples> tiles_;
    ElevationScale scale_;
    std::size_t level_;
    TileId last_id_;
    std::shared_ptr<const Tile> last_;
    std::unordered_map<TileId, std::shared_ptr<const Tile>, TileIdHash> used_;
};

class FileSamples final : public SampleReader {
public:
    FileSamples(OpenRaster& raster, std::shared_ptr<const TileSource> tiles)
        : SampleReader(1)
        , raster_(raster)
        , scale_(raster.info.elevationScale())
        , tiles_(std::move(tiles))
    {}

    double sample(std::size_t column, std::size_t row) override
    {
        const std::size_t place =
            row / kTileSide * (raster_.info.columns / kTileSide + 1) + column / kTileSide;
        if (last_ == nullptr || place != last_place_) {
            last_ = windowAt(place, column / kTileSide, row / kTileSide);
            last_place_ = place;
        }
        if (last_ == nullptr || last_->isVoid(column % kTileSide, row % kTileSide)) {
            return kNoMeasure;
        }
        return scale_.height(last_->raw(column % kTileSide, row % kTileSide));
    }

private:
    static constexpr std::size_t kWindowsMax = 256; // 128 MiB of double, 32 MiB of int16

    const SampleGrid* windowAt(std::size_t place, std::size_t tile_column, std::size_t tile_row)
    {
        auto at = read_.find(place);
        if (at == read_.end()) {
            Result<SampleGrid> samples = read(tile_column, tile_row);
            if (!samples) {
                fail(samples.error());
                return nullptr;
            }
            if (read_.size() >= kWindowsMax) {
                read_.clear();
            }
            at = read_.emplace(place, std::move(*samples)).first;
        }
        return &at->second;
    }

    Result<SampleGrid> read(std::size_t tile_column, std::size_t tile_row)
    {
        if (!tiles_) {
            const std::size_t column = tile_column * kTileSide;
            const std::size_t row = tile_row * kTileSide;
            Result<LoadedSamples> window = raster_.file.readWindow(
                {column, row, std::min(kTileSide, raster_.info.columns - column),
                 std::min(kTileSide, raster_.info.rows - row)},
                raster_.voids());
            return window ? Result<SampleGrid>(std::move(window->grid))
                          : Result<SampleGrid>(window.error());
        }
        if (!reader_) {
            auto reader = tiles_->open();
            if (!reader) {
                return std::move(reader).error();
            }
            reader_ = std::move(*reader);
        }
        Result<Tile> tile = reader_->read({.column = static_cast<std::uint32_t>(tile_column),
                                           .row = static_cast<std::uint32_t>(tile_row)});
        return tile ? Result<SampleGrid>(std::move(tile->samples))
                    : Result<SampleGrid>(tile.error());
    }

    OpenRaster& raster_;
    ElevationScale scale_;
    std::shared_ptr<const TileSource> tiles_;
    std::unique_ptr<TileReader> reader_; // once one is needed
    std::size_t last_place_ = 0;
    const SampleGrid* last_ = nullptr;
    std::unordered_map<std::size_t, SampleGrid> read_;
};

} // namespace

std::unique_ptr<SampleReader> readSamples(const Heightfield& heightfield, std::size_t level)
{
    const std::size_t used = std::min(level, coarsestLevel(heightfield));
    if (heightfield.isTiled()) {
        return std::make_unique<TiledLevel>(heightfield, used);
    }
    return std::make_unique<HeldSamples>(heightfield, used);
}

std::unique_ptr<SampleReader> readSamples(OpenRaster& raster,
                                          std::shared_ptr<const TileSource> tiles)
{
    return std::make_unique<FileSamples>(raster, std::move(tiles));
}

} // namespace marsview
