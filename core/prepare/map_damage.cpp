#include "core/prepare/map_damage.h"

#include "core/base/check.h"
#include "core/prepare/tile_rows.h"

#include <atomic>
#include <limits>
#include <utility>

namespace marsview {
namespace {

bool isDamage(const Error& error)
{
    return error.code == ErrorCode::Invalid || error.code == ErrorCode::Unreadable;
}

// Rows of stored tiles: the raster's, then those of each overview.
TileId firstOfRow(const TileLayout& layout, std::size_t row)
{
    TileId id{.kind = TileKind::Samples, .level = 0, .column = 0, .row = 0};
    while (row >= layout.tileRows(id.kind, id.level)) {
        row -= layout.tileRows(id.kind, id.level);
        id.kind = TileKind::Means;
        ++id.level;
    }
    id.row = static_cast<std::uint32_t>(row);
    return id;
}

std::size_t rowCount(const TileLayout& layout)
{
    std::size_t rows = layout.tileRows(TileKind::Samples, 0);
    for (std::size_t level = 1; level <= layout.mean_levels; ++level) {
        rows += layout.tileRows(TileKind::Means, level);
    }
    return rows;
}

Status readAll(const TileSource& source, JobMonitor& monitor)
{
    const std::size_t rows = rowCount(source.layout());
    std::atomic<std::size_t> done{0};
    const auto read_row = [&](TileReader& reader, std::size_t row) -> Status {
        for (TileId id = firstOfRow(source.layout(), row);
             id.column < source.layout().tileColumns(id.kind, id.level); ++id.column) {
            if (const auto tile = readTile(reader, source, id, monitor); !tile) {
                return tile.error();
            }
        }
        monitor.report(static_cast<double>(++done) / static_cast<double>(rows));
        return Done{};
    };
    TileReaders readers(source, std::numeric_limits<std::size_t>::max());
    const auto read = readers.eachRow({.first = 0, .end = rows}, read_row, monitor);
    return read ? Status(Done{}) : Status(read.error());
}

} // namespace

Result<std::optional<MapDamage>> findDamage(const PreparedFiles& files, JobMonitor& monitor)
{
    MARSVIEW_CHECK(files.raster != nullptr);
    const auto found = [](MapDamage::Of of, Error error) -> Result<std::optional<MapDamage>> {
        if (!isDamage(error)) {
            return error;
        }
        return std::optional(MapDamage{.of = of, .error = std::move(error)});
    };
    Result<LevelFile> levels = LevelFile::open(files.level_path, files.level_key);
    if (!levels) {
        return std::move(levels).error();
    }
    if (Status checked = levels->check(monitor); !checked) {
        return found(MapDamage::Of::Levels, std::move(checked).error());
    }
    Result<MapLevels> known = levels->readLevels({});
    if (!known) {
        return found(MapDamage::Of::Levels, std::move(known).error());
    }
    const auto checked = files.raster->checkedBy(known->checksums, files.remedy);
    if (Status read = readAll(*checked, monitor); !read) {
        return found(MapDamage::Of::Raster, std::move(read).error());
    }
    return std::optional<MapDamage>();
}

} // namespace marsview
