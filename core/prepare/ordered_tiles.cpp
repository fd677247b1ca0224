#include "core/prepare/ordered_tiles.h"

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

std::size_t tileRowOfSampleRow(const TileLayout& layout, std::size_t level, std::size_t row)
{
    return std::min(row << level, layout.rows - 1) / kTileSide;
}

} // namespace

std::size_t firstTileRowOf(const TileLayout& layout, std::size_t level, std::size_t tile_row)
{
    return tileRowOfSampleRow(layout, level, tile_row * kTileSide);
}

std::size_t lastTileRowOf(const TileLayout& layout, std::size_t level, std::size_t tile_row)
{
    const std::size_t end =
        std::min((tile_row + 1) * kTileSide, layout.rowsAt(TileKind::Samples, level));
    return tileRowOfSampleRow(layout, level, end - 1);
}

void OrderedTiles::put(const Place& place, std::vector<std::byte> bytes, Stored stored)
{
    if (writer_ == nullptr) {
        return;
    }
    const std::lock_guard lock(mutex_);
    if (!is_ordered_) {
        const auto part = writer_->append(bytes);
        if (part) {
            stored(*part);
        } else if (!failure_) {
            failure_ = part.error();
        }
        return;
    }
    waiting_.insert_or_assign(place, Waiting{std::move(bytes), std::move(stored)});
}

Status OrderedTiles::done(std::size_t tile_row)
{
    const std::lock_guard lock(mutex_);
    if (failure_) {
        return *failure_;
    }
    done_.insert(tile_row);
    while (!done_.empty() && *done_.begin() == next_row_) {
        while (!waiting_.empty() && waiting_.begin()->first.tile_row <= next_row_) {
            const Waiting& tile = waiting_.begin()->second;
            auto part = writer_->append(tile.bytes);
            if (!part) {
                return std::move(part).error();
            }
            tile.stored(*part);
            waiting_.erase(waiting_.begin());
        }
        done_.erase(done_.begin());
        ++next_row_;
    }
    return Done{};
}

} // namespace marsview
