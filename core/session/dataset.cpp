#include "core/session/dataset.h"

#include "core/raster/raster_file.h"
#include "core/terrain/seam.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace marsview {
namespace {

void notePreview(RasterInfo& info, const Heightfield& heightfield)
{
    info.notices.insert(info.notices.begin(),
                        fmt::format("a preview of {} × {} samples is shown; heights are read from "
                                    "it until the map itself, of {} × {}, is there",
                                    heightfield.columns(), heightfield.rows(), info.columns,
                                    info.rows));
}

} // namespace

Dataset::Dataset(DatasetSpec spec,
                 RasterInfo file_info,
                 RasterInfo info,
                 const SampleStatistics& statistics,
                 Heightfield heightfield,
                 DatasetKind kind)
    : spec_(std::move(spec))
    , file_info_(std::move(file_info))
    , info_(std::move(info))
    , statistics_(statistics)
    , georeference_(georeferenceOf(info_, heightfield.columns(), heightfield.rows()))
    , heightfield_(std::move(heightfield))
    , kind_(kind)
{}

double Dataset::height(GeographicPoint geographic) const
{
    const std::optional<GridPoint> grid = georeference_.toGrid(geographic);
    if (!grid) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    if (georeference_.wrapsAround()) {
        if (const auto seam = seamCell(*grid, heightfield_.columns(), heightfield_.rows())) {
            const std::size_t last = heightfield_.columns() - 1;
            return heightInCell(
                {heightfield_.sample(last, seam->row), heightfield_.sample(0, seam->row),
                 heightfield_.sample(last, seam->row + 1), heightfield_.sample(0, seam->row + 1)},
                seam->u, seam->v);
        }
    }
    return heightfield_.height(*grid);
}

Error noHeights(const std::string& path, const SampleStatistics& statistics)
{
    return {ErrorCode::Invalid,
            fmt::format("{}: holds no elevations: all of its {} samples are nodata", path,
                        statistics.sample_count)};
}

Result<std::shared_ptr<const Dataset>> loadDataset(const DatasetSpec& spec,
                                                   JobMonitor& monitor,
                                                   std::size_t memory_bytes_max,
                                                   const std::vector<std::string>& notices)
{
    Result<RasterFile> file = RasterFile::open(spec.path, spec.band);
    if (!file) {
        return std::move(file).error();
    }
    RasterInfo file_info = file->info();
    Result<RasterInfo> info = withOverrides(file_info, spec.overrides);
    if (!info) {
        return Error{info.error().code, fmt::format("{}: {}", spec.path, info.error().message)};
    }
    if (Status surface = checkIsSurface(spec.path, *info); !surface) {
        return std::move(surface).error();
    }
    Result<LoadedSamples> samples = file->readAll(monitor, {info->nodata}, memory_bytes_max);
    if (!samples) {
        return std::move(samples).error();
    }
    if (!samples->statistics.hasSamples()) {
        return noHeights(spec.path, samples->statistics);
    }
    info->notices.insert(info->notices.end(), notices.begin(), notices.end());
    noteSuspiciousSamples(*info, samples->statistics);
    Heightfield heightfield(std::make_shared<const SampleGrid>(std::move(samples->grid)),
                            samples->statistics, info->elevationScale());
    return std::shared_ptr<const Dataset>(new Dataset(spec, std::move(file_info),
                                                      std::move(info).value(), samples->statistics,
                                                      std::move(heightfield)));
}

Result<std::shared_ptr<const Dataset>> withOverrides(const Dataset& dataset,
                                                     const RasterOverrides& overrides)
{
    const std::string& path = dataset.spec().path;
    Result<RasterInfo> info = withOverrides(dataset.fileInfo(), overrides);
    if (!info) {
        return Error{info.error().code, fmt::format("{}: {}", path, info.error().message)};
    }
    if (info->nodata != dataset.info().nodata) {
        return Error{ErrorCode::Unsupported,
                     fmt::format("{}: another nodata value needs the samples read again", path)};
    }
    if (dataset.heightfield().isTiled()) {
        return Error{ErrorCode::Unsupported,
                     fmt::format("{}: is read in tiles, which depend on these options", path)};
    }
    if (dataset.isPreview()) {
        notePreview(*info, dataset.heightfield());
    } else {
        noteSuspiciousSamples(*info, dataset.statistics_);
    }
    DatasetSpec spec = dataset.spec();
    spec.overrides = overrides;
    Heightfield heightfield =
        dataset.heightfield().scaled(dataset.statistics_, info->elevationScale());
    return std::shared_ptr<const Dataset>(new Dataset(std::move(spec), dataset.fileInfo(),
                                                      std::move(info).value(), dataset.statistics_,
                                                      std::move(heightfield), dataset.kind_));
}

std::shared_ptr<const Dataset> tiledDataset(const TiledDatasetParts& parts)
{
    RasterInfo info = parts.info;
    noteSuspiciousSamples(info, parts.statistics);
    Heightfield heightfield(parts.tiles, parts.statistics, info.elevationScale());
    return std::shared_ptr<const Dataset>(new Dataset(parts.spec, parts.file_info, std::move(info),
                                                      parts.statistics, std::move(heightfield)));
}

std::shared_ptr<const Dataset> previewDataset(const PreviewParts& parts)
{
    RasterInfo info = parts.info;
    Heightfield heightfield(parts.samples, parts.statistics, info.elevationScale());
    notePreview(info, heightfield);
    return std::shared_ptr<const Dataset>(new Dataset(parts.spec, parts.file_info, std::move(info),
                                                      parts.statistics, std::move(heightfield),
                                                      parts.kind));
}

bool isOfSameMap(const Dataset& preview, const Dataset& map)
{
    return preview.isPreview() && preview.spec() == map.spec() &&
           preview.info().columns == map.info().columns && preview.info().rows == map.info().rows;
}

Georeference georeferenceOf(const RasterInfo& info)
{
    return georeferenceOf(info, info.columns, info.rows);
}

Georeference georeferenceOf(const RasterInfo& info, std::size_t columns, std::size_t rows)
{
    const GeoTransform transform = info.transform.value_or(GeoTransform{});
    if (columns == info.columns && rows == info.rows) {
        return {columns, rows, transform, info.crs};
    }
    // What can be inverted can be so in larger pixels too.
    const double wider = static_cast<double>(info.columns) / static_cast<double>(columns);
    const double higher = static_cast<double>(info.rows) / static_cast<double>(rows);
    GeoTransform::Terms terms = transform.terms();
    for (const std::size_t along_rows : {1U, 4U}) {
        terms[along_rows] *= wider;
        terms[along_rows + 1] *= higher;
    }
    return {columns, rows, GeoTransform::fromTerms(terms).value(), info.crs};
}

} // namespace marsview
