// A map with everything that showing and touching it needs.
#pragma once

#include "core/levels/level_file.h"
#include "core/session/dataset.h"
#include "core/terrain/filled_heightfield.h"
#include "core/terrain/relief_tile.h"
#include "core/terrain/surface_analysis.h"
#include "core/view/slope_range.h"

#include <memory>

namespace marsview {

/// All null, or none, but for what says otherwise. Immutable; copies share; any thread.
struct LoadedMap {
    std::shared_ptr<const Dataset> dataset;
    std::shared_ptr<const SurfaceAnalysis> analysis; // of the dataset's heightfield
    /// To be touched. Null where the map comes in tiles.
    std::shared_ptr<const FilledHeightfield> filled;
    /// What touching tiles needs. Null where the map is held.
    std::shared_ptr<const MapLevels> levels;
    HeightRange tint_range; // over which colours are spread: all but the rarest heights
    SlopeRange slope_range; // over which colors of slopes are spread by default
    double slope_max = 1.0; // that relief tiles are made for
    /// The relief of the whole map, the first that drawing needs.
    std::shared_ptr<const ReliefTile> relief;

    explicit operator bool() const noexcept { return dataset != nullptr; }
};

/// Analyses a dataset's surface: not for the GUI thread. Only Cancelled can go wrong.
Result<LoadedMap> prepareMap(std::shared_ptr<const Dataset> dataset, JobMonitor& monitor);

/// As above for a map in tiles, which was analysed when it was prepared. Waits for a few of its
/// tiles, and passes on why one could not be read.
Result<LoadedMap> prepareTiledMap(std::shared_ptr<const Dataset> dataset,
                                  std::shared_ptr<const MapLevels> levels);

/// Which relief tile covers all of a map of columns × rows samples.
ReliefTileId wholeRelief(std::size_t columns, std::size_t rows);

/// The factor at which the map's relief is easily seen (exaggeration.h).
double suitableExaggeration(const Dataset& dataset);

} // namespace marsview
