// Integrals over the part of a polygon between the outermost row of a map and a pole.
#pragma once

#include "core/measure/cell_part.h"
#include "core/measure/hypsometry.h"
#include "core/measure/measured_terrain.h"
#include "core/measure/volume_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace marsview {

/// A straight part of a polygon's edge in one triangle of a cap, in the plane of the cap.
struct CapEdge {
    std::uint32_t face = 0;
    CapPlane::Point from;
    CapPlane::Point to;
};

/// Sums up a polygon in a cap. The polygon is a signed sum of triangles from the pole: to what it
/// covers of the circle of samples, and to its edges. Each is cut into the triangles of the cap, so
/// that integrals are exact for their surface. For one thread; must not outlive what it is given.
class CapArea {
public:
    CapArea(MeasuredTerrain& terrain,
            const CapTerrain& cap,
            const VolumeSurface& base,
            const LocalFrame& frame,
            HypsometrySum& hypsometry)
        : terrain_(terrain)
        , cap_(cap)
        , base_(base)
        , frame_(frame)
        , hypsometry_(hypsometry)
    {
        const Ellipsoid& body = *terrain.ground().ellipsoid();
        radius_share_ = cap.radius_m / body.equatorial_m;
        flatness_ = body.polar_m / body.equatorial_m;
        m2_of_plane_ = cap.radius_m * cap.radius_m;
        if (const auto sample = terrain.fromGrid({0.0, terrain.rowLine(cap.row)})) {
            const Vec3 first = terrain.ground().cartesian(*sample, 0.0);
            const double turn = terrain.columnsRunEast() ? 1.0 : -1.0;
            x_ = {first.x, first.y, 0.0};
            y_ = {-turn * first.y, turn * first.x, 0.0};
            pole_ = {0.0, 0.0, std::copysign(body.polar_m, first.z)};
        }
    }

    /// What the polygon covers of the circle: the part [u0, u1] of a column of cells, `weight`
    /// times.
    void addCircle(std::size_t column, double u0, double u1, double weight)
    {
        const std::uint32_t face =
            cap_.plane.shape().cornerAtCircle(static_cast<std::uint32_t>(column)) / 3;
        const Point from = cap_.plane.at(column, u0, 1.0);
        const Point to = cap_.plane.at(column, u1, 1.0);
        addWedge(face, from, to, weight);
        addBeyondChord(face, from, to, weight);
    }
    /// The triangle from the pole to an edge; negative where the edge runs clockwise.
    void addEdge(const CapEdge& edge, double weight)
    {
        addWedge(edge.face, edge.from, edge.to, weight);
    }

    /// Whether the polygon has the pole, and the elevation there.
    bool hasPole() const { return pole_turns_ > 0.5; }
    double poleM() const { return cap_.pole_m; }

    double covered_m2 = 0.0;
    double surface_m2 = 0.0;
    double height_m3 = 0.0; // ∫ elevation
    double above_m3 = 0.0;
    double below_m3 = 0.0;

private:
    using Point = CapPlane::Point;

    // Parts of faces are CellParts here, with the plane's x and y as u and v.

    void addWedge(std::uint32_t face, const Point& from, const Point& to, double weight)
    {
        const double turned = CapPlane::cross(from, to);
        if (turned == 0.0) {
            return;
        }
        const double signed_weight = turned > 0.0 ? weight : -weight;
        pole_turns_ +=
            weight * std::atan2(turned, from.x * to.x + from.y * to.y) / (2.0 * std::numbers::pi);
        CellPart wedge;
        wedge.add({0.0, 0.0});
        wedge.add(turned > 0.0 ? UvPoint{from.x, from.y} : UvPoint{to.x, to.y});
        wedge.add(turned > 0.0 ? UvPoint{to.x, to.y} : UvPoint{from.x, from.y});
        // The wedge is convex: what it has in common with faces hangs together over their edges.
        seen_.assign(1, face);
        for (std::size_t next = 0; next < seen_.size(); ++next) {
            const std::uint32_t at = seen_[next];
            CellPart part = wedge;
            const std::array<std::uint32_t, 3> corners = cap_.plane.shape().face(at);
            for (std::size_t i = 0; i < 3 && part.count > 0; ++i) {
                const Point a = cap_.plane.vertex(corners[i]);
                const Point edge = cap_.plane.vertex(corners[(i + 1) % 3]) - a;
                part = clipped(part, [&](const UvPoint& p) {
                    return CapPlane::cross(edge, Point{p.u, p.v} - a);
                });
            }
            if (part.count < 3 && next > 0) {
                continue;
            }
            addPart(part, at, signed_weight);
            for (std::uint32_t i = 0; i < 3; ++i) {
                const PoleCap::Beyond beyond = cap_.plane.shape().across(3 * at + i);
                if (!beyond.is_outside &&
                    std::find(seen_.begin(), seen_.end(), beyond.at / 3) == seen_.end()) {
                    seen_.push_back(beyond.at / 3);
                }
            }
        }
    }

    // The ground between the chord from sample to sample and the circle has the elevations of the
    // chord.
    void addBeyondChord(std::uint32_t face, const Point& from, const Point& to, double weight)
    {
        const std::array<double, 3> elevation_m = terrain_.corners(cap_, face);
        if (!std::isfinite(elevation_m[0] + elevation_m[1] + elevation_m[2])) {
            return;
        }
        const double sine = CapPlane::cross(from, to);
        const double angle = std::atan2(sine, from.x * to.x + from.y * to.y);
        const UvPoint begin{from.x, from.y};
        const UvPoint end{to.x, to.y};
        const UvPoint middle{0.5 * (begin.u + end.u), 0.5 * (begin.v + end.v)};
        const double in_plane = 0.5 * (angle - sine);
        add({linear(face, elevation_m), heightAboveBase(face, elevation_m)}, begin, middle, end,
            weight * in_plane * m2_of_plane_ * slopeOfBody(middle));
    }

    // The part of the ellipsoid that is as large as 1 in the plane, over the same where they are
    // parallel.
    double slopeOfBody(const UvPoint& p) const
    {
        const double r2 = radius_share_ * radius_share_ * (p.u * p.u + p.v * p.v);
        return std::sqrt(1.0 + flatness_ * flatness_ * r2 / (1.0 - r2));
    }

    LinearOnCell linear(std::uint32_t face, const std::array<double, 3>& at_corners) const
    {
        const auto value = [&](const Point& p) {
            const std::array<double, 3> w = cap_.plane.weights(face, p);
            return w[0] * at_corners[0] + w[1] * at_corners[1] + w[2] * at_corners[2];
        };
        const double at_pole = value({0.0, 0.0});
        return {at_pole, value({1.0, 0.0}) - at_pole, value({0.0, 1.0}) - at_pole};
    }

    double baseAt(std::uint32_t vertex) const
    {
        if (base_.kind != VolumeBase::BorderPlane) {
            return base_.level_m;
        }
        const CapPlane::Point at = cap_.plane.vertex(vertex);
        const double r = radius_share_ * std::hypot(at.x, at.y);
        const Vec3 local = frame_.toLocal(x_ * at.x + y_ * at.y + pole_ * std::sqrt(1.0 - r * r));
        return base_.level_m + base_.per_east * local.x + base_.per_north * local.y;
    }

    // Over a face.
    struct Heights {
        LinearOnCell elevation_m;
        LinearOnCell above_base_m; // zero without a base
    };

    LinearOnCell heightAboveBase(std::uint32_t face, std::array<double, 3> elevation_m) const
    {
        if (base_.kind == VolumeBase::None) {
            return {};
        }
        const std::array<std::uint32_t, 3> vertices = cap_.plane.shape().face(face);
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            elevation_m[i] -= baseAt(vertices[i]);
        }
        return linear(face, elevation_m);
    }

    void addPart(const CellPart& part, std::uint32_t face, double weight)
    {
        const std::array<double, 3> elevation_m = terrain_.corners(cap_, face);
        if (!std::isfinite(elevation_m[0] + elevation_m[1] + elevation_m[2])) {
            return;
        }
        const Heights heights{linear(face, elevation_m), heightAboveBase(face, elevation_m)};
        const LinearOnCell& above = heights.above_base_m;
        const auto side = [&](double sign) {
            return clipped(part, [&above, sign](const UvPoint& p) { return sign * above(p); });
        };
        const auto add_all = [&](const CellPart& of) {
            forEachPiece(of, [&](const UvPoint& o, const UvPoint& a, const UvPoint& b, double m2) {
                add(heights, o, a, b, weight * m2);
            });
        };
        if (base_.kind == VolumeBase::None) {
            add_all(part);
        } else {
            add_all(side(1.0));
            add_all(side(-1.0));
        }
    }

    // A triangle that the base does not cut.
    void add(const Heights& heights,
             const UvPoint& o,
             const UvPoint& a,
             const UvPoint& b,
             double area_m2)
    {
        const LinearOnCell& z = heights.elevation_m;
        covered_m2 += area_m2;
        surface_m2 += area_m2 * stretch(z, {(o.u + a.u + b.u) / 3.0, (o.v + a.v + b.v) / 3.0});
        height_m3 += area_m2 * (z(o) + z(a) + z(b)) / 3.0;
        hypsometry_.add({z(o), z(a), z(b)}, area_m2);
        const LinearOnCell& above = heights.above_base_m;
        const double above_m = (above(o) + above(a) + above(b)) / 3.0;
        (above_m >= 0.0 ? above_m3 : below_m3) += area_m2 * std::abs(above_m);
    }

    // Calls visit(corners, area) with the triangles of a part. The area is exact where the ground
    // is a quadratic function in the plane.
    template <typename Visit>
    void forEachPiece(const CellPart& part, const Visit& visit) const
    {
        forEachTriangle(part, [&](const UvPoint& o, const UvPoint& a, const UvPoint& b,
                                  double in_plane) {
            const auto halfway = [this](const UvPoint& p, const UvPoint& q) {
                return slopeOfBody({0.5 * (p.u + q.u), 0.5 * (p.v + q.v)});
            };
            visit(o, a, b,
                  in_plane * m2_of_plane_ * (halfway(o, a) + halfway(a, b) + halfway(b, o)) / 3.0);
        });
    }

    // The area of the terrain over that of the ground.
    double stretch(const LinearOnCell& z, const UvPoint& at) const
    {
        const double distance = std::hypot(at.u, at.v);
        const UvPoint out =
            distance > 0.0 ? UvPoint{at.u / distance, at.v / distance} : UvPoint{1.0, 0.0};
        const double outward =
            (z.per_u * out.u + z.per_v * out.v) / (cap_.radius_m * slopeOfBody(at));
        const double around = (z.per_v * out.u - z.per_u * out.v) / cap_.radius_m;
        return std::sqrt(1.0 + outward * outward + around * around);
    }

    MeasuredTerrain& terrain_;
    const CapTerrain& cap_;
    const VolumeSurface& base_;
    const LocalFrame& frame_;
    HypsometrySum& hypsometry_;
    double radius_share_ = 0.0; // of the circle, of the equator's radius
    double flatness_ = 1.0;
    double m2_of_plane_ = 0.0;
    // From the plane to the body-fixed frame.
    Vec3 x_;
    Vec3 y_;
    Vec3 pole_;
    double pole_turns_ = 0.0; // of the polygon around the pole
    std::vector<std::uint32_t> seen_;
};

} // namespace marsview
