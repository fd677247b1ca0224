#include "core/prepare/void_fills.h"

#include "core/base/deflate.h"
#include "core/base/durable_file.h"
#include "core/prepare/tile_counts.h"

#include <algorithm>
#include <cerrno>
#include <fmt/format.h>
#include <span>
#include <system_error>
#include <utility>

namespace marsview {
namespace {

Error failed(const std::string& name, const char* what)
{
    const int reason = errno;
    return {ErrorCode::Unreadable,
            fmt::format("{}: {} ({}); make room there or choose another folder", name, what,
                        std::generic_category().message(reason))};
}

std::uint64_t rowChecksum(std::span<const float> heights_m)
{
    return std::uint64_t{crc32Of(std::as_bytes(heights_m))} + 1;
}

} // namespace

Result<FineMeans> FineMeans::open(const BlockExtent& kept, const std::string& path, Content content)
{
    FineMeans means;
    for (BlockExtent level{kept.columns, kept.rows, BlockMeans::kBlock};
         level.block_samples < kept.block_samples; level = level.coarser()) {
        means.levels_.push_back(level);
        means.row_checksums_.emplace_back(level.blockRows());
    }
    if (means.levels_.empty()) {
        return means;
    }
    means.name_ = path;
    means.file_.reset(std::fopen(path.c_str(), content == Content::Empty ? "wb+" : "rb+"));
    if (!means.file_) {
        return failed(means.name_, "cannot be written");
    }
    return means;
}

bool FineMeans::save(CheckpointWriter& to) const
{
    const std::lock_guard lock(*mutex_);
    for (const std::vector<std::uint64_t>& rows : row_checksums_) {
        to.putArray(rows);
    }
    return !file_ || flushToDisk(file_.get());
}

bool FineMeans::restore(CheckpointReader& from)
{
    for (std::vector<std::uint64_t>& rows : row_checksums_) {
        if (!from.getArray(rows)) {
            return false;
        }
    }
    for (std::size_t level = 0; level < levels_.size(); ++level) {
        BlockRows row{.columns = levels_[level].blockColumns(),
                      .level_rows = levels_[level].blockRows(),
                      .first_row = 0,
                      .heights_m = {}};
        row.heights_m.resize(row.columns);
        for (; row.first_row < row.level_rows; ++row.first_row) {
            const std::uint64_t expected = row_checksums_[level][row.first_row];
            if (expected != 0 && (!read(level, row) || rowChecksum(row.heights_m) != expected)) {
                return false;
            }
        }
    }
    return true;
}

long FineMeans::offsetOf(std::size_t level, std::size_t row) const
{
    std::size_t blocks = 0;
    for (std::size_t i = 0; i < level; ++i) {
        blocks += levels_[i].blockColumns() * levels_[i].blockRows();
    }
    return static_cast<long>((blocks + row * levels_[level].blockColumns()) * sizeof(float));
}

Status FineMeans::write(std::size_t level, const BlockRows& rows)
{
    const std::lock_guard lock(*mutex_);
    const std::size_t count = rows.heights_m.size();
    if (std::fseek(file_.get(), offsetOf(level, rows.first_row), SEEK_SET) != 0 ||
        std::fwrite(rows.heights_m.data(), sizeof(float), count, file_.get()) != count) {
        return failed(name_, "cannot be written");
    }
    const std::span<const float> heights(rows.heights_m);
    for (std::size_t row = 0; row * rows.columns < count; ++row) {
        row_checksums_[level][rows.first_row + row] =
            rowChecksum(heights.subspan(row * rows.columns, rows.columns));
    }
    return Done{};
}

Status FineMeans::read(std::size_t level, BlockRows& rows) const
{
    const std::lock_guard lock(*mutex_);
    const std::size_t count = rows.heights_m.size();
    if (std::fseek(file_.get(), offsetOf(level, rows.first_row), SEEK_SET) != 0 ||
        std::fread(rows.heights_m.data(), sizeof(float), count, file_.get()) != count) {
        return failed(name_, "cannot be read back");
    }
    return Done{};
}

Result<BlockRows> filledRows(const FineMeans& fine, const BlockMeans& kept, std::size_t tile_row)
{
    const GridView<const float> coarsest = kept.filledMeans();
    const auto rows_of = [&](std::size_t level) {
        return level < fine.levelCount() ? fine.extent(level).blockRows() : coarsest.rows();
    };
    // The rows needed of each level, from the finest up.
    std::vector<RowRange> needed;
    needed.push_back({tile_row * kTileBlocks - (tile_row > 0 ? 1 : 0),
                      std::min((tile_row + 1) * kTileBlocks + 1, rows_of(0))});
    for (std::size_t level = 1; level <= fine.levelCount(); ++level) {
        needed.push_back(rowsToFillFrom(needed.back(), rows_of(level)));
    }
    BlockRows filled{.columns = coarsest.columns(),
                     .level_rows = coarsest.rows(),
                     .first_row = needed.back().first,
                     .heights_m = {}};
    filled.heights_m.assign(coarsest.row(needed.back().first).data(),
                            coarsest.row(needed.back().end - 1).data() + coarsest.columns());
    for (std::size_t level = fine.levelCount(); level-- > 0;) {
        BlockRows rows{.columns = fine.extent(level).blockColumns(),
                       .level_rows = rows_of(level),
                       .first_row = needed[level].first,
                       .heights_m = {}};
        rows.heights_m.resize(rows.columns * (needed[level].end - needed[level].first));
        if (auto read = fine.read(level, rows); !read) {
            return std::move(read).error();
        }
        fillGaps(rows, filled);
        filled = std::move(rows);
    }
    return filled;
}

TileFill tileFill(const BlockRows& filled, const TileLayout& layout, const TileId& id)
{
    TileFill fill{.window = fillWindow(layout, id),
                  .means_m = {},
                  .level_columns = filled.columns,
                  .level_rows = filled.level_rows};
    for (std::size_t row = 0; row < fill.window.rows; ++row) {
        for (std::size_t column = 0; column < fill.window.columns; ++column) {
            fill.means_m.push_back(
                filled(fill.window.first_column + column, fill.window.first_row + row));
        }
    }
    return fill;
}

} // namespace marsview
