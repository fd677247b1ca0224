#include "core/session/open_map.h"

#include "core/prepare/prepare_map.h"
#include "core/session/map_opening.h"
#include "core/session/preview.h"

#include <fmt/format.h>
#include <utility>

namespace marsview {
namespace {

Status buildOverviews(const OpenRaster& raster, const MapResources& resources, JobMonitor& monitor)
{
    const Result<PrepareReport> prepared = prepareInFolder(
        raster, {.folder = resources.folder, .folder_bytes_max = resources.folder_bytes_max},
        monitor);
    return prepared ? Status(Done{}) : Status(prepared.error());
}

Result<MapOpening>
beginPrepared(MapOpening unprepared, const MapResources& resources, JobMonitor& monitor)
{
    if (Status built = buildOverviews(unprepared.raster(), resources, monitor); !built) {
        return std::move(built).error();
    }
    const std::string path = unprepared.raster().spec.path;
    Result<MapOpening> opening = MapOpening::begin(std::move(unprepared).takeRaster(), resources);
    if (opening && opening->storage() == MapStorage::NeedsOverviews) {
        return Error{
            ErrorCode::Unreadable,
            fmt::format("{}: its overviews were built but have disappeared from {}; choose "
                        "another folder for prepared maps",
                        path, resources.folder.string())};
    }
    return opening;
}

} // namespace

Result<std::shared_ptr<const Map>> openMap(const RasterSpec& spec,
                                           const MapResources& resources,
                                           JobMonitor& monitor,
                                           const OpenMapOptions& options)
{
    Result<OpenRaster> raster = openRaster(spec);
    if (!raster) {
        return std::move(raster).error();
    }
    if (options.is_in_memory) {
        return readMap(std::move(*raster), monitor, defaultMemoryBudget());
    }
    Result<MapOpening> opening = MapOpening::begin(std::move(*raster), resources);
    if (opening && opening->storage() == MapStorage::NeedsOverviews) {
        if (options.without_overviews == WithoutOverviews::Preview) {
            return readPreview(std::move(*opening).takeRaster(), options.preview, monitor);
        }
        opening = beginPrepared(std::move(*opening), resources, monitor);
    }
    if (!opening) {
        return std::move(opening).error();
    }
    Result<std::shared_ptr<const Map>> map = opening->finish(monitor);
    if (map || !opening->isDamageToPrepared(map.error()) || !opening->discardPrepared()) {
        return map;
    }
    return openMap(spec, resources, monitor, options); // the damaged files are gone, so this ends
}

Status buildOverviews(const RasterSpec& spec, const MapResources& resources, JobMonitor& monitor)
{
    if (Status local = checkIsLocal(spec); !local) {
        return local;
    }
    const Result<OpenRaster> raster = openRaster(spec);
    return raster ? buildOverviews(*raster, resources, monitor) : Status(raster.error());
}

} // namespace marsview
