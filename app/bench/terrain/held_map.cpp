#include "app/bench/terrain/held_map.h"

#include "core/session/map.h"
#include "core/terrain/surface_analysis.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace marsview {
namespace {

// Tiles of a part of the samples; every tile is a copy.
class HeldTiles final : public TileSource {
public:
    explicit HeldTiles(std::shared_ptr<const FilledHeightfield> filled)
        : filled_(std::move(filled))
    {
        layout_.columns = filled_->columns();
        layout_.rows = filled_->rows();
        layout_.type = samples().type();
        layout_.has_voids = samples().hasVoids();
    }

    const TileLayout& layout() const noexcept override { return layout_; }
    const std::string& name() const noexcept override { return name_; }
    Result<std::unique_ptr<TileReader>> open() const override
    {
        return std::unique_ptr<TileReader>(new Reader(*this));
    }

private:
    class Reader final : public TileReader {
    public:
        explicit Reader(const HeldTiles& source)
            : source_(source)
        {}
        Result<Tile> read(const TileId& id) override { return source_.tile(id); }

    private:
        const HeldTiles& source_;
    };

    const SampleGrid& samples() const { return filled_->heightfield().samples(); }

    Result<Tile> tile(const TileId& id) const
    {
        const std::size_t width = layout_.tileWidth(id);
        const std::size_t height = layout_.tileHeight(id);
        Result<SampleGrid> grid = SampleGrid::create(layout_.type, width, height);
        if (!grid) {
            return std::move(grid).error();
        }
        Tile tile{.id = id, .samples = std::move(grid).value(), .filled_m = {}};
        const auto sampleOf = [&id](std::size_t tile_number, std::size_t i, std::size_t count) {
            return std::min((tile_number * kTileSide + i) << id.level, count - 1);
        };
        samples().visit([&](auto view) {
            using T = std::remove_const_t<std::remove_pointer_t<decltype(view.data())>>;
            for (std::size_t r = 0; r < height; ++r) {
                auto* to = reinterpret_cast<T*>(tile.samples.rowData(r));
                const std::size_t row = sampleOf(id.row, r, layout_.rows);
                for (std::size_t c = 0; c < width; ++c) {
                    to[c] = view(sampleOf(id.column, c, layout_.columns), row);
                }
            }
        });
        if (samples().hasVoids()) {
            fill(tile, sampleOf);
        }
        return tile;
    }

    template <typename F>
    void fill(Tile& tile, const F& sample_of) const
    {
        const std::size_t width = tile.samples.columns();
        std::vector<float> filled_m(width * tile.samples.rows());
        bool has_voids = false;
        for (std::size_t r = 0; r < tile.samples.rows(); ++r) {
            const std::size_t row = sample_of(tile.id.row, r, layout_.rows);
            for (std::size_t c = 0; c < width; ++c) {
                const std::size_t column = sample_of(tile.id.column, c, layout_.columns);
                if (filled_->isVoid(column, row)) {
                    tile.samples.markVoid(c, r);
                    filled_m[r * width + c] = static_cast<float>(filled_->sample(column, row));
                    has_voids = true;
                }
            }
        }
        if (has_voids) {
            tile.filled_m = std::move(filled_m);
        }
    }

    std::shared_ptr<const FilledHeightfield> filled_;
    TileLayout layout_;
    std::string name_ = "part of a map";
};

} // namespace

GridWindow
middleOf(std::size_t map_columns, std::size_t map_rows, std::size_t columns, std::size_t rows)
{
    columns = std::min(columns, map_columns);
    rows = std::min(rows, map_rows);
    return {.column = (map_columns - columns) / 2,
            .row = (map_rows - rows) / 2,
            .columns = columns,
            .rows = rows};
}

Result<HeldMap> holdWindow(const MapOptions& options, const GridWindow& window, JobMonitor& monitor)
{
    Result<OpenRaster> opened = openRaster(options);
    if (!opened) {
        return std::move(opened).error();
    }
    Result<LoadedSamples> loaded = opened->file.readWindow(window, opened->voids());
    if (!loaded) {
        return std::move(loaded).error();
    }
    if (!loaded->statistics.hasSamples()) {
        return Error{ErrorCode::Unsupported,
                     fmt::format("{}: all samples in its center are nodata", options.path)};
    }
    const Heightfield heightfield(std::make_shared<const SampleGrid>(std::move(loaded->grid)),
                                  loaded->statistics, opened->info.elevationScale());
    auto analysis = analyze(heightfield, monitor);
    if (!analysis) {
        return std::move(analysis).error();
    }
    Result<FilledHeightfield> filled = FilledHeightfield::build(heightfield, *analysis, monitor);
    if (!filled) {
        return std::move(filled).error();
    }
    SceneFrame frame = georeferenceOf(opened->info).sceneFrame();
    frame.origin.column -= static_cast<double>(window.column);
    frame.origin.row -= static_cast<double>(window.row);
    return HeldMap{.filled = std::make_shared<const FilledHeightfield>(std::move(filled).value()),
                   .analysis = std::move(analysis).value(),
                   .statistics = loaded->statistics,
                   .frame = frame,
                   .window = window};
}

std::shared_ptr<const TileSource> tilesOf(const HeldMap& map)
{
    return std::make_shared<const HeldTiles>(map.filled);
}

std::shared_ptr<const TileHeights> tileHeightsOf(const HeldMap& map)
{
    MapLevels levels;
    levels.layout = tilesOf(map)->layout();
    levels.statistics = map.statistics;
    levels.analysis = map.analysis;
    if (levels.layout.has_voids) {
        const MinMaxPyramid& bounds = map.analysis->bounds;
        for (std::size_t k = 0; k < bounds.levelCount(); ++k) {
            std::vector<float>& maxima = levels.filled_maxima_m.emplace_back();
            for (std::size_t r = 0; r < bounds.rows(k); ++r) {
                for (std::size_t c = 0; c < bounds.columns(k); ++c) {
                    maxima.push_back(static_cast<float>(map.filled->maximum(k, c, r)));
                }
            }
        }
    }
    return std::make_shared<const TileHeights>(std::make_shared<const MapLevels>(std::move(levels)),
                                               map.filled->heightfield().scale());
}

} // namespace marsview
