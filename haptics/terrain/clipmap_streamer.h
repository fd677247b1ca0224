// Keeps the part of a map that the hand touches in memory, ahead of the hand.
#pragma once

#include "core/base/result.h"
#include "core/tiles/tile_cache.h"
#include "haptics/terrain/clipmap.h"
#include "haptics/terrain/clipmap_exchange.h"
#include "haptics/terrain/clipmap_plan.h"

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

struct ClipmapStreamerOptions {
    WindowPlanOptions plan;
    /// Polling interval of the hand while there is one, unless a tile arrives sooner; idle_period
    /// otherwise.
    std::chrono::milliseconds active_period{5};
    std::chrono::milliseconds idle_period{50};
};

struct ClipmapStreamerStatistics {
    std::uint64_t published = 0;  // windows published
    std::uint64_t tiles_put = 0;  // not in the previous window
    std::size_t finest_level = 0; // that could be loaded in time at the last round
    double tiles_per_s = 0.0;     // throughput of the loaders
    /// The errno value if pages of tiles could not be locked in memory; 0 if they are locked. The
    /// tiles are paged in either way.
    int lock_error = 0;
};

/// A separate thread reads the hand's position and velocity, requests the tiles along its path, and
/// publishes a new window whenever tiles arrive or the hand moves on. Tiles live as long as a
/// window that contains them; windows that the servo thread has released are freed here, never on
/// the servo thread.
class ClipmapStreamer {
public:
    /// Reads the tile of the coarsest level first, so the calling thread must be able to wait.
    static Result<std::unique_ptr<ClipmapStreamer>>
    create(const TiledRaster& raster,
           std::shared_ptr<const TileHeights> heights,
           const ClipmapStreamerOptions& options = {});
    /// `heights` have the raster's layout, and `top` is the tile of its coarsest level. Does not
    /// wait.
    ClipmapStreamer(const TiledRaster& raster,
                    std::shared_ptr<const TileHeights> heights,
                    std::shared_ptr<const Tile> top,
                    const ClipmapStreamerOptions& options = {});
    /// Stops.
    ~ClipmapStreamer();
    ClipmapStreamer(const ClipmapStreamer&) = delete;
    ClipmapStreamer& operator=(const ClipmapStreamer&) = delete;

    /// Call when a hand arrives over the map, and stop() when it leaves: in between nothing runs
    /// and no tiles are requested. Both for the thread that owns the streamer.
    void start();
    void stop();

    /// For the one servo thread, which may keep it longer than the streamer.
    const std::shared_ptr<ClipmapExchange>& exchange() const noexcept { return exchange_; }
    const std::shared_ptr<const TileHeights>& heights() const noexcept { return heights_; }
    /// Any thread.
    ClipmapStreamerStatistics statistics() const;

    using Clock = std::chrono::steady_clock;
    /// Runs one round of the thread's work; only while the thread is stopped. Returns whether there
    /// is a hand.
    bool feed(Clock::time_point now);

private:
    void run(const std::stop_token& stop);
    void request(std::vector<TileId> tiles);
    void learnThroughput(Clock::time_point now, std::size_t arrived);
    std::shared_ptr<const Tile> locked(std::shared_ptr<const Tile> tile);

    TiledRaster raster_;
    std::shared_ptr<const TileHeights> heights_;
    std::shared_ptr<const Tile> top_;
    ClipmapStreamerOptions options_;
    std::shared_ptr<ClipmapExchange> exchange_;

    // Used by the thread, or by the caller of feed().
    std::shared_ptr<const Clipmap> window_; // the latest
    std::uint64_t generation_ = 0;          // of the raster at the last lookup
    double tiles_per_s_;
    std::optional<Clock::time_point> wanted_since_; // or the last throughput measurement
    std::vector<TileId> wanted_;
    std::size_t arrived_count_ = 0;

    mutable std::mutex mutex_; // guards the members below
    std::condition_variable_any changed_;
    bool has_arrived_ = false;
    ClipmapStreamerStatistics statistics_;

    TileRequests requests_; // after the members that its notifications use
    std::jthread thread_;
};

} // namespace marsview
