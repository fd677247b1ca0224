#include "core/terrain/surface_reader.h"

#include "core/terrain/seam.h"
#include "core/terrain/triangulation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace marsview {
namespace {

constexpr double kNoHeight = std::numeric_limits<double>::quiet_NaN();

constexpr std::size_t kTilesMax = 256; // 32 MiB of int16

double heightAt(const SampleGrid& samples,
                const ElevationScale& scale,
                std::size_t column,
                std::size_t row)
{
    return samples.isVoid(column, row) ? kNoHeight : scale.height(samples.raw(column, row));
}

} // namespace

SurfaceReader::SurfaceReader(RasterFile& file,
                             const RasterInfo& info,
                             const Georeference& georeference,
                             std::shared_ptr<const TileSource> tiles)
    : file_(file)
    , info_(info)
    , georeference_(georeference)
    , scale_(info.elevationScale())
    , tiles_(std::move(tiles))
{}

Result<std::vector<double>> SurfaceReader::heightsIn(const GridWindow& window)
{
    std::vector<double> heights;
    if (!tiles_) {
        Result<LoadedSamples> read = file_.readWindow(window, {info_.nodata});
        if (!read) {
            return std::move(read).error();
        }
        for (std::size_t row = 0; row < window.rows; ++row) {
            for (std::size_t column = 0; column < window.columns; ++column) {
                heights.push_back(heightAt(read->grid, scale_, column, row));
            }
        }
        return heights;
    }
    for (std::size_t row = window.row; row < window.row + window.rows; ++row) {
        for (std::size_t column = window.column; column < window.column + window.columns;
             ++column) {
            const Result<double> height = heightInTile(column, row);
            if (!height) {
                return height.error();
            }
            heights.push_back(*height);
        }
    }
    return heights;
}

Result<double> SurfaceReader::heightInTile(std::size_t column, std::size_t row)
{
    const TileId id{.column = static_cast<std::uint32_t>(column / kTileSide),
                    .row = static_cast<std::uint32_t>(row / kTileSide)};
    auto at = read_.find(id);
    if (at == read_.end()) {
        if (!reader_) {
            auto reader = tiles_->open();
            if (!reader) {
                return std::move(reader).error();
            }
            reader_ = std::move(*reader);
        }
        Result<Tile> tile = reader_->read(id);
        if (!tile) {
            return std::move(tile).error();
        }
        if (read_.size() >= kTilesMax) {
            read_.clear();
        }
        at = read_.emplace(id, std::move(*tile)).first;
    }
    return heightAt(at->second.samples, scale_, column % kTileSide, row % kTileSide);
}

Result<double> SurfaceReader::height(GridPoint grid)
{
    const double last_column = static_cast<double>(info_.columns - 1);
    const double last_row = static_cast<double>(info_.rows - 1);
    if (!(grid.column >= 0.0 && grid.column <= last_column && grid.row >= 0.0 &&
          grid.row <= last_row)) {
        return kNoHeight;
    }
    // The last sample belongs to the last cell; a raster one sample wide has no cells, only
    // samples.
    const double c = std::max(0.0, std::min(std::floor(grid.column), last_column - 1.0));
    const double r = std::max(0.0, std::min(std::floor(grid.row), last_row - 1.0));
    const GridWindow cell{static_cast<std::size_t>(c), static_cast<std::size_t>(r),
                          std::min<std::size_t>(2, info_.columns),
                          std::min<std::size_t>(2, info_.rows)};
    const Result<std::vector<double>> heights = heightsIn(cell);
    if (!heights) {
        return heights.error();
    }
    const std::size_t right = cell.columns - 1;
    const std::size_t below = (cell.rows - 1) * cell.columns;
    return heightInCell(
        {(*heights)[0], (*heights)[right], (*heights)[below], (*heights)[below + right]},
        grid.column - c, grid.row - r);
}

Result<double> SurfaceReader::height(GeographicPoint geographic)
{
    const std::optional<GridPoint> grid = georeference_.toGrid(geographic);
    if (!grid) {
        return kNoHeight;
    }
    const auto seam = georeference_.wrapsAround() && info_.rows > 1
                          ? seamCell(*grid, info_.columns, info_.rows)
                          : std::nullopt;
    if (!seam) {
        return height(*grid);
    }
    CellHeights corners{};
    const std::size_t last = info_.columns - 1;
    const auto fill = [&](double& corner, std::size_t column, std::size_t row) -> Status {
        const Result<std::vector<double>> value = heightsIn({column, row, 1, 1});
        if (!value) {
            return value.error();
        }
        corner = value->front();
        return Done{};
    };
    for (const Status& status :
         {fill(corners.upper_left, last, seam->row), fill(corners.upper_right, 0, seam->row),
          fill(corners.lower_left, last, seam->row + 1),
          fill(corners.lower_right, 0, seam->row + 1)}) {
        if (!status) {
            return status.error();
        }
    }
    return heightInCell(corners, seam->u, seam->v);
}

} // namespace marsview
