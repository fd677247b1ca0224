// The terrain that the servo thread touches: resident tiles, and coarser levels where tiles are
// missing.
#pragma once

#include "core/geo/frames.h"
#include "core/levels/tiled_terrain.h"
#include "haptics/terrain/clipmap.h"
#include "haptics/terrain/clipmap_blend.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace marsview {

struct ResidentTerrainOptions {
    /// The fastest change of a surface height near the hand when a tile arrives, in meters per
    /// second before exaggeration. Infinite: immediate. This bounds the rate of change of the
    /// force: at most this value times the exaggeration, the scale from the scene to the workspace,
    /// and the stiffness (ClipmapBlend).
    double rate_m_per_s = 100.0;
    bool wraps = false; // WindowSides::wraps
};

/// Counts of reads at less than full resolution.
struct ClipmapMisses {
    std::uint64_t count = 0;     // samples read at a coarser level
    std::uint8_t last_level = 0; // level used for the last of them; 0: none yet
    std::uint8_t worst_level = 0;
};

/// Heights of a Clipmap, equal to those of FilledHeightfield where the full-resolution tile
/// is resident. When a tile arrives near the hand, its heights replace the previous ones at a
/// bounded rate. Within a tick the surface does not change, whoever reads it and however often.
///
/// For the servo thread: does not allocate, lock or wait. Between updates of the contact models
/// over it, each tick calls show() if there is a new window, and advance(); if one of them returns
/// true, call ContactModel::terrainChanged().
class ResidentTerrain final : public TiledTerrain {
public:
    /// `window` must not change until the next show(); the same applies to later windows.
    explicit ResidentTerrain(const Clipmap& window,
                             std::shared_ptr<const TileHeights> heights,
                             const ResidentTerrainOptions& options = {});

    /// Switches to this window of the same map; the previous one is no longer accessed and may have
    /// been destroyed. `hand` is the proxy's position: tiles that arrive in the 3 × 3 tiles around
    /// it are blended, all others take effect at once. Returns true if heights near the hand may
    /// change.
    bool show(const Clipmap& window, GridPoint hand) noexcept;
    /// Copies the state of another ResidentTerrain: its window and its blend.
    void show(const Clipmap& window, const ClipmapBlend& blend) noexcept;
    /// Advances the blending. Returns true if heights near the hand have changed.
    bool advance(GridPoint hand, double seconds) noexcept;

    bool isVoid(std::size_t column, std::size_t row) const noexcept override
    {
        return window_->isVoid(column, row);
    }
    const Clipmap& window() const noexcept { return *window_; }
    /// For each level of the window.
    const ShownTiles& shown(std::size_t level) const noexcept { return shown_[level]; }
    const ClipmapBlend& blend() const noexcept { return blend_; }
    const ClipmapMisses& misses() const noexcept { return misses_; }
    void resetMisses() noexcept { misses_ = {}; }
    /// > 0; the scale from scene to workspace decides what can be felt.
    void setRate(double rate_m_per_s) noexcept { rate_m_per_s_ = rate_m_per_s; }

    /// Maps have fewer than 2^30 samples per side.
    static constexpr std::size_t kLevelsMax = 24;

private:
    static_assert(Clipmap::kSideMax <= kPlacesASide);

    double sampleElsewhere(std::size_t column, std::size_t row) const noexcept override;
    SamplesNear near(GridPoint hand) const noexcept
    {
        return {heights().layout(), hand, 1, wraps_};
    }
    void remember() noexcept;
    void putAtHand() noexcept;

    const Clipmap* window_;
    ClipmapBlend blend_;
    std::array<ShownTiles, kLevelsMax> shown_;
    double rate_m_per_s_;
    bool wraps_;
    mutable ClipmapMisses misses_;
};

} // namespace marsview
