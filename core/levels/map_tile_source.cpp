#include "core/levels/map_tile_source.h"

#include "core/base/check.h"
#include "core/files/shared_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace marsview {
namespace {

class MapTileReader final : public TileReader {
public:
    MapTileReader(std::shared_ptr<const MapTiles> tiles,
                  std::unique_ptr<TileReader> raster,
                  std::optional<LevelFile> levels)
        : tiles_(std::move(tiles))
        , raster_(std::move(raster))
        , levels_(std::move(levels))
    {}

    Result<Tile> read(const TileId& id) override
    {
        const bool is_kept = levels_.has_value() && id.kind == TileKind::Samples &&
                             id.level >= LevelFile::kFirstLevel;
        Result<Tile> tile = is_kept ? readKept(id) : raster_->read(id);
        if (!tile || id.kind == TileKind::Means || !tile->samples.hasVoids()) {
            return tile;
        }
        if (levels_ && id.level == 0) {
            Result<std::vector<float>> filled = levels_->readFilled(id, tiles_->scale);
            if (!filled) {
                return std::move(filled).error();
            }
            tile->filled_m = std::move(filled).value();
        }
        if (tile->filled_m.empty()) {
            fill(*tile);
        }
        return tile;
    }

private:
    Result<Tile> readKept(const TileId& id)
    {
        Result<SampleGrid> samples = levels_->readSamples(id);
        if (!samples) {
            return std::move(samples).error();
        }
        return Tile{.id = id, .samples = std::move(samples).value(), .filled_m = {}};
    }

    // Fills from the means that are always in memory, which are coarser than those for full
    // resolution.
    void fill(Tile& tile) const
    {
        const TileLayout& layout = tiles_->layout;
        const std::size_t columns = tile.samples.columns();
        const std::size_t rows = tile.samples.rows();
        tile.filled_m.resize(columns * rows);
        for (std::size_t j = 0; j < rows; ++j) {
            const std::size_t row =
                std::min((tile.id.row * kTileSide + j) << tile.id.level, layout.rows - 1);
            for (std::size_t i = 0; i < columns; ++i) {
                if (tile.samples.isVoid(i, j)) {
                    const std::size_t column = std::min(
                        (tile.id.column * kTileSide + i) << tile.id.level, layout.columns - 1);
                    tile.filled_m[j * columns + i] = tiles_->analysis->means.filled(column, row);
                }
            }
        }
    }

    std::shared_ptr<const MapTiles> tiles_;
    std::unique_ptr<TileReader> raster_;
    std::optional<LevelFile> levels_;
};

class MapTileSource final : public TileSource {
public:
    explicit MapTileSource(MapTiles tiles)
        : tiles_(std::make_shared<const MapTiles>(std::move(tiles)))
        , level_file_(tiles_->level_path ? openShared(*tiles_->level_path) : nullptr)
    {}

    const TileLayout& layout() const noexcept override { return tiles_->layout; }
    const std::string& name() const noexcept override { return tiles_->raster->name(); }

    Result<std::unique_ptr<TileReader>> open() const override
    {
        Result<std::unique_ptr<TileReader>> raster = tiles_->raster->open();
        if (!raster) {
            return std::move(raster).error();
        }
        std::optional<LevelFile> levels;
        if (tiles_->level_path) {
            Result<LevelFile> opened = LevelFile::open(*tiles_->level_path, tiles_->level_key);
            if (!opened) {
                return std::move(opened).error();
            }
            levels = std::move(opened).value();
        }
        return std::unique_ptr<TileReader>(
            std::make_unique<MapTileReader>(tiles_, std::move(raster).value(), std::move(levels)));
    }

private:
    std::shared_ptr<const MapTiles> tiles_;
    std::shared_ptr<const SharedFile> level_file_; // open for all readers; null: none
};

} // namespace

std::shared_ptr<const TileSource> mapTileSource(MapTiles tiles)
{
    MARSVIEW_CHECK(tiles.raster != nullptr && tiles.analysis != nullptr);
    return std::make_shared<const MapTileSource>(std::move(tiles));
}

} // namespace marsview
