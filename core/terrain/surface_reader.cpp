#include "core/terrain/surface_reader.h"

#include "core/terrain/seam.h"
#include "core/terrain/triangulation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace marsview {
namespace {

constexpr double kNoHeight = std::numeric_limits<double>::quiet_NaN();

double heightAt(const LoadedSamples& window,
                const ElevationScale& scale,
                std::size_t column,
                std::size_t row)
{
    return window.grid.isVoid(column, row) ? kNoHeight : scale.height(window.grid.raw(column, row));
}

} // namespace

SurfaceReader::SurfaceReader(RasterFile& file,
                             const RasterInfo& info,
                             const Georeference& georeference)
    : file_(file)
    , info_(info)
    , georeference_(georeference)
    , scale_(info.elevationScale())
{}

Result<double> SurfaceReader::sample(std::size_t column, std::size_t row)
{
    Result<LoadedSamples> window = file_.readWindow({column, row, 1, 1}, {info_.nodata});
    if (!window) {
        return std::move(window).error();
    }
    return heightAt(*window, scale_, 0, 0);
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
    Result<LoadedSamples> window = file_.readWindow(cell, {info_.nodata});
    if (!window) {
        return std::move(window).error();
    }
    const std::size_t right = cell.columns - 1;
    const std::size_t below = cell.rows - 1;
    return heightInCell({heightAt(*window, scale_, 0, 0), heightAt(*window, scale_, right, 0),
                         heightAt(*window, scale_, 0, below),
                         heightAt(*window, scale_, right, below)},
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
        Result<double> value = sample(column, row);
        if (!value) {
            return std::move(value).error();
        }
        corner = *value;
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
