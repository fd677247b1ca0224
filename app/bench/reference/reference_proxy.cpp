#include "app/bench/reference/reference_proxy.h"

#include "core/base/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace marsview {
namespace {

using Real = long double;

// Directions whose cosine with the goal is at most this lead nowhere: far above the rounding error
// of 0. From a goal 10 cells away, the minimum is missed by 1e-13 cell.
constexpr Real kCosineLeast = 1e-14L;

// Rounding error of a length of 1 after a few operations.
constexpr Real kRounding = 64.0L * std::numeric_limits<Real>::epsilon();

// Cells. Parts of a cast shorter than this are skipped: rounding would decide in which triangle
// they lie, and the next part covers the same terrain.
constexpr Real kPartLeast = 1e-14L;

// Otherwise a motion across a continent would take hours.
constexpr Real kPiecesMax = 16777216.0L;

constexpr int kStepsMax = 100'000;

// Cells. A position closer than this to an edge or a vertex is on it: feet of goals at regular
// positions lie on features exactly, up to rounding, and the features beyond must be considered.
constexpr Real kOn = 1e-12L;

// Number of consecutive steps that may be as short as the snapping by kOn.
constexpr int kTinyStepsMax = 16;

} // namespace

double ReferenceProxy::cellMeters(const SceneFrame& frame)
{
    return (std::hypot(frame.east_per_column, frame.north_per_column) +
            std::hypot(frame.east_per_row, frame.north_per_row)) /
           2.0;
}

ReferenceProxy::ReferenceProxy(const HeightfieldSurface& surface, double piece_cells)
    : surface_(surface)
    , piece_m_(static_cast<Real>(piece_cells) * static_cast<Real>(cellMeters(surface.frame())))
    , cell_m_(static_cast<Real>(cellMeters(surface.frame())))
    , column_{surface.frame().east_per_column, surface.frame().north_per_column, 0.0L}
    , row_{surface.frame().east_per_row, surface.frame().north_per_row, 0.0L}
    , last_column_(static_cast<Real>(surface.terrain()->columns() - 1))
    , last_row_(static_cast<Real>(surface.terrain()->rows() - 1))
{
    MARSVIEW_CHECK(piece_cells > 0.0);
}

ReferenceProxy::Vector ReferenceProxy::offset(Real columns, Real rows, Real up) const
{
    return {columns * column_.x + rows * row_.x, columns * column_.y + rows * row_.y, up};
}

ReferenceProxy::Aim ReferenceProxy::aimAt(Real column, Real row, Real z) const
{
    return {std::clamp(column, 0.0L, last_column_), std::clamp(row, 0.0L, last_row_), z};
}

ReferenceProxy::Place ReferenceProxy::onFeature(Place place)
{
    const auto snap = [](Real& value, Real to) {
        if (std::abs(value - to) < kOn) {
            value = to;
        }
    };
    for (Real* const value : {&place.u, &place.v}) {
        snap(*value, 0.0L);
        snap(*value, 1.0L);
    }
    snap(place.v, place.u);
    return place;
}

// Whether a direction from the position in the triangle leads into it or along its border.
bool ReferenceProxy::Triangle::holds(Real du, Real dv) const
{
    if (u == v && (is_upper ? du < dv : du > dv)) {
        return false;
    }
    return is_upper ? (v != 0.0L || dv >= 0.0L) && (u != 1.0L || du <= 0.0L)
                    : (u != 0.0L || du >= 0.0L) && (v != 1.0L || dv <= 0.0L);
}

ReferenceProxy::Triangle ReferenceProxy::triangleAt(
    std::int32_t column, std::int32_t row, bool is_upper, Real u, Real v) const
{
    const auto sample = [&](std::int32_t c, std::int32_t r) {
        return static_cast<Real>(surface_.exaggeration()) *
               static_cast<Real>(surface_.terrain()->sample(static_cast<std::size_t>(c),
                                                            static_cast<std::size_t>(r)));
    };
    const Real upper_left = sample(column, row);
    const Real lower_right = sample(column + 1, row + 1);
    const Real third = is_upper ? sample(column + 1, row) : sample(column, row + 1);
    return {column,
            row,
            is_upper,
            u,
            v,
            upper_left,
            is_upper ? third - upper_left : lower_right - third,
            is_upper ? lower_right - third : third - upper_left};
}

// All triangles that contain the position.
ReferenceProxy::Around ReferenceProxy::around(const Place& place) const
{
    Around result;
    const int left = place.u == 0.0L ? -1 : 0;
    const int right = place.u == 1.0L ? 1 : 0;
    const int up = place.v == 0.0L ? -1 : 0;
    const int down = place.v == 1.0L ? 1 : 0;
    for (int dr = up; dr <= down; ++dr) {
        for (int dc = left; dc <= right; ++dc) {
            const std::int32_t column = place.column + dc;
            const std::int32_t row = place.row + dr;
            if (column < 0 || row < 0 || static_cast<Real>(column) >= last_column_ ||
                static_cast<Real>(row) >= last_row_) {
                continue;
            }
            const Real u = place.u - static_cast<Real>(dc);
            const Real v = place.v - static_cast<Real>(dr);
            if (u >= v) {
                result.triangles[result.count++] = triangleAt(column, row, true, u, v);
            }
            if (u <= v) {
                result.triangles[result.count++] = triangleAt(column, row, false, u, v);
            }
        }
    }
    return result;
}

ReferenceProxy::Place ReferenceProxy::placeBelow(const Aim& aim) const
{
    const Real column = std::min(std::floor(aim.column), last_column_ - 1.0L);
    const Real row = std::min(std::floor(aim.row), last_row_ - 1.0L);
    return {static_cast<std::int32_t>(column), static_cast<std::int32_t>(row), aim.column - column,
            aim.row - row};
}

Real ReferenceProxy::heightAt(Real column, Real row) const
{
    const Place at = placeBelow({column, row, 0.0L});
    return triangleAt(at.column, at.row, at.u >= at.v, at.u, at.v).height(at.u, at.v);
}

// The first position where the straight path from `from`, which is on or above the surface, goes
// below it; empty if `to` is reached. `cells` is the distance to it, horizontal or, for a vertical
// path, upward.
std::optional<ReferenceProxy::Place>
ReferenceProxy::cast(Aim from, const Aim& to, Real& cells) const
{
    const Real columns = to.column - from.column;
    const Real rows = to.row - from.row;
    const Real up = to.z - from.z;
    cells = std::max({std::abs(columns), std::abs(rows), std::abs(up) / cell_m_});
    // The lines where the path may enter another triangle: whole columns, rows, diagonals.
    struct Lines {
        Real start;
        Real change;
        Real next;
        Real time() const
        {
            return change == 0.0L ? std::numeric_limits<Real>::infinity() : (next - start) / change;
        }
        void pass() { next += change > 0.0L ? 1.0L : -1.0L; }
    };
    const auto lines = [](Real start, Real change) {
        return Lines{start, change,
                     change > 0.0L ? std::floor(start) + 1.0L : std::ceil(start) - 1.0L};
    };
    std::array<Lines, 3> families{lines(from.column, columns), lines(from.row, rows),
                                  lines(from.column - from.row, columns - rows)};
    const auto at = [&](Real t) {
        return t == 1.0L ? to
                         : aimAt(from.column + t * columns, from.row + t * rows, from.z + t * up);
    };
    Real begin = 0.0L;
    while (begin < 1.0L) {
        Real end = 1.0L;
        for (const Lines& family : families) {
            end = std::min(end, family.time());
        }
        for (Lines& family : families) {
            if (family.time() <= end) {
                family.pass();
            }
        }
        if ((end - begin) * cells < kPartLeast && end < 1.0L) {
            continue; // `begin` stays: the next part has this one in it
        }
        const Place middle = placeBelow(at((begin + end) / 2.0L));
        const Triangle triangle =
            triangleAt(middle.column, middle.row, middle.u >= middle.v, 0.0L, 0.0L);
        const auto above = [&](const Aim& point) {
            return point.z - triangle.height(point.column - static_cast<Real>(triangle.column),
                                             point.row - static_cast<Real>(triangle.row));
        };
        const Real above_begin = std::max(above(at(begin)), 0.0L);
        const Real above_end = above(at(end));
        if (above_end < 0.0L) {
            const Real t = begin + (end - begin) * above_begin / (above_begin - above_end);
            cells *= t;
            const Aim hit = at(t);
            Place place{triangle.column, triangle.row,
                        std::clamp(hit.column - static_cast<Real>(triangle.column), 0.0L, 1.0L),
                        std::clamp(hit.row - static_cast<Real>(triangle.row), 0.0L, 1.0L)};
            if (triangle.is_upper ? place.u < place.v : place.u > place.v) {
                place.v = place.u;
            }
            return onFeature(place);
        }
        begin = end;
    }
    return std::nullopt;
}

// Moves by (du, dv) from the position in the triangle, or up to its border.
ReferenceProxy::Place ReferenceProxy::alongFace(const Triangle& triangle, Real du, Real dv)
{
    Real share = 1.0L;
    enum class Border { None, Row, Column, Diagonal } border = Border::None;
    const auto meet = [&](Real room, Real speed, Border met) {
        if (speed > 0.0L && room / speed < share) {
            share = room / speed;
            border = met;
        }
    };
    if (triangle.is_upper) {
        meet(triangle.v, -dv, Border::Row);
        meet(1.0L - triangle.u, du, Border::Column);
        meet(triangle.u - triangle.v, dv - du, Border::Diagonal);
    } else {
        meet(1.0L - triangle.v, dv, Border::Row);
        meet(triangle.u, -du, Border::Column);
        meet(triangle.v - triangle.u, du - dv, Border::Diagonal);
    }
    Place to{triangle.column, triangle.row, std::clamp(triangle.u + share * du, 0.0L, 1.0L),
             std::clamp(triangle.v + share * dv, 0.0L, 1.0L)};
    if (border == Border::Row) {
        to.v = triangle.is_upper ? 0.0L : 1.0L;
    }
    if (border == Border::Column) {
        to.u = triangle.is_upper ? 1.0L : 0.0L;
    }
    if (border == Border::Diagonal || (triangle.is_upper ? to.u < to.v : to.u > to.v)) {
        to.v = to.u;
    }
    return onFeature(to);
}

// Rounding error, in meters, of the vector from the position to the goal.
Real ReferenceProxy::rounding(const Around& around) const
{
    Real size = std::abs(aim_.z) + cell_m_;
    for (int i = 0; i < around.count; ++i) {
        const Triangle& triangle = around.triangles[i];
        size = std::max(size, std::abs(triangle.z) + std::abs(triangle.per_column) +
                                  std::abs(triangle.per_row));
    }
    return kRounding * size;
}

// Leaves the surface if the straight path to the goal is free, and follows it.
bool ReferenceProxy::release(const Around& around, const Vector& to_goal)
{
    const Real columns = (aim_.column - static_cast<Real>(place_.column)) - place_.u;
    const Real rows = (aim_.row - static_cast<Real>(place_.row)) - place_.v;
    for (int i = 0; i < around.count; ++i) {
        const Triangle& triangle = around.triangles[i];
        const Real rise = triangle.per_column * columns + triangle.per_row * rows;
        const Real least = kCosineLeast * (std::abs(to_goal.z) + std::abs(rise) +
                                           std::sqrt(dot(to_goal, to_goal)));
        if (!triangle.holds(columns, rows) || to_goal.z - rise <= least) {
            continue;
        }
        const Aim from{static_cast<Real>(place_.column) + place_.u,
                       static_cast<Real>(place_.row) + place_.v,
                       triangle.height(triangle.u, triangle.v)};
        Real cells = 0.0L;
        const std::optional<Place> hit = cast(from, aim_, cells);
        if (hit && cells < kPartLeast) {
            return false; // out of the surface by rounding only
        }
        is_free_ = !hit;
        place_ = hit.value_or(place_);
        return true;
    }
    return false;
}

// One step of steepest descent for the current goal. False at a minimum.
bool ReferenceProxy::stepDown()
{
    const Around around = this->around(place_);
    const Triangle& first = around.triangles[0];
    const Real columns = (aim_.column - static_cast<Real>(place_.column)) - place_.u;
    const Real rows = (aim_.row - static_cast<Real>(place_.row)) - place_.v;
    const Vector to_goal = offset(columns, rows, aim_.z - first.height(first.u, first.v));
    if (release(around, to_goal)) {
        return !is_free_;
    }
    Move best;
    const Real determinant = column_.x * row_.y - column_.y * row_.x;
    for (int i = 0; i < around.count; ++i) {
        const Triangle& triangle = around.triangles[i];
        // The foot of the goal on the plane, and the vector to it in columns and rows.
        const Vector along{column_.x, column_.y, triangle.per_column};
        const Vector down{row_.x, row_.y, triangle.per_row};
        const Vector normal{along.y * down.z - along.z * down.y,
                            along.z * down.x - along.x * down.z,
                            along.x * down.y - along.y * down.x};
        const Real share = dot(to_goal, normal) / dot(normal, normal);
        const Vector way{to_goal.x - share * normal.x, to_goal.y - share * normal.y,
                         to_goal.z - share * normal.z};
        const Real du = (way.x * row_.y - way.y * row_.x) / determinant;
        const Real dv = (way.y * column_.x - way.x * column_.y) / determinant;
        if (triangle.holds(du, dv)) {
            const Real gain_squared = dot(way, way);
            if (gain_squared > best.gain_squared) {
                best = {gain_squared, alongFace(triangle, du, dv)};
            }
            continue; // no border of this triangle is steeper
        }
        const std::array<std::array<Real, 2>, 3> corners{
            {{0.0L, 0.0L},
             {1.0L, 1.0L},
             {triangle.is_upper ? 1.0L : 0.0L, triangle.is_upper ? 0.0L : 1.0L}}};
        for (const auto& [corner_u, corner_v] : corners) {
            const Real u = corner_u - triangle.u;
            const Real v = corner_v - triangle.v;
            if (u == 0.0L && v == 0.0L) {
                continue;
            }
            const Vector edge = offset(u, v, triangle.per_column * u + triangle.per_row * v);
            const Real closer = dot(to_goal, edge);
            const Real edge_squared = dot(edge, edge);
            if (closer <= 0.0L) {
                continue;
            }
            const Real gain_squared = closer / edge_squared * closer;
            if (gain_squared > best.gain_squared) {
                const Real part = closer / edge_squared;
                Place to{triangle.column, triangle.row, corner_u, corner_v};
                if (part < 1.0L) {
                    const bool is_diagonal = triangle.u == triangle.v && corner_u == corner_v;
                    to.u = triangle.u + part * u;
                    to.v = is_diagonal ? to.u : triangle.v + part * v;
                }
                best = {gain_squared, onFeature(to)};
            }
        }
    }
    const Real least = kCosineLeast * std::sqrt(dot(to_goal, to_goal)) + rounding(around);
    if (!(best.gain_squared > least * least)) {
        return false;
    }
    place_ = best.to;
    return true;
}

void ReferenceProxy::settle()
{
    int tiny_steps = 0;
    for (int step = 0; step < kStepsMax; ++step) {
        const Place before = place_;
        if (!stepDown()) {
            return;
        }
        const Real columns = static_cast<Real>(place_.column - before.column) + place_.u - before.u;
        const Real rows = static_cast<Real>(place_.row - before.row) + place_.v - before.v;
        const bool is_tiny = std::abs(columns) + std::abs(rows) < 4.0L * kOn;
        tiny_steps = is_tiny ? tiny_steps + 1 : 0;
        if (tiny_steps > kTinyStepsMax) {
            return;
        }
    }
    ++unfinished_count_;
}

void ReferenceProxy::followLeg(const Aim& from, const Aim& to)
{
    const Vector motion = offset(to.column - from.column, to.row - from.row, to.z - from.z);
    const Real count =
        std::clamp(std::ceil(std::sqrt(dot(motion, motion)) / piece_m_), 1.0L, kPiecesMax);
    const auto pieces = static_cast<std::int32_t>(count);
    for (std::int32_t piece = 1; piece <= pieces; ++piece) {
        const Real share = static_cast<Real>(piece) / count;
        const Aim last = aim_;
        aim_ = piece == pieces
                   ? to
                   : Aim{from.column + share * (to.column - from.column),
                         from.row + share * (to.row - from.row), from.z + share * (to.z - from.z)};
        if (is_free_) {
            Real cells = 0.0L;
            const std::optional<Place> hit = cast(last, aim_, cells);
            is_free_ = !hit;
            place_ = hit.value_or(place_);
        }
        if (!is_free_) {
            settle();
        }
    }
}

// The goal as given moves straight; as clamped it bends where it crosses the border.
void ReferenceProxy::follow(const ScenePoint& goal)
{
    const auto grid = [this](const ScenePoint& point) {
        const Real determinant = column_.x * row_.y - column_.y * row_.x;
        const Real x = point.x;
        const Real y = point.y;
        return std::array<Real, 2>{static_cast<Real>(surface_.frame().origin.column) +
                                       (x * row_.y - y * row_.x) / determinant,
                                   static_cast<Real>(surface_.frame().origin.row) +
                                       (y * column_.x - x * column_.y) / determinant};
    };
    const auto [to_column, to_row] = grid(goal);
    if (!is_placed_) {
        aim_ = aimAt(to_column, to_row, goal.z);
        is_free_ = aim_.z > heightAt(aim_.column, aim_.row);
        if (!is_free_) {
            place_ = onFeature(placeBelow(aim_));
            settle();
        }
    } else {
        const auto [from_column, from_row] = grid(goal_);
        std::array<Real, 6> times{0.0L, 1.0L, 1.0L, 1.0L, 1.0L, 1.0L};
        std::size_t count = 1;
        const auto cross = [&](Real from, Real to, Real line) {
            const Real t = (line - from) / (to - from);
            if (t > 0.0L && t < 1.0L) {
                times[count++] = t;
            }
        };
        cross(from_column, to_column, 0.0L);
        cross(from_column, to_column, last_column_);
        cross(from_row, to_row, 0.0L);
        cross(from_row, to_row, last_row_);
        std::sort(times.begin(), times.end());
        const Aim end = aimAt(to_column, to_row, goal.z);
        for (std::size_t i = 1; i <= count; ++i) {
            const Real t = times[i];
            const Aim to =
                t == 1.0L ? end
                          : aimAt(from_column + t * (to_column - from_column),
                                  from_row + t * (to_row - from_row),
                                  static_cast<Real>(goal_.z) +
                                      t * (static_cast<Real>(goal.z) - static_cast<Real>(goal_.z)));
            followLeg(aim_, to);
        }
    }
    is_placed_ = true;
    goal_ = goal;
}

ReferenceProxy::State ReferenceProxy::state() const
{
    Aim at = aim_;
    if (!is_free_) {
        at = {static_cast<Real>(place_.column) + place_.u, static_cast<Real>(place_.row) + place_.v,
              triangleAt(place_.column, place_.row, place_.u >= place_.v, 0.0L, 0.0L)
                  .height(place_.u, place_.v)};
    }
    const Vector point = offset(at.column - static_cast<Real>(surface_.frame().origin.column),
                                at.row - static_cast<Real>(surface_.frame().origin.row), at.z);
    return {.proxy = {static_cast<double>(point.x), static_cast<double>(point.y),
                      static_cast<double>(point.z)},
            .is_in_contact = !is_free_};
}

ReferenceProxy::State ReferenceProxy::place(const ScenePoint& goal)
{
    is_placed_ = false;
    return update(goal);
}

ReferenceProxy::State ReferenceProxy::update(const ScenePoint& goal)
{
    if (surface_.goal(goal)) {
        follow(goal);
    }
    return state();
}

} // namespace marsview
