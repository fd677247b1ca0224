#include "core/prepare/source_rows.h"

#include "core/tiles/tile.h"

#include <algorithm>
#include <future>
#include <utility>

namespace marsview {
namespace {

// The total size of the rows that are being read while earlier ones are written.
constexpr std::size_t kWindowBytes = std::size_t{230} << 20;
// A row of blocks taller than a tile is read at once up to this size.
constexpr std::size_t kTallBlockBytesMax = std::size_t{16} << 20;

} // namespace

SourceRows::SourceRows(RasterFile& source, const RasterInfo& info)
    : source_(source)
    , info_(info)
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
        window_rows_ = std::min(
            block_rows, std::max(kTileSide, kWindowBytes / row_bytes / kTileSide * kTileSide));
    } else {
        window_rows_ = window_rows_ / block_rows * block_rows;
    }
    reads_ahead_ = 2 * window_rows_ * row_bytes <= kWindowBytes || window_rows_ == kTileSide;
}

Status SourceRows::each(std::size_t first, std::size_t end, const Work& work)
{
    const std::size_t end_row = std::min(end * kTileSide, info_.rows);
    const auto read = [this, end_row](std::size_t row) {
        return source_.readWindow({0, row, info_.columns, std::min(window_rows_, end_row - row)},
                                  {info_.nodata});
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
