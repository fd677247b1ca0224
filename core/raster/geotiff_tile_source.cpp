#include "core/raster/geotiff_tile_source.h"

#include "core/base/check.h"
#include "core/raster/remote_raster.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <utility>

namespace marsview {
namespace {

// Overviews are rounded up or, by some programs, down.
bool isAlmost(const GridSize& size, const GridSize& wanted)
{
    const auto is_close = [](std::size_t a, std::size_t b) { return a == b || a + 1 == b; };
    return size.columns > 0 && size.rows > 0 && is_close(size.columns, wanted.columns) &&
           is_close(size.rows, wanted.rows);
}

class GeotiffTileReader final : public TileReader {
public:
    GeotiffTileReader(RasterFile file,
                      const TileLayout& layout,
                      VoidRule voids,
                      std::vector<std::size_t> overviews)
        : file_(std::move(file))
        , layout_(layout)
        , voids_(voids)
        , overviews_(std::move(overviews))
    {}

    Result<Tile> read(const TileId& id) override
    {
        MARSVIEW_CHECK(layout_.contains(id));
        Result<SampleGrid> samples = id.kind == TileKind::Means ? readMeans(id) : readSamples(id);
        if (!samples) {
            return std::move(samples).error();
        }
        return Tile{.id = id, .samples = std::move(samples).value(), .filled_m = {}};
    }

private:
    static Result<SampleGrid> gridOf(Result<LoadedSamples> loaded)
    {
        if (!loaded) {
            return std::move(loaded).error();
        }
        return std::move(loaded->grid);
    }

    Result<SampleGrid> readMeans(const TileId& id)
    {
        const std::size_t overview = overviews_[id.level];
        const GridSize size = file_.overviewSize(overview);
        const std::size_t column = std::min(id.column * kTileSide, size.columns - 1);
        const std::size_t row = std::min(id.row * kTileSide, size.rows - 1);
        const std::size_t width = layout_.tileWidth(id);
        const std::size_t height = layout_.tileHeight(id);
        const GridWindow window{column, row, std::min(width, size.columns - column),
                                std::min(height, size.rows - row)};
        Result<SampleGrid> means = gridOf(file_.readOverview(overview, window, voids_));
        if (!means || (means->columns() == width && means->rows() == height)) {
            return means;
        }
        return thinned(*means, 1, width, height); // the overview was rounded down
    }

    Result<SampleGrid> readSamples(const TileId& id)
    {
        MARSVIEW_CHECK(id.level <= GeotiffTileSource::kLastLevel);
        const std::size_t step = std::size_t{1} << id.level;
        const std::size_t width = layout_.tileWidth(id);
        const std::size_t height = layout_.tileHeight(id);
        // The last sample of a level is the raster's last, however far from the one before; it may
        // have a tile of its own.
        GridWindow window{std::min(id.column * kTileSide * step, layout_.columns - 1),
                          std::min(id.row * kTileSide * step, layout_.rows - 1),
                          (width - 1) * step + 1, (height - 1) * step + 1};
        window.columns = std::min(window.columns, layout_.columns - window.column);
        window.rows = std::min(window.rows, layout_.rows - window.row);
        Result<SampleGrid> all = gridOf(file_.readWindow(window, voids_));
        if (!all || id.level == 0) {
            return all;
        }
        return thinned(*all, step, width, height);
    }

    // Every `step`-th sample, and where there are no more, the last.
    static Result<SampleGrid>
    thinned(const SampleGrid& all, std::size_t step, std::size_t width, std::size_t height)
    {
        Result<SampleGrid> few = SampleGrid::create(all.type(), width, height);
        if (!few) {
            return few;
        }
        all.visit([&](auto view) {
            using T = std::remove_cvref_t<decltype(view(0, 0))>;
            for (std::size_t j = 0; j < height; ++j) {
                const std::size_t row = std::min(j * step, all.rows() - 1);
                std::byte* to = few->rowData(j);
                for (std::size_t i = 0; i < width; ++i) {
                    const std::size_t column = std::min(i * step, all.columns() - 1);
                    const T sample = view(column, row);
                    std::memcpy(to + i * sizeof(T), &sample, sizeof(T));
                    if (all.isVoid(column, row)) {
                        few->markVoid(i, j);
                    }
                }
            }
        });
        return few;
    }

    RasterFile file_;
    TileLayout layout_;
    VoidRule voids_;
    std::vector<std::size_t> overviews_;
};

} // namespace

Result<std::shared_ptr<const GeotiffTileSource>> GeotiffTileSource::of(const RasterFile& file,
                                                                       const VoidRule& voids)
{
    const RasterInfo& info = file.info();
    const auto refuse = [&info](const std::string& why) {
        return remoteNameFor(info.path)
                   ? notCloudOptimised(info.path, why)
                   : Error{ErrorCode::Unsupported,
                           fmt::format("{}: {}; prepare it first", info.path, why)};
    };
    const GridSize block = file.blockSize();
    if (block.columns > kBlockSideMax || block.rows > kBlockSideMax) {
        return refuse(
            fmt::format("it is stored in blocks of {} × {} samples, too large to be read in "
                        "pieces",
                        block.columns, block.rows));
    }
    auto source = std::shared_ptr<GeotiffTileSource>(new GeotiffTileSource);
    TileLayout& layout = source->layout_;
    layout = {.columns = info.columns,
              .rows = info.rows,
              .type = info.type,
              .has_voids = info.has_mask_band || voids.nodata.has_value() ||
                           info.type == SampleType::Float32 || info.type == SampleType::Float64,
              .mean_levels = 0};
    source->overviews_.push_back(0);
    for (std::size_t level = 1;; ++level) {
        const GridSize wanted{layout.columnsAt(TileKind::Means, level),
                              layout.rowsAt(TileKind::Means, level)};
        std::size_t overview = 0;
        while (overview < file.overviewCount() && !isAlmost(file.overviewSize(overview), wanted)) {
            ++overview;
        }
        if (overview == file.overviewCount()) {
            break;
        }
        source->overviews_.push_back(overview);
        layout.mean_levels = level;
    }
    // A picture of all of it has to be cheap.
    constexpr std::size_t kCoarsestMax = 1024;
    if (std::max(layout.columnsAt(TileKind::Means, layout.mean_levels),
                 layout.rowsAt(TileKind::Means, layout.mean_levels)) > kCoarsestMax) {
        return refuse("it has no overviews down to a small picture of it");
    }
    source->path_ = info.path;
    source->name_ = addressOf(info.path);
    source->remote_version_ = info.remote_version;
    source->band_ = info.band;
    source->voids_ = voids;
    return std::shared_ptr<const GeotiffTileSource>(std::move(source));
}

Result<std::unique_ptr<TileReader>> GeotiffTileSource::open() const
{
    Result<RasterFile> file = RasterFile::open(path_, band_);
    if (!file) {
        return std::move(file).error();
    }
    const RasterInfo& info = file->info();
    if (info.columns != layout_.columns || info.rows != layout_.rows || info.type != layout_.type ||
        info.remote_version != remote_version_) {
        return Error{ErrorCode::Invalid,
                     name_ + ": has become another raster since it was opened; open it again"};
    }
    return std::unique_ptr<TileReader>(
        std::make_unique<GeotiffTileReader>(std::move(*file), layout_, voids_, overviews_));
}

} // namespace marsview
