#include "haptics/terrain/resident_terrain.h"

#include "core/base/check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace marsview {

ResidentTerrain::ResidentTerrain(const Clipmap& window,
                                 std::shared_ptr<const TileHeights> heights,
                                 const ResidentTerrainOptions& options)
    : TiledTerrain(std::move(heights))
    , window_(&window)
    , rate_m_per_s_(options.rate_m_per_s)
    , wraps_(options.wraps)
{
    MARSVIEW_CHECK(&window.heights() == &this->heights());
    MARSVIEW_CHECK(window.levelCount() <= kLevelsMax);
    MARSVIEW_CHECK(rate_m_per_s_ > 0.0);
    remember();
    putAtHand();
}

void ResidentTerrain::remember() noexcept
{
    for (std::size_t k = 0; k < window_->levelCount(); ++k) {
        shown_[k] = window_->shown(k);
    }
}

// Blended tiles are read together with their weights.
void ResidentTerrain::putAtHand() noexcept
{
    clearPlaces();
    for (const Clipmap::Slot& slot : window_->level(0).slots) {
        if (slot.tile) {
            setAtHand(*slot.tile);
        }
    }
    blend_.eachTile([this](const TileId& id, double) {
        if (id.level == 0) {
            clearPlace(id.column, id.row);
        }
    });
}

bool ResidentTerrain::show(const Clipmap& window, GridPoint hand) noexcept
{
    const TileLayout& layout = heights().layout();
    window_ = &window;
    const SamplesNear around = near(hand);
    bool is_changed = false;
    // Tiles that have left the window are forgotten; if one returns, it counts as newly arrived.
    blend_.keepOnly([&](const TileId& id, const SampleBox&) { return window.has(id); });
    const double range_m = heights().range().maximum_m - heights().range().minimum_m;
    for (std::size_t k = 0; k < window.levelCount(); ++k) {
        const Clipmap::Level& level = window.level(k);
        for (std::size_t i = 0; i < level.slots.size(); ++i) {
            const Clipmap::Slot& slot = level.slots[i];
            const TileId id{TileKind::Samples, static_cast<std::uint8_t>(k), level.tileColumn(i),
                            level.tileRow(i)};
            const bool was_there = shown_[k].has(id.column, id.row, level.tile_columns);
            if (was_there == (slot.tile != nullptr) ||
                !around.doOverlap(ClipmapBlend::reach(layout, id))) {
                continue;
            }
            is_changed = true;
            if (!was_there && std::isfinite(rate_m_per_s_)) {
                blend_.add(layout, id, std::min(slot.difference_m, range_m));
            }
        }
    }
    remember();
    putAtHand();
    return is_changed;
}

void ResidentTerrain::show(const Clipmap& window, const ClipmapBlend& blend) noexcept
{
    window_ = &window;
    blend_ = blend;
    remember();
    putAtHand();
}

bool ResidentTerrain::advance(GridPoint hand, double seconds) noexcept
{
    if (blend_.isEmpty()) {
        return false;
    }
    const SamplesNear around = near(hand);
    blend_.keepOnly([&](const TileId&, const SampleBox& reach) { return around.doOverlap(reach); });
    if (std::isfinite(rate_m_per_s_)) {
        blend_.advance(std::max(seconds, 0.0), rate_m_per_s_);
    } else {
        blend_.clear();
    }
    putAtHand();
    return true;
}

double ResidentTerrain::sampleElsewhere(std::size_t column, std::size_t row) const noexcept
{
    double height_m = 0.0;
    double rest = 1.0; // weight that remains for coarser levels
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    Clipmap::Sources sources;
    bool is_first = true;
    for (std::size_t k = 0; k < window_->levelCount(); ++k) {
        const auto at_level = window_->heightAtLevel(k, column, row, &sources);
        if (!at_level) {
            continue;
        }
        if (std::exchange(is_first, false) && k > 0) {
            ++misses_.count;
            misses_.last_level = static_cast<std::uint8_t>(k);
            misses_.worst_level = std::max(misses_.worst_level, misses_.last_level);
        }
        double weight = 1.0;
        for (std::size_t i = 0; i < sources.count && !blend_.isEmpty(); ++i) {
            weight = std::min(weight, blend_.weight(sources.tiles[i]));
        }
        if (weight == 0.0) {
            continue;
        }
        const double bounded =
            k == 0 ? *at_level : std::min(*at_level, heights().ceiling(column, row));
        if (weight == 1.0 && rest == 1.0) {
            return bounded;
        }
        height_m += rest * weight * bounded;
        rest *= 1.0 - weight;
        low = std::min(low, bounded);
        high = std::max(high, bounded);
        if (weight == 1.0) {
            break;
        }
    }
    // Rounding must not exceed the maxima that ray casts use.
    return std::clamp(height_m, low, high);
}

} // namespace marsview
