#include "core/mesh/mesh_check.h"

#include "core/base/parallel.h"
#include "core/mesh/mesh_cast.h"
#include "core/mesh/predicates.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <mutex>
#include <numeric>

namespace marsview {
namespace {

// Faces are distributed to threads, and cancellation is checked, in parts of this many.
constexpr std::size_t kGrain = 4096;

struct HalfEdge {
    std::uint32_t from;
    std::uint32_t to;
    std::uint32_t corner; // opposite

    std::array<std::uint32_t, 2> ends() const noexcept
    {
        return {std::min(from, to), std::max(from, to)};
    }
};

bool isWithinBounds(const ScenePoint& p) noexcept
{
    constexpr double kMax = TriangleMesh::kCoordinateMaxM;
    return std::abs(p.x) <= kMax && std::abs(p.y) <= kMax && std::abs(p.z) <= kMax;
}

bool isDegenerate(const ScenePoint& a, const ScenePoint& b, const ScenePoint& c) noexcept
{
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const Vec3 bc = c - b;
    const double longest = std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)});
    const double area = length(cross(ab, ac));
    // Below the last threshold, products of normals underflow.
    return !(area > 1e-12 * longest) || !(area > 1e-140) || areCollinear(a, b, c);
}

// The two axes with the largest projection of a face.
std::array<int, 2> bestAxes(const Vec3& normal) noexcept
{
    const double x = std::abs(normal.x);
    const double y = std::abs(normal.y);
    const double z = std::abs(normal.z);
    if (z >= x && z >= y) {
        return {0, 1};
    }
    return x >= y ? std::array{1, 2} : std::array{2, 0};
}

double coordinate(const ScenePoint& p, int axis) noexcept
{
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

// Whether the closed segment pq meets the closed triangle. Exact.
class SegmentAndTriangle {
public:
    explicit SegmentAndTriangle(const std::array<ScenePoint, 3>& triangle) noexcept
        : t_(triangle)
        , axes_(bestAxes(cross(triangle[1] - triangle[0], triangle[2] - triangle[0])))
    {}

    bool meet(const ScenePoint& p, const ScenePoint& q) const noexcept
    {
        const int p_side = sideOfPlane(t_[0], t_[1], t_[2], p);
        const int q_side = sideOfPlane(t_[0], t_[1], t_[2], q);
        if (p_side * q_side > 0) {
            return false;
        }
        if (p_side == 0 && q_side == 0) {
            return meetInPlane(p, q);
        }
        const std::array<int, 3> sides{sideOfPlane(p, q, t_[0], t_[1]),
                                       sideOfPlane(p, q, t_[1], t_[2]),
                                       sideOfPlane(p, q, t_[2], t_[0])};
        const auto [least, most] = std::minmax_element(sides.begin(), sides.end());
        return *least >= 0 || *most <= 0;
    }

private:
    int side(const ScenePoint& a, const ScenePoint& b, const ScenePoint& p) const noexcept
    {
        return sideOfLine(coordinate(a, axes_[0]), coordinate(a, axes_[1]), coordinate(b, axes_[0]),
                          coordinate(b, axes_[1]), coordinate(p, axes_[0]),
                          coordinate(p, axes_[1]));
    }
    bool holds(const ScenePoint& p) const noexcept
    {
        const std::array<int, 3> sides{side(t_[0], t_[1], p), side(t_[1], t_[2], p),
                                       side(t_[2], t_[0], p)};
        const auto [least, most] = std::minmax_element(sides.begin(), sides.end());
        return *least >= 0 || *most <= 0;
    }
    bool cross2(const ScenePoint& a,
                const ScenePoint& b,
                const ScenePoint& p,
                const ScenePoint& q) const noexcept
    {
        const int pa = side(p, q, a);
        const int pb = side(p, q, b);
        const int ap = side(a, b, p);
        const int aq = side(a, b, q);
        if (pa == 0 && pb == 0) { // on one line: their extents overlap
            const auto overlap = [&](int axis) {
                const auto [a_low, a_high] =
                    std::minmax({coordinate(a, axis), coordinate(b, axis)});
                const auto [p_low, p_high] =
                    std::minmax({coordinate(p, axis), coordinate(q, axis)});
                return a_low <= p_high && p_low <= a_high;
            };
            return overlap(axes_[0]) && overlap(axes_[1]);
        }
        return pa * pb <= 0 && ap * aq <= 0;
    }
    bool meetInPlane(const ScenePoint& p, const ScenePoint& q) const noexcept
    {
        return holds(p) || holds(q) || cross2(t_[0], t_[1], p, q) || cross2(t_[1], t_[2], p, q) ||
               cross2(t_[2], t_[0], p, q);
    }

    std::array<ScenePoint, 3> t_;
    std::array<int, 2> axes_;
};

class Checker {
public:
    Checker(std::span<const ScenePoint> vertices,
            std::span<const MeshFace> faces,
            JobMonitor& monitor)
        : vertices_(vertices)
        , faces_(faces)
        , monitor_(monitor)
    {}

    std::vector<MeshFault> check(TriangleTree* tree_out)
    {
        checkVertices();
        checkFaces();
        TriangleTree tree(vertices_, faces_, sound_);
        monitor_.report(0.2);
        if (!monitor_.isCanceled()) {
            checkDuplicates();
            checkEdges();
            checkFans();
            monitor_.report(0.4);
        }
        if (!monitor_.isCanceled()) {
            checkGaps(tree);
            monitor_.report(0.5);
        }
        if (!monitor_.isCanceled()) {
            checkIntersections(tree);
        }
        if (tree_out != nullptr) {
            *tree_out = std::move(tree);
        }
        return std::move(faults_);
    }

private:
    void add(MeshFaultKind kind, std::array<std::uint32_t, 2> numbers, const ScenePoint& at)
    {
        if (faults_.empty() || faults_.back().kind != kind) {
            faults_.push_back({kind, 0, {}});
        }
        MeshFault& fault = faults_.back();
        ++fault.count;
        if (fault.first.size() < MeshFault::kFirstMax) {
            fault.first.push_back({numbers, at});
        }
    }

    std::array<ScenePoint, 3> points(std::uint32_t face) const
    {
        const MeshFace& f = faces_[face];
        return {vertices_[f[0]], vertices_[f[1]], vertices_[f[2]]};
    }
    ScenePoint middle(std::uint32_t face) const
    {
        const auto [a, b, c] = points(face);
        return (a + b + c) * (1.0 / 3.0);
    }

    void checkVertices()
    {
        for (std::size_t v = 0; v < vertices_.size(); ++v) {
            if (!isWithinBounds(vertices_[v])) {
                const auto number = static_cast<std::uint32_t>(v);
                add(MeshFaultKind::BadCoordinate, {number, number}, vertices_[v]);
            }
        }
    }

    void checkFaces()
    {
        std::vector<std::uint32_t> degenerate;
        for (std::size_t f = 0; f < faces_.size(); ++f) {
            const MeshFace& face = faces_[f];
            const auto number = static_cast<std::uint32_t>(f);
            const auto missing = std::find_if(face.begin(), face.end(), [this](std::uint32_t v) {
                return v >= vertices_.size();
            });
            if (missing != face.end()) {
                add(MeshFaultKind::MissingVertex, {number, *missing}, {});
                continue;
            }
            const auto [a, b, c] = points(number);
            if (!isWithinBounds(a) || !isWithinBounds(b) || !isWithinBounds(c)) {
                continue;
            }
            if (isDegenerate(a, b, c)) {
                degenerate.push_back(number);
                continue;
            }
            sound_.push_back(number);
        }
        for (const std::uint32_t face : degenerate) {
            add(MeshFaultKind::Degenerate, {face, face}, vertices_[faces_[face][0]]);
        }
    }

    void checkDuplicates()
    {
        struct Sorted {
            MeshFace corners;
            std::uint32_t face;
        };
        std::vector<Sorted> sorted;
        sorted.reserve(sound_.size());
        for (const std::uint32_t face : sound_) {
            sorted.push_back({faces_[face], face});
            std::sort(sorted.back().corners.begin(), sorted.back().corners.end());
        }
        std::sort(sorted.begin(), sorted.end(), [](const Sorted& a, const Sorted& b) {
            return a.corners != b.corners ? a.corners < b.corners : a.face < b.face;
        });
        std::vector<std::array<std::uint32_t, 2>> found;
        std::size_t original = 0;
        for (std::size_t i = 1; i < sorted.size(); ++i) {
            if (sorted[i].corners == sorted[original].corners) {
                found.push_back({sorted[i].face, sorted[original].face});
            } else {
                original = i;
            }
        }
        std::sort(found.begin(), found.end());
        // A duplicate would also make all its edges faulty.
        std::vector<std::uint32_t> copies;
        for (const auto& pair : found) {
            add(MeshFaultKind::Duplicate, pair, middle(pair[0]));
            copies.push_back(pair[0]);
        }
        std::erase_if(sound_, [&copies](std::uint32_t face) {
            return std::binary_search(copies.begin(), copies.end(), face);
        });
        copies_ = std::move(copies);
    }

    void checkEdges()
    {
        half_edges_.reserve(3 * sound_.size());
        for (const std::uint32_t face : sound_) {
            for (std::uint32_t i = 0; i < 3; ++i) {
                half_edges_.push_back(
                    {faces_[face][(i + 1) % 3], faces_[face][(i + 2) % 3], 3 * face + i});
            }
        }
        std::sort(half_edges_.begin(), half_edges_.end(), [](const HalfEdge& a, const HalfEdge& b) {
            const auto a_ends = a.ends();
            const auto b_ends = b.ends();
            return a_ends != b_ends ? a_ends < b_ends : a.corner < b.corner;
        });
        std::vector<std::array<std::uint32_t, 2>> crowded;
        std::vector<std::array<std::uint32_t, 2>> turned;
        is_border_.assign(vertices_.size(), false);
        for (std::size_t i = 0; i < half_edges_.size();) {
            const auto ends = half_edges_[i].ends();
            std::size_t next = i + 1;
            while (next < half_edges_.size() && half_edges_[next].ends() == ends) {
                ++next;
            }
            if (next - i > 2) {
                crowded.push_back(ends);
            } else if (next - i == 2 && half_edges_[i].from == half_edges_[i + 1].from) {
                turned.push_back(ends);
            } else if (next - i == 1) {
                borders_.push_back(half_edges_[i]);
                is_border_[ends[0]] = true;
                is_border_[ends[1]] = true;
            }
            i = next;
        }
        for (const auto& ends : crowded) {
            add(MeshFaultKind::NonManifoldEdge, ends,
                (vertices_[ends[0]] + vertices_[ends[1]]) * 0.5);
        }
        for (const auto& ends : turned) {
            add(MeshFaultKind::TurnedFace, ends, (vertices_[ends[0]] + vertices_[ends[1]]) * 0.5);
        }
        crowded_ = std::move(crowded);
    }

    // The faces of a vertex, joined at shared edges, must form one fan. Vertices of edges with more
    // than two faces have been reported already.
    void checkFans()
    {
        std::vector<std::uint32_t> begins(vertices_.size() + 1, 0);
        for (const std::uint32_t face : sound_) {
            for (const std::uint32_t v : faces_[face]) {
                ++begins[v + 1];
            }
        }
        std::partial_sum(begins.begin(), begins.end(), begins.begin());
        std::vector<std::uint32_t> at_vertex(begins.back());
        std::vector<std::uint32_t> fill(begins.begin(), begins.end() - 1);
        for (const std::uint32_t face : sound_) {
            for (const std::uint32_t v : faces_[face]) {
                at_vertex[fill[v]++] = face;
            }
        }
        std::vector<bool> is_crowded(vertices_.size(), false);
        for (const auto& ends : crowded_) {
            is_crowded[ends[0]] = true;
            is_crowded[ends[1]] = true;
        }
        // Each face at the vertex as the two neighbors it links; links are followed by sorting.
        std::vector<std::array<std::uint32_t, 2>> links; // neighbor, position of the face
        std::vector<std::uint32_t> root;
        const auto find = [&root](std::uint32_t i) {
            while (root[i] != i) {
                root[i] = root[root[i]];
                i = root[i];
            }
            return i;
        };
        for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
            const std::uint32_t count = begins[v + 1] - begins[v];
            if (count < 2 || is_crowded[v]) {
                continue;
            }
            links.clear();
            root.resize(count);
            std::iota(root.begin(), root.end(), 0U);
            for (std::uint32_t i = 0; i < count; ++i) {
                for (const std::uint32_t other : faces_[at_vertex[begins[v] + i]]) {
                    if (other != v) {
                        links.push_back({other, i});
                    }
                }
            }
            std::sort(links.begin(), links.end());
            std::uint32_t fans = count;
            for (std::size_t i = 1; i < links.size(); ++i) {
                if (links[i][0] == links[i - 1][0]) {
                    const std::uint32_t a = find(links[i][1]);
                    const std::uint32_t b = find(links[i - 1][1]);
                    fans -= a != b ? 1 : 0;
                    root[a] = b;
                }
            }
            if (fans > 1) {
                add(MeshFaultKind::BowTie, {v, v}, vertices_[v]);
            }
        }
    }

    void checkGaps(const TriangleTree& tree)
    {
        // The shortest border edge at each vertex determines what counts as near it.
        std::vector<double> shortest(vertices_.size(), std::numeric_limits<double>::infinity());
        std::vector<std::array<bool, 3>> is_border(faces_.size(), std::array<bool, 3>{});
        for (const HalfEdge& edge : borders_) {
            const double edge_length = length(vertices_[edge.to] - vertices_[edge.from]);
            shortest[edge.from] = std::min(shortest[edge.from], edge_length);
            shortest[edge.to] = std::min(shortest[edge.to], edge_length);
            is_border[edge.corner / 3][edge.corner % 3] = true;
        }
        for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
            if (!is_border_[v]) {
                continue;
            }
            const ScenePoint& here = vertices_[v];
            const double near_m = kGapShare * shortest[v];
            const Vec3 reach{near_m, near_m, near_m};
            std::uint32_t other = TriangleMesh::kNone;
            tree.inBox(here - reach, here + reach, [&](std::uint32_t face) {
                const MeshFace& f = faces_[face];
                if (f[0] == v || f[1] == v || f[2] == v) {
                    return;
                }
                for (std::uint32_t i = 0; i < 3; ++i) {
                    const std::uint32_t from = f[(i + 1) % 3];
                    const std::uint32_t to = f[(i + 2) % 3];
                    if (!is_border[face][i]) {
                        continue;
                    }
                    const Vec3 edge = vertices_[to] - vertices_[from];
                    const double share =
                        std::clamp(dot(here - vertices_[from], edge) / dot(edge, edge), 0.0, 1.0);
                    const Vec3 rest = (here - vertices_[from]) - edge * share;
                    if (dot(rest, rest) <= near_m * near_m) {
                        gaps_.push_back({v, face});
                        other = std::min({other, share < 0.5 ? from : to});
                    }
                }
            });
            if (other != TriangleMesh::kNone) {
                add(MeshFaultKind::Gap, {v, other}, here);
            }
        }
        std::sort(gaps_.begin(), gaps_.end());
    }

    bool isGap(std::uint32_t face, std::uint32_t other) const
    {
        const auto meets = [this](std::uint32_t a, std::uint32_t b) {
            return std::any_of(faces_[a].begin(), faces_[a].end(), [this, b](std::uint32_t v) {
                if (!is_border_[v]) {
                    return false;
                }
                // Through its edge, or through a corner of it that is at the border itself.
                const auto begin = std::lower_bound(gaps_.begin(), gaps_.end(), std::array{v, 0U});
                for (auto gap = begin; gap != gaps_.end() && (*gap)[0] == v; ++gap) {
                    if ((*gap)[1] == b) {
                        return true;
                    }
                    for (const std::uint32_t corner : faces_[(*gap)[1]]) {
                        const Vec3 between = vertices_[corner] - vertices_[v];
                        const MeshFace& f = faces_[b];
                        if (std::find(f.begin(), f.end(), corner) != f.end() &&
                            is_border_[corner] && dot(between, between) <= 1e-8 * edgeSquared(b)) {
                            return true;
                        }
                    }
                }
                return false;
            });
        };
        return !gaps_.empty() && (meets(face, other) || meets(other, face));
    }
    double edgeSquared(std::uint32_t face) const
    {
        const auto [a, b, c] = points(face);
        return std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
    }

    bool intersect(std::uint32_t one, std::uint32_t other) const
    {
        const MeshFace& f = faces_[one];
        const MeshFace& g = faces_[other];
        // Corners that are shared, as positions in each.
        std::array<std::size_t, 3> in_f{};
        std::array<std::size_t, 3> in_g{};
        std::size_t shared = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                if (f[i] == g[j]) {
                    in_f[shared] = i;
                    in_g[shared] = j;
                    ++shared;
                }
            }
        }
        const auto p = points(one);
        const auto q = points(other);
        const SegmentAndTriangle with_p(p);
        const SegmentAndTriangle with_q(q);
        switch (shared) {
        case 0:
            for (std::size_t i = 0; i < 3; ++i) {
                if (with_p.meet(q[i], q[(i + 1) % 3]) || with_q.meet(p[i], p[(i + 1) % 3])) {
                    return true;
                }
            }
            return false;
        case 1: {
            // Anything else in common extends from the corner to an opposite edge.
            const std::size_t i = in_f[0];
            const std::size_t j = in_g[0];
            return with_q.meet(p[(i + 1) % 3], p[(i + 2) % 3]) ||
                   with_p.meet(q[(j + 1) % 3], q[(j + 2) % 3]);
        }
        case 2: {
            // Folded onto each other.
            const ScenePoint& a = p[in_f[0]];
            const ScenePoint& b = p[in_f[1]];
            const ScenePoint& c = p[3 - in_f[0] - in_f[1]];
            const ScenePoint& d = q[3 - in_g[0] - in_g[1]];
            if (sideOfPlane(a, b, c, d) != 0) {
                return false;
            }
            const auto axes = bestAxes(cross(b - a, c - a));
            const auto side = [&](const ScenePoint& x) {
                return sideOfLine(coordinate(a, axes[0]), coordinate(a, axes[1]),
                                  coordinate(b, axes[0]), coordinate(b, axes[1]),
                                  coordinate(x, axes[0]), coordinate(x, axes[1]));
            };
            return side(c) * side(d) > 0;
        }
        default:
            return false; // duplicates have been reported
        }
    }

    void checkIntersections(const TriangleTree& tree)
    {
        std::vector<std::array<std::uint32_t, 2>> found;
        std::mutex mutex;
        std::size_t done = 0;
        parallelRanges(sound_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
            if (monitor_.isCanceled()) {
                return;
            }
            std::vector<std::array<std::uint32_t, 2>> mine;
            for (std::size_t i = begin; i < end; ++i) {
                const std::uint32_t face = sound_[i];
                const auto [a, b, c] = points(face);
                const ScenePoint low{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}),
                                     std::min({a.z, b.z, c.z})};
                const ScenePoint high{std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}),
                                      std::max({a.z, b.z, c.z})};
                tree.inBox(low, high, [&](std::uint32_t other) {
                    if (face < other && !isCopy(other) && intersect(face, other) &&
                        !isGap(face, other)) {
                        mine.push_back({face, other});
                    }
                });
            }
            const std::lock_guard lock(mutex);
            found.insert(found.end(), mine.begin(), mine.end());
            done += end - begin;
            monitor_.report(0.5 +
                            0.5 * static_cast<double>(done) / static_cast<double>(sound_.size()));
        });
        std::sort(found.begin(), found.end());
        for (const auto& pair : found) {
            add(MeshFaultKind::Intersection, pair, (middle(pair[0]) + middle(pair[1])) * 0.5);
        }
    }

    bool isCopy(std::uint32_t face) const
    {
        return std::binary_search(copies_.begin(), copies_.end(), face);
    }

    static constexpr double kGapShare = 1e-4; // of the shortest border edge at the vertex

    std::span<const ScenePoint> vertices_;
    std::span<const MeshFace> faces_;
    JobMonitor& monitor_;
    std::vector<MeshFault> faults_;
    std::vector<std::uint32_t> sound_;  // faces that take part
    std::vector<std::uint32_t> copies_; // duplicates of earlier faces
    std::vector<HalfEdge> half_edges_;
    std::vector<HalfEdge> borders_;
    std::vector<std::array<std::uint32_t, 2>> crowded_;
    std::vector<bool> is_border_;
    std::vector<std::array<std::uint32_t, 2>> gaps_; // vertex, face with a border edge there
};

struct Words {
    const char* one;
    const char* many;
    const char* place; // {0} and {1}: the numbers, {2}: the coordinates
};

const Words& wordsFor(MeshFaultKind kind)
{
    static constexpr std::array<Words, 9> kWords{{
        {"coordinate that is not a number within 1e12 m",
         "coordinates that are not numbers within 1e12 m", "vertex {0}, {2}"},
        {"face with a vertex that does not exist", "faces with vertices that do not exist",
         "face {0}, vertex {1}"},
        {"triangle without area", "triangles without area", "face {0} at {2}"},
        {"duplicated triangle", "duplicated triangles", "face {0} is face {1}, at {2}"},
        {"edge of more than two faces", "edges of more than two faces",
         "vertices {0} and {1}, at {2}"},
        {"edge between faces turned opposite ways", "edges between faces turned opposite ways",
         "vertices {0} and {1}, at {2}"},
        {"vertex where faces meet in a point only", "vertices where faces meet in a point only",
         "vertex {0} at {2}"},
        {"gap", "gaps", "vertex {0} is on the border at vertex {1} but not part of it, at {2}"},
        {"pair of intersecting triangles", "pairs of intersecting triangles",
         "faces {0} and {1} near {2}"},
    }};
    return kWords[static_cast<std::size_t>(kind)];
}

} // namespace

std::vector<MeshFault> findMeshFaults(std::span<const ScenePoint> vertices,
                                      std::span<const MeshFace> faces,
                                      JobMonitor& monitor,
                                      TriangleTree* tree)
{
    return Checker(vertices, faces, monitor).check(tree);
}

std::string describe(std::span<const MeshFault> faults)
{
    std::string text;
    for (const MeshFault& fault : faults) {
        const Words& words = wordsFor(fault.kind);
        text += fmt::format("{}{} {} (", text.empty() ? "" : ", ", fault.count,
                            fault.count == 1 ? words.one : words.many);
        for (std::size_t i = 0; i < fault.first.size(); ++i) {
            const MeshFaultPlace& place = fault.first[i];
            text += i == 0 ? "" : "; ";
            text += fmt::format(
                fmt::runtime(words.place), std::uint64_t{place.numbers[0]} + 1,
                std::uint64_t{place.numbers[1]} + 1,
                fmt::format("{:.9g}, {:.9g}, {:.9g}", place.at.x, place.at.y, place.at.z));
        }
        text += fault.count > fault.first.size() ? "; …)" : ")";
    }
    return text;
}

} // namespace marsview
