// The servo thread's access to a map larger than memory.
#pragma once

#include "haptics/terrain/clipmap_exchange.h"
#include "haptics/terrain/resident_terrain.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <utility>

namespace marsview {

/// The servo's end of a ClipmapExchange. Created by any thread, used only by the servo thread: all
/// members except the constructor are wait-free and do not allocate or free memory.
class ServoTerrain {
public:
    /// At most one per exchange.
    ServoTerrain(std::shared_ptr<ClipmapExchange> exchange,
                 std::shared_ptr<const TileHeights> heights,
                 const ResidentTerrainOptions& options = {})
        : exchange_(std::move(exchange))
        , terrain_(std::make_shared<ResidentTerrain>(
              *exchange_->windows.front(), std::move(heights), options))
    {}

    /// For the contact model: TiledHeightfieldSurface.
    std::shared_ptr<const TiledTerrain> terrain() const noexcept { return terrain_; }
    ResidentTerrain& resident() noexcept { return *terrain_; }

    /// Call at the beginning of each tick, `seconds` after the last. If it returns true, heights
    /// near the hand have changed: call ContactModel::terrainChanged().
    bool refresh(const HandMotion& motion, double seconds) noexcept
    {
        exchange_->motion.write(motion);
        const bool is_shown =
            exchange_->windows.take() && terrain_->show(*exchange_->windows.front(), motion.at);
        return terrain_->advance(motion.at, seconds) || is_shown;
    }

    /// Time since the streamer's last sign of life; 0 before it has started.
    std::chrono::nanoseconds silence(std::chrono::steady_clock::time_point now) const noexcept
    {
        const std::int64_t fed_ns = exchange_->fed_ns.load(std::memory_order_relaxed);
        return fed_ns == 0 ? std::chrono::nanoseconds(0)
                           : now.time_since_epoch() - std::chrono::nanoseconds(fed_ns);
    }
    /// For the thread that stops the servo thread, after that has ended: reports that the hand is
    /// gone.
    void leave() noexcept { exchange_->motion.write({}); }

private:
    std::shared_ptr<ClipmapExchange> exchange_;
    std::shared_ptr<ResidentTerrain> terrain_;
};

} // namespace marsview
