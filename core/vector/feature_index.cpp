#include "core/vector/feature_index.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace marsview {
namespace {

constexpr std::size_t kFanOut = 8;
constexpr std::size_t kSegmentsPerStrip = 8; // of the last strips, which are not halved
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double distanceToSegment(const PlanePoint& p, const PlanePoint& a, const PlanePoint& b)
{
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double square = dx * dx + dy * dy;
    const double share =
        square > 0.0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0) : 0.0;
    return std::hypot(p.x - (a.x + share * dx), p.y - (a.y + share * dy));
}

// The bits of a number with a gap after each.
std::uint64_t spread(std::uint64_t bits)
{
    bits &= 0xFFFFFFFFU;
    bits = (bits | (bits << 16)) & 0x0000FFFF0000FFFFU;
    bits = (bits | (bits << 8)) & 0x00FF00FF00FF00FFU;
    bits = (bits | (bits << 4)) & 0x0F0F0F0F0F0F0F0FU;
    bits = (bits | (bits << 2)) & 0x3333333333333333U;
    bits = (bits | (bits << 1)) & 0x5555555555555555U;
    return bits;
}

// Along the Z-order curve through a square of 2^32 cells a side.
class ZOrder {
public:
    explicit ZOrder(const PlaneBox& box)
        : box_(box)
        , side_(std::max({box.max_x - box.min_x, box.max_y - box.min_y, 1e-300}))
    {}
    std::uint64_t operator()(const PlaneBox& box) const
    {
        const auto cell = [this](double from_edge) {
            constexpr double kCells = 4294967295.0;
            return static_cast<std::uint64_t>(std::clamp(from_edge / side_, 0.0, 1.0) * kCells);
        };
        return spread(cell(0.5 * (box.min_x + box.max_x) - box_.min_x)) |
               (spread(cell(0.5 * (box.min_y + box.max_y) - box_.min_y)) << 1);
    }

private:
    PlaneBox box_;
    double side_;
};

bool isSmall(const PlaneBox& box, double size)
{
    return box.max_x - box.min_x <= size && box.max_y - box.min_y <= size;
}

} // namespace

void PlaneBox::include(const PlanePoint& point) noexcept
{
    include(PlaneBox{point.x, point.y, point.x, point.y});
}

void PlaneBox::include(const PlaneBox& box) noexcept
{
    min_x = std::min(min_x, box.min_x);
    min_y = std::min(min_y, box.min_y);
    max_x = std::max(max_x, box.max_x);
    max_y = std::max(max_y, box.max_y);
}

double PlaneBox::distance(const PlanePoint& point) const noexcept
{
    return std::hypot(std::max({min_x - point.x, point.x - max_x, 0.0}),
                      std::max({min_y - point.y, point.y - max_y, 0.0}));
}

void PlaneFeatures::addDot(std::uint32_t feature, const PlanePoint& point)
{
    add(feature, PlaneShape::Dot, std::span(&point, 1));
}

void PlaneFeatures::add(std::uint32_t feature,
                        PlaneShape shape,
                        std::span<const PlanePoint> path,
                        const std::vector<bool>& is_course_of_path)
{
    const std::size_t begin = points.size();
    if (std::find(is_course_of_path.begin(), is_course_of_path.end(), true) !=
        is_course_of_path.end()) {
        is_course.resize(begin);
        is_course.insert(is_course.end(), is_course_of_path.begin(), is_course_of_path.end());
    }
    points.insert(points.end(), path.begin(), path.end());
    parts.push_back({.feature = feature, .shape = shape, .begin = begin, .end = points.size()});
}

FeatureIndex::FeatureIndex(PlaneFeatures features)
    : features_(std::move(features))
    , order_(features_.parts.size())
    , roots_(features_.parts.size())
{
    for (std::size_t part = 0; part < roots_.size(); ++part) {
        const PlaneFeatures::Part& of = features_.parts[part];
        if (of.shape != PlaneShape::Dot) {
            roots_[part] = addStrip(of.begin, of.end - 1);
        }
    }
    std::iota(order_.begin(), order_.end(), 0U);
    PlaneBox all;
    for (std::size_t item = 0; item < order_.size(); ++item) {
        all.include(boxOfItem(item));
    }
    const ZOrder code(all);
    std::vector<std::pair<std::uint64_t, std::uint32_t>> coded(order_.size());
    for (std::size_t item = 0; item < order_.size(); ++item) {
        coded[item] = {code(boxOfItem(item)), static_cast<std::uint32_t>(item)};
    }
    std::sort(coded.begin(), coded.end());
    std::transform(coded.begin(), coded.end(), order_.begin(),
                   [](const auto& entry) { return entry.second; });
    for (std::size_t below = order_.size(); below > 1;) {
        const std::size_t level = boxes_.size();
        std::vector<PlaneBox> boxes((below + kFanOut - 1) / kFanOut);
        for (std::size_t child = 0; child < below; ++child) {
            boxes[child / kFanOut].include(level == 0 ? boxOfItem(child)
                                                      : boxes_[level - 1][child]);
        }
        below = boxes.size();
        boxes_.push_back(std::move(boxes));
    }
}

std::size_t FeatureIndex::addStrip(std::size_t first, std::size_t last)
{
    const std::size_t index = strips_.size();
    strips_.emplace_back();
    Strip strip;
    const auto& points = features_.points;
    for (std::size_t i = first; i <= last; ++i) {
        strip.box.include(points[i]);
        strip.deviation =
            std::max(strip.deviation, distanceToSegment(points[i], points[first], points[last]));
    }
    if (last - first > kSegmentsPerStrip) {
        const std::size_t middle = first + (last - first) / 2;
        addStrip(first, middle);
        strip.right = addStrip(middle, last);
    }
    strips_[index] = strip;
    return index;
}

PlaneBox FeatureIndex::boxOfItem(std::size_t item) const
{
    const PlaneFeatures::Part& part = features_.parts[order_[item]];
    if (part.shape != PlaneShape::Dot) {
        return strips_[roots_[order_[item]]].box;
    }
    PlaneBox box;
    box.include(features_.points[part.begin]);
    return box;
}

std::pair<std::size_t, std::size_t> FeatureIndex::nodesBelow(std::size_t level,
                                                             std::size_t index) const
{
    const std::size_t below_count = level == 1 ? order_.size() : boxes_[level - 2].size();
    return {index * kFanOut, std::min((index + 1) * kFanOut, below_count)};
}

// Level 0: items. The nodes of level n + 1 are those of boxes_[n].
PlaneBox FeatureIndex::boxOfNode(std::size_t level, std::size_t index) const
{
    return level == 0 ? boxOfItem(index) : boxes_[level - 1][index];
}

class FeatureIndex::Selector {
public:
    Selector(const FeatureIndex& index,
             const Resolution& resolution,
             std::size_t points_max,
             double coarsening)
        : index_(index)
        , resolution_(resolution)
        , points_max_(points_max)
    {
        selection_.coarsening = coarsening;
    }

    // False if there are too many points.
    bool run()
    {
        if (!index_.order_.empty()) {
            visit(index_.boxes_.size(), 0);
        }
        return selection_.points.size() <= points_max_;
    }
    Selection take() { return std::move(selection_); }

private:
    double resolutionIn(const PlaneBox& box) const
    {
        return resolution_(box) * selection_.coarsening;
    }

    void visit(std::size_t level, std::size_t node)
    {
        if (selection_.points.size() > points_max_) {
            return;
        }
        const PlaneBox box = index_.boxOfNode(level, node);
        const double resolution = resolutionIn(box);
        if (resolution == kInfinity) {
            return;
        }
        if (level == 0 || isSmall(box, resolution)) {
            std::size_t item = node;
            for (std::size_t below = level; below > 0; --below) {
                item *= kFanOut; // the first of the node
            }
            addItem(index_.order_[item]);
            return;
        }
        const auto [begin, end] = index_.nodesBelow(level, node);
        for (std::size_t child = begin; child < end; ++child) {
            visit(level - 1, child);
        }
    }

    void addItem(std::uint32_t part)
    {
        const PlaneFeatures::Part& of = index_.features_.parts[part];
        piece_ = {.feature = of.feature, .shape = of.shape, .begin = 0, .end = 0, .part = part};
        if (of.shape == PlaneShape::Dot) {
            selection_.points.push_back(index_.features_.points[of.begin]);
            piece_.begin = selection_.points.size() - 1;
            piece_.end = selection_.points.size();
            selection_.pieces.push_back(piece_);
            return;
        }
        is_open_ = false;
        addStrip(index_.roots_[part], of.begin, of.end - 1);
        endPiece();
    }

    void addStrip(std::size_t strip, std::size_t first, std::size_t last)
    {
        const Strip& of = index_.strips_[strip];
        const double resolution = resolutionIn(of.box);
        if (resolution == kInfinity || selection_.points.size() > points_max_) {
            endPiece();
        } else if (of.deviation <= resolution) {
            addVertex(first);
            addVertex(last);
        } else if (of.right == 0) {
            for (std::size_t i = first; i <= last; ++i) {
                addVertex(i);
            }
        } else {
            const std::size_t middle = first + (last - first) / 2;
            addStrip(strip + 1, first, middle);
            addStrip(of.right, middle, last);
        }
    }

    void addVertex(std::size_t vertex)
    {
        if (!is_open_) {
            is_open_ = true;
            piece_.begin = selection_.points.size();
        } else if (vertex == last_vertex_) {
            return; // shared with the strip before
        }
        last_vertex_ = vertex;
        selection_.points.push_back(index_.features_.points[vertex]);
    }

    void endPiece()
    {
        if (std::exchange(is_open_, false)) {
            piece_.end = selection_.points.size();
            selection_.pieces.push_back(piece_);
        }
    }

    const FeatureIndex& index_;
    const Resolution& resolution_;
    std::size_t points_max_;
    Selection selection_;
    Selection::Piece piece_;
    bool is_open_ = false;
    std::size_t last_vertex_ = 0;
};

// The finest of the steps that fits. One feature remains at the coarsest.
FeatureIndex::Selection FeatureIndex::select(const Resolution& resolution,
                                             std::size_t points_max,
                                             double likely_coarsening) const
{
    constexpr double kStep = 1.5;
    constexpr int kSteps = 69; // to 1e12
    const auto selected = [&](int step) -> std::optional<Selection> {
        Selector selector(*this, resolution, points_max, std::pow(kStep, step));
        return selector.run() ? std::optional(selector.take()) : std::nullopt;
    };
    int step = std::clamp(
        static_cast<int>(std::lround(std::log(likely_coarsening) / std::log(kStep))), 0, kSteps);
    std::optional<Selection> best = selected(step);
    while (!best && step < kSteps) {
        best = selected(++step);
        if (best) {
            return std::move(*best); // a finer one did not fit
        }
    }
    for (; best && step > 0; --step) {
        std::optional<Selection> finer = selected(step - 1);
        if (!finer) {
            break;
        }
        best = std::move(finer);
    }
    return best ? std::move(*best) : Selection{};
}

class FeatureIndex::Finder {
public:
    Finder(const FeatureIndex& index, const PlanePoint& place, double reach)
        : index_(index)
        , place_(place)
        , dot_distance_(reach)
        , line_distance_(reach)
    {}

    std::optional<std::uint32_t> run()
    {
        if (!index_.order_.empty()) {
            visit(index_.boxes_.size(), 0);
        }
        if (dot_ || line_) {
            return dot_ ? dot_ : line_;
        }
        std::optional<std::uint32_t> smallest;
        double area = kInfinity;
        for (const auto& [feature, around] : around_) {
            if (around.is_inside && around.area <= area) {
                area = around.area;
                smallest = feature;
            }
        }
        return smallest;
    }

private:
    struct Around {
        bool is_inside = false;
        double area = 0.0; // of the largest box
    };

    void visit(std::size_t level, std::size_t node)
    {
        const PlaneBox box = index_.boxOfNode(level, node);
        if (box.distance(place_) > std::max(dot_distance_, line_distance_)) {
            return;
        }
        if (level == 0) {
            visitPart(index_.order_[node], box);
            return;
        }
        const auto [begin, end] = index_.nodesBelow(level, node);
        for (std::size_t child = begin; child < end; ++child) {
            visit(level - 1, child);
        }
    }

    void visitPart(std::uint32_t part, const PlaneBox& box)
    {
        const PlaneFeatures::Part& of = index_.features_.parts[part];
        if (of.shape == PlaneShape::Dot) {
            const double distance = box.distance(place_);
            if (distance <= dot_distance_) {
                dot_distance_ = distance;
                dot_ = of.feature;
            }
            return;
        }
        const auto& points = index_.features_.points;
        bool is_inside = false;
        for (std::size_t i = of.begin; i + 1 < of.end; ++i) {
            const PlanePoint& a = points[i];
            const PlanePoint& b = points[i + 1];
            const double distance = distanceToSegment(place_, a, b);
            if (distance <= line_distance_) {
                line_distance_ = distance;
                line_ = of.feature;
            }
            if ((a.y > place_.y) != (b.y > place_.y) &&
                place_.x < a.x + (place_.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
                is_inside = !is_inside;
            }
        }
        if (of.shape == PlaneShape::Ring) {
            Around& around = around_[of.feature];
            around.is_inside = around.is_inside != is_inside;
            around.area = std::max(around.area, (box.max_x - box.min_x) * (box.max_y - box.min_y));
        }
    }

    const FeatureIndex& index_;
    PlanePoint place_;
    double dot_distance_;
    double line_distance_;
    std::optional<std::uint32_t> dot_;
    std::optional<std::uint32_t> line_;
    std::map<std::uint32_t, Around> around_;
};

std::optional<std::uint32_t> FeatureIndex::find(const PlanePoint& place, double reach) const
{
    return Finder(*this, place, reach).run();
}

class FeatureIndex::VertexFinder {
public:
    VertexFinder(const FeatureIndex& index, const PlanePoint& place, double reach)
        : index_(index)
        , place_(place)
        , distance_(reach)
    {}

    std::optional<PlanePoint> run()
    {
        if (!index_.order_.empty()) {
            visit(index_.boxes_.size(), 0);
        }
        return nearest_;
    }

private:
    void visit(std::size_t level, std::size_t node)
    {
        if (index_.boxOfNode(level, node).distance(place_) > distance_) {
            return;
        }
        if (level == 0) {
            const std::uint32_t part = index_.order_[node];
            const PlaneFeatures::Part& of = index_.features_.parts[part];
            if (of.shape == PlaneShape::Dot) {
                look(of.begin);
            } else {
                visitStrip(index_.roots_[part], of.begin, of.end - 1);
            }
            return;
        }
        const auto [begin, end] = index_.nodesBelow(level, node);
        for (std::size_t child = begin; child < end; ++child) {
            visit(level - 1, child);
        }
    }

    void visitStrip(std::size_t strip, std::size_t first, std::size_t last)
    {
        const Strip& of = index_.strips_[strip];
        if (of.box.distance(place_) > distance_) {
            return;
        }
        if (of.right == 0) {
            for (std::size_t i = first; i <= last; ++i) {
                look(i);
            }
            return;
        }
        const std::size_t middle = first + (last - first) / 2;
        visitStrip(strip + 1, first, middle);
        visitStrip(of.right, middle, last);
    }

    void look(std::size_t vertex)
    {
        const auto& is_course = index_.features_.is_course;
        if (vertex < is_course.size() && is_course[vertex]) {
            return;
        }
        const PlanePoint& point = index_.features_.points[vertex];
        const double distance = std::hypot(point.x - place_.x, point.y - place_.y);
        if (distance <= distance_) {
            distance_ = distance;
            nearest_ = point;
        }
    }

    const FeatureIndex& index_;
    PlanePoint place_;
    double distance_;
    std::optional<PlanePoint> nearest_;
};

std::optional<PlanePoint> FeatureIndex::nearestVertex(const PlanePoint& place, double reach) const
{
    return VertexFinder(*this, place, reach).run();
}

PlaneBox FeatureIndex::boxOf(std::uint32_t feature) const
{
    PlaneBox box;
    for (std::size_t item = 0; item < order_.size(); ++item) {
        if (features_.parts[order_[item]].feature == feature) {
            box.include(boxOfItem(item));
        }
    }
    return box;
}

} // namespace marsview
