#include "core/session/preview_map.h"

#include "core/session/open_map.h"

#include <fmt/format.h>
#include <memory>
#include <utility>

namespace marsview {

Result<LoadedMap>
readPreview(const DatasetSpec& spec, const DecimationLimits& limits, JobMonitor& monitor)
{
    Result<RasterFile> file = RasterFile::open(spec.path, spec.band);
    if (!file) {
        return std::move(file).error();
    }
    Result<RasterInfo> info = withOverrides(file->info(), spec.overrides);
    if (!info) {
        return Error{info.error().code, fmt::format("{}: {}", spec.path, info.error().message)};
    }
    if (Status surface = checkIsSurface(spec.path, *info); !surface) {
        return std::move(surface).error();
    }
    monitor.beginStage(0.0, 0.8);
    Result<DecimatedSamples> samples = readDecimated(*file, {info->nodata}, limits, monitor);
    if (!samples) {
        return std::move(samples).error();
    }
    const SampleStatistics& statistics = samples->loaded.statistics;
    if (!statistics.hasSamples()) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: no height was found among {} samples all over it", spec.path,
                                 statistics.sample_count)};
    }
    const JobPart measuring(monitor, 0.8, 1.0);
    return prepareMap(
        previewDataset(
            {.spec = spec,
             .file_info = file->info(),
             .info = std::move(info).value(),
             .statistics = statistics,
             .samples = std::make_shared<const SampleGrid>(std::move(samples->loaded.grid)),
             .kind = samples->is_finest ? DatasetKind::Preview : DatasetKind::RoughPreview}),
        monitor);
}

Result<LoadedMap> previewMap(const DatasetSpec& spec, std::size_t samples_max, JobMonitor& monitor)
{
    return readPreview(spec, {.samples_max = samples_max}, monitor);
}

} // namespace marsview
