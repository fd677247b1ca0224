// A map as the program works with it: samples, placement and surface together.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/geo/georeference.h"
#include "core/raster/dataset_spec.h"
#include "core/raster/raster_info.h"
#include "core/terrain/heightfield.h"

#include <cstddef>
#include <memory>
#include <string>

namespace marsview {

/// What a map in tiles is made of.
struct TiledDatasetParts {
    DatasetSpec spec;
    RasterInfo file_info; // as the file tells it
    RasterInfo info;      // with the overrides of `spec`
    SampleStatistics statistics;
    std::shared_ptr<const TiledSamples> tiles;
};

/// How much of its file a dataset shows.
enum class DatasetKind {
    Whole,        // every sample
    Preview,      // some samples, to be looked at until the map itself is ready
    RoughPreview, // as few as could be read at once: a better one can be had soon
};

/// What a preview is made of.
struct PreviewParts {
    DatasetSpec spec;
    RasterInfo file_info; // as the file tells it
    RasterInfo info;      // with the overrides of `spec`
    SampleStatistics statistics;
    /// At least 2 × 2 samples, each in the middle of its share of the map.
    std::shared_ptr<const SampleGrid> samples;
    DatasetKind kind = DatasetKind::Preview;
};

/// A loaded map. Immutable and shared between threads; a change makes a new one that shares the
/// samples.
class Dataset {
public:
    const DatasetSpec& spec() const noexcept { return spec_; }
    /// As the file tells it, without overrides.
    const RasterInfo& fileInfo() const noexcept { return file_info_; }
    /// With the overrides in place. A preview's is that of the whole file too: what people are told
    /// about the map.
    const RasterInfo& info() const noexcept { return info_; }
    /// Of the samples that are there. The outer corners of a preview are those of its map.
    const Georeference& georeference() const noexcept { return georeference_; }
    const Heightfield& heightfield() const noexcept { return heightfield_; }

    DatasetKind kind() const noexcept { return kind_; }
    bool isPreview() const noexcept { return kind_ != DatasetKind::Whole; }

    /// Height in metres at a geographic position. Where the map goes once around the body, the
    /// strip between the last column and the first is interpolated as any other cell. A
    /// millionth of a sample beyond the outermost ones still counts as on them. NaN outside and in
    /// voids.
    double height(GeographicPoint geographic) const;

private:
    friend Result<std::shared_ptr<const Dataset>>
    loadDataset(const DatasetSpec&, JobMonitor&, std::size_t, const std::vector<std::string>&);
    friend Result<std::shared_ptr<const Dataset>> withOverrides(const Dataset&,
                                                                const RasterOverrides&);
    friend std::shared_ptr<const Dataset> tiledDataset(const TiledDatasetParts&);
    friend std::shared_ptr<const Dataset> previewDataset(const PreviewParts&);

    Dataset(DatasetSpec spec,
            RasterInfo file_info,
            RasterInfo info,
            const SampleStatistics& statistics,
            Heightfield heightfield,
            DatasetKind kind = DatasetKind::Whole);

    DatasetSpec spec_;
    RasterInfo file_info_;
    RasterInfo info_;
    SampleStatistics statistics_;
    Georeference georeference_;
    Heightfield heightfield_;
    DatasetKind kind_;
};

/// The refusal of a map whose samples are all void.
Error noHeights(const std::string& path, const SampleStatistics& statistics);

/// Reads the map whole. Refuses what cannot be shown: fewer than 2 × 2 samples, only voids, more
/// than `memory_bytes_max` of samples. `notices` are added to those of the map. Blocks on the disk:
/// not for the GUI thread.
Result<std::shared_ptr<const Dataset>> loadDataset(const DatasetSpec& spec,
                                                   JobMonitor& monitor,
                                                   std::size_t memory_bytes_max,
                                                   const std::vector<std::string>& notices = {});

/// A map whose samples come in tiles.
std::shared_ptr<const Dataset> tiledDataset(const TiledDatasetParts& parts);

/// A smaller map of the same ground. Its info() says in a notice that it is one.
std::shared_ptr<const Dataset> previewDataset(const PreviewParts& parts);

/// Whether `map` shows what `preview` stands for: the same file, told the same about, and whole.
bool isOfSameMap(const Dataset& preview, const Dataset& map);

/// The same map with other overrides, without reading it again. A changed nodata value cannot be
/// applied this way and is refused as Unsupported, and so is any change of a tiled map: load again.
Result<std::shared_ptr<const Dataset>> withOverrides(const Dataset& dataset,
                                                     const RasterOverrides& overrides);

/// The placement that `info` describes; one map unit a pixel where it has none.
Georeference georeferenceOf(const RasterInfo& info);
/// The same for columns × rows samples that share out the ground of `info` evenly.
Georeference georeferenceOf(const RasterInfo& info, std::size_t columns, std::size_t rows);

} // namespace marsview
