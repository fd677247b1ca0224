#include "core/tiles/geotiff_tile_source.h"

#include "core/base/check.h"
#include "core/files/remote_raster.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <utility>

namespace marsview {
namespace {

// Repeated requests for a tile whose response was truncated.
constexpr int kRepeatsMax = 2;

// Overview sizes are rounded up or, by some programs, down.
bool isAlmost(const GridSize& size, const GridSize& wanted)
{
    const auto is_close = [](std::size_t a, std::size_t b) { return a == b || a + 1 == b; };
    return size.columns > 0 && size.rows > 0 && is_close(size.columns, wanted.columns) &&
           is_close(size.rows, wanted.rows);
}

} // namespace

class GeotiffTileSource::Reader final : public TileReader {
public:
    Reader(RasterFile file, const Raster& raster)
        : file_(std::move(file))
        , raster_(raster)
    {}

    Result<Tile> read(const TileId& id) override
    {
        MARSVIEW_CHECK(raster_.layout.contains(id));
        Result<SampleGrid> samples = readOnce(id);
        for (int i = 0; i < kRepeatsMax && !samples && isCutShort(samples.error()); ++i) {
            samples = readOnce(id);
        }
        if (!samples) {
            // A local raster that was intact when it was prepared.
            const bool is_damage = raster_.checksums && raster_.remote_version.empty() &&
                                   samples.error().code == ErrorCode::Unreadable;
            return is_damage ? damaged(id, "can no longer be decoded") : samples.error();
        }
        if (raster_.checksums && TileChecksums::covers(id) &&
            sampleChecksum(*samples) != raster_.checksums->of(id)) {
            return damaged(id);
        }
        return Tile{.id = id, .samples = std::move(samples).value(), .filled_m = {}};
    }

private:
    Result<SampleGrid> readOnce(const TileId& id)
    {
        return id.kind == TileKind::Means ? readMeans(id) : readSamples(id);
    }

    // GDAL retries when a server reports an error, but not when a response is truncated.
    bool isCutShort(const Error& error) const
    {
        return !raster_.remote_version.empty() && error.code == ErrorCode::Unreadable &&
               error.message.find(kConnectionLost) != std::string::npos;
    }

    Error damaged(const TileId& id,
                  const char* how = "differ from those that it was prepared with") const
    {
        return {ErrorCode::Unreadable,
                fmt::format("{}: is damaged in the tile at column {}, row {} of {} {}, whose "
                            "heights {}; {}",
                            addressOf(file_.info().path), id.column, id.row,
                            id.kind == TileKind::Means ? "overview" : "level", id.level, how,
                            raster_.remedy)};
    }

    static Result<SampleGrid> gridOf(Result<LoadedSamples> loaded)
    {
        if (!loaded) {
            return std::move(loaded).error();
        }
        return std::move(loaded->grid);
    }

    Result<SampleGrid> readMeans(const TileId& id)
    {
        const std::size_t overview = raster_.overviews[id.level];
        const GridSize size = file_.overviewSize(overview);
        const std::size_t column = std::min(id.column * kTileSide, size.columns - 1);
        const std::size_t row = std::min(id.row * kTileSide, size.rows - 1);
        const std::size_t width = raster_.layout.tileWidth(id);
        const std::size_t height = raster_.layout.tileHeight(id);
        const GridWindow window{column, row, std::min(width, size.columns - column),
                                std::min(height, size.rows - row)};
        Result<SampleGrid> means = gridOf(file_.readOverview(overview, window, raster_.voids));
        if (!means || (means->columns() == width && means->rows() == height)) {
            return means;
        }
        return thinned(*means, {0, 0, width, height}, 1); // the overview was rounded down
    }

    Result<SampleGrid> readSamples(const TileId& id)
    {
        MARSVIEW_CHECK(id.level <= GeotiffTileSource::kLastLevel);
        const std::size_t step = std::size_t{1} << id.level;
        const std::size_t width = raster_.layout.tileWidth(id);
        const std::size_t height = raster_.layout.tileHeight(id);
        // The last sample of a level is the raster's last, whatever its distance from the one
        // before; it may be alone in a tile.
        const std::size_t first_column =
            std::min(id.column * kTileSide * step, raster_.layout.columns - 1);
        const std::size_t first_row = std::min(id.row * kTileSide * step, raster_.layout.rows - 1);
        GridWindow window{first_column, first_row, (width - 1) * step + 1, (height - 1) * step + 1};
        if (raster_.checksums) { // checksums cover whole tiles
            window = {first_column / kTileSide * kTileSide, first_row / kTileSide * kTileSide,
                      kTileSide * step, kTileSide * step};
        }
        window.columns = std::min(window.columns, raster_.layout.columns - window.column);
        window.rows = std::min(window.rows, raster_.layout.rows - window.row);
        Result<SampleGrid> all = gridOf(file_.readWindow(window, raster_.voids));
        if (!all || id.level == 0) {
            return all;
        }
        if (raster_.checksums) {
            if (const std::optional<TileId> wrong = firstDamaged(*all, window)) {
                return damaged(*wrong);
            }
        }
        return thinned(*all, {first_column - window.column, first_row - window.row, width, height},
                       step);
    }

    // The first damaged one of the window's level-0 tiles.
    std::optional<TileId> firstDamaged(const SampleGrid& samples, const GridWindow& window) const
    {
        for (std::size_t row = 0; row < window.rows; row += kTileSide) {
            for (std::size_t column = 0; column < window.columns; column += kTileSide) {
                const TileId id{
                    .kind = TileKind::Samples,
                    .level = 0,
                    .column = static_cast<std::uint32_t>((window.column + column) / kTileSide),
                    .row = static_cast<std::uint32_t>((window.row + row) / kTileSide)};
                const GridWindow part{column, row, raster_.layout.tileWidth(id),
                                      raster_.layout.tileHeight(id)};
                if (sampleChecksum(samples, part) != raster_.checksums->of(id)) {
                    return id;
                }
            }
        }
        return std::nullopt;
    }

    // Every `step`-th sample from the part's first on, as many as it has columns and rows; beyond
    // the end, the last sample.
    static Result<SampleGrid>
    thinned(const SampleGrid& all, const GridWindow& part, std::size_t step)
    {
        Result<SampleGrid> few = SampleGrid::create(all.type(), part.columns, part.rows);
        if (!few) {
            return few;
        }
        all.visit([&](auto view) {
            using T = std::remove_cvref_t<decltype(view(0, 0))>;
            for (std::size_t j = 0; j < part.rows; ++j) {
                const std::size_t row = std::min(part.row + j * step, all.rows() - 1);
                std::byte* to = few->rowData(j);
                for (std::size_t i = 0; i < part.columns; ++i) {
                    const std::size_t column = std::min(part.column + i * step, all.columns() - 1);
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
    Raster raster_;
};

GeotiffTileSource::GeotiffTileSource(Raster raster)
    : raster_(std::move(raster))
{}

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
    Raster raster{.layout = {},
                  .path = info.path,
                  .name = addressOf(info.path),
                  .remote_version = info.remote_version,
                  .band = info.band,
                  .voids = voids,
                  .overviews = {0},
                  .open_files = file.openFiles()};
    TileLayout& layout = raster.layout;
    layout = {.columns = info.columns,
              .rows = info.rows,
              .type = info.type,
              .has_voids = info.needsVoidMask() || voids.nodata.has_value() ||
                           info.type == SampleType::Float32 || info.type == SampleType::Float64,
              .mean_levels = 0,
              .is_remote = remoteNameFor(info.path).has_value()};
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
        raster.overviews.push_back(overview);
        layout.mean_levels = level;
    }
    // A picture of the whole raster must be cheap to read.
    constexpr std::size_t kCoarsestMax = 1024;
    if (std::max(layout.columnsAt(TileKind::Means, layout.mean_levels),
                 layout.rowsAt(TileKind::Means, layout.mean_levels)) > kCoarsestMax) {
        return refuse("it has no overviews that are small enough");
    }
    return std::shared_ptr<const GeotiffTileSource>(new GeotiffTileSource(std::move(raster)));
}

std::shared_ptr<const GeotiffTileSource>
GeotiffTileSource::checkedBy(std::shared_ptr<const TileChecksums> checksums,
                             const std::string& remedy) const
{
    Raster raster = raster_;
    raster.checksums = std::move(checksums);
    raster.remedy = remedy;
    return std::shared_ptr<const GeotiffTileSource>(new GeotiffTileSource(std::move(raster)));
}

Result<std::unique_ptr<TileReader>> GeotiffTileSource::open() const
{
    Result<RasterFile> file = RasterFile::open(raster_.path, raster_.band);
    if (!file) {
        return std::move(file).error();
    }
    const RasterInfo& info = file->info();
    if (info.columns != raster_.layout.columns || info.rows != raster_.layout.rows ||
        info.type != raster_.layout.type || info.remote_version != raster_.remote_version) {
        return Error{ErrorCode::Invalid,
                     raster_.name + ": has changed since it was opened; open it again"};
    }
    return std::unique_ptr<TileReader>(std::make_unique<Reader>(std::move(*file), raster_));
}

} // namespace marsview
