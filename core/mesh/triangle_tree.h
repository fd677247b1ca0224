// A hierarchy of boxes around triangles, for finding the triangles near a segment, a point or a box
// without visiting the rest.
#pragma once

#include "core/geo/frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace marsview {

/// Three vertices, counter-clockwise seen from free space.
using MeshFace = std::array<std::uint32_t, 3>;

/// Binary, split by the surface-area heuristic over bins (I. Wald, "On fast construction of
/// SAH-based bounding volume hierarchies", 2007). Boxes are floats, rounded outward, relative to
/// the middle of all: 32 bytes per node, about 25 bytes per face. Immutable, any thread. Visits
/// allocate nothing and are bounded. They may include a face whose triangle is not hit, but never
/// omit one that is.
class TriangleTree {
public:
    /// A box, at first empty.
    struct Bounds {
        ScenePoint low{std::numeric_limits<double>::infinity(),
                       std::numeric_limits<double>::infinity(),
                       std::numeric_limits<double>::infinity()};
        ScenePoint high = -low;

        void add(const ScenePoint& point) noexcept
        {
            low = {std::min(low.x, point.x), std::min(low.y, point.y), std::min(low.z, point.z)};
            high = {std::max(high.x, point.x), std::max(high.y, point.y),
                    std::max(high.z, point.z)};
        }
    };

    TriangleTree() = default;
    /// A tree over the faces `which`, with valid indices and finite coordinates.
    TriangleTree(std::span<const ScenePoint> vertices,
                 std::span<const MeshFace> faces,
                 std::vector<std::uint32_t> which);
    /// A tree over the boxes of small groups of triangles: where faces are named below, it has the
    /// indices of the boxes, none of which is empty.
    explicit TriangleTree(std::span<const Bounds> groups);

    bool isEmpty() const noexcept { return nodes_.empty(); }
    std::size_t byteCount() const noexcept
    {
        return nodes_.size() * sizeof(Node) + order_.size() * sizeof(std::uint32_t);
    }
    /// The middle of all boxes, the origin for `alongSegment`.
    const ScenePoint& middle() const noexcept { return middle_; }
    /// The largest distance of a box from the middle along an axis.
    double reach() const noexcept { return reach_; }

    /// Calls visit(face, t_max) with faces whose boxes, grown by `slack`, the segment middle() +
    /// from + t · along hits for t in [0, t_max], approximately in the order of the hits; `t_max`
    /// begins as 1 and visit may reduce it.
    template <typename F>
    void alongSegment(const Vec3& from, const Vec3& along, double slack, F&& visit) const noexcept;
    /// Calls visit(face, limit) with faces whose boxes are within sqrt(limit) of `point`,
    /// approximately nearest first; `limit` begins as infinity and visit may reduce it.
    template <typename F>
    void nearestFirst(const ScenePoint& point, F&& visit) const noexcept;
    /// Calls visit(face) with each face whose box intersects the box from `low` to `high`.
    template <typename F>
    void inBox(const ScenePoint& low, const ScenePoint& high, F&& visit) const noexcept;

private:
    struct Node {
        std::array<float, 3> low;
        std::array<float, 3> high;
        std::uint32_t first; // of its faces in order_, or its second child; the first one follows
        std::uint32_t count; // of its faces; 0: it has children
    };
    static_assert(sizeof(Node) == 32);
    // The first levels are split at the lowest cost, those below in halves, so 32 more are enough.
    static constexpr std::size_t kLevelsOfChoice = 48;
    static constexpr std::size_t kLevelsMax = kLevelsOfChoice + 33;
    static constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

    class Builder;

    struct Entry {
        std::uint32_t node;
        double at;
    };

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;
    ScenePoint middle_;
    double reach_ = 0.0;
};

template <typename F>
void TriangleTree::alongSegment(const Vec3& from,
                                const Vec3& along,
                                double slack,
                                F&& visit) const noexcept
{
    if (nodes_.empty()) {
        return;
    }
    const std::array<double, 3> origin{from.x, from.y, from.z};
    std::array<double, 3> inverse{along.x, along.y, along.z};
    double farthest = reach_;
    for (std::size_t i = 0; i < 3; ++i) {
        // Parallel to an axis: a slope too small to leave a box.
        constexpr double kLeast = 1e-280;
        inverse[i] = std::abs(inverse[i]) < kLeast ? 1.0 / kLeast : 1.0 / inverse[i];
        farthest = std::max(farthest, std::abs(origin[i]));
    }
    const double grown = slack + 8.0 * kEpsilon * farthest;
    std::array<double, 3> begin_shift{};
    std::array<double, 3> end_shift{};
    std::array<bool, 3> is_forward{};
    for (std::size_t i = 0; i < 3; ++i) {
        is_forward[i] = inverse[i] > 0.0;
        begin_shift[i] = origin[i] + (is_forward[i] ? grown : -grown);
        end_shift[i] = origin[i] + (is_forward[i] ? -grown : grown);
    }
    double t_max = 1.0;
    // Where the segment enters the box; infinite if it does not.
    const auto enters = [&](const Node& node) {
        double begin = 0.0;
        double end = t_max;
        for (std::size_t i = 0; i < 3; ++i) {
            const double near = static_cast<double>(is_forward[i] ? node.low[i] : node.high[i]);
            const double far = static_cast<double>(is_forward[i] ? node.high[i] : node.low[i]);
            begin = std::max(begin, (near - begin_shift[i]) * inverse[i]);
            end = std::min(end, (far - end_shift[i]) * inverse[i]);
        }
        return begin <= end ? begin : std::numeric_limits<double>::infinity();
    };
    std::array<Entry, kLevelsMax + 1> stack;
    std::size_t size = 0;
    const double root = enters(nodes_[0]);
    if (root <= t_max) {
        stack[size++] = {0, root};
    }
    while (size > 0) {
        const Entry entry = stack[--size];
        if (entry.at > t_max) {
            continue;
        }
        std::uint32_t at = entry.node;
        while (nodes_[at].count == 0) {
            const std::uint32_t first = at + 1;
            const std::uint32_t second = nodes_[at].first;
            const double enter_first = enters(nodes_[first]);
            const double enter_second = enters(nodes_[second]);
            const bool is_first_nearer = enter_first <= enter_second;
            const double nearer = is_first_nearer ? enter_first : enter_second;
            const double farther = is_first_nearer ? enter_second : enter_first;
            if (nearer > t_max) {
                break; // at an inner node, which has no faces of its own
            }
            if (farther <= t_max) {
                stack[size++] = {is_first_nearer ? second : first, farther};
            }
            at = is_first_nearer ? first : second;
        }
        const Node& leaf = nodes_[at];
        for (std::uint32_t i = 0; i < leaf.count; ++i) {
            visit(order_[leaf.first + i], t_max);
        }
    }
}

template <typename F>
void TriangleTree::nearestFirst(const ScenePoint& point, F&& visit) const noexcept
{
    if (nodes_.empty()) {
        return;
    }
    const Vec3 from = point - middle_;
    const std::array<double, 3> origin{from.x, from.y, from.z};
    const double grown =
        8.0 * kEpsilon * std::max({reach_, std::abs(from.x), std::abs(from.y), std::abs(from.z)});
    const auto distance_squared = [&](const Node& node) {
        double sum = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double beyond =
                std::max({static_cast<double>(node.low[i]) - origin[i] - grown,
                          origin[i] - static_cast<double>(node.high[i]) - grown, 0.0});
            sum += beyond * beyond;
        }
        return sum;
    };
    double limit = std::numeric_limits<double>::infinity();
    std::array<Entry, kLevelsMax + 1> stack;
    std::size_t size = 0;
    stack[size++] = {0, 0.0};
    while (size > 0) {
        const Entry entry = stack[--size];
        if (entry.at > limit) {
            continue;
        }
        std::uint32_t at = entry.node;
        while (nodes_[at].count == 0) {
            const std::uint32_t first = at + 1;
            const std::uint32_t second = nodes_[at].first;
            const double to_first = distance_squared(nodes_[first]);
            const double to_second = distance_squared(nodes_[second]);
            const bool is_first_nearer = to_first <= to_second;
            if (std::min(to_first, to_second) > limit) {
                break; // at an inner node, which has no faces of its own
            }
            if (std::max(to_first, to_second) <= limit) {
                stack[size++] = {is_first_nearer ? second : first, std::max(to_first, to_second)};
            }
            at = is_first_nearer ? first : second;
        }
        const Node& leaf = nodes_[at];
        for (std::uint32_t i = 0; i < leaf.count; ++i) {
            visit(order_[leaf.first + i], limit);
        }
    }
}

template <typename F>
void TriangleTree::inBox(const ScenePoint& low, const ScenePoint& high, F&& visit) const noexcept
{
    if (nodes_.empty()) {
        return;
    }
    const Vec3 from = low - middle_;
    const Vec3 to = high - middle_;
    const auto meets = [&](const Node& node) {
        const auto within = [&](std::size_t i, double least, double most) {
            const double grown = 4.0 * kEpsilon * (std::abs(least) + std::abs(most));
            return static_cast<double>(node.low[i]) <= most + grown &&
                   static_cast<double>(node.high[i]) >= least - grown;
        };
        return within(0, from.x, to.x) && within(1, from.y, to.y) && within(2, from.z, to.z);
    };
    std::array<std::uint32_t, kLevelsMax + 1> stack;
    std::size_t size = 0;
    if (meets(nodes_[0])) {
        stack[size++] = 0;
    }
    while (size > 0) {
        const std::uint32_t at = stack[--size];
        const Node& node = nodes_[at];
        for (std::uint32_t i = 0; i < node.count; ++i) {
            visit(order_[node.first + i]);
        }
        if (node.count == 0) {
            if (meets(nodes_[node.first])) {
                stack[size++] = node.first;
            }
            if (meets(nodes_[at + 1])) {
                stack[size++] = at + 1;
            }
        }
    }
}

} // namespace marsview
