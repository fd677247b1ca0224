// What a bench of contact models needs of the terrain, on the flat map and on the body.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/contact/contact_model.h"
#include "core/geo/georeference.h"
#include "core/terrain/filled_heightfield.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace marsview {

/// The motion of a hand. Lengths in cells.
struct StrokeOptions {
    double speed = 1.0; // per update
    double low = -5.0;  // above the surface; negative: below it
    double high = -2.0;
    std::size_t update_count = 1000;
    std::size_t stroke_count = 500; // updates
    std::uint64_t seed = 7;
};

/// The goals of a hand's strokes. Each stroke begins at its own place on the surface, or `low`
/// above it: one goal that places the proxy, then one per update. The hand wanders at a constant
/// speed, approaches its depth at the same speed, and turns back before the border.
std::vector<ScenePoint> strokesOfAHand(const HeightfieldSurface& surface,
                                       const StrokeOptions& options);

/// The ideal of a path, goal by goal. One thread at a time.
class IdealProxy {
public:
    virtual ~IdealProxy() = default;
    IdealProxy(const IdealProxy&) = delete;
    IdealProxy& operator=(const IdealProxy&) = delete;

    virtual ScenePoint place(const ScenePoint& goal) = 0;
    virtual ScenePoint update(const ScenePoint& goal) = 0;
    /// Descents that did not end. If not 0, the result is wrong.
    virtual std::uint64_t unfinishedCount() const = 0;

protected:
    IdealProxy() = default;
};

/// A map at one vertical scale. Immutable; any thread.
class BenchSurface {
public:
    virtual ~BenchSurface() = default;
    BenchSurface(const BenchSurface&) = delete;
    BenchSurface& operator=(const BenchSurface&) = delete;

    /// Length of a cell in meters: the mean of its two sides.
    virtual double cellM() const = 0;
    virtual std::vector<ScenePoint> strokes(const StrokeOptions& options) const = 0;
    virtual std::unique_ptr<ContactModel> model(ContactModelKind kind,
                                                const ContactModelOptions& options) const = 0;
    /// `piece_cells` > 0: the motion of a goal is cut into pieces of this length.
    virtual std::unique_ptr<IdealProxy> ideal(double piece_cells) const = 0;
    /// The goal as a model sees it.
    virtual ScenePoint seen(const ScenePoint& goal) const = 0;
    /// See local_minimum.h.
    virtual double steepestCosineAt(const ScenePoint& proxy, const ScenePoint& goal) const = 0;

protected:
    BenchSurface() = default;
};

/// The map at a vertical scale.
using BenchSurfaceMaker = std::function<Result<std::shared_ptr<const BenchSurface>>(double scale)>;

/// The map laid out in the plane. The ideal is that of ReferenceProxy, which shares no code with
/// the models. Never fails.
BenchSurfaceMaker flatBenchSurfaces(std::shared_ptr<const FilledHeightfield> terrain,
                                    const SceneFrame& frame);

/// The map on its body, touched by the same hand: its goals have the same places on the map and the
/// same heights above it. The ideal is the surface walk after each piece of the motion. Errors:
/// those of BodyMesh::build().
BenchSurfaceMaker bodyBenchSurfaces(std::shared_ptr<const FilledHeightfield> terrain,
                                    const Georeference& georeference,
                                    JobMonitor& monitor);

} // namespace marsview
