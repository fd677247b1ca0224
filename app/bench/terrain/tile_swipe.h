// A hand that swipes across a tiled map at the servo rate.
#pragma once

#include "app/bench/terrain/terrain_bench.h"
#include "core/base/job_monitor.h"
#include "haptics/loop/real_time_thread.h"
#include "haptics/terrain/clipmap_streamer.h"

#include <array>
#include <cstdint>
#include <memory>

namespace marsview {

struct TileSwipeOptions {
    double speed_cells = 1.0; // per update
    double seconds = 60.0;    // at a thousand updates per second
    std::uint64_t seed = 1;
};

/// Counts of turns, without the initial, uncounted ones.
struct SwipeCounts {
    static constexpr std::size_t kLevels = 32;

    std::uint64_t in_contact = 0;
    std::uint64_t cut_short = 0;
    std::uint64_t turns_with_misses = 0;
    std::uint64_t samples_missed = 0;                    // reads at less than full resolution
    std::array<std::uint64_t, kLevels> turns_at_level{}; // by the coarsest level used
};

struct TileSwipeResult {
    SwipeCounts counts;
    LoopStatistics loop;
    RealTimeGrants grants;
    ClipmapStreamerStatistics streamer;
    std::uint64_t tiles_loaded = 0; // from the caller's counters
    std::uint64_t tiles_failed = 0;
};

/// Starts at once, on its own threads.
class TileSwipe {
public:
    /// Waits for the tile of the coarsest level.
    static Result<TileSwipe> begin(const TouchedTiles& tiles, const TileSwipeOptions& options);

    TileSwipe(TileSwipe&&) noexcept;
    TileSwipe& operator=(TileSwipe&&) noexcept;
    ~TileSwipe();

    /// Waits until its time is over or it is canceled.
    TileSwipeResult finish(JobMonitor& monitor);
    /// Stops at once.
    TileSwipeResult stop();

private:
    struct Impl;
    explicit TileSwipe(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

} // namespace marsview
