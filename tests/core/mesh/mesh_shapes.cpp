#include "tests/core/mesh/mesh_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace marsview::test {
namespace {

using Real = long double;

struct Exact {
    Real x;
    Real y;
    Real z;
};
Exact operator-(const Exact& a, const Exact& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Exact operator+(const Exact& a, const Exact& b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Exact operator*(const Exact& a, Real s)
{
    return {a.x * s, a.y * s, a.z * s};
}
Real dot(const Exact& a, const Exact& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Exact cross(const Exact& a, const Exact& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Exact exact(const Vec3& v)
{
    return {static_cast<Real>(v.x), static_cast<Real>(v.y), static_cast<Real>(v.z)};
}

Real squaredToSegment(const Exact& a, const Exact& b)
{
    const Exact along = b - a;
    const Real share = std::clamp(-dot(a, along) / dot(along, along), Real{0}, Real{1});
    const Exact rest = a + along * share;
    return dot(rest, rest);
}

} // namespace

TriangleSoup tetrahedron()
{
    return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
            {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

TriangleSoup cube()
{
    TriangleSoup soup;
    for (int i = 0; i < 8; ++i) {
        soup.vertices.push_back(
            {(i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0, (i & 4) != 0 ? 1.0 : -1.0});
    }
    const std::array<std::array<std::uint32_t, 4>, 6> sides{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (const auto& s : sides) {
        soup.faces.push_back({s[0], s[1], s[2]});
        soup.faces.push_back({s[0], s[2], s[3]});
    }
    return soup;
}

TriangleSoup icosphere(int level)
{
    const double g = std::numbers::phi;
    TriangleSoup soup{{{-1, g, 0},
                       {1, g, 0},
                       {-1, -g, 0},
                       {1, -g, 0},
                       {0, -1, g},
                       {0, 1, g},
                       {0, -1, -g},
                       {0, 1, -g},
                       {g, 0, -1},
                       {g, 0, 1},
                       {-g, 0, -1},
                       {-g, 0, 1}},
                      {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                       {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                       {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                       {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
    for (int i = 0; i < level; ++i) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [at, is_new] = middles.try_emplace(
                std::minmax(a, b), static_cast<std::uint32_t>(soup.vertices.size()));
            if (is_new) {
                soup.vertices.push_back((soup.vertices[a] + soup.vertices[b]) * 0.5);
            }
            return at->second;
        };
        std::vector<MeshFace> faces;
        for (const auto& [a, b, c] : soup.faces) {
            const std::uint32_t ab = middle(a, b);
            const std::uint32_t bc = middle(b, c);
            const std::uint32_t ca = middle(c, a);
            faces.insert(faces.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        soup.faces = std::move(faces);
    }
    for (ScenePoint& v : soup.vertices) {
        v = normalized(v);
    }
    return soup;
}

TriangleSoup torus(int around, int across)
{
    TriangleSoup soup;
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const double u = 2.0 * std::numbers::pi * i / around;
            const double v = 2.0 * std::numbers::pi * j / across;
            const double r = 1.0 + 0.4 * std::cos(v);
            soup.vertices.push_back({r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v)});
        }
    }
    const auto at = [&](int i, int j) {
        return static_cast<std::uint32_t>((i % around) * across + j % across);
    };
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            soup.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            soup.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return soup;
}

TriangleSoup star()
{
    TriangleSoup soup = icosphere(2);
    for (std::size_t v = 0; v < soup.vertices.size(); ++v) {
        const double radius = v < 12 ? 2.5 : v < 42 ? 0.7 : 1.0 + 0.05 * static_cast<double>(v % 3);
        soup.vertices[v] = soup.vertices[v] * radius;
    }
    return soup;
}

TriangleSoup notchedBlock(double angle_rad)
{
    // A profile in x and z, counter-clockwise seen from -y, extruded along y from 0 to 1.
    const double half = std::tan(angle_rad / 2.0);
    const std::vector<std::array<double, 2>> profile{
        {-2.0, -1.0}, {2.0, -1.0}, {2.0, 1.0}, {half, 1.0}, {0.0, 0.0}, {-half, 1.0}, {-2.0, 1.0}};
    const std::vector<std::array<std::uint32_t, 3>> caps{
        {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {4, 5, 6}, {4, 6, 0}};
    TriangleSoup soup;
    for (const double y : {0.0, 1.0}) {
        for (const auto& [x, z] : profile) {
            soup.vertices.push_back({x, y, z});
        }
    }
    const auto n = static_cast<std::uint32_t>(profile.size());
    for (const auto& [a, b, c] : caps) {
        soup.faces.push_back({a, b, c});
        soup.faces.push_back({n + a, n + c, n + b});
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        soup.faces.push_back({i, n + i, n + j});
        soup.faces.push_back({i, n + j, j});
    }
    return soup;
}

TriangleSoup sheet(int columns, int rows, const std::function<double(int, int)>& height)
{
    TriangleSoup soup;
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c) {
            soup.vertices.push_back(
                {static_cast<double>(c), static_cast<double>(-r), height(c, r)});
        }
    }
    const auto at = [columns](int c, int r) { return static_cast<std::uint32_t>(r * columns + c); };
    for (int r = 0; r + 1 < rows; ++r) {
        for (int c = 0; c + 1 < columns; ++c) {
            soup.faces.push_back({at(c, r), at(c + 1, r + 1), at(c + 1, r)});
            soup.faces.push_back({at(c, r), at(c, r + 1), at(c + 1, r + 1)});
        }
    }
    return soup;
}

TriangleSoup placed(TriangleSoup soup, double scale, const Vec3& offset, Turned turned)
{
    for (ScenePoint& v : soup.vertices) {
        ScenePoint p = v * scale;
        if (turned == Turned::Yes) {
            const double c1 = std::cos(0.7);
            const double s1 = std::sin(0.7);
            p = {c1 * p.x - s1 * p.y, s1 * p.x + c1 * p.y, p.z};
            const double c2 = std::cos(1.1);
            const double s2 = std::sin(1.1);
            p = {p.x, c2 * p.y - s2 * p.z, s2 * p.y + c2 * p.z};
        }
        v = p + offset;
    }
    return soup;
}

TriangleSoup joined(TriangleSoup a, const TriangleSoup& b)
{
    const auto first = static_cast<std::uint32_t>(a.vertices.size());
    a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
    for (const auto& [i, j, k] : b.faces) {
        a.faces.push_back({first + i, first + j, first + k});
    }
    return a;
}

std::shared_ptr<const TriangleMesh> meshOf(TriangleSoup soup)
{
    JobMonitor monitor;
    auto mesh = TriangleMesh::build(std::move(soup), monitor);
    if (!mesh) {
        ADD_FAILURE() << mesh.error().message;
        return meshOf(tetrahedron());
    }
    return *mesh;
}

std::vector<NamedMesh> closedMeshes()
{
    const Vec3 far{5e6 + 0.3, -5e6 + 0.7, 1234.5};
    return {
        {"tetrahedron", meshOf(tetrahedron()), 2.0, {}},
        {"cube", meshOf(cube()), 2.0, {}},
        {"turned cube",
         meshOf(placed(cube(), 1.0, {0.1, 0.2, 0.3}, Turned::Yes)),
         2.0,
         {0.1, 0.2, 0.3}},
        {"icosphere", meshOf(icosphere(2)), 1.0, {}},
        {"torus", meshOf(torus(24, 12)), 1.4, {}},
        {"star", meshOf(star()), 2.5, {}},
        {"notched block", meshOf(notchedBlock(0.5)), 2.0, {}},
        {"sharply notched block",
         meshOf(placed(notchedBlock(1e-3), 1.0, {0.3, 0.1, 0.7}, Turned::Yes)),
         2.0,
         {0.3, 0.1, 0.7}},
        {"cube and icosphere",
         meshOf(joined(cube(), placed(icosphere(1), 0.8, {1.9, 0.1, 0.2}))),
         2.5,
         {0.8, 0.0, 0.0}},
        {"far small icosphere", meshOf(placed(icosphere(2), 0.03, far)), 0.03, far},
        {"far small star", meshOf(placed(star(), 0.02, far, Turned::Yes)), 0.05, far},
        {"large torus", meshOf(placed(torus(16, 8), 1e6, {}, Turned::Yes)), 1.4e6, {}},
    };
}

double windingNumber(const TriangleMesh& mesh, const ScenePoint& point)
{
    Real angle = 0;
    const Exact p = exact(point);
    for (std::uint32_t f = 0; f < mesh.faceCount(); ++f) {
        const auto points = mesh.points(f);
        const Exact a = exact(points[0]) - p;
        const Exact b = exact(points[1]) - p;
        const Exact c = exact(points[2]) - p;
        const Real la = std::sqrt(dot(a, a));
        const Real lb = std::sqrt(dot(b, b));
        const Real lc = std::sqrt(dot(c, c));
        const Real volume = dot(a, cross(b, c));
        const Real rest = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
        angle += 2 * std::atan2(volume, rest);
    }
    return static_cast<double>(angle / (4 * std::numbers::pi_v<Real>));
}

double bruteDistance(const std::array<ScenePoint, 3>& triangle, const ScenePoint& point)
{
    const Exact p = exact(point);
    const Exact a = exact(triangle[0]) - p;
    const Exact b = exact(triangle[1]) - p;
    const Exact c = exact(triangle[2]) - p;
    const Exact n = cross(b - a, c - a);
    const bool is_inside =
        dot(cross(a, b), n) >= 0 && dot(cross(b, c), n) >= 0 && dot(cross(c, a), n) >= 0;
    const Real above = dot(a, n);
    return static_cast<double>(std::sqrt(
        is_inside
            ? above * above / dot(n, n)
            : std::min({squaredToSegment(a, b), squaredToSegment(b, c), squaredToSegment(c, a)})));
}

double bruteDistance(const TriangleMesh& mesh, const ScenePoint& point)
{
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t f = 0; f < mesh.faceCount(); ++f) {
        least = std::min(least, bruteDistance(mesh.points(f), point));
    }
    return least;
}

double longestEdge(const TriangleMesh& mesh)
{
    double longest = 0.0;
    for (std::uint32_t f = 0; f < mesh.faceCount(); ++f) {
        const auto [a, b, c] = mesh.points(f);
        longest = std::max({longest, length(b - a), length(c - b), length(a - c)});
    }
    return longest;
}

Vec3 randomDirection(Random& random)
{
    while (true) {
        const Vec3 v{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                     random.uniform(-1.0, 1.0)};
        if (dot(v, v) > 0.01 && dot(v, v) < 1.0) {
            return normalized(v);
        }
    }
}

} // namespace marsview::test
