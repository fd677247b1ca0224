#include "core/session/preview.h"

#include <fmt/format.h>
#include <utility>

namespace marsview {

Result<std::shared_ptr<const Map>>
readPreview(OpenRaster raster, const DecimationLimits& limits, JobMonitor& monitor)
{
    const std::string& path = raster.spec.path;
    if (Status surface = checkIsSurface(path, raster.info); !surface) {
        return std::move(surface).error();
    }
    constexpr double kReadingShare = 0.8;
    monitor.beginStage(0.0, kReadingShare);
    Result<DecimatedSamples> samples = readDecimated(raster.file, raster.voids(), limits, monitor);
    if (!samples) {
        return std::move(samples).error();
    }
    const SampleStatistics& statistics = samples->loaded.statistics;
    if (!statistics.hasSamples()) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: no elevation was found among {} samples all over it", path,
                                 statistics.sample_count)};
    }
    Heightfield heightfield(std::make_shared<const SampleGrid>(std::move(samples->loaded.grid)),
                            statistics, raster.info.elevationScale());
    const JobPart analyzing(monitor, kReadingShare, 1.0);
    return analyzeMap({.spec = std::move(raster.spec),
                       .file_info = raster.file.info(),
                       .info = std::move(raster.info),
                       .statistics = statistics,
                       .heightfield = std::move(heightfield),
                       .kind = samples->is_finest ? MapKind::Preview : MapKind::RoughPreview},
                      monitor);
}

Result<std::shared_ptr<const Map>>
readPreview(const RasterSpec& spec, const DecimationLimits& limits, JobMonitor& monitor)
{
    Result<OpenRaster> raster = openRaster(spec);
    return raster ? readPreview(std::move(*raster), limits, monitor)
                  : Result<std::shared_ptr<const Map>>(std::move(raster).error());
}

} // namespace marsview
