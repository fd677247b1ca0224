// The definitions of mesh_cast.h, for the files that instantiate them.
//
// Notation. Points are sheared along the segment's longest axis so that it becomes a point, the
// origin, in the plane of the two other axes (S. Woop, C. Benthin, I. Wald, "Watertight
// ray/triangle intersection", Journal of Computer Graphics Techniques 2, 2013). The sheared
// position of a vertex depends only on the vertex, and the side of an edge on which the origin lies
// is decided without rounding error. So the sheared mesh has no gaps, and a segment that ends
// inside a closed object has hit one of its faces.
//
// A vertex is taken relative to the nearer end of the segment: relative to a far start, rounding
// would move it by more than the goal may be above it. The goal's own coordinates decide whether it
// is behind a face, so that the end of this segment, which is the start of the next, is in free
// space for both.
#pragma once

#include "core/mesh/mesh_cast.h"
#include "core/mesh/predicates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace marsview {
namespace mesh_cast {

inline constexpr double kCastEpsilon = std::numeric_limits<double>::epsilon();
// A start is on a face if it is nearer to it than this fraction of the sizes of both. Four times
// the lift that MeshSurface gives to starts.
inline constexpr double kOnFace = 256.0 * kCastEpsilon;

template <typename Mesh>
class SegmentCast {
public:
    using Index = typename Mesh::Index;
    using Start = MeshStart<Index>;
    using Cast = BasicMeshCast<Index>;

    SegmentCast(const Mesh& mesh, const Start& start, const MeshEnd& goal) noexcept
        : mesh_(mesh)
        , start_(start)
        , goal_(goal)
        , along_(((goal.point - start.base) - start.offset) + goal.rest)
    {
        const double x = std::abs(along_.x);
        const double y = std::abs(along_.y);
        const double z = std::abs(along_.z);
        axis_ = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
        const Vec3 turned = turn(along_);
        shear_x_ = turned.x / turned.z;
        shear_y_ = turned.y / turned.z;
        is_forward_ = turned.z > 0.0;
        along_size_ = sizeOf(along_);
    }

    Cast cast() noexcept
    {
        if (along_ == Vec3{}) {
            return {};
        }
        const auto& tree = mesh_.tree();
        const Vec3 from = (start_.base - tree.middle()) + start_.offset;
        const double slack = 4.0 * kOnFace * start_.size_m;
        using Points = std::array<ScenePoint, 3>;
        const auto look_at = [this](Index face, const Points& points, double& t_max) {
            ++result_.faces;
            look(face, points, t_max);
        };
        if constexpr (requires { tree.pointsAlong(from, along_, slack, look_at); }) {
            tree.pointsAlong(from, along_, slack, look_at);
        } else {
            tree.alongSegment(from, along_, slack, [&](Index face, double& t_max) {
                look_at(face, mesh_.points(face), t_max);
            });
        }
        return result_;
    }

private:
    // The segment's longest axis becomes z, in a right-handed frame.
    Vec3 turn(const Vec3& v) const noexcept
    {
        return axis_ == 2 ? v : axis_ == 0 ? Vec3{v.y, v.z, v.x} : Vec3{v.z, v.x, v.y};
    }

    struct Sheared {
        double x;
        double y;
        double from_start; // along the longest axis
        double to_goal;
    };
    Sheared sheared(const Vec3& from_start, const ScenePoint& vertex) const noexcept
    {
        const Vec3 a = turn(from_start);
        const Vec3 b = turn((vertex - goal_.point) - goal_.rest);
        const Vec3& nearer = std::abs(a.z) <= std::abs(b.z) ? a : b;
        return {nearer.x - shear_x_ * nearer.z, nearer.y - shear_y_ * nearer.z, a.z, -b.z};
    }

    static double sizeOf(const Vec3& v) noexcept
    {
        return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
    }

    bool isSkipped(Index index) const noexcept
    {
        if (index == start_.skipped_faces[0] || index == start_.skipped_faces[1]) {
            return true;
        }
        if (start_.skipped_vertex == Mesh::kNone) {
            return false;
        }
        const auto face = mesh_.face(index);
        return face[0] == start_.skipped_vertex || face[1] == start_.skipped_vertex ||
               face[2] == start_.skipped_vertex;
    }

    void look(Index index, const std::array<ScenePoint, 3>& points, double& t_max) noexcept
    {
        if (isSkipped(index)) {
            return;
        }
        const auto& [p0, p1, p2] = points;
        const Vec3 a = p1 - p0;
        const Vec3 b = p2 - p0;
        const Vec3 normal = cross(a, b);
        const Vec3 v0 = (p0 - start_.base) - start_.offset;
        // Doubles represent the plane of a sliver poorly.
        const double error = 8.0 * kCastEpsilon * sizeOf(a) * sizeOf(b);
        const double facing = dot(normal, along_);
        if (facing > error * along_size_) {
            return; // seen from behind
        }
        const double above = -dot(normal, v0);
        const double above_error = error * sizeOf(v0);
        const double area_squared = dot(normal, normal);
        // sqrt(x) + y is at most sqrt(2 (x + y²)), and at least half of it.
        const double near_m =
            kOnFace *
            std::sqrt(2.0 * (std::max(dot(a, a), dot(b, b)) + start_.size_m * start_.size_m));
        const double beyond_error = std::abs(above) - above_error;
        const bool may_be_near =
            beyond_error <= 0.0 || beyond_error * beyond_error <= near_m * near_m * area_squared;
        if (above < 0.0 && !may_be_near) {
            return; // begins behind
        }
        if (sideOfPlane(p0, p1, p2, goal_.point, goal_.rest) > 0) {
            return; // ends in front
        }
        const Vec3 v1 = (p1 - start_.base) - start_.offset;
        const Vec3 v2 = (p2 - start_.base) - start_.offset;
        if (may_be_near && beginsOn(index, v0, v1, v2, near_m, area_squared)) {
            t_max = 0.0;
            return;
        }
        if (above <= above_error && sideOfPlane(p0, p1, p2, start_.base, start_.offset) <= 0) {
            return;
        }
        const Sheared s0 = sheared(v0, p0);
        const Sheared s1 = sheared(v1, p1);
        const Sheared s2 = sheared(v2, p2);
        // Seen along the segment, the face turns clockwise; against the axis, counter-clockwise.
        const auto weight = [this](const Sheared& p, const Sheared& q) {
            const int sign = signOfDeterminant(p.x, p.y, q.x, q.y);
            const double value = std::abs(p.x * q.y - p.y * q.x);
            return (is_forward_ ? -sign : sign) < 0 ? -1.0 : sign == 0 ? 0.0 : value;
        };
        const double w0 = weight(s1, s2);
        const double w1 = weight(s2, s0);
        const double w2 = weight(s0, s1);
        const double sum = w0 + w1 + w2;
        if (w0 < 0.0 || w1 < 0.0 || w2 < 0.0 || !(sum > 0.0)) {
            return;
        }
        // Computed from the position in the face, not from the distances to its plane. Near the
        // goal the remaining distance has more digits than the distance covered.
        const double per_sum = 1.0 / (sum * turn(along_).z);
        const auto share = [&](double Sheared::*depth) {
            const double at = w0 * s0.*depth + w1 * s1.*depth + w2 * s2.*depth;
            return std::clamp(at * per_sum, 0.0, 1.0);
        };
        const double t = share(&Sheared::from_start);
        const double rest = share(&Sheared::to_goal);
        if (t > t_max || (result_.hit && t == t_max && rest <= rest_)) {
            return;
        }
        t_max = t;
        rest_ = rest;
        result_.hit = BasicMeshPlace<Index>{index, {w0 / sum, w1 / sum, w2 / sum}};
    }

    // Whether the start is on the face, as far as rounding allows; then that is the hit.
    bool beginsOn(Index index,
                  const Vec3& v0,
                  const Vec3& v1,
                  const Vec3& v2,
                  double near_m,
                  double area_squared) noexcept
    {
        std::array<double, 3> weights = nearestWeights(v0, v1, v2);
        const Vec3 nearest = v0 * weights[0] + v1 * weights[1] + v2 * weights[2];
        if (dot(nearest, nearest) > 4.0 * near_m * near_m) {
            return false;
        }
        // A position this near to an edge or a corner is on it: around a ridge the path may leave
        // along the other face, which then also counts as left.
        const std::array<Vec3, 3> edges{v2 - v1, v0 - v2, v1 - v0};
        double sum = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double height_squared = area_squared / dot(edges[i], edges[i]);
            if (weights[i] * weights[i] * height_squared <= 16.0 * near_m * near_m) {
                weights[i] = 0.0;
            }
            sum += weights[i];
        }
        if (!(sum > 0.0)) { // the whole face is smaller than rounding error
            weights = {1.0, 0.0, 0.0};
            sum = 1.0;
        }
        for (double& weight : weights) {
            weight /= sum;
        }
        rest_ = 1.0;
        result_.hit = BasicMeshPlace<Index>{index, weights};
        return true;
    }

    const Mesh& mesh_;
    const Start& start_;
    const MeshEnd& goal_;
    Vec3 along_;
    int axis_;
    double shear_x_;
    double shear_y_;
    bool is_forward_;
    double along_size_;
    double rest_ = 1.0;
    Cast result_;
};

} // namespace mesh_cast

template <typename Mesh>
int sideOf(const Mesh& mesh, typename Mesh::Index face, const MeshEnd& end) noexcept
{
    const auto points = mesh.points(face);
    return sideOfPlane(points[0], points[1], points[2], end.point, end.rest);
}

template <typename Mesh>
BasicMeshCast<typename Mesh::Index> castSegment(const Mesh& mesh,
                                                const MeshStart<typename Mesh::Index>& start,
                                                const MeshEnd& goal) noexcept
{
    return mesh_cast::SegmentCast<Mesh>(mesh, start, goal).cast();
}

template <typename Mesh>
BasicMeshPlace<typename Mesh::Index> nearestPlace(const Mesh& mesh,
                                                  const ScenePoint& point) noexcept
{
    using Index = typename Mesh::Index;
    BasicMeshPlace<Index> nearest;
    using Points = std::array<ScenePoint, 3>;
    const auto look_at = [&](Index index, const Points& points, double& limit) {
        const Vec3 a = points[0] - point;
        const Vec3 b = points[1] - point;
        const Vec3 c = points[2] - point;
        const std::array<double, 3> weights = nearestWeights(a, b, c);
        const Vec3 rest = a * weights[0] + b * weights[1] + c * weights[2];
        const double squared = dot(rest, rest);
        if (squared < limit) {
            limit = squared;
            nearest = {index, weights};
        }
    };
    const auto& tree = mesh.tree();
    if constexpr (requires { tree.pointsNearest(point, look_at); }) {
        tree.pointsNearest(point, look_at);
    } else {
        tree.nearestFirst(
            point, [&](Index index, double& limit) { look_at(index, mesh.points(index), limit); });
    }
    return nearest;
}

} // namespace marsview
