#include "core/session/map.h"

#include "core/base/free_memory.h"
#include "core/raster/sample_suggestions.h"
#include "core/terrain/seam.h"
#include "core/view/exaggeration.h"
#include "core/view/scene_box.h"
#include "core/view/tint_range.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace marsview {
namespace {

// The steepest slope that relief tiles hold, as a multiple of the slope that the default
// exaggeration makes steep. 16 bits then resolve 5e-4 of that, which no light shows.
constexpr double kSlopeReach = 16.0;

constexpr double kAnalysisShare = 0.95; // of the time, filling voids takes the rest

void notePreview(RasterInfo& info, const Heightfield& heightfield)
{
    info.notices.insert(info.notices.begin(),
                        fmt::format("a preview of {} × {} samples is shown; elevations are read "
                                    "from it until all {} × {} are available",
                                    heightfield.columns(), heightfield.rows(), info.columns,
                                    info.rows));
}

HeightRange wholeRange(const Heightfield& heightfield)
{
    return heightfield.range().value_or(HeightRange{});
}

ReliefTileId wholeReliefOf(const Heightfield& heightfield)
{
    return wholeRelief(heightfield.columns(), heightfield.rows());
}

// Closes the raster, so that GDAL's blocks are gone before the surface is analyzed.
Result<MapSource> readSource(OpenRaster raster, JobMonitor& monitor, std::size_t memory_bytes_max)
{
    if (Status surface = checkIsSurface(raster.spec.path, raster.info); !surface) {
        return std::move(surface).error();
    }
    Result<LoadedSamples> samples = raster.file.readAll(monitor, raster.voids(), memory_bytes_max);
    if (!samples) {
        return std::move(samples).error();
    }
    if (!samples->statistics.hasSamples()) {
        return noElevations(raster.spec.path, samples->statistics);
    }
    Heightfield heightfield(std::make_shared<const SampleGrid>(std::move(samples->grid)),
                            samples->statistics, raster.info.elevationScale());
    return MapSource{.spec = std::move(raster.spec),
                     .file_info = raster.file.info(),
                     .info = std::move(raster.info),
                     .statistics = samples->statistics,
                     .heightfield = std::move(heightfield)};
}

} // namespace

Map::Map(MapSource source, std::shared_ptr<const SurfaceAnalysis> analysis)
    : source_(std::move(source))
    , georeference_(
          georeferenceOf(source_.info, source_.heightfield.columns(), source_.heightfield.rows()))
    , analysis_(std::move(analysis))
    , tint_range_(marsview::tintRange(analysis_->means, wholeRange(source_.heightfield)))
    , slope_max_(kSlopeReach / suitableExaggeration(*this))
{}

void Map::setRelief(ReliefTile relief)
{
    const Heightfield& heightfield = source_.heightfield;
    const std::size_t step = std::size_t{1} << wholeReliefOf(heightfield).level;
    const std::size_t columns = (heightfield.columns() + step - 1) / step;
    const std::size_t rows = (heightfield.rows() + step - 1) / step;
    slope_range_ = marsview::slopeRange(relief, columns, rows, slope_max_);
    slopes_ = slopeHistogram(relief, columns, rows, slope_max_);
    relief_ = std::make_shared<const ReliefTile>(std::move(relief));
}

double Map::height(GeographicPoint geographic) const
{
    const std::optional<GridPoint> grid = georeference_.toGrid(geographic);
    if (!grid) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    const Heightfield& heightfield = source_.heightfield;
    if (georeference_.wrapsAround()) {
        if (const auto seam = seamCell(*grid, heightfield.columns(), heightfield.rows())) {
            const std::size_t last = heightfield.columns() - 1;
            return heightInCell(
                {heightfield.sample(last, seam->row), heightfield.sample(0, seam->row),
                 heightfield.sample(last, seam->row + 1), heightfield.sample(0, seam->row + 1)},
                seam->u, seam->v);
        }
    }
    return heightfield.height(*grid);
}

Result<std::shared_ptr<const Map>> analyzeMap(MapSource source, JobMonitor& monitor)
{
    auto analysis = [&] {
        const JobPart analyzing(monitor, 0.0, kAnalysisShare);
        return analyze(source.heightfield, monitor);
    }();
    if (!analysis) {
        return std::move(analysis).error();
    }
    monitor.beginStage(kAnalysisShare, 1.0);
    auto filled = FilledHeightfield::build(source.heightfield, *analysis, monitor);
    if (!filled) {
        return std::move(filled).error();
    }
    if (source.kind == MapKind::Whole) {
        noteSuspiciousSamples(source.info, source.statistics);
    } else {
        notePreview(source.info, source.heightfield);
        noteElevations(source.info, source.statistics);
    }
    std::shared_ptr<Map> map(new Map(std::move(source), std::move(*analysis)));
    map->filled_ = std::make_shared<const FilledHeightfield>(std::move(*filled));
    map->setRelief(makeReliefTile(map->heightfield(), map->georeference().sceneFrame(),
                                  wholeReliefOf(map->heightfield()), map->slopeMax()));
    // GDAL's blocks and the buffers of the passes: half as much again as the samples.
    returnFreeMemory();
    return std::shared_ptr<const Map>(std::move(map));
}

Result<std::shared_ptr<const Map>> tiledMap(MapSource source,
                                            std::shared_ptr<const MapLevels> levels)
{
    noteSuspiciousSamples(source.info, source.statistics);
    std::shared_ptr<Map> map(new Map(std::move(source), levels->analysis));
    map->levels_ = std::move(levels);
    Result<ReliefTile> relief = loadReliefTile(map->heightfield(), map->georeference().sceneFrame(),
                                               wholeReliefOf(map->heightfield()), map->slopeMax());
    if (!relief) {
        return std::move(relief).error();
    }
    map->setRelief(std::move(*relief));
    return std::shared_ptr<const Map>(std::move(map));
}

Result<std::shared_ptr<const Map>>
readMap(OpenRaster raster, JobMonitor& monitor, std::size_t memory_bytes_max)
{
    // Shares as measured on a map of 34 million samples.
    constexpr double kReadingShare = 0.6;
    monitor.beginStage(0.0, kReadingShare);
    Result<MapSource> source = readSource(std::move(raster), monitor, memory_bytes_max);
    if (!source) {
        return std::move(source).error();
    }
    const JobPart analyzing(monitor, kReadingShare, 1.0);
    return analyzeMap(std::move(*source), monitor);
}

Result<std::shared_ptr<const Map>>
readMap(const RasterSpec& spec, JobMonitor& monitor, std::size_t memory_bytes_max)
{
    Result<OpenRaster> raster = openRaster(spec);
    return raster ? readMap(std::move(*raster), monitor, memory_bytes_max)
                  : Result<std::shared_ptr<const Map>>(std::move(raster).error());
}

Error noElevations(const std::string& path, const SampleStatistics& statistics)
{
    return {ErrorCode::Invalid,
            fmt::format("{}: contains no elevations; all of its {} samples are nodata", path,
                        statistics.sample_count)};
}

Result<std::shared_ptr<const Map>>
withOverrides(const Map& map, const RasterOverrides& overrides, JobMonitor& monitor)
{
    RasterSpec spec = map.spec();
    spec.overrides = overrides;
    Result<RasterInfo> info = infoWithOverrides(map.fileInfo(), spec);
    if (!info) {
        return std::move(info).error();
    }
    if (info->nodata != map.info().nodata) {
        return Error{
            ErrorCode::Unsupported,
            fmt::format("{}: another nodata value needs the samples read again", spec.path)};
    }
    if (map.heightfield().isTiled()) {
        return Error{ErrorCode::Unsupported,
                     fmt::format("{}: is read in tiles, which depend on these options", spec.path)};
    }
    const SampleStatistics& statistics = map.source_.statistics;
    Heightfield heightfield = map.heightfield().scaled(statistics, info->elevationScale());
    return analyzeMap({.spec = std::move(spec),
                       .file_info = map.fileInfo(),
                       .info = std::move(*info),
                       .statistics = statistics,
                       .heightfield = std::move(heightfield),
                       .kind = map.kind()},
                      monitor);
}

bool isOfSameMap(const Map& preview, const Map& map)
{
    return preview.isPreview() && preview.spec() == map.spec() &&
           preview.info().columns == map.info().columns && preview.info().rows == map.info().rows;
}

ReliefTileId wholeRelief(std::size_t columns, std::size_t rows)
{
    // Nodes double from DetailErrors::kNodeCells cells until one is enough; tiles cover the same.
    std::size_t level = 0;
    while ((ReliefTile::kTexels << level) < std::max(columns, rows) - 1) {
        ++level;
    }
    return {.level = level};
}

double suitableExaggeration(const Map& map)
{
    const Heightfield& heightfield = map.heightfield();
    const HeightRange range = wholeRange(heightfield);
    const SceneBox box = sceneBox(map.georeference().sceneFrame(), heightfield.columns(),
                                  heightfield.rows(), range, 1.0);
    return defaultExaggeration(box.extent_m(), range.maximum_m - range.minimum_m);
}

} // namespace marsview
