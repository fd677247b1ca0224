// The terrain that a recording's updates used, as far as the map alone does not determine it.
#pragma once

#include "core/geo/body.h"
#include "core/geo/scene_frame.h"
#include "core/tiles/tile.h"
#include "haptics/terrain/clipmap.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <variant>

namespace marsview {

/// A contact model begins: its map, the uppermost of several, and the map's place in its scene.
struct GroundPart {
    std::uint64_t part = 0; // ServoMap's serial
    std::size_t columns = 0;
    std::size_t rows = 0;
    Ellipsoid ellipsoid; // of the map's body; zeros if unknown
    SceneFrame frame;

    bool operator==(const GroundPart&) const = default;
};

/// The next map below those of a part, which is joined with them to one surface on a body.
struct GroundBelow {
    GroundPart map;

    bool operator==(const GroundBelow&) const = default;
};

/// From the next GroundFelt on, these tiles of a level are resident.
struct GroundLevel {
    std::size_t level = 0;
    ShownTiles shown;
    /// Of joined maps, whose tiles: 0 is the uppermost. Empty for a map by itself, and in older
    /// recordings, where only one of the maps was in tiles.
    std::optional<std::uint32_t> map{};

    bool operator==(const GroundLevel&) const = default;
};

/// From the next GroundFelt to the one after it, a resident tile is blended in at less than full
/// weight.
struct GroundTile {
    TileId id;
    double weight = 1.0;                // in [0, 1), ClipmapBlend's
    std::optional<std::uint32_t> map{}; // as in GroundLevel

    bool operator==(const GroundTile&) const = default;
};

/// Applies the records before this one, of all maps.
struct GroundFelt {
    std::uint64_t changed_part = 0; // part whose model got ContactModel::terrainChanged(); 0: none

    bool operator==(const GroundFelt&) const = default;
};

using GroundRecord = std::variant<GroundPart, GroundBelow, GroundLevel, GroundTile, GroundFelt>;
static_assert(std::is_trivially_copyable_v<GroundRecord>);

} // namespace marsview
