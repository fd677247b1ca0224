// Notation. Sample i of level k is sample min(i · 2^k, count - 1) of the map, along either axis, so
// that the last cell of a level is narrower than the others if 2^k does not divide count - 1.
#include "haptics/terrain/clipmap.h"

#include "core/base/check.h"
#include "core/terrain/triangulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace marsview {
namespace {

// The position of a map sample between the samples of a level, along one axis.
struct AlongAxis {
    std::size_t index; // of the level's sample before it, or at it
    double share;      // fraction of the following cell, in [0, 1)
};

AlongAxis alongAxis(std::size_t level, std::size_t sample, std::size_t count) noexcept
{
    const std::size_t step = std::size_t{1} << level;
    const std::size_t index = sample >> level;
    const std::size_t begin = index << level;
    if (sample == begin) {
        return {index, 0.0};
    }
    if (sample == count - 1) {
        return {index + 1, 0.0};
    }
    const std::size_t end = std::min(begin + step, count - 1);
    return {index, static_cast<double>(sample - begin) / static_cast<double>(end - begin)};
}

} // namespace

std::size_t
Clipmap::firstTile(double center, std::size_t level, std::size_t tiles, std::size_t side) noexcept
{
    const double width = static_cast<double>(kTileSide << level);
    const double most = static_cast<double>(tiles - side);
    const double first = std::round(center / width - static_cast<double>(side) / 2.0);
    return static_cast<std::size_t>(std::clamp(first, 0.0, most));
}

std::int64_t Clipmap::firstTileAround(double center, std::size_t level, std::size_t side) noexcept
{
    const double width = static_cast<double>(kTileSide << level);
    return std::llround(center / width - static_cast<double>(side) / 2.0);
}

Clipmap::Clipmap(std::shared_ptr<const TileHeights> heights,
                 std::shared_ptr<const Tile> top,
                 const std::vector<GridPoint>& centers,
                 const WindowSides& sides)
    : heights_(std::move(heights))
{
    const TileLayout& layout = heights_->layout();
    const std::size_t top_level = layout.topLevel();
    MARSVIEW_CHECK(centers.size() == top_level + 1);
    MARSVIEW_CHECK(sides.finest >= 3 && sides.finest <= kSideMax);
    MARSVIEW_CHECK(sides.coarser >= 3 && sides.coarser <= kSideMax);
    levels_.resize(top_level + 1);
    for (std::size_t k = 0; k <= top_level; ++k) {
        const std::size_t side = k == 0 ? sides.finest : sides.coarser;
        const std::size_t tile_columns = layout.tileColumns(TileKind::Samples, k);
        const std::size_t tile_rows = layout.tileRows(TileKind::Samples, k);
        const std::size_t columns = std::min(side, tile_columns);
        const std::size_t rows = std::min(side, tile_rows);
        Level& level = levels_[k];
        level.columns = static_cast<std::uint32_t>(columns);
        level.rows = static_cast<std::uint32_t>(rows);
        level.tile_columns = static_cast<std::uint32_t>(tile_columns);
        if (sides.wraps && columns < tile_columns) {
            const auto around = static_cast<std::int64_t>(tile_columns);
            const std::int64_t first = firstTileAround(centers[k].column, k, columns) % around;
            level.first_column = static_cast<std::uint32_t>(first < 0 ? first + around : first);
        } else {
            level.first_column =
                static_cast<std::uint32_t>(firstTile(centers[k].column, k, tile_columns, columns));
        }
        level.first_row = static_cast<std::uint32_t>(firstTile(centers[k].row, k, tile_rows, rows));
        level.slots.resize(columns * rows);
    }
    putTop(std::move(top));
}

Clipmap::Clipmap(std::shared_ptr<const TileHeights> heights,
                 std::shared_ptr<const Tile> top,
                 std::span<const ShownTiles> squares)
    : heights_(std::move(heights))
{
    const TileLayout& layout = heights_->layout();
    MARSVIEW_CHECK(squares.size() == layout.topLevel() + 1);
    for (std::size_t k = 0; k < squares.size(); ++k) {
        const ShownTiles& square = squares[k];
        MARSVIEW_CHECK(fits(layout, k, square));
        levels_.push_back(
            {.first_column = square.first_column,
             .first_row = square.first_row,
             .columns = square.columns,
             .rows = square.rows,
             .tile_columns = static_cast<std::uint32_t>(layout.tileColumns(TileKind::Samples, k)),
             .slots = std::vector<Slot>(std::size_t{square.columns} * square.rows)});
    }
    putTop(std::move(top));
}

bool Clipmap::fits(const TileLayout& layout, std::size_t level, const ShownTiles& square) noexcept
{
    const std::size_t columns = layout.tileColumns(TileKind::Samples, level);
    const std::size_t rows = layout.tileRows(TileKind::Samples, level);
    return square.columns > 0 && square.columns <= std::min(kSideMax, columns) &&
           square.first_column < columns && square.rows > 0 && square.rows <= kSideMax &&
           square.first_row < rows && square.rows <= rows - square.first_row;
}

void Clipmap::putTop(std::shared_ptr<const Tile> top)
{
    MARSVIEW_CHECK(top && top->id.level + 1U == levels_.size());
    put(std::move(top), 0.0);
}

ShownTiles Clipmap::shown(std::size_t level) const noexcept
{
    const Level& l = levels_[level];
    ShownTiles shown{l.first_column, l.first_row, l.columns, l.rows, 0};
    for (std::size_t i = 0; i < l.slots.size(); ++i) {
        shown.is_there |= std::uint64_t{l.slots[i].tile != nullptr} << i;
    }
    return shown;
}

void Clipmap::put(std::shared_ptr<const Tile> tile, double difference_m)
{
    const TileLayout& layout = heights_->layout();
    const TileId& id = tile->id;
    MARSVIEW_CHECK(id.kind == TileKind::Samples && slot(id) != nullptr);
    MARSVIEW_CHECK(tile->samples.type() == layout.type &&
                   tile->samples.columns() == layout.tileWidth(id) &&
                   tile->samples.rows() == layout.tileHeight(id));
    MARSVIEW_CHECK(TileHeights::isTouchable(*tile));
    Level& level = levels_[id.level];
    const std::uint32_t column =
        ShownTiles::columnWithin(id.column, level.first_column, level.columns, level.tile_columns);
    level.slots[(id.row - level.first_row) * level.columns + column] = {std::move(tile),
                                                                        difference_m};
}

std::optional<double>
Clipmap::vertex(std::size_t level, std::size_t column, std::size_t row) const noexcept
{
    const Slot* found = slot(level, column / kTileSide, row / kTileSide);
    if (found == nullptr || found->tile == nullptr) {
        return std::nullopt;
    }
    return heights_->sample(*found->tile, column % kTileSide, row % kTileSide);
}

std::optional<double> Clipmap::heightAtLevel(std::size_t level,
                                             std::size_t column,
                                             std::size_t row,
                                             Sources* sources) const noexcept
{
    const TileLayout& layout = heights_->layout();
    const auto [c, u] = alongAxis(level, column, layout.columns);
    const auto [r, v] = alongAxis(level, row, layout.rows);
    constexpr double kUnread = std::numeric_limits<double>::quiet_NaN();
    CellHeights z{kUnread, kUnread, kUnread, kUnread};
    const auto read = [&](double& corner, std::size_t i, std::size_t j) {
        const auto height_m = vertex(level, i, j);
        if (!height_m) {
            return false;
        }
        corner = *height_m;
        if (sources != nullptr) {
            const TileId id{TileKind::Samples, static_cast<std::uint8_t>(level),
                            static_cast<std::uint32_t>(i / kTileSide),
                            static_cast<std::uint32_t>(j / kTileSide)};
            const auto end = sources->tiles.begin() + static_cast<std::ptrdiff_t>(sources->count);
            if (std::find(sources->tiles.begin(), end, id) == end) {
                sources->tiles[sources->count++] = id;
            }
        }
        return true;
    };
    if (sources != nullptr) {
        sources->count = 0;
    }
    // A corner with zero weight is not read: beyond the last sample there is no corner.
    if (!read(z.upper_left, c, r) || (u > v && !read(z.upper_right, c + 1, r)) ||
        (u < v && !read(z.lower_left, c, r + 1)) ||
        (std::min(u, v) > 0.0 && !read(z.lower_right, c + 1, r + 1))) {
        return std::nullopt;
    }
    return u == 0.0 && v == 0.0 ? z.upper_left : heightInCell(z, u, v);
}

Clipmap::Reading Clipmap::read(std::size_t column, std::size_t row) const noexcept
{
    for (std::size_t level = 0; level + 1 < levels_.size(); ++level) {
        if (const auto height_m = heightAtLevel(level, column, row)) {
            return {level == 0 ? *height_m : std::min(*height_m, heights_->ceiling(column, row)),
                    level};
        }
    }
    const std::size_t top = levels_.size() - 1;
    const double height_m = *heightAtLevel(top, column, row);
    return {top == 0 ? height_m : std::min(height_m, heights_->ceiling(column, row)), top};
}

bool Clipmap::isVoid(std::size_t column, std::size_t row) const noexcept
{
    for (std::size_t level = 0; level < levels_.size(); ++level) {
        const std::size_t c = column >> level;
        const std::size_t r = row >> level;
        const Slot* found = slot(level, c / kTileSide, r / kTileSide);
        if (found != nullptr && found->tile != nullptr) {
            return found->tile->samples.isVoid(c % kTileSide, r % kTileSide);
        }
    }
    return false;
}

// The levels' triangles are nested, so that two levels differ most at a sample of the finer one.
// The exception are the narrow cells at the end of a level, whose diagonals differ from those of
// the finer levels: there, both planes of a cell are compared with all samples in the closed cell,
// which bounds the difference between samples on either plane.
double Clipmap::differenceFromCoarser(const TileId& id) const
{
    const TileLayout& layout = heights_->layout();
    const std::size_t finer = id.level;
    const std::size_t last_i = layout.columnsAt(TileKind::Samples, finer) - 1;
    const std::size_t last_j = layout.rowsAt(TileKind::Samples, finer) - 1;
    // A sample affects the cells before and after it, which have samples of other tiles.
    const auto before = [](std::size_t first) { return std::max<std::size_t>(first, 1) - 1; };
    const std::size_t left = before(id.column * kTileSide);
    const std::size_t upper = before(id.row * kTileSide);
    const std::size_t right = std::min(id.column * kTileSide + layout.tileWidth(id), last_i);
    const std::size_t lower = std::min(id.row * kTileSide + layout.tileHeight(id), last_j);
    const auto column_of = [&](std::size_t i) { return std::min(i << finer, layout.columns - 1); };
    const auto row_of = [&](std::size_t j) { return std::min(j << finer, layout.rows - 1); };
    const std::size_t width = right - left + 1;
    constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> finer_m(width * (lower - upper + 1));
    for (std::size_t j = upper; j <= lower; ++j) {
        for (std::size_t i = left; i <= right; ++i) {
            finer_m[(j - upper) * width + (i - left)] = vertex(finer, i, j).value_or(kMissing);
        }
    }
    double most = 0.0;
    const auto hold = [&most](double here_m, double there_m) {
        const double difference_m = std::abs(there_m - here_m);
        most = difference_m > most ? difference_m : most; // ignores missing samples (NaN)
    };
    const auto hold_cell = [&](std::size_t k, std::size_t c, std::size_t r, bool is_last) {
        const std::size_t shift = k - finer;
        const std::size_t i_begin = c << shift;
        const std::size_t j_begin = r << shift;
        const std::size_t i_end = std::min((c + 1) << shift, last_i);
        const std::size_t j_end = std::min((r + 1) << shift, last_j);
        const double west = static_cast<double>(column_of(i_begin));
        const double north = static_cast<double>(row_of(j_begin));
        const double per_column = 1.0 / (static_cast<double>(column_of(i_end)) - west);
        const double per_row = 1.0 / (static_cast<double>(row_of(j_end)) - north);
        const double upper_left = vertex(k, c, r).value_or(kMissing);
        const double upper_right = vertex(k, c + 1, r).value_or(kMissing);
        const double lower_left = vertex(k, c, r + 1).value_or(kMissing);
        const double lower_right = vertex(k, c + 1, r + 1).value_or(kMissing);
        const bool is_whole = !std::isnan(upper_left + upper_right + lower_left + lower_right);
        for (std::size_t j = std::max(j_begin, upper); j <= std::min(j_end, lower); ++j) {
            const double v = (static_cast<double>(row_of(j)) - north) * per_row;
            const double* const finer_row = &finer_m[(j - upper) * width];
            for (std::size_t i = std::max(i_begin, left); i <= std::min(i_end, right); ++i) {
                const double here_m = finer_row[i - left];
                const double u = (static_cast<double>(column_of(i)) - west) * per_column;
                if (is_last || u >= v) {
                    hold(here_m, upper_left + u * (upper_right - upper_left) +
                                     v * (lower_right - upper_right));
                }
                if (is_last || u < v) {
                    hold(here_m, upper_left + v * (lower_left - upper_left) +
                                     u * (lower_right - lower_left));
                }
                if (!is_whole) { // on edges, two corners are sufficient
                    hold(here_m, heightAtLevel(k, column_of(i), row_of(j)).value_or(kMissing));
                }
            }
        }
    };
    for (std::size_t k = finer + 1; k < levels_.size(); ++k) {
        const std::size_t shift = k - finer;
        const std::size_t last_c = layout.columnsAt(TileKind::Samples, k) - 2;
        const std::size_t last_r = layout.rowsAt(TileKind::Samples, k) - 2;
        for (std::size_t r = std::min(upper >> shift, last_r);
             r <= std::min(lower >> shift, last_r); ++r) {
            for (std::size_t c = std::min(left >> shift, last_c);
                 c <= std::min(right >> shift, last_c); ++c) {
                hold_cell(k, c, r, c == last_c || r == last_r);
            }
        }
    }
    return most * (1.0 + 1e-12); // covers the rounding of heights between samples
}

} // namespace marsview
