// A map with everything that showing and touching it needs.
#pragma once

#include "core/session/dataset.h"
#include "core/terrain/surface_analysis.h"

#include <memory>

namespace marsview {

/// All null, or none. Immutable; copies share; any thread.
struct LoadedMap {
    std::shared_ptr<const Dataset> dataset;
    std::shared_ptr<const SurfaceAnalysis> analysis; // of the dataset's heightfield
    HeightRange tint_range; // over which colours are spread: all but the rarest heights

    explicit operator bool() const noexcept { return dataset != nullptr; }
};

/// Analyses a dataset's surface: not for the GUI thread. Only Cancelled can go wrong.
Result<LoadedMap> prepareMap(std::shared_ptr<const Dataset> dataset, JobMonitor& monitor);

/// The factor at which the map's relief is easily seen (exaggeration.h).
double suitableExaggeration(const Dataset& dataset);

} // namespace marsview
