#include "core/terrain/tiled_samples.h"

#include "core/terrain/triangulation.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace marsview {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Enough for the tiles under the pointer, a pressed stylus and an open dialog.
constexpr std::size_t kAskedMax = 32;

TileId sampleTile(std::size_t level, std::size_t i, std::size_t j)
{
    return {.kind = TileKind::Samples,
            .level = static_cast<std::uint8_t>(level),
            .column = static_cast<std::uint32_t>(i / kTileSide),
            .row = static_cast<std::uint32_t>(j / kTileSide)};
}

// The cell of a level that contains a sample, along one axis, in samples.
struct CellSpan {
    std::size_t first = 0; // index in the level
    std::size_t begin = 0;
    std::size_t end = 0;
    double share = 0.0; // of the sample between them, in [0, 1]
};

CellSpan cellAround(std::size_t place, std::size_t level, std::size_t count)
{
    const std::size_t last = TileLayout::samplesAlong(TileKind::Samples, level, count) - 1;
    CellSpan span;
    span.first = std::min(place >> level, last - 1);
    span.begin = span.first << level;
    span.end = std::min((span.first + 1) << level, count - 1);
    span.share =
        static_cast<double>(place - span.begin) / static_cast<double>(span.end - span.begin);
    return span;
}

} // namespace

TiledSamples::TiledSamples(const TiledRaster& raster, std::shared_ptr<const Tile> top)
    : raster_(raster)
    , top_(std::move(top))
    , requests_(raster, TileUrgency::View)
{}

Result<std::shared_ptr<const TiledSamples>> TiledSamples::open(const TiledRaster& raster)
{
    Result<std::shared_ptr<const Tile>> top =
        raster.get(sampleTile(raster.layout().topLevel(), 0, 0));
    if (!top) {
        return std::move(top).error();
    }
    return std::shared_ptr<const TiledSamples>(new TiledSamples(raster, std::move(top).value()));
}

void TiledSamples::ask(std::size_t column, std::size_t row) const
{
    const TileId id = sampleTile(0, column, row);
    const std::lock_guard lock(mutex_);
    const auto known = std::find(asked_.begin(), asked_.end(), id);
    if (known != asked_.end() && known == asked_.begin() && raster_.find(id) != nullptr) {
        return;
    }
    if (known != asked_.end()) {
        asked_.erase(known);
    } else if (asked_.size() == kAskedMax) {
        asked_.pop_back();
    }
    asked_.insert(asked_.begin(), id);
    requests_.request(asked_);
}

bool TiledSamples::isLoading() const
{
    return requests_.missingCount() > 0;
}

TileCursor::TileCursor(const TiledSamples& samples, const ElevationScale& scale, TileAccess access)
    : samples_(samples)
    , scale_(scale)
    , access_(access)
    , top_level_(samples.layout().topLevel())
{}

// Null if the tile is not resident.
const Tile* TileCursor::tileAt(std::size_t level, std::size_t i, std::size_t j)
{
    if (level == top_level_) {
        return samples_.top().get();
    }
    const TileId id = sampleTile(level, i, j);
    // Neighbors and levels use different slots.
    Slot& slot = slots_[(id.column % 2 + id.row % 2 * 2 + level * 4) % kSlots];
    if (!slot.is_known || !(slot.id == id)) {
        slot = {.is_known = true, .id = id, .tile = nullptr};
        if (access_ == TileAccess::Resident) {
            slot.tile = samples_.raster().find(id);
        } else if (auto tile = samples_.raster().get(id)) {
            slot.tile = std::move(tile).value();
        }
    }
    return slot.tile.get();
}

// False if the tile is not resident.
bool TileCursor::sampleAt(std::size_t level, std::size_t i, std::size_t j, double& height)
{
    const Tile* tile = tileAt(level, i, j);
    if (tile == nullptr) {
        return false;
    }
    const std::size_t column = i % kTileSide;
    const std::size_t row = j % kTileSide;
    height =
        tile->samples.isVoid(column, row) ? kNan : scale_.height(tile->samples.raw(column, row));
    return true;
}

bool TileCursor::interpolated(std::size_t level,
                              std::size_t column,
                              std::size_t row,
                              double& height)
{
    const TileLayout& layout = samples_.layout();
    const CellSpan across = cellAround(column, level, layout.columns);
    const CellSpan down = cellAround(row, level, layout.rows);
    const double u = across.share;
    const double v = down.share;
    // Only corners with weight need to be resident.
    CellHeights cell{0.0, 0.0, 0.0, 0.0};
    const bool is_upper = u >= v;
    if (((is_upper ? u : v) < 1.0 && !sampleAt(level, across.first, down.first, cell.upper_left)) ||
        (u > v && !sampleAt(level, across.first + 1, down.first, cell.upper_right)) ||
        (u < v && !sampleAt(level, across.first, down.first + 1, cell.lower_left)) ||
        ((is_upper ? v : u) > 0.0 &&
         !sampleAt(level, across.first + 1, down.first + 1, cell.lower_right))) {
        return false;
    }
    height = heightInCell(cell, u, v);
    return true;
}

double TileCursor::heightFrom(std::size_t level, std::size_t column, std::size_t row)
{
    double height = kNan;
    for (std::size_t k = level; k <= top_level_; ++k) {
        if (interpolated(k, column, row, height)) {
            is_exact_ = is_exact_ && k == level;
            return height;
        }
        if (access_ == TileAccess::Wait) {
            break; // reading failed: do not substitute another height
        }
    }
    is_exact_ = false;
    return height;
}

} // namespace marsview
