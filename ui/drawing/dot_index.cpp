#include "ui/drawing/dot_index.h"

#include "ui/drawing/handle_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

constexpr std::uint32_t kLeafDots = 16;

std::array<ScenePoint, 8> cornersOf(const ScenePoint& low, const ScenePoint& high)
{
    return {ScenePoint{low.x, low.y, low.z}, {high.x, low.y, low.z},  {low.x, high.y, low.z},
            {high.x, high.y, low.z},         {low.x, low.y, high.z},  {high.x, low.y, high.z},
            {low.x, high.y, high.z},         {high.x, high.y, high.z}};
}

} // namespace

DotSight::DotSight(const CameraPose& pose,
                   const Viewport& viewport,
                   double pixels_per_point,
                   double exaggeration,
                   const QRectF& area,
                   std::optional<Horizon> horizon)
    : exaggeration_(exaggeration)
    , area_(area)
    , horizon_(horizon)
{
    // Half the height of the picture at a depth of 1.
    const double half = std::tan(0.5 * pose.field_of_view.radians());
    const double points = 0.5 * viewport.height / pixels_per_point / half;
    eye_ = pose.eye;
    axes_ = {.right = pose.axes.right * points,
             .up = pose.axes.up * points,
             .forward = pose.axes.forward};
    center_ = QPointF(0.5 * viewport.width, 0.5 * viewport.height) / pixels_per_point;
}

std::optional<QPointF> DotSight::at(const ScenePoint& place) const
{
    const ScenePoint point = raised(place);
    return horizon_ && horizon_->hides(point, eye_) ? std::nullopt : projected(point);
}

std::optional<QPointF> DotSight::projected(const ScenePoint& raised) const
{
    const Vec3 p = raised - eye_;
    const double depth = dot(p, axes_.forward);
    if (!(depth > 0.0)) {
        return std::nullopt;
    }
    return QPointF(center_.x() + dot(p, axes_.right) / depth,
                   center_.y() - dot(p, axes_.up) / depth);
}

std::optional<QRectF> DotSight::enclosing(const ScenePoint& low, const ScenePoint& high) const
{
    // Bounds of the box along each axis of the camera; those of the quotients follow.
    const ScenePoint a = raised(low);
    const ScenePoint b = raised(high);
    const Vec3 middle = (a - eye_) * 0.5 + (b - eye_) * 0.5;
    const Vec3 half = (b - a) * 0.5;
    const auto reach = [&half](const Vec3& axis) {
        return std::abs(half.x * axis.x) + std::abs(half.y * axis.y) + std::abs(half.z * axis.z);
    };
    const double depth = dot(middle, axes_.forward);
    const double depth_reach = reach(axes_.forward);
    if (!(depth - depth_reach > 0.0)) {
        return std::nullopt;
    }
    const double nearest = 1.0 / (depth - depth_reach);
    const double farthest = 1.0 / (depth + depth_reach);
    const auto lowest = [&](double at) { return at * (at < 0.0 ? nearest : farthest); };
    const auto highest = [&](double at) { return at * (at > 0.0 ? nearest : farthest); };
    const double right = dot(middle, axes_.right);
    const double right_reach = reach(axes_.right);
    const double up = dot(middle, axes_.up);
    const double up_reach = reach(axes_.up);
    constexpr double kRounding = 1e-3; // points
    return QRectF(QPointF(center_.x() + lowest(right - right_reach) - kRounding,
                          center_.y() - highest(up + up_reach) - kRounding),
                  QPointF(center_.x() + highest(right + right_reach) + kRounding,
                          center_.y() - lowest(up - up_reach) + kRounding));
}

bool DotSight::isBehind(const ScenePoint& low, const ScenePoint& high) const
{
    const auto corners = cornersOf(low, high);
    return std::none_of(corners.begin(), corners.end(), [this](const ScenePoint& corner) {
        return projected(raised(corner)).has_value();
    });
}

bool DotSight::isHidden(const ScenePoint& low, const ScenePoint& high) const
{
    if (!horizon_) {
        return false;
    }
    const auto corners = cornersOf(low, high);
    return std::all_of(corners.begin(), corners.end(), [this](const ScenePoint& corner) {
        return horizon_->hides(raised(corner), eye_);
    });
}

DotIndex::DotIndex(std::vector<Dot> dots)
    : dots_(std::move(dots))
{
    if (!dots_.empty()) {
        nodes_.reserve(4 * dots_.size() / kLeafDots + 1);
        build(0, static_cast<std::uint32_t>(dots_.size()));
    }
}

// Halves of equal number, across the longest side.
std::uint32_t DotIndex::build(std::uint32_t begin, std::uint32_t end)
{
    Node node{.low = dots_[begin].place,
              .high = dots_[begin].place,
              .begin = begin,
              .end = end,
              .further = 0};
    for (std::uint32_t i = begin + 1; i < end; ++i) {
        const ScenePoint& place = dots_[i].place;
        node.low = {std::min(node.low.x, place.x), std::min(node.low.y, place.y),
                    std::min(node.low.z, place.z)};
        node.high = {std::max(node.high.x, place.x), std::max(node.high.y, place.y),
                     std::max(node.high.z, place.z)};
    }
    const auto at = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back(node);
    if (end - begin <= kLeafDots) {
        return at;
    }
    const Vec3 size = node.high - node.low;
    const auto longest = size.z > std::max(size.x, size.y) ? &ScenePoint::z
                         : size.x > size.y                 ? &ScenePoint::x
                                                           : &ScenePoint::y;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(
        dots_.begin() + begin, dots_.begin() + middle, dots_.begin() + end,
        [longest](const Dot& a, const Dot& b) { return a.place.*longest < b.place.*longest; });
    build(begin, middle);
    const std::uint32_t further = build(middle, end);
    nodes_[at].further = further;
    return at;
}

// `look` says whether a node may have something; `see` sees the dots of its leaves.
template <typename Look, typename See>
void DotIndex::visit(std::uint32_t at, const Look& look, const See& see) const
{
    const Node& node = nodes_[at];
    if (!look(node)) {
        return;
    }
    if (node.further == 0) {
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
            if (is_removed_.empty() || !is_removed_[i]) {
                see(dots_[i]);
            }
        }
        return;
    }
    visit(at + 1, look, see);
    visit(node.further, look, see);
}

void DotIndex::remove(std::size_t place)
{
    is_removed_.resize(dots_.size(), false);
    if (!is_removed_[place]) {
        is_removed_[place] = true;
        ++removed_;
    }
}

void DotIndex::thinned(const DotSight& sight,
                       HandleGrid& grid,
                       const std::function<void(const Dot&, QPointF)>& take) const
{
    if (nodes_.empty()) {
        return;
    }
    const auto may_have = [&](const Node& node) {
        if (sight.isHidden(node.low, node.high)) {
            return false;
        }
        const auto box = sight.enclosing(node.low, node.high);
        return box ? box->intersects(sight.area()) && !grid.isTaken(*box)
                   : !sight.isBehind(node.low, node.high);
    };
    visit(0, may_have, [&](const Dot& dot) {
        const auto place = sight.at(dot.place);
        if (place && sight.area().contains(*place) && grid.take(*place)) {
            take(dot, *place);
        }
    });
}

std::optional<DotIndex::Near>
DotIndex::nearest(const DotSight& sight, QPointF position, double reach) const
{
    std::optional<Near> found;
    if (nodes_.empty()) {
        return found;
    }
    const auto may_have = [&](const Node& node) {
        if (sight.isHidden(node.low, node.high)) {
            return false;
        }
        const auto box = sight.enclosing(node.low, node.high);
        return box ? box->adjusted(-reach, -reach, reach, reach).contains(position)
                   : !sight.isBehind(node.low, node.high);
    };
    visit(0, may_have, [&](const Dot& dot) {
        const auto place = sight.at(dot.place);
        if (!place) {
            return;
        }
        const double away = std::hypot(place->x() - position.x(), place->y() - position.y());
        if (away <= reach) {
            reach = away;
            found = Near{.dot = dot, .place = *place, .away = away};
        }
    });
    return found;
}

} // namespace marsview
