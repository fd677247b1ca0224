// The map or mesh that `trace` touches.
#pragma once

#include "app/cli/contact_trace.h"
#include "app/console/map_options.h"
#include "app/console/map_pile.h"
#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/contact/contact_model.h"
#include "core/geo/scene_frame.h"
#include "core/levels/waiting_terrain.h"
#include "core/session/map.h"
#include "haptics/trace/goal_file.h"
#include "haptics/trace/recorded_ground.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// The contact settings for the goals from `first` on.
struct TraceTouch {
    std::size_t first = 0;
    std::uint64_t part = 0; // of a recording: different for another model
    ContactModelKind kind = kContactModelDefault;
    double radius_m = 1.0;
    double exaggeration = 1.0;
    std::optional<SceneFrame> frame{}; // for a map placed in another map's scene
};

struct Toucher {
    std::unique_ptr<ContactModel> model;
    TraceFrame frame;
};

struct TraceSubject {
    std::function<Toucher(const TraceTouch&)> make;
    double radius_m = 1.0;          // unless given
    std::shared_ptr<const Map> map; // null for a mesh
    bool is_on_body = false;        // in the body scene
    /// Of maps in tiles, or else, as it was when the recording was made:
    std::vector<std::shared_ptr<const WaitingTerrain>> waiting;
    std::shared_ptr<RecordedGround> recorded;
    bool is_recorded_on = false; // the recording's description of its map matches
};

/// Whether a path has the extension of a mesh.
bool isMesh(const std::string& path);

/// `exaggeration` applies to all models over the subject.
Result<TraceSubject>
meshSubject(const MapOptions& options, double exaggeration, JobMonitor& monitor);

/// The map on its body, on top of others if `pile` has them; the errors of BodyMesh and
/// pileOnBody() are added to those of opening. `exaggeration` applies to all models over the
/// subject. A tiled map without others has the tiles of the recording, if that was made on such a
/// map.
Result<TraceSubject> bodySubject(const MapOptions& options,
                                 const PileOptions& pile,
                                 const GoalRecording& recording,
                                 double exaggeration,
                                 JobMonitor& monitor);

/// A tiled map has the tiles of the recording, if that was made on such a map.
Result<TraceSubject>
mapSubject(const MapOptions& options, const GoalRecording& recording, JobMonitor& monitor);

} // namespace marsview
