#include "core/mesh/triangle_tree.h"

#include "core/base/check.h"

#include <numeric>
#include <utility>

namespace marsview {
namespace {

using Corner = std::array<double, 3>;

struct Box {
    Corner low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
               std::numeric_limits<double>::infinity()};
    Corner high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                -std::numeric_limits<double>::infinity()};

    void add(const Corner& point) noexcept
    {
        for (std::size_t i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], point[i]);
            high[i] = std::max(high[i], point[i]);
        }
    }
    void merge(const Box& box) noexcept
    {
        add(box.low);
        add(box.high);
    }
    double halfArea() const noexcept
    {
        const double x = high[0] - low[0];
        const double y = high[1] - low[1];
        const double z = high[2] - low[2];
        return x < 0.0 ? 0.0 : x * y + y * z + z * x;
    }
};

struct Item {
    Box box;
    std::uint32_t face;

    double center(std::size_t axis) const noexcept
    {
        return 0.5 * box.low[axis] + 0.5 * box.high[axis];
    }
};

constexpr std::size_t kBins = 16;
constexpr std::size_t kLeafMax = 8;
constexpr double kVisitCost = 1.2; // of visiting a node's children, in faces

} // namespace

class TriangleTree::Builder {
public:
    Builder(TriangleTree& tree, std::vector<Item>& items)
        : tree_(tree)
        , items_(items)
    {}

    void build()
    {
        struct Range {
            std::size_t begin;
            std::size_t end;
            std::size_t depth;
            std::uint32_t parent; // whose second child this is
        };
        constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
        std::vector<Range> pending{{0, items_.size(), 0, kNone}};
        while (!pending.empty()) {
            const Range range = pending.back();
            pending.pop_back();
            const auto index = static_cast<std::uint32_t>(tree_.nodes_.size());
            if (range.parent != kNone) {
                tree_.nodes_[range.parent].first = index;
            }
            MARSVIEW_CHECK(range.depth < kLevelsMax);
            Box box;
            Box centers;
            for (std::size_t i = range.begin; i < range.end; ++i) {
                box.merge(items_[i].box);
                centers.add({items_[i].center(0), items_[i].center(1), items_[i].center(2)});
            }
            Node node = nodeOf(box);
            const std::size_t middle = split(range.begin, range.end, range.depth, box, centers);
            if (middle == range.begin) {
                node.first = static_cast<std::uint32_t>(tree_.order_.size());
                node.count = static_cast<std::uint32_t>(range.end - range.begin);
                for (std::size_t i = range.begin; i < range.end; ++i) {
                    tree_.order_.push_back(items_[i].face);
                }
                tree_.nodes_.push_back(node);
                continue;
            }
            tree_.nodes_.push_back(node);
            pending.push_back({middle, range.end, range.depth + 1, index});
            pending.push_back({range.begin, middle, range.depth + 1, kNone});
        }
    }

private:
    static Node nodeOf(const Box& box)
    {
        Node node{};
        for (std::size_t i = 0; i < 3; ++i) {
            constexpr float kInfinity = std::numeric_limits<float>::infinity();
            node.low[i] = std::nextafter(static_cast<float>(box.low[i]), -kInfinity);
            node.high[i] = std::nextafter(static_cast<float>(box.high[i]), kInfinity);
        }
        return node;
    }

    // Puts the items of the first child before those of the second. Returns `begin` if a leaf is
    // better.
    std::size_t
    split(std::size_t begin, std::size_t end, std::size_t depth, const Box& box, const Box& centers)
    {
        const std::size_t count = end - begin;
        if (count <= 2) {
            return begin;
        }
        const auto first = items_.begin() + static_cast<std::ptrdiff_t>(begin);
        const auto last = items_.begin() + static_cast<std::ptrdiff_t>(end);
        std::size_t widest = 0;
        for (std::size_t axis = 1; axis < 3; ++axis) {
            if (centers.high[axis] - centers.low[axis] >
                centers.high[widest] - centers.low[widest]) {
                widest = axis;
            }
        }
        const auto halves = [&] {
            const auto middle = first + static_cast<std::ptrdiff_t>(count / 2);
            std::nth_element(first, middle, last, [widest](const Item& a, const Item& b) {
                return a.center(widest) < b.center(widest);
            });
            return begin + count / 2;
        };
        if (depth >= kLevelsOfChoice) {
            return halves();
        }
        double least = static_cast<double>(count) * box.halfArea();
        const bool may_be_leaf = count <= kLeafMax;
        if (!may_be_leaf) {
            least = std::numeric_limits<double>::infinity();
        }
        std::size_t best_axis = 3;
        std::size_t best_bin = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!(centers.high[axis] > centers.low[axis])) {
                continue;
            }
            std::array<Box, kBins> boxes{};
            std::array<std::size_t, kBins> counts{};
            for (auto item = first; item != last; ++item) {
                const std::size_t bin = binOf(*item, axis, centers);
                boxes[bin].merge(item->box);
                ++counts[bin];
            }
            std::array<double, kBins> costs_after{};
            Box after;
            std::size_t count_after = 0;
            for (std::size_t bin = kBins - 1; bin > 0; --bin) {
                after.merge(boxes[bin]);
                count_after += counts[bin];
                costs_after[bin] = static_cast<double>(count_after) * after.halfArea();
            }
            Box before;
            std::size_t count_before = 0;
            for (std::size_t bin = 1; bin < kBins; ++bin) {
                before.merge(boxes[bin - 1]);
                count_before += counts[bin - 1];
                const double cost = kVisitCost * box.halfArea() +
                                    static_cast<double>(count_before) * before.halfArea() +
                                    costs_after[bin];
                if (count_before > 0 && count_before < count && cost < least) {
                    least = cost;
                    best_axis = axis;
                    best_bin = bin;
                }
            }
        }
        if (best_axis == 3) {
            return may_be_leaf ? begin : halves();
        }
        const auto middle = std::partition(first, last, [&](const Item& item) {
            return binOf(item, best_axis, centers) < best_bin;
        });
        return begin + static_cast<std::size_t>(middle - first);
    }

    static std::size_t binOf(const Item& item, std::size_t axis, const Box& centers) noexcept
    {
        const double share =
            (item.center(axis) - centers.low[axis]) / (centers.high[axis] - centers.low[axis]);
        return std::min(static_cast<std::size_t>(share * static_cast<double>(kBins)), kBins - 1);
    }

    TriangleTree& tree_;
    std::vector<Item>& items_;
};

TriangleTree::TriangleTree(std::span<const ScenePoint> vertices,
                           std::span<const MeshFace> faces,
                           std::vector<std::uint32_t> which)
{
    if (which.empty()) {
        return;
    }
    Box all;
    for (const std::uint32_t face : which) {
        for (const std::uint32_t corner : faces[face]) {
            all.add({vertices[corner].x, vertices[corner].y, vertices[corner].z});
        }
    }
    middle_ = {0.5 * all.low[0] + 0.5 * all.high[0], 0.5 * all.low[1] + 0.5 * all.high[1],
               0.5 * all.low[2] + 0.5 * all.high[2]};
    std::vector<Item> items(which.size());
    for (std::size_t i = 0; i < which.size(); ++i) {
        items[i].face = which[i];
        for (const std::uint32_t corner : faces[which[i]]) {
            const Vec3 at = vertices[corner] - middle_;
            items[i].box.add({at.x, at.y, at.z});
            reach_ = std::max({reach_, std::abs(at.x), std::abs(at.y), std::abs(at.z)});
        }
    }
    which = {};
    nodes_.reserve(items.size());
    order_.reserve(items.size());
    Builder(*this, items).build();
    nodes_.shrink_to_fit();
}

TriangleTree::TriangleTree(std::span<const Bounds> groups)
{
    if (groups.empty()) {
        return;
    }
    Bounds all;
    for (const Bounds& group : groups) {
        all.add(group.low);
        all.add(group.high);
    }
    middle_ = all.low * 0.5 + all.high * 0.5;
    std::vector<Item> items(groups.size());
    for (std::size_t i = 0; i < groups.size(); ++i) {
        items[i].face = static_cast<std::uint32_t>(i);
        for (const ScenePoint& corner : {groups[i].low, groups[i].high}) {
            const Vec3 at = corner - middle_;
            items[i].box.add({at.x, at.y, at.z});
            reach_ = std::max({reach_, std::abs(at.x), std::abs(at.y), std::abs(at.z)});
        }
    }
    nodes_.reserve(items.size());
    order_.reserve(items.size());
    Builder(*this, items).build();
    nodes_.shrink_to_fit();
}

} // namespace marsview
