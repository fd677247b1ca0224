// The surface that a tick touches, whether its map is laid out in the plane or lies on its body.
#pragma once

#include "core/base/vec.h"
#include "core/contact/goal_frame.h"
#include "core/geo/body.h"
#include "core/geo/frames.h"

#include <array>
#include <cstddef>

namespace marsview {

/// Goals in free space, in order.
struct HighWay {
    static constexpr std::size_t kMax = 3;
    std::array<TracePoint, kMax> goals{};
    std::size_t count = 0;
};

/// The scene is the frame in which the contact model works: that of GoalFrame in the plane, the
/// body-fixed frame on a body. Servo thread; nothing here allocates.
class TouchSurface {
public:
    virtual ~TouchSurface() = default;
    TouchSurface(const TouchSurface&) = delete;
    TouchSurface& operator=(const TouchSurface&) = delete;

    /// Goals and proxies as in recordings, and the same in the scene.
    virtual ScenePoint toScene(const TracePoint& goal) const noexcept = 0;
    virtual TracePoint fromScene(const ScenePoint& point) const noexcept = 0;
    /// Whether a model replaces the goal by a point on the border of the map.
    virtual bool isClamped(const TracePoint& goal) const noexcept = 0;

    /// The nearest point over the map, horizontally.
    virtual ScenePoint overMap(const ScenePoint& point) const noexcept = 0;
    /// From there to the point; zero over the map.
    virtual Vec3 beyondMap(const ScenePoint& point) const noexcept = 0;

    /// Of a point over the surface straight below or above it, along the local vertical, in scene
    /// meters. Outside the map, over its edge.
    virtual double clearance(const ScenePoint& point) const noexcept = 0;

    /// The nearest position on the grid of a map in tiles, and there, of the way to the next row,
    /// that to the next column. Of several maps, one that is further away than it is large needs no
    /// tiles.
    struct OnGrid {
        GridPoint at;
        double column_share = 1.0;
        bool is_near = true;
    };
    /// `tiles` is the index of the map in ServoMap::tiles.
    virtual OnGrid onGrid(const ScenePoint& point, std::size_t tiles) const noexcept = 0;
    /// Where its grid goes around the body, the columns per turn; otherwise 0.
    virtual double columnsPerTurn(std::size_t /*tiles*/) const noexcept { return 0.0; }

    /// Leads from a proxy, above all of the terrain, to straight above a goal.
    virtual HighWay highWay(const ScenePoint& proxy, const TracePoint& goal) const noexcept = 0;

    /// A wall between two maps holds a proxy in contact, although the surface straight above the
    /// goal is nearer to the goal than the proxy is. Where the proxy goes over the wall then, a
    /// pull against a step overcomes it, and the force turns without becoming stronger.
    virtual bool isHeldByWall(const ScenePoint& /*proxy*/,
                              const TracePoint& /*goal*/) const noexcept
    {
        return false;
    }

    /// On which the map lies, around the origin of the scene; null in the plane.
    virtual const Ellipsoid* body() const noexcept = 0;

protected:
    TouchSurface() = default;
};

} // namespace marsview
