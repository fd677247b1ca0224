#include "core/prepare/nested_levels.h"

#include <algorithm>
#include <cstring>

namespace marsview {
namespace {

// A sample's index in a tile and in a level.
struct Nested {
    std::size_t from = 0; // within the tile
    std::size_t to = 0;   // within the level
};

// Along an axis with `count` samples, of which the tile has [first, end).
std::vector<Nested>
nestedAlong(std::size_t first, std::size_t end, std::size_t count, std::size_t level)
{
    const std::size_t step = std::size_t{1} << level;
    std::vector<Nested> samples;
    for (std::size_t i = (first + step - 1) / step * step; i < end; i += step) {
        samples.push_back({i - first, i / step});
    }
    const std::size_t last = count - 1;
    if (first <= last && last < end && last % step != 0) {
        samples.push_back({last - first, last / step + 1});
    }
    return samples;
}

// The samples [first_column, first_column + columns) of all rows of a grid.
SampleGrid columnsOf(const SampleGrid& samples, std::size_t first_column, std::size_t columns)
{
    SampleGrid part = SampleGrid::create(samples.type(), columns, samples.rows()).value();
    samples.visit([&](auto values) {
        for (std::size_t row = 0; row < samples.rows(); ++row) {
            std::memcpy(part.rowData(row), values.row(row).data() + first_column,
                        columns * sizeof(values(0, 0)));
        }
    });
    for (std::size_t row = 0; samples.hasVoids() && row < samples.rows(); ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            if (samples.isVoid(first_column + column, row)) {
                part.markVoid(column, row);
            }
        }
    }
    return part;
}

} // namespace

NestedLevels::NestedLevels(const TileLayout& layout,
                           SampleType type,
                           std::size_t first,
                           std::size_t last,
                           const ScratchPlace* scratch)
    : layout_(layout)
    , type_(type)
    , first_(first)
    , last_(last)
    , scratch_(scratch)
{}

Result<SampleGrid> NestedLevels::zeros(std::size_t columns, std::size_t rows) const
{
    Result<SampleGrid> grid = SampleGrid::create(type_, columns, rows, scratch_);
    if (grid && !grid->isInFile()) { // a new file has zeros
        std::memset(grid->rowData(0), 0, columns * rows * sampleBytes(type_));
    }
    return grid;
}

void NestedLevels::release()
{
    const std::lock_guard lock(mutex_);
    for (const auto& [place, band] : bands_) {
        if (band.samples) {
            band.samples->releasePages();
        }
    }
}

Result<std::vector<LevelBand>> NestedLevels::add(const TileId& id, const SampleGrid* samples)
{
    MARSVIEW_CHECK(samples == nullptr || samples->type() == type_);
    const std::size_t first_column = id.column * kTileSide;
    const std::size_t first_row = id.row * kTileSide;
    std::vector<LevelBand> complete;
    for (std::size_t level = first_; level <= last_; ++level) {
        const auto columns =
            nestedAlong(first_column, first_column + layout_.tileWidth(id), layout_.columns, level);
        const auto rows =
            nestedAlong(first_row, first_row + layout_.tileHeight(id), layout_.rows, level);
        if (columns.empty()) {
            continue;
        }
        const std::size_t level_columns = layout_.columnsAt(TileKind::Samples, level);
        const std::lock_guard lock(mutex_);
        for (const Nested& row : rows) {
            const std::size_t tile_row = row.to / kTileSide;
            const std::size_t band_rows = std::min(
                kTileSide, layout_.rowsAt(TileKind::Samples, level) - tile_row * kTileSide);
            const auto at = bands_.try_emplace({level, tile_row}).first;
            Band& band = at->second;
            if (band.missing == 0) {
                band.missing = level_columns * band_rows;
            }
            if (samples != nullptr) {
                if (!band.samples) {
                    Result<SampleGrid> made = zeros(level_columns, band_rows);
                    if (!made) {
                        return std::move(made).error();
                    }
                    band.samples = std::move(made).value();
                }
                samples->visit([&](auto values) {
                    using T = std::remove_cvref_t<decltype(values(0, 0))>;
                    auto* to =
                        reinterpret_cast<T*>(band.samples->rowData(row.to - tile_row * kTileSide));
                    for (const Nested& column : columns) {
                        to[column.to] = values(column.from, row.from);
                    }
                });
                for (const Nested& column : columns) {
                    if (samples->isVoid(column.from, row.from)) {
                        band.samples->markVoid(column.to, row.to - tile_row * kTileSide);
                    }
                }
            }
            band.missing -= columns.size();
            if (band.missing == 0) {
                if (band.samples) {
                    complete.push_back({level, tile_row, std::move(*band.samples)});
                }
                bands_.erase(at);
            }
        }
    }
    return complete;
}

void NestedLevels::save(CheckpointWriter& to) const
{
    to.put(static_cast<std::uint64_t>(bands_.size()));
    for (const auto& [place, band] : bands_) {
        to.put(static_cast<std::uint64_t>(place.first));
        to.put(static_cast<std::uint64_t>(place.second));
        to.put(static_cast<std::uint64_t>(band.missing));
        to.put(static_cast<std::uint8_t>(band.samples ? 1 : 0));
        if (band.samples) {
            to.putRows(*band.samples, 0, band.samples->rows());
        }
    }
}

std::optional<NestedLevels::SavedBand> NestedLevels::readBand(CheckpointReader& from) const
{
    std::uint64_t level = 0;
    std::uint64_t tile_row = 0;
    std::uint64_t missing = 0;
    std::uint8_t has_samples = 0;
    if (!from.get(level) || !from.get(tile_row) || !from.get(missing) || !from.get(has_samples) ||
        level < first_ || level > last_ || tile_row >= layout_.tileRows(TileKind::Samples, level)) {
        return std::nullopt;
    }
    SavedBand saved{level, tile_row, {.samples = {}, .missing = missing}};
    if (has_samples != 0) {
        Result<SampleGrid> samples =
            zeros(layout_.columnsAt(TileKind::Samples, level), bandRows(level, tile_row));
        if (!samples || !from.getRows(*samples, 0, samples->rows())) {
            return std::nullopt;
        }
        saved.band.samples = std::move(samples).value();
    }
    return saved;
}

bool NestedLevels::restore(CheckpointReader& from)
{
    std::uint64_t count = 0;
    if (!from.get(count)) {
        return false;
    }
    for (std::uint64_t i = 0; i < count; ++i) {
        std::optional<SavedBand> saved = readBand(from);
        if (!saved) {
            return false;
        }
        bands_.insert_or_assign({saved->level, saved->tile_row}, std::move(saved->band));
    }
    return true;
}

std::optional<std::vector<LevelBand>>
NestedLevels::merge(CheckpointReader& from, std::size_t first, std::size_t end)
{
    std::uint64_t count = 0;
    if (!from.get(count)) {
        return std::nullopt;
    }
    const std::lock_guard lock(mutex_);
    std::vector<LevelBand> complete;
    for (std::uint64_t i = 0; i < count; ++i) {
        std::optional<SavedBand> saved = readBand(from);
        if (!saved) {
            return std::nullopt;
        }
        const std::size_t columns = layout_.columnsAt(TileKind::Samples, saved->level);
        const std::size_t rows = bandRows(saved->level, saved->tile_row);
        const auto at = bands_.try_emplace({saved->level, saved->tile_row}).first;
        Band& band = at->second;
        if (band.missing == 0) {
            band.missing = columns * rows;
        }
        const std::size_t added = columns * rows - saved->band.missing;
        if (added > band.missing) {
            return std::nullopt;
        }
        band.missing -= added;
        for (std::size_t row = 0; saved->band.samples && row < rows; ++row) {
            const std::size_t map_row =
                std::min((saved->tile_row * kTileSide + row) << saved->level, layout_.rows - 1);
            if (map_row / kTileSide < first || map_row / kTileSide >= end) {
                continue;
            }
            if (!band.samples) {
                Result<SampleGrid> made = zeros(columns, rows);
                if (!made) {
                    return std::nullopt;
                }
                band.samples = std::move(made).value();
            }
            std::memcpy(band.samples->rowData(row), saved->band.samples->rowData(row),
                        columns * sampleBytes(type_));
            for (std::size_t column = 0; saved->band.samples->hasVoids() && column < columns;
                 ++column) {
                if (saved->band.samples->isVoid(column, row)) {
                    band.samples->markVoid(column, row);
                }
            }
            saved->band.samples->releasePages();
            band.samples->releasePages();
        }
        if (band.missing == 0) {
            if (band.samples) {
                complete.push_back({saved->level, saved->tile_row, std::move(*band.samples)});
            }
            bands_.erase(at);
        }
    }
    return complete;
}

Status forEachTile(const LevelBand& band,
                   const TileLayout& layout,
                   const JobMonitor& monitor,
                   const std::function<void(const TileId&, const SampleGrid&)>& take)
{
    for (std::size_t first = 0; first < band.samples.columns(); first += kTileSide) {
        if (monitor.isCanceled()) {
            return Error{ErrorCode::Canceled, "canceled"};
        }
        const TileId id{.kind = TileKind::Samples,
                        .level = static_cast<std::uint8_t>(band.level),
                        .column = static_cast<std::uint32_t>(first / kTileSide),
                        .row = static_cast<std::uint32_t>(band.tile_row)};
        take(id, columnsOf(band.samples, first, layout.tileWidth(id)));
        if (id.column % kTilesPerRelease == kTilesPerRelease - 1) {
            band.samples.releasePages();
        }
    }
    return Done{};
}

} // namespace marsview
