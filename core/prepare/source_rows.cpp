#include "core/prepare/source_rows.h"

#include "core/tiles/tile.h"

#include <algorithm>
#include <future>
#include <utility>

namespace marsview {
namespace {

// The total size of the rows that are being read while earlier ones are written.
constexpr std::size_t kWindowBytes = std::size_t{230} << 20;
// The same in a scratch file.
constexpr std::size_t kScratchBytes = std::size_t{4} << 30;
// A row of blocks taller than a tile is read at once up to this size.
constexpr std::size_t kTallBlockBytesMax = std::size_t{16} << 20;

// The pieces of a window that is `columns` wide: whole rows of wide blocks, otherwise columns.
GridSize
pieceOf(const GridSize& block, bool has_cheap_rows, const GridSize& window, std::size_t at_once)
{
    const auto rounded_up = [](std::size_t value, std::size_t step) {
        return (value + step - 1) / step * step;
    };
    if (has_cheap_rows || block.columns > at_once) {
        const std::size_t rows = std::max<std::size_t>(1, at_once * kTileSide / window.columns);
        return {window.columns,
                has_cheap_rows ? rows : rounded_up(rows, std::max<std::size_t>(1, block.rows))};
    }
    const std::size_t columns = at_once * kTileSide / std::max(kTileSide, window.rows);
    return {rounded_up(std::max<std::size_t>(1, columns), std::max<std::size_t>(1, block.columns)),
            window.rows};
}

} // namespace

SourceRows::SourceRows(RasterFile& source, const RasterInfo& info, RowMemory memory)
    : source_(source)
    , info_(info)
    , memory_(std::move(memory))
{
    const std::size_t row_bytes =
        info.columns * (sampleBytes(info.type) + (info.needsVoidMask() ? 1 : 0));
    const std::size_t block_rows =
        source.hasCheapRows()
            ? kTileSide
            : (std::max<std::size_t>(source.blockSize().rows, 1) + kTileSide - 1) / kTileSide *
                  kTileSide;
    window_rows_ = std::max(kTileSide, kTallBlockBytesMax / row_bytes / kTileSide * kTileSide);
    if (block_rows > window_rows_) {
        const std::size_t rows_max = memory_.scratch ? kScratchBytes : kWindowBytes;
        window_rows_ =
            std::min(block_rows, std::max(kTileSide, rows_max / row_bytes / kTileSide * kTileSide));
    } else {
        window_rows_ = window_rows_ / block_rows * block_rows;
    }
    reads_ahead_ = 2 * window_rows_ * row_bytes <= kWindowBytes || window_rows_ == kTileSide ||
                   memory_.scratch.has_value();
}

Result<LoadedSamples> SourceRows::read(std::size_t row, std::size_t rows)
{
    const ScratchPlace* scratch = memory_.place();
    if (scratch == nullptr || info_.columns * rows * sampleBytes(info_.type) < scratch->bytes_min) {
        return source_.readWindow({0, row, info_.columns, rows}, {info_.nodata});
    }
    Result<SampleGrid> grid = SampleGrid::create(info_.type, info_.columns, rows, scratch);
    if (!grid) {
        return std::move(grid).error();
    }
    const GridSize piece =
        pieceOf(source_.blockSize(), source_.hasCheapRows(), {info_.columns, rows},
                memory_.tilesAtOnce(info_.type) * kTileSide);
    SampleStatistics statistics;
    for (std::size_t y = 0; y < rows; y += piece.rows) {
        for (std::size_t x = 0; x < info_.columns; x += piece.columns) {
            const GridWindow window{x, row + y, std::min(piece.columns, info_.columns - x),
                                    std::min(piece.rows, rows - y)};
            const Result<LoadedSamples> samples = source_.readWindow(window, {info_.nodata});
            if (!samples) {
                return samples.error();
            }
            grid->put(samples->grid, x, y);
            grid->releasePages();
            statistics.merge(samples->statistics);
        }
    }
    return LoadedSamples{std::move(grid).value(), statistics};
}

Status SourceRows::each(std::size_t first, std::size_t end, const Work& work)
{
    const std::size_t end_row = std::min(end * kTileSide, info_.rows);
    const auto read = [this, end_row](std::size_t row) {
        return this->read(row, std::min(window_rows_, end_row - row));
    };
    std::future<Result<LoadedSamples>> ahead;
    for (std::size_t row = first * kTileSide; row < end_row;) {
        Result<LoadedSamples> samples = ahead.valid() ? ahead.get() : read(row);
        if (!samples) {
            return std::move(samples).error();
        }
        const std::size_t next = row + samples->grid.rows();
        if (reads_ahead_ && next < end_row) {
            ahead = std::async(std::launch::async, read, next);
        }
        for (std::size_t grid_row = 0; row < next;
             grid_row += kTileSide, row = std::min(row + kTileSide, next)) {
            if (Status done = work(samples->grid, grid_row, row / kTileSide); !done) {
                return done;
            }
        }
        samples_read_ += std::uint64_t{samples->grid.columns()} * samples->grid.rows();
    }
    return Done{};
}

} // namespace marsview
