// Maps on top of each other on their body: the options --below and --feather.
#pragma once

#include "app/console/scene_option.h"
#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/session/body_terrain.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace marsview {

/// Filled by the parser.
struct PileOptions {
    std::vector<std::string> below; // the uppermost first
    std::size_t feather_cells = 0;

    void addTo(CLI::App& command);
    /// The maps below and the one on top of them.
    std::vector<std::string> withPath(const std::string& top) const;
    /// Refuses combinations that mean nothing, with the parser's error. Call once.
    void check(SceneKind scene);
};

/// The map and those below it, the uppermost first, on the ellipsoid of the lowest. The edges of
/// all but the lowest are blended if the options say so. Errors: those of openMap(), of
/// BodyPositions and of featheredMap(); Invalid for maps of several bodies.
Result<std::vector<BodyTerrain>>
pileOnBody(const std::shared_ptr<const Map>& map, const PileOptions& options, JobMonitor& monitor);

} // namespace marsview
