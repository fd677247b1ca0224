#include "core/mesh/mesh_cast.h"

#include "core/mesh/mesh_cast_definitions.h"
#include "core/mesh/triangle_mesh.h"

namespace marsview {

template int sideOf(const TriangleMesh&, std::uint32_t, const MeshEnd&) noexcept;
template MeshCast
castSegment(const TriangleMesh&, const MeshStart<TriangleMesh::Index>&, const MeshEnd&) noexcept;
template MeshPlace nearestPlace(const TriangleMesh&, const ScenePoint&) noexcept;

// C. Ericson, "Real-time collision detection", 2005, section 5.1.5.
std::array<double, 3> nearestWeights(const Vec3& a, const Vec3& b, const Vec3& c) noexcept
{
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const double d1 = -dot(ab, a);
    const double d2 = -dot(ac, a);
    if (d1 <= 0.0 && d2 <= 0.0) {
        return {1.0, 0.0, 0.0};
    }
    const double d3 = -dot(ab, b);
    const double d4 = -dot(ac, b);
    if (d3 >= 0.0 && d4 <= d3) {
        return {0.0, 1.0, 0.0};
    }
    const double d5 = -dot(ab, c);
    const double d6 = -dot(ac, c);
    if (d6 >= 0.0 && d5 <= d6) {
        return {0.0, 0.0, 1.0};
    }
    // Through the normal: differences of products of the above cancel on slivers.
    const Vec3 normal = cross(ab, ac);
    double wc = dot(cross(a, b), normal);
    if (wc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        const double share = d1 / (d1 - d3);
        return {1.0 - share, share, 0.0};
    }
    double wb = dot(cross(c, a), normal);
    if (wb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        const double share = d2 / (d2 - d6);
        return {1.0 - share, 0.0, share};
    }
    const double wa = dot(cross(b, c), normal);
    if (wa <= 0.0 && d4 >= d3 && d5 >= d6) {
        const double share = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {0.0, 1.0 - share, share};
    }
    const double sum = std::max(wa, 0.0) + std::max(wb, 0.0) + std::max(wc, 0.0);
    if (!(sum > 0.0)) {
        return {1.0, 0.0, 0.0}; // the whole triangle is within rounding error
    }
    wb = std::max(wb, 0.0) / sum;
    wc = std::max(wc, 0.0) / sum;
    // On slivers the normal is inaccurate; the remaining vector within the plane is small, and so
    // is its error.
    const Vec3 rest = a + ab * wb + ac * wc;
    const double area_squared = dot(normal, normal);
    wb = std::clamp(wb - dot(cross(rest, ac), normal) / area_squared, 0.0, 1.0);
    wc = std::clamp(wc - dot(cross(ab, rest), normal) / area_squared, 0.0, 1.0 - wb);
    return {std::max(1.0 - wb - wc, 0.0), wb, wc};
}

} // namespace marsview
