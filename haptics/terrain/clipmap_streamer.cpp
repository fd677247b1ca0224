#include "haptics/terrain/clipmap_streamer.h"

#include "core/base/check.h"
#include "haptics/sync/page_lock.h"
#include "haptics/terrain/clipmap_blend.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace marsview {
namespace {

// The interval over which the loaders' throughput is measured.
constexpr std::chrono::milliseconds kLearning{250};
// A servo thread without updates for this long has stopped.
constexpr std::chrono::seconds kSilence{1};
constexpr double kTilesPerSecondMin = 1.0; // keeps fine levels from never being requested again

// A tile and the lock of its pages, which ends with the last window that contains the tile.
struct LockedTile {
    std::shared_ptr<const Tile> tile;
    PageLock samples;
    PageLock filled;
};

TileId idAt(const Clipmap::Level& level, std::size_t k, std::size_t i)
{
    return {TileKind::Samples, static_cast<std::uint8_t>(k), level.tileColumn(i), level.tileRow(i)};
}

} // namespace

Result<std::unique_ptr<ClipmapStreamer>>
ClipmapStreamer::create(const TiledRaster& raster,
                        std::shared_ptr<const TileHeights> heights,
                        const ClipmapStreamerOptions& options)
{
    const std::size_t top_level = raster.layout().topLevel();
    auto top = raster.get({TileKind::Samples, static_cast<std::uint8_t>(top_level), 0, 0});
    if (!top) {
        return std::move(top).error();
    }
    return std::make_unique<ClipmapStreamer>(raster, std::move(heights), std::move(top).value(),
                                             options);
}

ClipmapStreamer::ClipmapStreamer(const TiledRaster& raster,
                                 std::shared_ptr<const TileHeights> heights,
                                 std::shared_ptr<const Tile> top,
                                 const ClipmapStreamerOptions& options)
    : raster_(raster)
    , heights_(std::move(heights))
    , options_(options)
    , tiles_per_s_(options.plan.tiles_per_s)
    , requests_(raster_, TileUrgency::Hand, [this] {
        {
            const std::lock_guard lock(mutex_);
            has_arrived_ = true;
        }
        changed_.notify_one();
    })
{
    MARSVIEW_CHECK(heights_ && heights_->layout().columns == raster_.layout().columns &&
                   heights_->layout().rows == raster_.layout().rows);
    MARSVIEW_CHECK(top);
    top_ = locked(std::move(top));
    const std::vector<GridPoint> centers(heights_->layout().topLevel() + 1);
    window_ = std::make_shared<const Clipmap>(heights_, top_, centers, options_.plan.sides);
    exchange_ = std::make_shared<ClipmapExchange>(window_);
}

ClipmapStreamer::~ClipmapStreamer()
{
    stop();
}

void ClipmapStreamer::start()
{
    if (!thread_.joinable()) {
        thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
    }
}

void ClipmapStreamer::stop()
{
    if (thread_.joinable()) {
        thread_.request_stop();
        thread_.join();
        thread_ = {};
        request({});
    }
}

ClipmapStreamerStatistics ClipmapStreamer::statistics() const
{
    const std::lock_guard lock(mutex_);
    return statistics_;
}

void ClipmapStreamer::run(const std::stop_token& stop)
{
    while (!stop.stop_requested()) {
        const bool is_active = feed(Clock::now());
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, stop, is_active ? options_.active_period : options_.idle_period,
                          [this] { return has_arrived_; });
        has_arrived_ = false;
    }
}

void ClipmapStreamer::request(std::vector<TileId> tiles)
{
    if (tiles != wanted_) {
        wanted_ = std::move(tiles);
        requests_.request(wanted_);
    }
}

void ClipmapStreamer::learnThroughput(Clock::time_point now, std::size_t arrived)
{
    arrived_count_ += arrived;
    if (wanted_.empty()) { // the loaders were idle: nothing to measure
        wanted_since_.reset();
        arrived_count_ = 0;
        return;
    }
    if (!wanted_since_) {
        wanted_since_ = now;
        arrived_count_ = 0;
    } else if (now - *wanted_since_ >= kLearning) {
        const double seconds = std::chrono::duration<double>(now - *wanted_since_).count();
        const double seen = static_cast<double>(arrived_count_) / seconds;
        tiles_per_s_ = std::max(0.5 * (tiles_per_s_ + seen), kTilesPerSecondMin);
        wanted_since_ = now;
        arrived_count_ = 0;
    }
}

std::shared_ptr<const Tile> ClipmapStreamer::locked(std::shared_ptr<const Tile> tile)
{
    const auto held = std::make_shared<LockedTile>();
    held->tile = std::move(tile);
    const SampleGrid& samples = held->tile->samples;
    held->samples = samples.visit([](auto view) {
        return PageLock(view.data(), view.columns() * view.rows() * sizeof(*view.data()));
    });
    held->filled = {held->tile->filled_m.data(), held->tile->filled_m.size() * sizeof(float)};
    const int error = held->samples.error() != 0 ? held->samples.error() : held->filled.error();
    if (error != 0) {
        const std::lock_guard lock(mutex_);
        statistics_.lock_error = error;
    }
    return {held, held->tile.get()};
}

bool ClipmapStreamer::feed(Clock::time_point now)
{
    exchange_->fed_ns.store(now.time_since_epoch() / std::chrono::nanoseconds(1),
                            std::memory_order_relaxed);
    HandMotion motion = exchange_->motion.read();
    const auto age = now.time_since_epoch() - std::chrono::nanoseconds(motion.time_ns);
    if (!motion.is_active || age > kSilence) {
        request({});
        learnThroughput(now, 0);
        return false;
    }
    const double seconds = std::clamp(std::chrono::duration<double>(age).count(), 0.0, 0.05);
    motion.at.column += seconds * motion.columns_per_s;
    motion.at.row += seconds * motion.rows_per_s;
    WindowPlanOptions plan_options = options_.plan;
    plan_options.tiles_per_s = tiles_per_s_;
    const ClipmapPlan plan = planWindow(heights_->layout(), motion, plan_options);

    auto next = std::make_shared<Clipmap>(heights_, top_, plan.centers, plan_options.sides);
    // Before the lookup, so that a tile that arrives in the meantime is not missed.
    const std::uint64_t generation = raster_.generation();
    bool is_changed = false;
    std::vector<TileId> arrived;
    for (std::size_t k = 0; k + 1 < next->levelCount(); ++k) {
        const Clipmap::Level& level = next->level(k);
        const Clipmap::Level& last = window_->level(k);
        const bool has_moved =
            level.first_column != last.first_column || level.first_row != last.first_row;
        is_changed = is_changed || has_moved;
        for (std::size_t i = 0; i < level.slots.size(); ++i) {
            const TileId id = idAt(level, k, i);
            const Clipmap::Slot* slot = window_->slot(id);
            if (slot != nullptr && slot->tile) {
                next->put(slot->tile, slot->difference_m);
            } else if (generation != generation_ || has_moved) {
                if (auto tile = raster_.find(id)) {
                    next->put(locked(std::move(tile)), std::numeric_limits<double>::infinity());
                    arrived.push_back(id);
                }
            }
        }
    }
    generation_ = generation;
    // Tiles may be touched before the next window but one: those around the hand, and one more. A
    // faster hand gets no blending.
    const SamplesNear near(heights_->layout(), motion.at, 2, plan_options.sides.wraps);
    for (const TileId& id : arrived) {
        if (near.doOverlap(ClipmapBlend::reach(heights_->layout(), id))) {
            next->put(next->slot(id)->tile, next->differenceFromCoarser(id));
        }
    }
    if (is_changed || !arrived.empty()) {
        window_ = std::move(next);
        exchange_->windows.back() = window_;
        exchange_->windows.publish();
    }
    learnThroughput(now, arrived.size());
    // Tiles in the window need not stay in the cache.
    std::vector<TileId> missing;
    std::copy_if(plan.tiles.begin(), plan.tiles.end(), std::back_inserter(missing),
                 [this](const TileId& id) { return !window_->has(id); });
    request(std::move(missing));
    const std::lock_guard lock(mutex_);
    statistics_.published += is_changed || !arrived.empty() ? 1U : 0U;
    statistics_.tiles_put += arrived.size();
    statistics_.finest_level = plan.finest_level;
    statistics_.tiles_per_s = tiles_per_s_;
    return true;
}

} // namespace marsview
