// Keeps the part of a map that the hand touches in memory, ahead of the hand.
#pragma once

#include "core/base/result.h"
#include "core/tiles/tile_cache.h"
#include "haptics/terrain/resident_window.h"
#include "haptics/terrain/window_exchange.h"
#include "haptics/terrain/window_plan.h"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

namespace marsview {

struct WindowFeederOptions {
    WindowPlanOptions plan;
    /// How often the hand is looked at, where no tile arrives sooner; while there is none.
    std::chrono::milliseconds active_period{5};
    std::chrono::milliseconds idle_period{50};
};

struct WindowFeederStatistics {
    std::uint64_t published = 0;  // windows
    std::uint64_t tiles_put = 0;  // that were in no window before
    std::size_t finest_level = 0; // that could be had in time when last looked
    double tiles_per_s = 0.0;     // what the loaders do
    /// Why pages of tiles are not locked in memory, as errno; 0 where they are. The tiles are
    /// touched in any case.
    int lock_error = 0;
};

/// A thread of its own reads where the hand is and goes, wants the tiles on its way, and publishes
/// a new window whenever some arrive or the hand moves on. Tiles live as long as a window that has
/// them; windows that the servo thread has left are freed here, never there.
class WindowFeeder {
public:
    /// Reads the tile of the coarsest level first: not for a thread that must not wait.
    static Result<std::unique_ptr<WindowFeeder>> create(const TiledRaster& raster,
                                                        std::shared_ptr<const TileHeights> heights,
                                                        const WindowFeederOptions& options = {});
    /// `heights` have the raster's layout, and `top` is the tile of its coarsest level. Waits for
    /// nothing.
    WindowFeeder(const TiledRaster& raster,
                 std::shared_ptr<const TileHeights> heights,
                 std::shared_ptr<const Tile> top,
                 const WindowFeederOptions& options = {});
    /// Stops.
    ~WindowFeeder();
    WindowFeeder(const WindowFeeder&) = delete;
    WindowFeeder& operator=(const WindowFeeder&) = delete;

    /// When a hand comes, and when it goes: nothing runs in between, and nothing is wanted. Both
    /// for the thread that owns the feeder.
    void start();
    void stop();

    /// For the one servo thread; lives on with it.
    const std::shared_ptr<WindowExchange>& exchange() const noexcept { return exchange_; }
    const std::shared_ptr<const TileHeights>& heights() const noexcept { return heights_; }
    /// Any thread.
    WindowFeederStatistics statistics() const;

    using Clock = std::chrono::steady_clock;
    /// One round, by hand, as the thread does them; only while it is stopped. Whether there is a
    /// hand.
    bool feed(Clock::time_point now);

private:
    void run(const std::stop_token& stop);
    void want(std::vector<TileId> tiles);
    void learnThroughput(Clock::time_point now, std::size_t arrived);
    std::shared_ptr<const Tile> locked(std::shared_ptr<const Tile> tile);

    TiledRaster raster_;
    std::shared_ptr<const TileHeights> heights_;
    std::shared_ptr<const Tile> top_;
    WindowFeederOptions options_;
    std::shared_ptr<WindowExchange> exchange_;

    // Of the thread, or of whoever calls feed().
    std::shared_ptr<const ResidentWindow> window_; // the latest
    std::uint64_t generation_ = 0;                 // of the raster, when its tiles were looked for
    double tiles_per_s_;
    std::optional<Clock::time_point> wanted_since_; // or since the throughput was last learned
    std::vector<TileId> wanted_;
    std::size_t arrived_count_ = 0;

    mutable std::mutex mutex_; // of the following
    std::condition_variable_any changed_;
    bool has_arrived_ = false;
    WindowFeederStatistics statistics_;

    TileWishes wishes_; // after what its notifications use
    std::jthread thread_;
};

} // namespace marsview
