#include "app/bench/terrain/tile_swipe.h"

#include "app/bench/terrain/swipe_path.h"
#include "core/contact/contact_model.h"
#include "haptics/terrain/servo_terrain.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <utility>

namespace marsview {
namespace {

constexpr std::chrono::milliseconds kPeriod{1};
constexpr std::uint64_t kUncounted = 200;

SwipeArea wholeOf(const TouchedTiles& tiles)
{
    return {{0.0, 0.0},
            {static_cast<double>(tiles.columns() - 1), static_cast<double>(tiles.rows() - 1)}};
}

} // namespace

struct TileSwipe::Impl {
    Impl(const TouchedTiles& tiles,
         const TileSwipeOptions& options,
         std::unique_ptr<ClipmapStreamer> its_streamer)
        : streamer(std::move(its_streamer))
        , terrain(streamer->exchange(), tiles.heights)
        , model(makeContactModel(kContactModelDefault,
                                 TiledHeightfieldSurface(terrain.terrain(), tiles.frame, 1.0)))
        , frame(tiles.frame)
        , hand(
              SwipePath(wholeOf(tiles), {.speed_cells = options.speed_cells, .seed = options.seed}),
              tiles.frame,
              options.speed_cells)
        , turn_count(kUncounted + static_cast<std::uint64_t>(options.seconds * 1e3))
    {}

    // The servo thread's turn.
    LoopOutcome turn(const LoopTick& tick) noexcept
    {
        if (tick.number == kUncounted) {
            counts = {};
        }
        ContactState state = model->state();
        const GridPoint at =
            tick.number == 0 ? frame.toGrid(hand.begin()) : frame.toGrid(state.proxy);
        const double per_s = tick.dt_s > 0.0 ? 1.0 / tick.dt_s : 0.0;
        const HandMotion motion{
            .at = at,
            .columns_per_s = tick.number > 1 ? (at.column - last.column) * per_s : 0.0,
            .rows_per_s = tick.number > 1 ? (at.row - last.row) * per_s : 0.0,
            .time_ns = std::chrono::steady_clock::now().time_since_epoch().count(),
            .is_active = true};
        last = at;
        terrain.resident().resetMisses();
        if (terrain.refresh(motion, tick.dt_s)) {
            model->terrainChanged();
        }
        state =
            tick.number == 0 ? model->place(hand.begin()) : model->update(hand.next(state.proxy));
        count(state);
        const bool is_over = tick.number + 1 >= turn_count;
        turns_done.store(tick.number + 1, std::memory_order_relaxed);
        return is_over ? LoopOutcome::Stop : LoopOutcome::Continue;
    }

    void count(const ContactState& state) noexcept
    {
        const ClipmapMisses& misses = terrain.resident().misses();
        counts.in_contact += state.is_in_contact ? 1U : 0U;
        counts.cut_short += state.counters.cut_short;
        counts.samples_missed += misses.count;
        counts.turns_with_misses += misses.count > 0 ? 1U : 0U;
        ++counts
              .turns_at_level[std::min<std::size_t>(misses.worst_level, SwipeCounts::kLevels - 1)];
    }

    TileSwipeResult result() const
    {
        return {.counts = counts,
                .loop = thread->statistics(),
                .grants = thread->grants(),
                .streamer = streamer->statistics()};
    }

    std::unique_ptr<ClipmapStreamer> streamer;
    ServoTerrain terrain;
    std::unique_ptr<MapContactModel> model;
    SceneFrame frame;
    SwipingHand hand;
    std::uint64_t turn_count;
    GridPoint last;
    SwipeCounts counts;
    std::atomic<std::uint64_t> turns_done{0};
    std::unique_ptr<RealTimeThread> thread; // last member: its thread uses all the others
};

TileSwipe::TileSwipe(std::unique_ptr<Impl> impl)
    : impl_(std::move(impl))
{}
TileSwipe::TileSwipe(TileSwipe&&) noexcept = default;
TileSwipe& TileSwipe::operator=(TileSwipe&&) noexcept = default;
TileSwipe::~TileSwipe() = default;

Result<TileSwipe> TileSwipe::begin(const TouchedTiles& tiles, const TileSwipeOptions& options)
{
    Result<std::unique_ptr<ClipmapStreamer>> streamer =
        ClipmapStreamer::create(tiles.raster, tiles.heights);
    if (!streamer) {
        return std::move(streamer).error();
    }
    auto impl = std::make_unique<Impl>(tiles, options, std::move(streamer).value());
    impl->streamer->start();
    impl->thread = std::make_unique<RealTimeThread>(
        RealTimeOptions{.period = kPeriod, .uncounted_turns = kUncounted},
        [self = impl.get()](const LoopTick& tick) noexcept { return self->turn(tick); });
    return TileSwipe(std::move(impl));
}

TileSwipeResult TileSwipe::finish(JobMonitor& monitor)
{
    constexpr std::chrono::milliseconds kLook{50};
    for (std::uint64_t done = 0; done < impl_->turn_count && !monitor.isCanceled();) {
        std::this_thread::sleep_for(kLook);
        done = impl_->turns_done.load(std::memory_order_relaxed);
        monitor.report(static_cast<double>(done) / static_cast<double>(impl_->turn_count));
    }
    return stop();
}

TileSwipeResult TileSwipe::stop()
{
    impl_->thread->stop();
    impl_->thread->join();
    impl_->streamer->stop();
    return impl_->result();
}

} // namespace marsview
