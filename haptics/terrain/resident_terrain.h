// The terrain that the servo thread touches: what is resident, and what stands in for the rest.
#pragma once

#include "core/geo/frames.h"
#include "core/levels/tiled_terrain.h"
#include "haptics/terrain/resident_window.h"
#include "haptics/terrain/window_blend.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace marsview {

struct ResidentTerrainOptions {
    /// A height of the surface near the hand changes by no more than this in a second, in metres
    /// before exaggeration, when a tile arrives. Infinite: at once. To bound what is felt: the
    /// force changes by at most this, times the exaggeration, the scale from the scene to the
    /// workspace, and the stiffness (WindowBlend).
    double rate_m_per_s = 100.0;
};

/// How often full resolution was not there to be felt.
struct WindowMisses {
    std::uint64_t count = 0;     // of samples that were read
    std::uint8_t last_level = 0; // of the last of them: what stood in for it; 0: none yet
    std::uint8_t worst_level = 0;
};

/// Heights of a ResidentWindow, as FilledHeightfield has them where a full-resolution tile is
/// there. Where one arrives near the hand, its heights take the place of what was felt before at a
/// bounded rate. In every tick the surface is one surface, whoever reads it and how often.
///
/// For the servo thread: nothing here allocates, locks or waits. Between updates of the contact
/// models that touch it, each tick calls show() where there is a new window, and advance(); where
/// one of them returns true, MapContactModel::terrainChanged().
class ResidentTerrain final : public TiledTerrain {
public:
    /// `window` stays as it is until the next show(), as do all that are shown.
    explicit ResidentTerrain(const ResidentWindow& window,
                             std::shared_ptr<const TileHeights> heights,
                             const ResidentTerrainOptions& options = {});

    /// From now on this window, of the same map, is felt; the last one is not touched any more, and
    /// may even be gone. `hand` is where the proxy is: tiles that arrive in the 3 × 3 tiles around
    /// it are blended, all others are felt at once. True where heights near the hand may change.
    bool show(const ResidentWindow& window, GridPoint hand) noexcept;
    /// The ground as another ResidentTerrain had it: its window and its blend.
    void show(const ResidentWindow& window, const WindowBlend& blend) noexcept;
    /// Time goes on. True where heights near the hand have changed.
    bool advance(GridPoint hand, double seconds) noexcept;

    bool isVoid(std::size_t column, std::size_t row) const noexcept override
    {
        return window_->isVoid(column, row);
    }
    const ResidentWindow& window() const noexcept { return *window_; }
    /// Of each level of the window.
    const ShownTiles& shown(std::size_t level) const noexcept { return shown_[level]; }
    const WindowBlend& blend() const noexcept { return blend_; }
    const WindowMisses& misses() const noexcept { return misses_; }
    void resetMisses() noexcept { misses_ = {}; }
    /// > 0; the scale from scene to workspace decides what can be felt.
    void setRate(double rate_m_per_s) noexcept { rate_m_per_s_ = rate_m_per_s; }

    /// Maps have fewer than 2^30 samples a side.
    static constexpr std::size_t kLevelsMax = 24;

private:
    static_assert(ResidentWindow::kSideMax <= kPlacesASide);

    double sampleElsewhere(std::size_t column, std::size_t row) const noexcept override;
    SampleBox near(GridPoint hand) const noexcept;
    void remember() noexcept;
    void putAtHand() noexcept;

    const ResidentWindow* window_;
    WindowBlend blend_;
    std::array<ShownTiles, kLevelsMax> shown_;
    double rate_m_per_s_;
    mutable WindowMisses misses_;
};

} // namespace marsview
