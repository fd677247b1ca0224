// A map as the program works with it: placement, samples, and all that drawing and touching need.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/geo/georeference.h"
#include "core/levels/level_file.h"
#include "core/raster/open_raster.h"
#include "core/raster/raster_info.h"
#include "core/terrain/filled_heightfield.h"
#include "core/terrain/heightfield.h"
#include "core/terrain/relief_tile.h"
#include "core/terrain/surface_analysis.h"
#include "core/view/slope_range.h"

#include <cstddef>
#include <memory>
#include <string>

namespace marsview {

/// How much of its file a map shows.
enum class MapKind {
    Whole,        // every sample
    Preview,      // some samples, until the overviews are built
    RoughPreview, // as few as could be read at once: a better preview can be had soon
};

/// What a map is made of, before its surface is analyzed.
struct MapSource {
    RasterSpec spec;
    RasterInfo file_info; // as the file states it
    RasterInfo info;      // with the overrides of `spec`
    SampleStatistics statistics;
    /// The samples. Those of a preview, at least 2 × 2, lie in the middle of their shares of the
    /// raster.
    Heightfield heightfield;
    MapKind kind = MapKind::Whole;
};

/// An open map. Immutable and shared between threads; a change makes a new one that shares the
/// samples.
///
///     auto map = openMap({.path = "mars.tif"}, defaultMapResources(), monitor);
///     double elevation_m = (*map)->height(GeographicPoint{latitude, longitude});
class Map {
public:
    const RasterSpec& spec() const noexcept { return source_.spec; }
    /// As the file states it, without overrides.
    const RasterInfo& fileInfo() const noexcept { return source_.file_info; }
    /// With the overrides. That of a preview describes the whole raster.
    const RasterInfo& info() const noexcept { return source_.info; }
    /// The placement of the samples in memory. The outer corners of a preview are those of its
    /// raster.
    const Georeference& georeference() const noexcept { return georeference_; }
    const Heightfield& heightfield() const noexcept { return source_.heightfield; }

    MapKind kind() const noexcept { return source_.kind; }
    bool isPreview() const noexcept { return source_.kind != MapKind::Whole; }

    /// Elevation in meters. Where the map goes once around the body, the strip between the last
    /// column and the first is interpolated as any other cell. A millionth of a sample beyond the
    /// outermost ones still counts as on them. NaN outside and in voids.
    double height(GeographicPoint geographic) const;

    /// Bounds, means and detail errors of heightfield(). Never null.
    const std::shared_ptr<const SurfaceAnalysis>& analysis() const noexcept { return analysis_; }
    /// The surface to touch, of samples in memory. Null for a map in tiles.
    const std::shared_ptr<const FilledHeightfield>& filled() const noexcept { return filled_; }
    /// What touching tiles needs. Null for a map in memory.
    const std::shared_ptr<const MapLevels>& levels() const noexcept { return levels_; }

    /// The elevations over which colors are spread: all but the rarest.
    const HeightRange& tintRange() const noexcept { return tint_range_; }
    /// The slopes over which slope colors are spread.
    const SlopeRange& slopeRange() const noexcept { return slope_range_; }
    /// Of the relief of the whole map.
    const SlopeHistogram& slopes() const noexcept { return slopes_; }
    /// The steepest slope, a gradient, that relief tiles can hold.
    double slopeMax() const noexcept { return slope_max_; }
    /// The relief of the whole map, the first that drawing needs. Never null.
    const std::shared_ptr<const ReliefTile>& relief() const noexcept { return relief_; }

private:
    friend Result<std::shared_ptr<const Map>> analyzeMap(MapSource, JobMonitor&);
    friend Result<std::shared_ptr<const Map>> tiledMap(MapSource, std::shared_ptr<const MapLevels>);
    friend Result<std::shared_ptr<const Map>>
    withOverrides(const Map&, const RasterOverrides&, JobMonitor&);

    Map(MapSource source, std::shared_ptr<const SurfaceAnalysis> analysis);
    void setRelief(ReliefTile relief);

    MapSource source_;
    Georeference georeference_;
    std::shared_ptr<const SurfaceAnalysis> analysis_;
    std::shared_ptr<const FilledHeightfield> filled_;
    std::shared_ptr<const MapLevels> levels_;
    HeightRange tint_range_;
    SlopeRange slope_range_;
    SlopeHistogram slopes_;
    double slope_max_ = 1.0;
    std::shared_ptr<const ReliefTile> relief_;
};

/// Analyzes the surface of samples in memory. Not for the GUI thread. Only Canceled can occur.
Result<std::shared_ptr<const Map>> analyzeMap(MapSource source, JobMonitor& monitor);

/// A map in tiles, which was analyzed when its levels were built. Waits for a few tiles, and
/// returns why one could not be read.
Result<std::shared_ptr<const Map>> tiledMap(MapSource source,
                                            std::shared_ptr<const MapLevels> levels);

/// Reads all samples into memory and analyzes them. Refuses rasters that cannot be shown: fewer
/// than 2 × 2 samples, only nodata, more than `memory_bytes_max` of samples. Blocks on the disk:
/// not for the GUI thread.
Result<std::shared_ptr<const Map>>
readMap(OpenRaster raster, JobMonitor& monitor, std::size_t memory_bytes_max);
/// The same, of a raster that is not open yet.
Result<std::shared_ptr<const Map>>
readMap(const RasterSpec& spec, JobMonitor& monitor, std::size_t memory_bytes_max);

/// The refusal of a raster whose samples are all nodata.
Error noElevations(const std::string& path, const SampleStatistics& statistics);

/// Whether `map` is what `preview` is a preview of: the same file with the same overrides, whole.
bool isOfSameMap(const Map& preview, const Map& map);

/// The same map with other overrides, without reading it again. Unsupported if it has to be opened
/// again: if the nodata value changes, and for a map in tiles.
Result<std::shared_ptr<const Map>>
withOverrides(const Map& map, const RasterOverrides& overrides, JobMonitor& monitor);

/// The relief tile that covers all of a map of columns × rows samples.
ReliefTileId wholeRelief(std::size_t columns, std::size_t rows);

/// The factor at which the map's relief is easily seen (exaggeration.h).
double suitableExaggeration(const Map& map);

} // namespace marsview
