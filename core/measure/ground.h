// The ground that lengths, areas and directions refer to: a body's ellipsoid, or a plane.
#pragma once

#include "core/base/vec.h"
#include "core/geo/body.h"
#include "core/geo/frames.h"

#include <memory>
#include <optional>
#include <span>

namespace marsview {

/// A position on a Ground. On an ellipsoid: degrees of longitude east, in any turn, and of
/// planetographic latitude. On a plane: meters east and north.
struct GroundPosition {
    double x = 0.0;
    double y = 0.0;
    bool operator==(const GroundPosition&) const = default;
};

/// The local frame of a position: unit vectors east, north and up.
struct LocalFrame {
    Vec3 origin;
    Vec3 east;
    Vec3 north;
    Vec3 up;

    /// East, north and up of `point`, which is in the frame of the body.
    Vec3 toLocal(const Vec3& point) const
    {
        const Vec3 d = point - origin;
        return {dot(d, east), dot(d, north), dot(d, up)};
    }
    Vec3 toBody(const Vec3& local) const
    {
        return origin + east * local.x + north * local.y + up * local.z;
    }
};

/// The shortest line between two positions: a geodesic, or a straight line on a plane. Immutable.
class GroundLine {
public:
    double lengthM() const noexcept { return length_m_; }
    /// At the start, clockwise from north, in [0°, 360°).
    double azimuthDeg() const noexcept { return azimuth_deg_; }
    /// The position at a distance from the start; beyond the ends the line continues. Longitudes
    /// continue from that of the start without a jump.
    GroundPosition at(double distance_m) const;

private:
    friend class Ground;
    struct Impl;

    double length_m_ = 0.0;
    double azimuth_deg_ = 0.0;
    std::shared_ptr<const Impl> impl_;
};

struct GroundPolygon {
    double area_m2 = 0.0; // signed: positive if the smaller side lies to the left of the edges
    double perimeter_m = 0.0;
};

/// Geodesics, areas and directions by GeographicLib (C. F. F. Karney 2013, Algorithms for
/// geodesics, J. Geodesy 87, 43–55), for any flattening: the errors of lengths are some nanometers.
/// Immutable; copies share; any thread.
class Ground {
public:
    static Ground onEllipsoid(const Ellipsoid& ellipsoid);
    static Ground onPlane();

    /// Empty on a plane.
    const std::optional<Ellipsoid>& ellipsoid() const noexcept { return ellipsoid_; }

    /// Only on an ellipsoid.
    GroundPosition position(GeographicPoint geographic) const;
    GeographicPoint geographic(GroundPosition position) const;

    GroundLine line(GroundPosition from, GroundPosition to) const;
    /// From `from` in a direction, clockwise from north; 1 m long.
    GroundLine ray(GroundPosition from, double azimuth_deg) const;
    double distanceM(GroundPosition a, GroundPosition b) const;

    /// The closed polygon whose edges are the shortest lines. Of its two sides on an ellipsoid the
    /// smaller one counts. Parts that are enclosed in opposite directions cancel.
    GroundPolygon polygon(std::span<const GroundPosition> vertices) const;

    /// Body-fixed Cartesian coordinates in meters of the point `elevation_m` above a position,
    /// along the normal: x to longitude 0, z to the north pole. On a plane: east, north, up.
    Vec3 cartesian(GroundPosition position, double elevation_m) const;
    /// The position below or above a point that is not the center of the body.
    GroundPosition positionOf(const Vec3& cartesian) const;
    /// The frame at elevation 0. At a pole, north and east are those of the given longitude.
    LocalFrame frameAt(GroundPosition position) const;

private:
    friend class GroundLine;
    struct Impl;

    std::optional<Ellipsoid> ellipsoid_;
    std::shared_ptr<const Impl> impl_; // null on a plane
};

} // namespace marsview
