// Notation. A place is (u, v) in its cell. The surface's height is affine over a triangle, and so
// is f(t) = z(t) - surface(t) along a segment: one sign change decides hit and release together.
// What is known exactly stays exact: a place on an edge has the edge's coordinate as 0 or 1, one on
// a diagonal has u = v, and crossings of grid lines are snapped to them, where only the two samples
// of the line count, so that neighbouring cells see the same f.

#include "core/contact/heightfield_surface.h"

#include "core/base/check.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace marsview {

using Contact = HeightfieldSurface::Contact;
using Face = HeightfieldSurface::Face;

HeightfieldSurface::HeightfieldSurface(std::shared_ptr<const FilledHeightfield> terrain,
                                       const SceneFrame& frame,
                                       double exaggeration)
    : terrain_(std::move(terrain))
    , frame_(frame)
    , exaggeration_(exaggeration)
    , column_{frame.east_per_column, frame.north_per_column, 0.0}
    , row_{frame.east_per_row, frame.north_per_row, 0.0}
{
    for (std::size_t i = 0; i < kSpokes.size(); ++i) {
        spokes_[i] = column_ * static_cast<double>(kSpokes[i].column) +
                     row_ * static_cast<double>(kSpokes[i].row);
    }
    MARSVIEW_CHECK(terrain_ && exaggeration > 0.0 && std::isfinite(exaggeration));
    constexpr std::size_t kSideMax = std::size_t{1} << 30;
    MARSVIEW_CHECK(terrain_->columns() < kSideMax && terrain_->rows() < kSideMax);
    const double determinant = column_.x * row_.y - column_.y * row_.x;
    MARSVIEW_CHECK(determinant != 0.0 && std::isfinite(determinant));
    last_column_ = static_cast<std::int32_t>(terrain_->columns() - 1);
    last_row_ = static_cast<std::int32_t>(terrain_->rows() - 1);
    is_mirrored_ = determinant > 0.0; // rows count downward, so the usual frame is negative
    // A straight way across the map meets three features a cell: four times that, and what short
    // ways from one peak of a checkerboard to the next may need.
    const auto across = static_cast<std::uint32_t>(terrain_->columns() + terrain_->rows());
    steps_max_ = 4096U + 12U * std::min(across, 1U << 27U);
}

HeightfieldSurface::InCell HeightfieldSurface::cellOf(GridPoint grid) const noexcept
{
    const double c = std::clamp(grid.column, 0.0, static_cast<double>(last_column_));
    const double r = std::clamp(grid.row, 0.0, static_cast<double>(last_row_));
    // The last sample belongs to the last cell.
    const auto column = std::min(static_cast<std::int32_t>(c), last_column_ - 1);
    const auto row = std::min(static_cast<std::int32_t>(r), last_row_ - 1);
    return {column, row, c - static_cast<double>(column), r - static_cast<double>(row)};
}

double HeightfieldSurface::height(GridPoint grid) const noexcept
{
    return heightAt(cellOf(grid));
}

bool HeightfieldSurface::isOverVoid(const ScenePoint& point) const noexcept
{
    const InCell at = cellOf(frame_.toGrid(point));
    const bool is_upper = at.u >= at.v;
    const auto is_void = [&](double weight, std::size_t columns, std::size_t rows) {
        return weight > 0.0 && terrain_->isVoid(static_cast<std::size_t>(at.column) + columns,
                                                static_cast<std::size_t>(at.row) + rows);
    };
    return is_void(1.0 - std::max(at.u, at.v), 0, 0) || is_void(std::min(at.u, at.v), 1, 1) ||
           is_void(std::abs(at.u - at.v), is_upper ? 1 : 0, is_upper ? 0 : 1);
}

std::optional<HeightfieldSurface::Goal>
HeightfieldSurface::goal(const ScenePoint& point) const noexcept
{
    if (!(std::abs(point.x) <= kGoalMaxM && std::abs(point.y) <= kGoalMaxM &&
          std::abs(point.z) <= kGoalMaxM)) {
        return std::nullopt;
    }
    const GridPoint grid = frame_.toGrid(point);
    if (!std::isfinite(grid.column) || !std::isfinite(grid.row)) {
        return std::nullopt;
    }
    Goal goal{{std::clamp(grid.column, 0.0, static_cast<double>(last_column_)),
               std::clamp(grid.row, 0.0, static_cast<double>(last_row_))},
              point};
    if (!(goal.grid == grid)) {
        goal.scene = frame_.toScene(goal.grid, point.z);
    }
    return goal;
}

Contact HeightfieldSurface::contactIn(const InCell& at, bool is_upper) const noexcept
{
    // Zero exactly where the place is on an edge. Rounding may have put it beyond the diagonal.
    const double upper_left = 1.0 - (is_upper ? at.u : at.v);
    const double lower_right = is_upper ? at.v : at.u;
    const double third = std::max(is_upper ? at.u - at.v : at.v - at.u, 0.0);
    const Face face{at.column, at.row, is_upper};
    return contactOnFace(*this, face,
                         face.is_upper != is_mirrored_
                             ? std::array{upper_left, lower_right, third}
                             : std::array{upper_left, third, lower_right});
}

SurfaceTriangle<HeightfieldSurface> HeightfieldSurface::triangle(Face face,
                                                                 const Goal& goal) const noexcept
{
    const CellHeights z = cellHeights(face.column, face.row);
    const Vec3 third = face.is_upper ? offset(1.0, 0.0, z.upper_right - z.upper_left)
                                     : offset(0.0, 1.0, z.lower_left - z.upper_left);
    const Vec3 lower_right = offset(1.0, 1.0, z.lower_right - z.upper_left);
    const bool is_third_last = face.is_upper != is_mirrored_; // as in corners()
    return {is_third_last ? lower_right : third, is_third_last ? third : lower_right,
            offset(goal.grid.column - static_cast<double>(face.column),
                   goal.grid.row - static_cast<double>(face.row), goal.scene.z - z.upper_left)};
}

Contact HeightfieldSurface::contactAt(const Goal& goal) const noexcept
{
    const InCell at = cellOf(goal.grid);
    return contactIn(at, at.u >= at.v);
}

Contact HeightfieldSurface::initialContact() const noexcept
{
    Contact contact;
    contact.feature = ContactFeature::Vertex;
    contact.vertex = {last_column_ / 2, last_row_ / 2};
    return contact;
}

std::array<std::optional<HeightfieldSurface::Wing>, 2>
HeightfieldSurface::wings(Edge edge) const noexcept
{
    const auto [column, row] = edge.first;
    // corners() puts the third sample, neither upper left nor lower right, last or in the middle.
    const auto third = [this](bool is_upper) { return is_upper != is_mirrored_ ? 2 : 1; };
    const auto lower_right = [this](bool is_upper) { return is_upper != is_mirrored_ ? 1 : 2; };
    std::array<std::optional<Wing>, 2> wings;
    switch (edge.kind) {
    case Edge::Kind::AlongRow:
        if (row < last_row_) {
            wings[0] = Wing{{column, row, true}, lower_right(true)};
        }
        if (row > 0) {
            wings[1] = Wing{{column, row - 1, false}, 0};
        }
        break;
    case Edge::Kind::AlongColumn:
        if (column < last_column_) {
            wings[0] = Wing{{column, row, false}, lower_right(false)};
        }
        if (column > 0) {
            wings[1] = Wing{{column - 1, row, true}, 0};
        }
        break;
    case Edge::Kind::Diagonal:
        wings[0] = Wing{{column, row, true}, third(true)};
        wings[1] = Wing{{column, row, false}, third(false)};
        break;
    }
    return wings;
}

HeightfieldSurface::InCell HeightfieldSurface::within(const Contact& contact,
                                                      Face face) const noexcept
{
    InCell at{face.column, face.row, 0.0, 0.0};
    switch (contact.feature) {
    case ContactFeature::Vertex:
        at.u = static_cast<double>(contact.vertex.column - face.column);
        at.v = static_cast<double>(contact.vertex.row - face.row);
        break;
    case ContactFeature::Edge:
        at.u = static_cast<double>(contact.edge.first.column - face.column) +
               (contact.edge.kind != Edge::Kind::AlongColumn ? contact.along : 0.0);
        at.v = static_cast<double>(contact.edge.first.row - face.row) +
               (contact.edge.kind != Edge::Kind::AlongRow ? contact.along : 0.0);
        break;
    default: {
        const bool is_third_last = face.is_upper != is_mirrored_;
        const double third = contact.weights[is_third_last ? 2 : 1];
        const double lower_right = contact.weights[is_third_last ? 1 : 2];
        at.u = std::min(lower_right + (face.is_upper ? third : 0.0), 1.0);
        at.v = std::min(lower_right + (face.is_upper ? 0.0 : third), 1.0);
        break;
    }
    }
    return at;
}

namespace {

// Some face that has the contact on it.
Face someFaceOf(const HeightfieldSurface& surface, const Contact& contact) noexcept
{
    if (contact.feature == ContactFeature::Face) {
        return contact.face;
    }
    if (contact.feature == ContactFeature::Edge) {
        const auto wings = surface.wings(contact.edge);
        return wings[0] ? wings[0]->face : wings[1]->face;
    }
    const auto last_column = static_cast<std::int32_t>(surface.terrain()->columns() - 1);
    const auto last_row = static_cast<std::int32_t>(surface.terrain()->rows() - 1);
    const std::int32_t column = std::min(contact.vertex.column, last_column - 1);
    const std::int32_t row = std::min(contact.vertex.row, last_row - 1);
    return {column, row, contact.vertex.column - column >= contact.vertex.row - row};
}

} // namespace

GridPoint HeightfieldSurface::gridPoint(const Contact& contact) const noexcept
{
    const InCell at = within(contact, someFaceOf(*this, contact));
    return {static_cast<double>(at.column) + at.u, static_cast<double>(at.row) + at.v};
}

ScenePoint HeightfieldSurface::point(const Contact& contact) const noexcept
{
    const InCell at = within(contact, someFaceOf(*this, contact));
    return frame_.toScene(
        {static_cast<double>(at.column) + at.u, static_cast<double>(at.row) + at.v}, heightAt(at));
}

HeightfieldSurface::Fan HeightfieldSurface::fan(Vertex v) const noexcept
{
    const bool has_right = v.column < last_column_;
    const bool has_below = v.row < last_row_;
    const bool has_left = v.column > 0;
    const bool has_above = v.row > 0;
    const auto column = static_cast<std::size_t>(v.column);
    const auto row = static_cast<std::size_t>(v.row);
    // What does not exist is read from inside and not used.
    const std::size_t right = column + (has_right ? 1 : 0);
    const std::size_t below = row + (has_below ? 1 : 0);
    const std::size_t left = column - (has_left ? 1 : 0);
    const std::size_t above = row - (has_above ? 1 : 0);
    const std::array<double, 7> z = terrain_->sevenSamples(column, row, left, right, above, below);
    const double e = exaggeration_;
    return {
        v,
        e * z[0],
        {e * z[1], e * z[2], e * z[3], e * z[4], e * z[5], e * z[6]},
        {has_right, has_right && has_below, has_below, has_left, has_left && has_above, has_above}};
}

namespace {

// Whether the goal is above a plane by more than rounding error. The plane's height at the goal is
// the sum of the last three.
bool isAbovePlane(double goal, double base, double across, double down) noexcept
{
    constexpr double kTolerance = 16.0 * std::numeric_limits<double>::epsilon();
    const double magnitude = std::abs(goal) + std::abs(base) + std::abs(across) + std::abs(down);
    return goal - (base + across + down) > kTolerance * magnitude;
}

} // namespace

std::optional<Face> HeightfieldSurface::wayOut(const Fan& fan, const Goal& goal) const noexcept
{
    // The face over which the way begins, from above, tells the quadrant and the side of the
    // diagonal. Along an edge either face will do, straight up any will.
    const auto [column, row] = fan.vertex;
    const double columns = goal.grid.column - static_cast<double>(column);
    const double rows = goal.grid.row - static_cast<double>(row);
    const bool is_right = columns > 0.0 || (columns == 0.0 && column < last_column_);
    const bool is_below = rows > 0.0 || (rows == 0.0 && row < last_row_);
    const bool is_upper = is_right == is_below ? columns >= rows : is_below;
    const auto& [right, right_below, below, left, left_above, above] = fan.around;
    double across = 0.0;
    double down = 0.0;
    if (is_right && is_below) {
        across = is_upper ? right - fan.height : right_below - below;
        down = is_upper ? right_below - right : below - fan.height;
    } else if (is_right) {
        across = right - fan.height;
        down = fan.height - above;
    } else if (is_below) {
        across = fan.height - left;
        down = below - fan.height;
    } else {
        across = is_upper ? above - left_above : fan.height - left;
        down = is_upper ? fan.height - above : left - left_above;
    }
    if (!isAbovePlane(goal.scene.z, fan.height, across * columns, down * rows)) {
        return std::nullopt;
    }
    return Face{is_right ? column : column - 1, is_below ? row : row - 1, is_upper};
}

std::optional<Face> HeightfieldSurface::wayOut(const Contact& contact,
                                               const Goal& goal) const noexcept
{
    if (contact.feature == ContactFeature::Vertex) {
        return wayOut(fan(contact.vertex), goal);
    }
    Face face = contact.face;
    if (contact.feature == ContactFeature::Edge) {
        const auto [column, row] = contact.edge.first;
        const double columns = goal.grid.column - static_cast<double>(column);
        const double rows = goal.grid.row - static_cast<double>(row);
        const auto wings = this->wings(contact.edge);
        const double to_first = contact.edge.kind == Edge::Kind::AlongRow      ? rows
                                : contact.edge.kind == Edge::Kind::AlongColumn ? columns
                                                                               : columns - rows;
        const bool is_first = wings[0] && (to_first >= 0.0 || !wings[1]);
        face = is_first ? wings[0]->face : wings[1]->face;
    }
    const CellHeights z = cellHeights(face.column, face.row);
    const double u = goal.grid.column - static_cast<double>(face.column);
    const double v = goal.grid.row - static_cast<double>(face.row);
    const double across =
        u * (face.is_upper ? z.upper_right - z.upper_left : z.lower_right - z.lower_left);
    const double down =
        v * (face.is_upper ? z.lower_right - z.upper_right : z.lower_left - z.upper_left);
    return isAbovePlane(goal.scene.z, z.upper_left, across, down) ? std::optional(face)
                                                                  : std::nullopt;
}

// One segment over the grid, cell after cell from its start. Over blocks, and over larger nodes of
// the hierarchy, that lie below it, it goes in one step.
class HeightfieldCast {
public:
    using InCell = HeightfieldSurface::InCell;
    using Goal = HeightfieldSurface::Goal;
    using Cast = HeightfieldSurface::Cast;

    // `over` is the half of the start's cell over which the segment leaves the surface; nothing
    // where the start is above the surface.
    HeightfieldCast(const HeightfieldSurface& surface,
                    const InCell& start,
                    double start_z,
                    std::optional<bool> over,
                    const Goal& goal) noexcept
        : surface_(surface)
        , terrain_(*surface.terrain_)
        , goal_(goal)
        , column_(start.column)
        , row_(start.row)
        , origin_column_(start.column)
        , origin_row_(start.row)
        , u_(start.u)
        , v_(start.v)
        , columns_((goal.grid.column - static_cast<double>(start.column)) - start.u)
        , rows_((goal.grid.row - static_cast<double>(start.row)) - start.v)
        , z_(start_z)
        , up_(goal.scene.z - start_z)
        , over_(over)
    {
        // Less than this is nothing, and its inverse would not be finite.
        constexpr double kLeast = 1e-300;
        columns_ = std::abs(columns_) < kLeast ? 0.0 : columns_;
        rows_ = std::abs(rows_) < kLeast ? 0.0 : rows_;
        per_column_ = columns_ == 0.0 ? 0.0 : 1.0 / columns_;
        per_row_ = rows_ == 0.0 ? 0.0 : 1.0 / rows_;
        // On a grid line, going to smaller coordinates: the cell before it.
        if (u_ == 0.0 && columns_ < 0.0 && column_ > 0 && !over_) {
            --column_;
        }
        if (v_ == 0.0 && rows_ < 0.0 && row_ > 0 && !over_) {
            --row_;
        }
    }

    Cast cast() noexcept
    {
        if (over_ && stepInCell()) {
            return result_;
        }
        std::size_t level = 0;
        // Every turn passes a cell, or a node that no later turn comes back to.
        while (true) {
            while (level > 0 && !isClear(level)) {
                --level;
            }
            if (level == 0 && !isClear(0)) {
                if (walkBlock()) {
                    return result_;
                }
                continue;
            }
            while (level + 1 < terrain_.levelCount() && exitOf(level) < 1.0 && isClear(level + 1)) {
                ++level;
            }
            if (passNode(level)) {
                return result_;
            }
        }
    }

private:
    static constexpr std::size_t kBlock = MinMaxPyramid::kBlock;

    // Where the segment crosses the grid line between two columns or rows.
    double timeOfColumn(std::int32_t line) const noexcept
    {
        return (static_cast<double>(line - origin_column_) - u_) * per_column_;
    }
    double timeOfRow(std::int32_t line) const noexcept
    {
        return (static_cast<double>(line - origin_row_) - v_) * per_row_;
    }
    double columnAt(double t) const noexcept
    {
        return static_cast<double>(origin_column_) + (u_ + t * columns_);
    }
    double rowAt(double t) const noexcept
    {
        return static_cast<double>(origin_row_) + (v_ + t * rows_);
    }
    double heightAt(double t) const noexcept { return t == 1.0 ? goal_.scene.z : z_ + t * up_; }

    struct Node {
        std::int32_t left;
        std::int32_t right; // the last grid line
        std::int32_t upper;
        std::int32_t lower;
    };
    Node nodeAt(std::size_t level) const noexcept
    {
        const auto shift = static_cast<int>(level) + 5;
        static_assert(kBlock == 1U << 5U);
        const std::int32_t left = (column_ >> shift) << shift;
        const std::int32_t upper = (row_ >> shift) << shift;
        const std::int64_t side = std::int64_t{1} << shift;
        return {
            left,
            static_cast<std::int32_t>(std::min<std::int64_t>(left + side, surface_.last_column_)),
            upper,
            static_cast<std::int32_t>(std::min<std::int64_t>(upper + side, surface_.last_row_))};
    }
    struct Exit {
        double t;
        bool by_column;
        bool by_row;
    };
    Exit exitFrom(const Node& node) const noexcept
    {
        // The border of the map is never crossed: goals lie on it at most.
        constexpr double kNever = std::numeric_limits<double>::infinity();
        double column = kNever;
        if (columns_ > 0.0 && node.right < surface_.last_column_) {
            column = timeOfColumn(node.right);
        } else if (columns_ < 0.0 && node.left > 0) {
            column = timeOfColumn(node.left);
        }
        double row = kNever;
        if (rows_ > 0.0 && node.lower < surface_.last_row_) {
            row = timeOfRow(node.lower);
        } else if (rows_ < 0.0 && node.upper > 0) {
            row = timeOfRow(node.upper);
        }
        const double t = std::max(std::min({column, row, 1.0}), t_);
        return {t, column <= t && column < 1.0, row <= t && row < 1.0};
    }
    double exitOf(std::size_t level) const noexcept { return exitFrom(nodeAt(level)).t; }

    bool isClear(std::size_t level) const noexcept
    {
        const double t = exitOf(level);
        const double lowest = std::min(heightAt(t_), heightAt(t));
        const auto shift = static_cast<int>(level) + 5;
        const double highest = surface_.exaggeration_ *
                               terrain_.maximum(level, static_cast<std::size_t>(column_ >> shift),
                                                static_cast<std::size_t>(row_ >> shift));
        return lowest > highest;
    }

    // Goes to the cell behind an exit. True where the segment ends before.
    bool advance(const Node& node, const Exit& exit) noexcept
    {
        t_ = exit.t;
        entered_by_column_ = exit.by_column;
        entered_by_row_ = exit.by_row;
        if (!exit.by_column && !exit.by_row) {
            return true;
        }
        if (exit.by_column) {
            column_ = columns_ > 0.0 ? node.right : node.left - 1;
        } else {
            column_ = std::clamp(cellAt(columnAt(t_)), node.left, node.right - 1);
        }
        if (exit.by_row) {
            row_ = rows_ > 0.0 ? node.lower : node.upper - 1;
        } else {
            row_ = std::clamp(cellAt(rowAt(t_)), node.upper, node.lower - 1);
        }
        return false;
    }
    static std::int32_t cellAt(double position) noexcept
    {
        return static_cast<std::int32_t>(std::floor(position));
    }

    bool passNode(std::size_t level) noexcept
    {
        const Node node = nodeAt(level);
        return advance(node, exitFrom(node)); // above the maximum: the end is free
    }

    bool walkBlock() noexcept
    {
        const Node block = nodeAt(0);
        do {
            if (stepInCell()) {
                return true;
            }
        } while (column_ >= block.left && column_ < block.right && row_ >= block.upper &&
                 row_ < block.lower);
        return false;
    }

    // Looks at one cell and goes on to the next. True where the cast is over.
    bool stepInCell() noexcept
    {
        ++result_.cells;
        const Node cell{column_, column_ + 1, row_, row_ + 1};
        const Exit exit = exitFrom(cell);
        const bool is_end = !exit.by_column && !exit.by_row;
        const CellHeights z = surface_.cellHeights(column_, row_);
        const auto leaving = std::exchange(over_, std::nullopt);
        const double highest =
            std::max(std::max(z.upper_left, z.upper_right), std::max(z.lower_left, z.lower_right));
        if (std::min(heightAt(t_), heightAt(exit.t)) <= highest) {
            InCell begin = inCell(t_);
            if (t_ == 0.0) {
                begin.u = static_cast<double>(origin_column_ - column_) + u_;
                begin.v = static_cast<double>(origin_row_ - row_) + v_;
            }
            if (entered_by_column_) {
                begin.u = columns_ > 0.0 ? 0.0 : 1.0;
            }
            if (entered_by_row_) {
                begin.v = rows_ > 0.0 ? 0.0 : 1.0;
            }
            InCell end = inCell(exit.t);
            if (exit.by_column) {
                end.u = columns_ > 0.0 ? 1.0 : 0.0;
            }
            if (exit.by_row) {
                end.v = rows_ > 0.0 ? 1.0 : 0.0;
            }
            if (is_end) {
                end.u = std::clamp(goal_.grid.column - static_cast<double>(column_), 0.0, 1.0);
                end.v = std::clamp(goal_.grid.row - static_cast<double>(row_), 0.0, 1.0);
            }
            if (castInCell(z, begin, end, exit.t, is_end, leaving)) {
                return true;
            }
        }
        return advance(cell, exit);
    }

    InCell inCell(double t) const noexcept
    {
        return {column_, row_, std::clamp(columnAt(t) - static_cast<double>(column_), 0.0, 1.0),
                std::clamp(rowAt(t) - static_cast<double>(row_), 0.0, 1.0)};
    }

    // True with the contact in result_ where the segment goes below the surface in this cell, or
    // ends on it.
    bool castInCell(const CellHeights& z,
                    const InCell& begin,
                    const InCell& end,
                    double t_end,
                    bool is_end,
                    std::optional<bool> leaving) noexcept
    {
        const double f_begin =
            leaving ? 0.0 : std::max(heightAt(t_) - heightInCell(z, begin.u, begin.v), 0.0);
        // At the goal, as isAbove() sees it.
        const double f_end = is_end ? goal_.scene.z - surface_.height(goal_.grid)
                                    : heightAt(t_end) - heightInCell(z, end.u, end.v);
        const double w_begin = begin.u - begin.v;
        const double w_end = end.u - end.v;
        if ((w_begin > 0.0 && w_end < 0.0) || (w_begin < 0.0 && w_end > 0.0)) {
            const double share = w_begin / (w_begin - w_end);
            const double t = t_ + (t_end - t_) * share;
            InCell middle = begin;
            middle.u = std::clamp(begin.u + (end.u - begin.u) * share, 0.0, 1.0);
            middle.v = middle.u; // on the diagonal, exactly
            const double f_middle = heightAt(t) - heightInCell(z, middle.u, middle.v);
            return (!leaving && f_middle < 0.0 &&
                    hit(begin, middle, f_begin, f_middle, w_begin > 0.0)) ||
                   isHit(middle, end, std::max(f_middle, 0.0), f_end, w_end > 0.0, is_end);
        }
        if (leaving && !is_end) {
            return false; // the only piece, over the face that it was found to leave
        }
        // On the diagonal, the half is told by where the segment comes from or goes to.
        const bool is_upper = leaving          ? *leaving
                              : w_begin == 0.0 ? (w_end != 0.0 ? w_end > 0.0 : columns_ >= rows_)
                                               : w_begin > 0.0;
        if (leaving) {
            return f_end <= 0.0 && hit(end, end, 0.0, 0.0, is_upper);
        }
        return isHit(begin, end, f_begin, f_end, is_upper, is_end);
    }

    bool isHit(const InCell& begin,
               const InCell& end,
               double f_begin,
               double f_end,
               bool is_upper,
               bool is_end) noexcept
    {
        return (f_end < 0.0 || (is_end && f_end == 0.0)) &&
               hit(begin, end, f_begin, f_end, is_upper);
    }

    bool hit(const InCell& begin,
             const InCell& end,
             double f_begin,
             double f_end,
             bool is_upper) noexcept
    {
        const double share = f_end == 0.0 ? 1.0 : f_begin / (f_begin - f_end);
        InCell at = begin;
        at.u = std::clamp(begin.u + (end.u - begin.u) * share, 0.0, 1.0);
        at.v = std::clamp(begin.v + (end.v - begin.v) * share, 0.0, 1.0);
        if (share == 1.0) {
            at = end;
        }
        result_.contact = surface_.contactIn(at, is_upper);
        return true;
    }

    const HeightfieldSurface& surface_;
    const FilledHeightfield& terrain_;
    const Goal& goal_;
    std::int32_t column_; // of the cell where the segment is at t_
    std::int32_t row_;
    std::int32_t origin_column_;
    std::int32_t origin_row_;
    double u_; // of the start, in the cell of the origin
    double v_;
    double columns_; // from start to goal
    double rows_;
    double z_;
    double up_;
    double per_column_ = 0.0;
    double per_row_ = 0.0;
    double t_ = 0.0;
    bool entered_by_column_ = false;
    bool entered_by_row_ = false;
    std::optional<bool> over_;
    Cast result_;
};

HeightfieldSurface::Cast
HeightfieldSurface::castFrom(const Contact& contact, Face over, const Goal& goal) const noexcept
{
    const InCell start = within(contact, over);
    return HeightfieldCast(*this, start, heightAt(start), over.is_upper, goal).cast();
}

HeightfieldSurface::Cast HeightfieldSurface::castFree(const Goal& from,
                                                      const Goal& to) const noexcept
{
    return HeightfieldCast(*this, cellOf(from.grid), from.scene.z, std::nullopt, to).cast();
}

} // namespace marsview
