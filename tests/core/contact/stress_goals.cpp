#include "tests/core/contact/stress_goals.h"

#include <algorithm>
#include <cmath>

namespace marsview::test {

StressGoals::StressGoals(Random& random, const HeightfieldTruth& truth)
    : random_(random)
    , truth_(truth)
    , columns_(static_cast<double>(truth.terrain().columns() - 1))
    , rows_(static_cast<double>(truth.terrain().rows() - 1))
    , lengths_m_{std::hypot(truth.frame().east_per_column, truth.frame().north_per_column),
                 std::hypot(truth.frame().east_per_row, truth.frame().north_per_row), truth.step(),
                 truth.step()}
{
    if (truth.step() == 0.0) {
        lengths_m_[2] = lengths_m_[3] = lengths_m_[0];
    }
}

double StressGoals::surface(GridPoint grid) const
{
    return static_cast<double>(truth_.height(longVec(truth_.frame().toScene(
        {std::clamp(grid.column, 0.0, columns_), std::clamp(grid.row, 0.0, rows_)}, 0.0))));
}

double StressGoals::length(double low_exponent, double high_exponent)
{
    return lengths_m_.at(random_.below(lengths_m_.size())) *
           std::pow(10.0, random_.uniform(low_exponent, high_exponent));
}

GridPoint StressGoals::anywhere(double beyond)
{
    return {random_.uniform(-beyond, 1.0 + beyond) * columns_,
            random_.uniform(-beyond, 1.0 + beyond) * rows_};
}

void StressGoals::begin()
{
    left_ = 1 + static_cast<int>(random_.below(60));
    const double kind = random_.unit();
    motion_ = kind < 0.35   ? Motion::Wander
              : kind < 0.5  ? Motion::Sweep
              : kind < 0.6  ? Motion::Jump
              : kind < 0.75 ? Motion::Lattice
              : kind < 0.87 ? Motion::Foot
              : kind < 0.89 ? Motion::Far
              : kind < 0.93 ? Motion::Dive
                            : Motion::Rest;
    at_ = truth_.frame().toGrid(goal_);
    at_ = {std::clamp(at_.column, -0.1 * columns_, 1.1 * columns_),
           std::clamp(at_.row, -0.1 * rows_, 1.1 * rows_)};
    step_ = std::pow(10.0, random_.uniform(-3.0, 1.5));
    depth_ = length(-3.0, 1.5);
    switch (motion_) {
    case Motion::Sweep: {
        at_ = anywhere(0.1);
        const GridPoint to = anywhere(0.3);
        const double cells = std::hypot(to.column - at_.column, to.row - at_.row);
        const double speed = std::pow(10.0, random_.uniform(-1.0, 1.7));
        left_ = std::clamp(static_cast<int>(cells / speed), 1, 200);
        const double per_update = std::min(speed / std::max(cells, 1e-3), 1.0);
        velocity_ = {(to.column - at_.column) * per_update, (to.row - at_.row) * per_update};
        if (random_.chance(0.3)) { // along a row, a column or a diagonal
            (random_.chance(0.5) ? velocity_.column : velocity_.row) = 0.0;
        } else if (random_.chance(0.3)) {
            velocity_.row = random_.chance(0.5) ? velocity_.column : -velocity_.column;
            at_ = {std::round(at_.column), std::round(at_.row)};
        }
        follows_ = random_.chance(0.5);
        z_ = surface(at_) - depth_;
        break;
    }
    case Motion::Dive:
        at_ = random_.chance(0.5) ? onLatticePoint() : anywhere(0.1);
        z_ = surface(at_) + depth_;
        left_ = 1 + static_cast<int>(random_.below(20));
        climb_ = -random_.uniform(0.5, 4.0) * depth_ / left_;
        break;
    case Motion::Rest:
        left_ = 3;
        break;
    default:
        break;
    }
}

ScenePoint StressGoals::next()
{
    if (left_ == 0) {
        begin();
    }
    --left_;
    switch (motion_) {
    case Motion::Wander:
        goal_ = wandering();
        break;
    case Motion::Sweep:
        at_ = {at_.column + velocity_.column, at_.row + velocity_.row};
        goal_ = truth_.frame().toScene(at_, follows_ ? surface(at_) - depth_ : z_);
        break;
    case Motion::Jump:
        goal_ = jumping();
        break;
    case Motion::Lattice:
        goal_ = onLattice();
        break;
    case Motion::Foot:
        goal_ = overFoot();
        break;
    case Motion::Far:
        goal_ = farAway();
        break;
    case Motion::Dive:
        z_ += climb_;
        goal_ = truth_.frame().toScene(at_, z_);
        break;
    case Motion::Rest:
        break;
    }
    constexpr double kMostM = 1e12;
    goal_ = {std::clamp(goal_.x, -kMostM, kMostM), std::clamp(goal_.y, -kMostM, kMostM),
             std::clamp(goal_.z, -kMostM, kMostM)};
    return goal_;
}

ScenePoint StressGoals::wandering()
{
    at_.column = std::clamp(at_.column + random_.uniform(-step_, step_), -0.3 * columns_ - 1.0,
                            1.3 * columns_ + 1.0);
    at_.row =
        std::clamp(at_.row + random_.uniform(-step_, step_), -0.3 * rows_ - 1.0, 1.3 * rows_ + 1.0);
    return truth_.frame().toScene(at_, surface(at_) - random_.uniform(-0.3, 1.0) * depth_);
}

ScenePoint StressGoals::jumping()
{
    GridPoint to = anywhere(0.2);
    if (random_.chance(0.3)) {
        to = {random_.chance(0.5) ? 0.0 : columns_, random_.chance(0.5) ? 0.0 : rows_};
    }
    return truth_.frame().toScene(to, surface(to) + random_.uniform(-1.0, 0.3) * length(-2.0, 2.0));
}

GridPoint StressGoals::onLatticePoint()
{
    GridPoint grid = random_.chance(0.7) ? truth_.frame().toGrid(goal_) : anywhere(0.0);
    grid = {std::clamp(grid.column + random_.uniform(-2.0, 2.0), -1.0, columns_ + 1.0),
            std::clamp(grid.row + random_.uniform(-2.0, 2.0), -1.0, rows_ + 1.0)};
    const double column = std::floor(grid.column);
    const double row = std::floor(grid.row);
    switch (random_.below(6)) {
    case 0:
        return {column, row};
    case 1:
        return {column, grid.row};
    case 2:
        return {grid.column, row};
    case 3: { // a diagonal
        const double share = random_.chance(0.5) ? 0.5 : random_.unit();
        return {column + share, row + share};
    }
    case 4: // on the border, or at a corner
        return {random_.chance(0.5) ? 0.0 : columns_, random_.chance(0.5) ? row : grid.row};
    default:
        return {random_.chance(0.5) ? column : grid.column, random_.chance(0.5) ? 0.0 : rows_};
    }
}

ScenePoint StressGoals::onLattice()
{
    const GridPoint grid = onLatticePoint();
    double z = surface(grid);
    switch (random_.below(5)) {
    case 0:
        break;
    case 1:
        z = std::nextafter(z, random_.chance(0.5) ? 1e30 : -1e30);
        break;
    case 2: { // as high as some sample
        const auto c = static_cast<std::size_t>(std::clamp(grid.column, 0.0, columns_));
        const auto r = static_cast<std::size_t>(std::clamp(grid.row, 0.0, rows_));
        z = truth_.terrain().sample(c, r) * truth_.exaggeration();
        break;
    }
    default:
        z -= random_.uniform(-0.3, 1.0) * depth_;
        break;
    }
    return truth_.frame().toScene(grid, z);
}

ScenePoint StressGoals::overFoot()
{
    GridPoint near = truth_.frame().toGrid(goal_);
    near = {near.column + random_.uniform(-3.0, 3.0), near.row + random_.uniform(-3.0, 3.0)};
    const double c = std::floor(std::clamp(near.column, 0.0, columns_ - 1.0));
    const double r = std::floor(std::clamp(near.row, 0.0, rows_ - 1.0));
    const bool is_upper = random_.chance(0.5);
    const auto corner = [&](double column, double row) {
        return truth_.frame().toScene({column, row}, surface({column, row}));
    };
    const ScenePoint a = corner(c, r);
    const ScenePoint b = corner(c + 1.0, r + 1.0);
    const ScenePoint d = is_upper ? corner(c + 1.0, r) : corner(c, r + 1.0);
    const auto share = [&] {
        const std::size_t kind = random_.below(4);
        return kind == 0 ? 0.0 : kind == 1 ? 1.0 : kind == 2 ? 0.5 : random_.unit();
    };
    const double first = share();
    const double second = share() * (1.0 - first);
    const ScenePoint foot = a + (b - a) * first + (d - a) * second;
    Vec3 normal = normalized(cross(b - a, d - a));
    if (normal.z < 0.0) {
        normal = -normal;
    }
    return random_.chance(0.1) ? foot : foot - normal * (random_.uniform(-0.1, 1.0) * depth_);
}

ScenePoint StressGoals::farAway()
{
    const auto coordinate = [&](double near) {
        const std::size_t kind = random_.below(4);
        return kind == 0 ? near
               : kind == 1
                   ? (random_.chance(0.5) ? 1e12 : -1e12)
                   : random_.uniform(-1.0, 1.0) * std::pow(10.0, random_.uniform(3.0, 12.0));
    };
    const ScenePoint near = jumping();
    return {coordinate(near.x), coordinate(near.y), coordinate(near.z)};
}

} // namespace marsview::test
