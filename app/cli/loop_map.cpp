#include "app/cli/loop_map.h"

#include "core/base/check.h"
#include "core/session/open_map.h"

#include <utility>

namespace marsview {

Result<LoopMap>
openLoopMap(const MapOptions& map, const LoopMapOptions& options, JobMonitor& monitor)
{
    Result<std::shared_ptr<const Map>> opened = openMap(map.spec(), defaultMapResources(), monitor);
    if (!opened) {
        return std::move(opened).error();
    }
    LoopMap result;
    result.opened = std::move(opened).value();
    const Georeference& georeference = result.opened->georeference();
    const Heightfield& heightfield = result.opened->heightfield();
    const SceneFrame& frame = georeference.sceneFrame();
    result.cell_m = frame.meanCellSideM();
    result.box = sceneBox(frame, georeference.columns(), georeference.rows(),
                          heightfield.range().value_or(HeightRange{}), options.exaggeration);
    result.touch = std::make_unique<TouchMap>(SceneMap{.map = result.opened, .frame = frame});
    result.map = result.touch->make(options.kind, options.exaggeration, options.radius_m);
    MARSVIEW_CHECK(result.map != nullptr); // openMap() fills the voids of a map in memory
    return result;
}

} // namespace marsview
