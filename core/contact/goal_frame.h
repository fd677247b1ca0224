// Goals and proxies in map coordinates, as in files, and in scene coordinates, as in contact
// models.
#pragma once

#include "core/contact/contact.h"
#include "core/geo/georeference.h"

#include <memory>

namespace marsview {

/// A goal or a proxy as in files: x and y in map coordinates, z in meters, not exaggerated.
struct TracePoint {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;

    constexpr bool operator==(const TracePoint&) const = default;
};

/// Converts between the two. A goal that is written to a file and read back aims at the same
/// position to the bit, in a servo loop and in a batch. A value; all functions except the
/// constructors are arithmetic, for any thread.
class GoalFrame {
public:
    /// A single map in its own scene. `georeference` is shared, not copied.
    GoalFrame(std::shared_ptr<const Georeference> georeference, double exaggeration);
    /// A map in another map's scene, with its grid placed by `frame`.
    GoalFrame(std::shared_ptr<const Georeference> georeference,
              const SceneFrame& frame,
              double exaggeration);

    ScenePoint toScene(const TracePoint& goal) const noexcept;
    /// Removes rounding errors of positions on samples.
    TracePoint fromScene(const ScenePoint& point) const noexcept;
    /// Whether a model replaces the goal by a point on the border of the map.
    bool isClamped(const TracePoint& goal) const noexcept;

    const Georeference& georeference() const noexcept { return *georeference_; }
    const SceneFrame& frame() const noexcept { return frame_; }
    double exaggeration() const noexcept { return exaggeration_; }

private:
    std::shared_ptr<const Georeference> georeference_;
    SceneFrame frame_;
    double exaggeration_;
};

} // namespace marsview
