// A map as the program works with it: samples, placement and surface together.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/geo/georeference.h"
#include "core/raster/raster_info.h"
#include "core/terrain/heightfield.h"

#include <cstddef>
#include <memory>
#include <string>

namespace marsview {

/// What the user asked for: enough to load the same map again.
struct DatasetSpec {
    std::string path;
    int band = 1;
    RasterOverrides overrides{};
    bool operator==(const DatasetSpec&) const = default;
};

/// What a map in tiles is made of.
struct TiledDatasetParts {
    DatasetSpec spec;
    RasterInfo file_info; // as the file tells it
    RasterInfo info;      // with the overrides of `spec`
    SampleStatistics statistics;
    std::shared_ptr<const TiledSamples> tiles;
};

/// A loaded map. Immutable and shared between threads; a change makes a new one that shares the
/// samples.
class Dataset {
public:
    const DatasetSpec& spec() const noexcept { return spec_; }
    /// As the file tells it, without overrides.
    const RasterInfo& fileInfo() const noexcept { return file_info_; }
    /// With the overrides in place.
    const RasterInfo& info() const noexcept { return info_; }
    const Georeference& georeference() const noexcept { return georeference_; }
    const Heightfield& heightfield() const noexcept { return heightfield_; }

    /// Height in metres at a geographic position. Where the map goes once around the body, the
    /// strip between the last column and the first is interpolated as any other cell. A
    /// millionth of a sample beyond the outermost ones still counts as on them. NaN outside and in
    /// voids.
    double height(GeographicPoint geographic) const;

private:
    friend Result<std::shared_ptr<const Dataset>>
    loadDataset(const DatasetSpec&, JobMonitor&, std::size_t);
    friend Result<std::shared_ptr<const Dataset>> withOverrides(const Dataset&,
                                                                const RasterOverrides&);
    friend std::shared_ptr<const Dataset> tiledDataset(const TiledDatasetParts&);

    Dataset(DatasetSpec spec,
            RasterInfo file_info,
            RasterInfo info,
            const SampleStatistics& statistics,
            Heightfield heightfield);

    DatasetSpec spec_;
    RasterInfo file_info_;
    RasterInfo info_;
    SampleStatistics statistics_;
    Georeference georeference_;
    Heightfield heightfield_;
};

/// Reads the map whole. Refuses what cannot be shown: fewer than 2 × 2 samples, only voids, more
/// than `memory_bytes_max` of samples. Blocks on the disk: not for the GUI thread.
Result<std::shared_ptr<const Dataset>>
loadDataset(const DatasetSpec& spec, JobMonitor& monitor, std::size_t memory_bytes_max);

/// A map whose samples come in tiles.
std::shared_ptr<const Dataset> tiledDataset(const TiledDatasetParts& parts);

/// The same map with other overrides, without reading it again. A changed nodata value cannot be
/// applied this way and is refused as Unsupported, and so is any change of a tiled map: load again.
Result<std::shared_ptr<const Dataset>> withOverrides(const Dataset& dataset,
                                                     const RasterOverrides& overrides);

/// The placement that `info` describes; one map unit a pixel where it has none.
Georeference georeferenceOf(const RasterInfo& info);

} // namespace marsview
