// Goals and proxies as files have them, in map coordinates, and as contact models have them.
#pragma once

#include "core/contact/contact.h"
#include "core/geo/georeference.h"

#include <memory>

namespace marsview {

/// A goal or a proxy as files have it: x and y in map coordinates, z in metres, not exaggerated.
struct TracePoint {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;

    constexpr bool operator==(const TracePoint&) const = default;
};

/// Between the two. A goal that was written down and is read again aims at the same place to the
/// bit, whoever reads it: a servo loop or a batch. A value; all but making it is arithmetic, for
/// any thread.
class GoalFrame {
public:
    /// A map alone in its scene. `georeference` is shared, not copied.
    GoalFrame(std::shared_ptr<const Georeference> georeference, double exaggeration);
    /// A map in another one's scene, where its grid lies as `frame` says.
    GoalFrame(std::shared_ptr<const Georeference> georeference,
              const SceneFrame& frame,
              double exaggeration);

    ScenePoint toScene(const TracePoint& goal) const noexcept;
    /// Without what rounding made of places on samples.
    TracePoint fromScene(const ScenePoint& point) const noexcept;
    /// Whether a model aims at another point instead, on the border of the map.
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
