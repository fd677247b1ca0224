#include "tests/core/contact/contact_truth.h"

#include "tests/support/reference_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace marsview::test {
namespace {

constexpr long double kEpsilon = std::numeric_limits<double>::epsilon();

LongVec cross(const LongVec& a, const LongVec& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

LongVec normalized(const LongVec& a)
{
    return a * (1.0L / length(a));
}

// The turn from `a` to `b` seen from above; positive: to the left.
long double turn(const LongVec& a, const LongVec& b)
{
    return a.x * b.y - a.y * b.x;
}

// The length of `goal` projected onto the cone spanned by two unit directions. They are not
// opposite.
long double pullBetween(const LongVec& a, const LongVec& b, const LongVec& goal)
{
    const LongVec normal = cross(a, b);
    const long double sine = length(normal);
    if (sine > 0.0L) {
        const LongVec across = cross(normal, a) * (1.0L / sine);
        const long double of_b = dot(goal, across) / sine;
        const long double of_a = dot(goal, a) - of_b * dot(a, b);
        if (of_a >= 0.0L && of_b >= 0.0L) {
            return std::hypot(dot(goal, a), dot(goal, across));
        }
    }
    return std::max({dot(goal, a), dot(goal, b), 0.0L});
}

// The same for a line and the half plane on one side of it.
long double pullBeside(const LongVec& line, const LongVec& side, const LongVec& goal)
{
    return std::hypot(dot(goal, line), std::max(dot(goal, side), 0.0L));
}

constexpr LongVec kUp{0.0L, 0.0L, 1.0L};

// The length of `goal` projected onto the space on and above one face, seen from a place on that
// face: inside it, on its edge from b to c, or at its corner a.
long double pullOver(
    std::size_t samples, const LongVec& a, const LongVec& b, const LongVec& c, const LongVec& goal)
{
    LongVec normal = normalized(cross(b - a, c - a));
    if (normal.z < 0.0L) {
        normal = normal * -1.0L;
    }
    const bool is_above = dot(normal, goal) > 0.0L;
    if (samples == 3) {
        const LongVec along = normalized(b - a);
        return is_above ? length(goal)
                        : std::hypot(dot(goal, along), dot(goal, cross(normal, along)));
    }
    if (samples == 2) {
        const LongVec along = normalized(c - b);
        LongVec inward = cross(normal, along);
        if (dot(inward, a - b) < 0.0L) {
            inward = inward * -1.0L;
        }
        if (is_above && turn(along, goal) * turn(along, a - b) >= 0.0L) {
            return length(goal);
        }
        return std::max(pullBeside(along, inward, goal),
                        pullBeside(along, normalized(kUp - along * along.z), goal));
    }
    const LongVec to_b = normalized(b - a);
    const LongVec to_c = normalized(c - a);
    const long double side = turn(to_b, to_c);
    if (is_above && turn(to_b, goal) * side >= 0.0L && turn(goal, to_c) * side >= 0.0L) {
        return length(goal);
    }
    return std::max({pullBetween(to_b, to_c, goal), pullBetween(kUp, to_b, goal),
                     pullBetween(kUp, to_c, goal)});
}

} // namespace

long double dot(const LongVec& a, const LongVec& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

long double length(const LongVec& a)
{
    return std::sqrt(dot(a, a));
}

LongVec longVec(const Vec3& a)
{
    return {static_cast<long double>(a.x), static_cast<long double>(a.y),
            static_cast<long double>(a.z)};
}

HeightfieldTruth::HeightfieldTruth(std::shared_ptr<const FilledHeightfield> terrain,
                                   const SceneFrame& frame,
                                   double exaggeration)
    : terrain_(std::move(terrain))
    , frame_(frame)
    , exaggeration_(exaggeration)
{
    for (std::size_t r = 0; r + 1 < terrain_->rows(); ++r) {
        for (std::size_t c = 0; c + 1 < terrain_->columns(); ++c) {
            const CellHeights z = terrain_->cell(c, r);
            const auto [low, high] =
                std::minmax({z.upper_left, z.upper_right, z.lower_left, z.lower_right});
            step_m_ = std::max(step_m_, (high - low) * exaggeration_);
            highest_m_ =
                std::max(highest_m_, std::max(std::abs(high), std::abs(low)) * exaggeration_);
        }
    }
}

LongVec HeightfieldTruth::toScene(long double column, long double row, long double z) const
{
    const long double c = column - static_cast<long double>(frame_.origin.column);
    const long double r = row - static_cast<long double>(frame_.origin.row);
    return {c * static_cast<long double>(frame_.east_per_column) +
                r * static_cast<long double>(frame_.east_per_row),
            c * static_cast<long double>(frame_.north_per_column) +
                r * static_cast<long double>(frame_.north_per_row),
            z};
}

std::array<long double, 2> HeightfieldTruth::toGrid(const LongVec& point) const
{
    const long double ec = frame_.east_per_column;
    const long double er = frame_.east_per_row;
    const long double nc = frame_.north_per_column;
    const long double nr = frame_.north_per_row;
    const long double determinant = ec * nr - er * nc;
    return {frame_.origin.column + (point.x * nr - point.y * er) / determinant,
            frame_.origin.row + (point.y * ec - point.x * nc) / determinant};
}

LongVec HeightfieldTruth::clamped(const LongVec& point) const
{
    const auto grid = toGrid(point);
    const long double column =
        std::clamp(grid[0], 0.0L, static_cast<long double>(terrain_->columns() - 1));
    const long double row =
        std::clamp(grid[1], 0.0L, static_cast<long double>(terrain_->rows() - 1));
    return column == grid[0] && row == grid[1] ? point : toScene(column, row, point.z);
}

LongVec HeightfieldTruth::goal(const ScenePoint& goal) const
{
    return clamped(longVec(goal));
}

long double HeightfieldTruth::wayOfGoal(const ScenePoint& from, const ScenePoint& to) const
{
    const LongVec first = longVec(from);
    const LongVec last = longVec(to);
    const auto begin = toGrid(first);
    const auto end = toGrid(last);
    std::vector<long double> shares{0.0L, 1.0L};
    const auto crossing = [&](long double a, long double b, long double border) {
        if ((a < border) != (b < border)) {
            shares.push_back((border - a) / (b - a));
        }
    };
    crossing(begin[0], end[0], 0.0L);
    crossing(begin[0], end[0], static_cast<long double>(terrain_->columns() - 1));
    crossing(begin[1], end[1], 0.0L);
    crossing(begin[1], end[1], static_cast<long double>(terrain_->rows() - 1));
    std::sort(shares.begin(), shares.end());
    long double way_m = 0.0L;
    LongVec at = clamped(first);
    for (const long double t : shares) {
        const LongVec next = clamped(first * (1.0L - t) + last * t);
        way_m += length(next - at);
        at = next;
    }
    return way_m;
}

bool HeightfieldTruth::isInside(const ScenePoint& goal) const
{
    const GridPoint grid = frame_.toGrid(goal);
    return grid.column >= 0.0 && grid.column <= static_cast<double>(terrain_->columns() - 1) &&
           grid.row >= 0.0 && grid.row <= static_cast<double>(terrain_->rows() - 1);
}

long double HeightfieldTruth::goalError(const ScenePoint& goal) const
{
    const LongVec column{frame_.east_per_column, frame_.north_per_column, 0.0L};
    const LongVec row{frame_.east_per_row, frame_.north_per_row, 0.0L};
    const long double determinant = std::abs(column.x * row.y - row.x * column.y);
    const long double x = std::abs(static_cast<long double>(goal.x));
    const long double y = std::abs(static_cast<long double>(goal.y));
    const long double columns = (x * std::abs(row.y) + y * std::abs(row.x)) / determinant +
                                static_cast<long double>(terrain_->columns());
    const long double rows = (y * std::abs(column.x) + x * std::abs(column.y)) / determinant +
                             static_cast<long double>(terrain_->rows());
    return kEpsilon * (4.0L * (columns * length(column) + rows * length(row)) +
                       std::abs(static_cast<long double>(goal.z)));
}

LongVec HeightfieldTruth::corner(int column, int row) const
{
    const auto height = static_cast<long double>(
        terrain_->sample(static_cast<std::size_t>(column), static_cast<std::size_t>(row)));
    return toScene(column, row, height * static_cast<long double>(exaggeration_));
}

LongVec HeightfieldTruth::point(const MeshPlace& place) const
{
    LongVec point{};
    for (std::size_t i = 0; i < place.count; ++i) {
        const MeshPlace::Part& part = place.parts.at(i);
        point = point + corner(part.column, part.row) * part.share;
    }
    return point;
}

long double HeightfieldTruth::heightAtGrid(long double column, long double row) const
{
    const auto last_c = static_cast<long double>(terrain_->columns() - 1);
    const auto last_r = static_cast<long double>(terrain_->rows() - 1);
    column = std::clamp(column, 0.0L, last_c);
    row = std::clamp(row, 0.0L, last_r);
    const auto c = static_cast<std::size_t>(std::min(std::floor(column), last_c - 1.0L));
    const auto r = static_cast<std::size_t>(std::min(std::floor(row), last_r - 1.0L));
    const CellHeights z = terrain_->cell(c, r);
    return planeHeight({z.upper_left, z.upper_right, z.lower_left, z.lower_right},
                       column - static_cast<long double>(c), row - static_cast<long double>(r)) *
           static_cast<long double>(exaggeration_);
}

long double HeightfieldTruth::height(const LongVec& point) const
{
    const auto grid = toGrid(point);
    return heightAtGrid(grid[0], grid[1]);
}

long double HeightfieldTruth::depth(const LongVec& from, const LongVec& to) const
{
    const auto begin = toGrid(from);
    const auto end = toGrid(to);
    long double deepest = -std::numeric_limits<long double>::infinity();
    const auto look = [&](long double t) {
        const long double column = begin[0] * (1.0L - t) + end[0] * t;
        const long double row = begin[1] * (1.0L - t) + end[1] * t;
        deepest = std::max(deepest, heightAtGrid(column, row) - (from.z * (1.0L - t) + to.z * t));
    };
    look(0.0L);
    look(1.0L);
    // Between the grid lines and the diagonals the surface is flat.
    const auto lines = [&](long double a, long double b) {
        const auto low = static_cast<long>(std::ceil(std::min(a, b)));
        const auto high = static_cast<long>(std::floor(std::max(a, b)));
        for (long line = low; line <= high && a != b; ++line) {
            look((static_cast<long double>(line) - a) / (b - a));
        }
    };
    lines(begin[0], end[0]);
    lines(begin[1], end[1]);
    lines(begin[0] - begin[1], end[0] - end[1]);
    return deepest;
}

HeightfieldTruth::Rest HeightfieldTruth::rest(const MeshPlace& place, const LongVec& goal) const
{
    const LongVec here = point(place);
    const LongVec to_goal = goal - here;
    Rest rest{std::max(to_goal.z, 0.0L), 0.0L, 1.0L, 0.0L, 0};
    int left = place.parts[0].column;
    int right = left;
    int top = place.parts[0].row;
    int bottom = top;
    for (std::size_t i = 1; i < place.count; ++i) {
        left = std::min(left, place.parts.at(i).column);
        right = std::max(right, place.parts.at(i).column);
        top = std::min(top, place.parts.at(i).row);
        bottom = std::max(bottom, place.parts.at(i).row);
    }
    for (int r = std::max(top - 1, 0);
         r <= std::min(bottom, static_cast<int>(terrain_->rows()) - 2); ++r) {
        for (int c = std::max(left - 1, 0);
             c <= std::min(right, static_cast<int>(terrain_->columns()) - 2); ++c) {
            for (const bool is_upper : {true, false}) {
                const std::array<std::array<int, 2>, 3> corners{
                    {{c, r}, {c + 1, r + 1}, {is_upper ? c + 1 : c, is_upper ? r : r + 1}}};
                // The corners that carry the place first, then the others, in the order that
                // pullOver() needs.
                std::array<LongVec, 3> points;
                std::size_t held = 0;
                std::size_t others = 0;
                for (const auto& [column, row] : corners) {
                    const bool is_held =
                        std::any_of(place.parts.begin(), place.parts.begin() + place.count,
                                    [&, column = column, row = row](const MeshPlace::Part& part) {
                                        return part.column == column && part.row == row;
                                    });
                    points.at(is_held ? held++ : 2 - others++) = corner(column, row);
                }
                if (held != place.count) {
                    continue; // the place is not on this face
                }
                if (held == 2) {
                    std::swap(points[0], points[2]); // the edge last
                }
                ++rest.faces;
                for (const LongVec& at : points) {
                    rest.highest_m = std::max(rest.highest_m, std::abs(at.z));
                }
                rest.pull_m =
                    std::max(rest.pull_m, pullOver(held, points[0], points[1], points[2], to_goal));
                const long double longest =
                    std::max({length(points[1] - points[0]), length(points[2] - points[1]),
                              length(points[0] - points[2])});
                const long double doubled_area =
                    length(cross(points[1] - points[0], points[2] - points[0]));
                rest.longest_m = std::max(rest.longest_m, longest);
                rest.slenderness = std::max(rest.slenderness, longest * longest / doubled_area);
            }
        }
    }
    return rest;
}

} // namespace marsview::test
