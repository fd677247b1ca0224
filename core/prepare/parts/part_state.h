// The files of the parts of a map, in a folder that all machines see.
#pragma once

#include "core/base/result.h"
#include "core/prepare/checkpoint_file.h"
#include "core/prepare/overview_builder.h"
#include "core/prepare/parts/part_rows.h"
#include "core/prepare/row_memory.h"
#include "core/raster/open_raster.h"
#include "core/tiles/tile.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// A map that is prepared in parts.
struct PartedMap {
    RasterInfo info; // with the user's overrides
    VoidRule voids;
    ElevationScale scale;
    std::string key;         // of the tiled GeoTIFF
    std::string source_path; // absolute; an address unchanged
    std::size_t parts = 1;
    std::string folder;
    std::size_t mean_blocks_max = 1; // as in LevelBuild
    RowMemory memory{};              // with the folder; not part of subject()

    std::size_t tileRows() const { return (info.rows + kTileSide - 1) / kTileSide; }
    PartRows rowsOf(std::size_t part) const { return rowsOfPart(tileRows(), part, parts); }
    /// Identifies the map, the settings and the number of parts.
    std::string subject() const;
    /// A file of a part, counted from 1, for example "3-of-8.tiles".
    std::string file(std::size_t part, const char* ending) const;
};

/// Reads a few dozen kilobytes of the source to identify it.
Result<PartedMap> partedMap(const OpenRaster& raster,
                            std::size_t parts,
                            const std::string& folder,
                            std::size_t mean_blocks_max,
                            RowMemory memory);

/// Endings of the files of a part.
inline constexpr const char* kPartTiles = "tiles";   // of the raster and its overviews, encoded
inline constexpr const char* kPartLevels = "levels"; // tiles of its nested levels
inline constexpr const char* kPartSurvey = "survey"; // what the first pass found
inline constexpr const char* kPartMeans = "means";   // finest means, on large maps with voids
inline constexpr const char* kPartBorder = "border"; // what other parts need of it
inline constexpr const char* kPartEdges = "edges";   // its share of tiles that no part has alone
inline constexpr const char* kPartFills = "fills";   // tiles of fills
inline constexpr const char* kPartErrors = "errors"; // what the second pass found

/// A file with the state of a part after a pass, which is read in the order of writing.
/// NotFound if it does not exist; Invalid if it is of another map; Damaged.
Result<CheckpointReader> openPartState(const PartedMap& map, std::size_t part, const char* ending);
/// Writes its beginning.
void beginPartState(CheckpointWriter& to, const PartedMap& map);

/// For a state that another part of the map, or another map, has left.
Error notOfThisPart();
/// Without an error if the file does not exist.
void removePartFile(const std::string& path);

/// Size and CRC-32 of a file; zeros if it does not exist or cannot be read.
struct FileMark {
    std::uint64_t bytes = 0;
    std::uint32_t checksum = 0;

    /// Reads the whole file.
    static FileMark of(const std::string& path);
    void save(CheckpointWriter& to) const;
    bool restore(CheckpointReader& from);
    bool operator==(const FileMark&) const = default;
};

/// What the first pass leaves for the file to be joined, at the beginning of its state.
struct PartFiles {
    std::uint64_t tile_bytes = 0;
    FileMark levels;
    FileMark means;
    std::vector<std::uint32_t> sizes; // of encoded tiles, as in PartTileFile
    std::vector<std::uint32_t> checksums;
    std::vector<std::uint64_t> sums; // of OverviewBuilder::sumsOf()
    std::vector<std::uint64_t> counts;

    void save(CheckpointWriter& to) const;
    /// False if it cannot be read.
    bool restore(CheckpointReader& from);
    /// Whether the part's other files have their size.
    bool areOnDisk(const PartedMap& map, std::size_t part) const;
    /// Whether they also have their content, the raster apart. Reads these files.
    bool areIntact(const PartedMap& map, std::size_t part) const;
};

/// Calls `function(level, tile_row)` for the rows of tiles that a part completes, in the order of
/// the file: a row of the raster, then the overviews up to OverviewBuilder::kStreamedLevels.
template <typename Function>
void forEachTileRow(const PartedMap& map, const PartRows& rows, Function&& function)
{
    const std::size_t levels =
        std::min(overviewCount(map.info.columns, map.info.rows), OverviewBuilder::kStreamedLevels);
    for (std::size_t row = rows.first; row < rows.end; ++row) {
        function(std::size_t{0}, row);
        for (std::size_t k = 1; k <= levels; ++k) {
            if ((row + 1) % (std::size_t{1} << k) == 0 || row + 1 == map.tileRows()) {
                function(k, row >> k);
            }
        }
    }
}

/// The layout of the map's tiles, as GeotiffTileSource finds it in the tiled GeoTIFF.
TileLayout layoutOf(const PartedMap& map);

/// Parts whose first pass is not complete, or was made for another map or is damaged. Reads the
/// states of all parts.
std::vector<std::size_t> missingParts(const PartedMap& map);
/// Parts whose first pass is not complete, by the names of the files alone.
std::vector<std::size_t> absentParts(const PartedMap& map);

} // namespace marsview
