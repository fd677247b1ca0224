// How the window opens maps, and what all of them share.
#pragma once

#include "core/session/open_map.h"
#include "core/session/preview.h"

#include <functional>
#include <memory>

namespace marsview {

/// Opens a map; one that has no overviews, but needs them, as a preview.
inline Result<std::shared_ptr<const Map>>
openMapOrPreview(const RasterSpec& spec, const MapResources& resources, JobMonitor& monitor)
{
    return openMap(spec, resources, monitor, {.without_overviews = WithoutOverviews::Preview});
}

/// A value that jobs take with them. The functions are called on threads other than the GUI's;
/// tests replace them.
struct MapOpener {
    using MapResult = Result<std::shared_ptr<const Map>>;

    MapResources resources{};
    std::function<MapResult(const RasterSpec&, const MapResources&, JobMonitor&)> open =
        openMapOrPreview;
    std::function<MapResult(const RasterSpec&, const DecimationLimits&, JobMonitor&)> preview =
        [](const RasterSpec& spec, const DecimationLimits& limits, JobMonitor& monitor) {
            return readPreview(spec, limits, monitor);
        };
    std::function<Status(const RasterSpec&, const MapResources&, JobMonitor&)> prepare =
        buildOverviews;
};

} // namespace marsview
