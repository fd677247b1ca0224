// How the program comes by maps: what all of them share, and the functions that read them.
#pragma once

#include "core/session/open_map.h"
#include "core/session/preview_map.h"

#include <functional>

namespace marsview {

/// A value that jobs take with them. The functions are called on threads other than the GUI's;
/// tests put others in their place.
struct MapOpener {
    MapResources resources{};
    std::function<Result<OpenPlan>(const DatasetSpec&, const MapResources&)> plan = planOpening;
    std::function<Result<LoadedMap>(
        const DatasetSpec&, const OpenPlan&, const MapResources&, JobMonitor&)>
        open = openPlanned;
    std::function<Result<LoadedMap>(const DatasetSpec&, const DecimationLimits&, JobMonitor&)>
        preview = readPreview;
    std::function<Status(const DatasetSpec&, const MapResources&, JobMonitor&)> prepare =
        prepareForOpening;
};

} // namespace marsview
