#include "core/body/body_locator.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

constexpr std::size_t kSamplesPerSide = 33;
constexpr int kStepsMax = 16;
constexpr double kNearMin = 0.5; // of the body's radius: a little less than 30°

} // namespace

BodyLocator::BodyLocator(std::shared_ptr<const BodyGrid> grid)
    : grid_(std::move(grid))
    , first_row_(grid_->isPole(0) ? 1 : 0)
    , last_row_(grid_->isPole(grid_->rows() - 1) ? grid_->rows() - 2 : grid_->rows() - 1)
{
    const auto place = [](std::size_t i, std::size_t first, std::size_t last) {
        return first + i * (last - first) / (kSamplesPerSide - 1);
    };
    for (std::size_t j = 0; j < kSamplesPerSide; ++j) {
        for (std::size_t i = 0; i < kSamplesPerSide; ++i) {
            const std::size_t column = place(i, 0, grid_->columns() - 1);
            const std::size_t row = place(j, first_row_, last_row_);
            samples_.push_back({.column = static_cast<double>(column),
                                .row = static_cast<double>(row),
                                .direction = normalized(grid_->at(column, row, 0.0))});
            middle_ = middle_ + samples_.back().direction;
        }
    }
    constexpr double kWhole = 4.0; // more than half a turn
    if (grid_->closes() || !(length(middle_) > 1.0)) {
        reach_ = kWhole;
        return;
    }
    middle_ = normalized(middle_);
    const double columns = static_cast<double>(grid_->columns() - 1) / (kSamplesPerSide - 1);
    const double rows = static_cast<double>(grid_->rows() - 1) / (kSamplesPerSide - 1);
    const double between = grid_->diagonalMaxM(columns + 1.0, rows + 1.0) /
                           std::min(grid_->ellipsoid().polar_m, grid_->ellipsoid().equatorial_m);
    for (const Sample& sample : samples_) {
        reach_ = std::max(reach_, std::acos(std::clamp(dot(middle_, sample.direction), -1.0, 1.0)));
    }
    reach_ += between;
}

bool BodyLocator::isNear(const Vec3& point, double margin_m) const noexcept
{
    const double distance_m = length(point);
    const double angle =
        std::acos(std::clamp(dot(middle_, point) / std::max(distance_m, 1e-300), -1.0, 1.0));
    return angle * distance_m <= reach_ * distance_m + margin_m;
}

GridPoint BodyLocator::guess(const Vec3& point) const
{
    const auto nearest = std::max_element(
        samples_.begin(), samples_.end(), [&point](const Sample& a, const Sample& b) {
            return dot(a.direction, point) < dot(b.direction, point);
        });
    return {nearest->column, nearest->row};
}

// Newton's steps from sample to sample, each in the plane of the steps to its neighbors.
std::optional<GridPoint> BodyLocator::find(const Vec3& point,
                                           const std::optional<GridPoint>& start) const
{
    const double last_column = static_cast<double>(grid_->columns() - 1);
    const double low_row = static_cast<double>(first_row_);
    const double high_row = static_cast<double>(last_row_);
    // The last column of a grid around the body repeats the first one.
    const double turn = grid_->closes() ? last_column : 0.0;
    // A grid without the repeated column goes on behind its last one, half a cell further.
    const double longest = turn > 0.0 ? 0.125 * turn : last_column;
    GridPoint from = start ? *start : guess(point); // a guess looks at many samples
    GridPoint result = from;
    for (int i = 0; i < kStepsMax; ++i) {
        const double whole = turn > 0.0
                                 ? std::round(from.column - turn * std::floor(from.column / turn))
                                 : std::clamp(std::round(from.column), 0.0, last_column);
        const double row = std::clamp(std::round(from.row), low_row, high_row);
        const auto c = static_cast<std::size_t>(whole);
        const auto r = static_cast<std::size_t>(row);
        const Vec3 sample = grid_->at(c, r, 0.0);
        const BodyGrid::Steps steps = grid_->steps(c, r);
        const Vec3 rest = point - sample;
        const double cc = dot(steps.column, steps.column);
        const double rr = dot(steps.row, steps.row);
        const double cr = dot(steps.column, steps.row);
        const double det = cc * rr - cr * cr;
        if (!(det > 0.0)) {
            return std::nullopt;
        }
        const double on_column = dot(steps.column, rest);
        const double on_row = dot(steps.row, rest);
        const double columns = std::clamp((on_column * rr - on_row * cr) / det, -longest, longest);
        const double rows = (on_row * cc - on_column * cr) / det;
        result = {whole + columns, row + rows};
        const bool is_there = std::abs(columns) <= 0.5 && std::abs(rows) <= 0.5;
        const double next_column =
            turn > 0.0 ? result.column : std::clamp(std::round(result.column), 0.0, last_column);
        const double next_row = std::clamp(std::round(result.row), low_row, high_row);
        const bool stays = std::abs(std::round(next_column) - whole) < 0.5 && next_row == row;
        if (is_there || stays || i + 1 == kStepsMax) {
            return length(rest) < kNearMin * length(point) ? std::optional(result) : std::nullopt;
        }
        from = result;
    }
    return std::nullopt;
}

} // namespace marsview
