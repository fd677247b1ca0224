#include "core/body/tiled_rim.h"

#include "core/base/check.h"
#include "core/levels/waiting_terrain.h"

namespace marsview {

Result<std::shared_ptr<const TiledRim>>
TiledRim::read(const BodyPositions& positions, const WaitingTerrain& terrain, JobMonitor& monitor)
{
    MARSVIEW_CHECK(canRead(terrain.heights()));
    std::shared_ptr<TiledRim> rim(new TiledRim);
    rim->columns_ = positions.columns();
    rim->rows_ = positions.rows();
    const auto at = [](std::size_t line, std::size_t count) {
        return line < kWidth ? line : count + line - 2 * kWidth;
    };
    // Tile by tile: the two lines next to each other have mostly the same ones.
    bool is_canceled = false;
    const auto read = [&](std::vector<double>& heights_m, std::size_t count, auto&& sample) {
        heights_m.resize(2 * kWidth * count);
        for (std::size_t first = 0; first < 2 * kWidth; first += kWidth) {
            for (std::size_t along = 0; along < count && !is_canceled; ++along) {
                is_canceled = along % kTileSide == 0 && monitor.isCanceled();
                for (std::size_t line = first; line < first + kWidth; ++line) {
                    heights_m[line * count + along] = sample(line, along);
                }
            }
        }
    };
    const std::size_t first_row = positions.firstRow();
    read(rim->rows_m_, rim->columns_, [&](std::size_t line, std::size_t column) {
        return terrain.sample(column, first_row + at(line, rim->rows_));
    });
    if (!positions.wraps()) {
        read(rim->columns_m_, rim->rows_, [&](std::size_t line, std::size_t row) {
            return terrain.sample(at(line, rim->columns_), first_row + row);
        });
    }
    if (is_canceled) {
        return Error{ErrorCode::Canceled, "joining the maps was canceled"};
    }
    if (terrain.error()) {
        return *terrain.error();
    }
    return std::shared_ptr<const TiledRim>(std::move(rim));
}

} // namespace marsview
