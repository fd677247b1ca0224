// A map larger than memory on the servo thread.
#pragma once

#include "haptics/terrain/resident_terrain.h"
#include "haptics/terrain/window_exchange.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <utility>

namespace marsview {

/// The servo's end of a WindowExchange. Made by any thread, used by the servo alone: all but the
/// constructor is wait-free and allocates and frees nothing.
class ServoTerrain {
public:
    /// There is one for each exchange.
    ServoTerrain(std::shared_ptr<WindowExchange> exchange,
                 std::shared_ptr<const TileHeights> heights,
                 const ResidentTerrainOptions& options = {})
        : exchange_(std::move(exchange))
        , terrain_(std::make_shared<ResidentTerrain>(
              *exchange_->windows.front(), std::move(heights), options))
    {}

    /// For the contact model: TiledHeightfieldSurface.
    std::shared_ptr<const TiledTerrain> terrain() const noexcept { return terrain_; }
    ResidentTerrain& resident() noexcept { return *terrain_; }

    /// At the begin of each tick, `seconds` after the last. Where it is true, heights near the hand
    /// have changed: MapContactModel::terrainChanged().
    bool refresh(const HandMotion& motion, double seconds) noexcept
    {
        exchange_->motion.write(motion);
        const bool is_shown =
            exchange_->windows.take() && terrain_->show(*exchange_->windows.front(), motion.at);
        return terrain_->advance(motion.at, seconds) || is_shown;
    }

    /// How long the feeder has said nothing; 0 where it has not begun.
    std::chrono::nanoseconds silence(std::chrono::steady_clock::time_point now) const noexcept
    {
        const std::int64_t fed_ns = exchange_->fed_ns.load(std::memory_order_relaxed);
        return fed_ns == 0 ? std::chrono::nanoseconds(0)
                           : now.time_since_epoch() - std::chrono::nanoseconds(fed_ns);
    }
    /// For who stops the servo thread, after it has ended: there is no hand any more.
    void leave() noexcept { exchange_->motion.write({}); }

private:
    std::shared_ptr<WindowExchange> exchange_;
    std::shared_ptr<ResidentTerrain> terrain_;
};

} // namespace marsview
