// Tiles of a map in the folder of prepared maps.
#pragma once

#include "core/prepare/map_folder.h"
#include "core/tiles/tile_source.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace marsview {

struct KeptMap {
    MapFolder folder;
    std::string path;             // from MapFolder::pathFor()
    std::optional<FileLock> lock; // protects the map while the source lives
    /// Whether the raster is a copy in that folder rather than one used in place.
    bool is_copy = true;
};

/// Returns the same tiles. If the prepared map turns out to be damaged, this is noted in the
/// folder, so that the map is rebuilt when it is opened next.
std::shared_ptr<const TileSource> keptSource(std::shared_ptr<const TileSource> source, KeptMap map);

/// Whether an error of reading or opening such a map concerns the prepared files rather than the
/// user's raster.
bool isDamageToKept(const Error& error, bool is_copy);

} // namespace marsview
