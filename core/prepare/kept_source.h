// Tiles of a map that lies in the folder of prepared maps.
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
    std::string path;             // as MapFolder::pathFor() has it
    std::optional<FileLock> lock; // keeps it there as long as the source lives
    /// Whether the raster is a copy that lies there too, and not one that is used in place.
    bool is_copy = true;
};

/// The same tiles. Where what lies in the folder turns out to be damaged, that is noted there, so
/// that it is made anew when the map is opened next.
std::shared_ptr<const TileSource> keptSource(std::shared_ptr<const TileSource> source, KeptMap map);

/// Whether an error of reading or opening such a map is about what was prepared, rather than about
/// a raster of the user's.
bool isDamageToKept(const Error& error, bool is_copy);

} // namespace marsview
