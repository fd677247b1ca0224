#include "app/bench/terrain/swipe_path.h"

#include "app/bench/reference/reference_proxy.h"
#include "core/base/split_mix.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace marsview {

SwipePath::SwipePath(const SwipeArea& area, const SwipeOptions& options) noexcept
    : area_(area)
    , options_(options)
    , state_(options.seed)
{
    at_ = {area.first.column + nextRandom(state_) * (area.last.column - area.first.column),
           area.first.row + nextRandom(state_) * (area.last.row - area.first.row)};
    const double heading = 2.0 * std::numbers::pi * nextRandom(state_);
    columns_ = std::cos(heading);
    rows_ = std::sin(heading);
}

GridPoint SwipePath::next() noexcept
{
    // A stroke curves one way for some hundred updates.
    constexpr double kUpdatesMin = 100.0;
    constexpr double kUpdatesMore = 400.0;
    constexpr double kTurnMost = 0.004;
    if (until_turn_ <= 0.0) {
        until_turn_ = kUpdatesMin + kUpdatesMore * nextRandom(state_);
        turn_ = kTurnMost * (2.0 * nextRandom(state_) - 1.0);
    }
    until_turn_ -= 1.0;
    const double cosine = std::cos(turn_);
    const double sine = std::sin(turn_);
    const double columns = columns_ * cosine - rows_ * sine;
    rows_ = columns_ * sine + rows_ * cosine;
    const double length = std::sqrt(columns * columns + rows_ * rows_);
    columns_ = columns / length;
    rows_ /= length;
    const auto move = [this](double& at, double& heading, double first, double last) {
        at += options_.speed_cells * heading;
        if (at < first) {
            at = std::min(2.0 * first - at, last);
            heading = std::abs(heading);
        } else if (at > last) {
            at = std::max(2.0 * last - at, first);
            heading = -std::abs(heading);
        }
    };
    move(at_.column, columns_, area_.first.column, area_.last.column);
    move(at_.row, rows_, area_.first.row, area_.last.row);
    return at_;
}

SwipingHand::SwipingHand(const SwipePath& path,
                         const SceneFrame& frame,
                         double speed_cells) noexcept
    : path_(path)
    , frame_(frame)
    , depth_m_(std::max(2.0, 0.1 * speed_cells) * ReferenceProxy::cellMeters(frame))
{}

ScenePoint SwipingHand::begin() const noexcept
{
    constexpr double kDeepM = 1e6;
    return frame_.toScene(path_.at(), -kDeepM);
}

ScenePoint SwipingHand::next(const ScenePoint& proxy) noexcept
{
    return frame_.toScene(path_.next(), proxy.z - depth_m_);
}

} // namespace marsview
