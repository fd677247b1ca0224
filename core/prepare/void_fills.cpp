#include "core/prepare/void_fills.h"

#include "core/base/check.h"
#include "core/base/deflate.h"
#include "core/base/durable_file.h"

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

FineMeans::FineMeans(const BlockExtent& kept)
{
    for (BlockExtent level{kept.columns, kept.rows, BlockMeans::kBlock};
         level.block_samples < kept.block_samples; level = level.coarser()) {
        levels_.push_back(level);
    }
}

FineMeans::File FineMeans::fileOf(const std::string& path, const TileRowRange& rows) const
{
    File file{.path = path, .rows = {}, .checksums = {}, .open = {}};
    for (std::size_t level = 0; level < levels_.size(); ++level) {
        const std::size_t side = kTileBlocks >> level;
        const std::size_t count = levels_[level].blockRows();
        const std::size_t tile_rows = (count + side - 1) / side;
        const std::size_t first = std::min(rows.first, tile_rows) * side;
        const std::size_t end = std::min(rows.end, tile_rows) * side;
        file.rows.push_back({std::min(first, count), std::min(end, count)});
        file.checksums.emplace_back(file.rows.back().end - file.rows.back().first);
    }
    return file;
}

Result<FineMeans> FineMeans::open(const BlockExtent& kept,
                                  const std::string& path,
                                  Content content,
                                  const TileRowRange& rows)
{
    FineMeans means(kept);
    if (means.levels_.empty()) {
        return means;
    }
    auto file = std::make_unique<File>(means.fileOf(path, rows));
    file->open.reset(std::fopen(path.c_str(), content == Content::Empty ? "wb+" : "rb+"));
    if (!file->open) {
        return failed(path, "cannot be written");
    }
    means.files_.push_back(std::move(file));
    return means;
}

bool FineMeans::save(CheckpointWriter& to) const
{
    saveChecksums(to);
    const std::lock_guard lock(*mutex_);
    return std::all_of(files_.begin(), files_.end(),
                       [](const auto& file) { return flushToDisk(file->open.get()); });
}

void FineMeans::saveChecksums(CheckpointWriter& to) const
{
    const std::lock_guard lock(*mutex_);
    for (const auto& file : files_) {
        for (const std::vector<std::uint64_t>& rows : file->checksums) {
            to.putArray(rows);
        }
    }
}

bool FineMeans::restoreChecksums(File& file, CheckpointReader& from)
{
    return std::all_of(file.checksums.begin(), file.checksums.end(),
                       [&from](std::vector<std::uint64_t>& rows) { return from.getArray(rows); });
}

bool FineMeans::restore(CheckpointReader& from)
{
    for (const auto& file : files_) {
        if (!restoreChecksums(*file, from)) {
            return false;
        }
        for (std::size_t level = 0; level < levels_.size(); ++level) {
            BlockRows row{.columns = levels_[level].blockColumns(),
                          .level_rows = levels_[level].blockRows(),
                          .first_row = file->rows[level].first,
                          .heights_m = {}};
            row.heights_m.resize(row.columns);
            for (const std::uint64_t checksum : file->checksums[level]) {
                if (checksum != 0 && !read(level, row)) {
                    return false;
                }
                ++row.first_row;
            }
        }
    }
    return true;
}

bool FineMeans::add(CheckpointReader& from, const std::string& path, const TileRowRange& rows)
{
    if (levels_.empty()) {
        return true;
    }
    auto file = std::make_unique<File>(fileOf(path, rows));
    const bool is_good = restoreChecksums(*file, from);
    files_.push_back(std::move(file));
    return is_good;
}

void FineMeans::openToRead(File& file) const
{
    constexpr std::size_t kOpenMax = 16;
    if (opened_.size() == kOpenMax) {
        opened_.front()->open.reset();
        opened_.erase(opened_.begin());
    }
    file.open.reset(std::fopen(file.path.c_str(), "rb"));
    if (file.open) {
        opened_.push_back(&file);
    }
}

FineMeans::File* FineMeans::fileWith(std::size_t level, std::size_t row) const
{
    const auto at = std::find_if(files_.begin(), files_.end(), [&](const auto& file) {
        return row >= file->rows[level].first && row < file->rows[level].end;
    });
    MARSVIEW_CHECK(at != files_.end());
    return at->get();
}

long FineMeans::offsetOf(const File& file, std::size_t level, std::size_t row) const
{
    std::size_t blocks = 0;
    for (std::size_t i = 0; i < level; ++i) {
        blocks += levels_[i].blockColumns() * (file.rows[i].end - file.rows[i].first);
    }
    blocks += (row - file.rows[level].first) * levels_[level].blockColumns();
    return static_cast<long>(blocks * sizeof(float));
}

Status FineMeans::write(std::size_t level, const BlockRows& rows)
{
    const std::size_t count = rows.heights_m.size();
    if (count == 0) {
        return Done{};
    }
    const std::lock_guard lock(*mutex_);
    File& file = *fileWith(level, rows.first_row);
    if (std::fseek(file.open.get(), offsetOf(file, level, rows.first_row), SEEK_SET) != 0 ||
        std::fwrite(rows.heights_m.data(), sizeof(float), count, file.open.get()) != count) {
        return failed(file.path, "cannot be written");
    }
    const std::span<const float> heights(rows.heights_m);
    for (std::size_t row = 0; row * rows.columns < count; ++row) {
        file.checksums[level][rows.first_row + row - file.rows[level].first] =
            rowChecksum(heights.subspan(row * rows.columns, rows.columns));
    }
    return Done{};
}

Status FineMeans::read(std::size_t level, BlockRows& rows) const
{
    const std::lock_guard lock(*mutex_);
    const std::size_t end = rows.first_row + rows.heights_m.size() / rows.columns;
    for (std::size_t row = rows.first_row; row < end;) {
        File& file = *fileWith(level, row);
        if (!file.open) {
            openToRead(file);
        }
        const BlockRowRange& in_file = file.rows[level];
        const std::size_t count = std::min(end, in_file.end) - row;
        const std::span<float> heights =
            std::span(rows.heights_m)
                .subspan((row - rows.first_row) * rows.columns, count * rows.columns);
        if (!file.open || std::fseek(file.open.get(), offsetOf(file, level, row), SEEK_SET) != 0 ||
            std::fread(heights.data(), sizeof(float), heights.size(), file.open.get()) !=
                heights.size()) {
            return failed(file.path, "cannot be read back");
        }
        for (std::size_t i = 0; i < count; ++i, ++row) {
            if (rowChecksum(heights.subspan(i * rows.columns, rows.columns)) !=
                file.checksums[level][row - in_file.first]) {
                return Error{ErrorCode::Damaged, file.path + ": is damaged"};
            }
        }
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
