// A heightfield in scene meters as contact models see it (contact_surface.h).
#pragma once

#include "core/contact/contact_surface.h"
#include "core/contact/scene_heights.h"
#include "core/geo/scene_frame.h"
#include "core/terrain/filled_heightfield.h"
#include "core/terrain/touch_terrain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

namespace marsview {

struct HeightfieldVertex {
    std::int32_t column = 0;
    std::int32_t row = 0;
    bool operator==(const HeightfieldVertex&) const = default;
};
/// From `first` one column to the right, one row down, or both.
struct HeightfieldEdge {
    enum class Kind : std::uint8_t { AlongRow, AlongColumn, Diagonal };
    HeightfieldVertex first;
    Kind kind = Kind::AlongRow;
};
/// The half of the cell (column, row) right above or left below its diagonal.
struct HeightfieldFace {
    std::int32_t column = 0;
    std::int32_t row = 0;
    bool is_upper = false;
};
struct HeightfieldGoal {
    GridPoint grid; // within the outermost samples
    ScenePoint scene;
};
/// A sample and those at the ends of its edges, read once.
struct HeightfieldFan {
    HeightfieldVertex vertex;
    double height; // in scene meters
    std::array<double, 6> around;
    std::array<bool, 6> exists;
};

/// A face as walks see it; the walk chooses the first corner (contact_surface.h).
///
/// Notation. a and b lead from the first corner to the second and third, horizontally, and rise by
/// `a_up` and `b_up`; M is the inverse of the matrix of their dot products; f = M (a_up, b_up).
/// With the goal at x a + y b, z above the first corner, and w = x f_b - y f_a, its foot on the
/// plane is at (x + z f_a + b_up w) a + (y + z f_b - a_up w) b, times 1/scale, where scale = 1 +
/// a_up f_a + b_up f_b. Nothing in it cancels on steep faces.
struct HeightfieldFacet {
    std::array<HeightfieldVertex, 3> vertices; // counter-clockwise seen from free space
    std::array<std::uint8_t, 3> kinds;         // of the edges opposite: HeightfieldEdge::Kind
    std::array<double, 3> heights;
    double scale;
    double a_up;
    double b_up;
    double f_a;
    double f_b;
    // The first corner, and b and a in rows and columns, times their turn: 1 or -1.
    double column;
    double row;
    double b_rows;
    double b_columns;
    double a_rows;
    double a_columns;

    struct Seen {
        double x;
        double y;
        double z;
    };
    [[gnu::always_inline]] inline Seen seen(const HeightfieldGoal& goal) const noexcept
    {
        const double columns = goal.grid.column - column;
        const double rows = goal.grid.row - row;
        return {columns * b_rows - rows * b_columns, rows * a_columns - columns * a_rows,
                goal.scene.z - heights[0]};
    }

    [[gnu::always_inline]] inline SurfaceFoot foot(const HeightfieldGoal& goal) const noexcept
    {
        const auto [x, y, z] = seen(goal);
        const double w = x * f_b - y * f_a;
        const double second = (x + z * f_a) + b_up * w;
        const double third = (y + z * f_b) - a_up * w;
        return {{scale - (second + third), second, third}, z - (a_up * x + b_up * y)};
    }
    double error(const HeightfieldGoal& goal) const noexcept
    {
        constexpr double kTolerance = 16.0 * std::numeric_limits<double>::epsilon();
        const auto [x, y, z] = seen(goal);
        const double across = std::abs(x) + std::abs(y);
        return kTolerance *
               (scale +
                (1.0 + (std::abs(a_up) + std::abs(b_up)) * (std::abs(f_a) + std::abs(f_b))) *
                    across +
                std::abs(z) * (std::abs(f_a) + std::abs(f_b)));
    }
};

template <typename Heights>
class BasicHeightfieldSurface;

template <typename Heights>
class HeightfieldCast;

/// Sample (c, r) lies at frame.toScene({c, r}, exaggeration × height). Cells are cut as in
/// core/terrain/triangulation.h; voids are filled (FilledHeightfield). The frame may be rotated,
/// sheared or mirrored. Beyond the outermost samples goals are clamped, horizontally and in grid
/// coordinates, to the grid.
///
/// A small immutable value that shares the terrain: cheap to copy and to rebuild for another
/// exaggeration. Any thread; allocates nothing after construction. `Heights` reads the samples
/// (scene_heights.h); a model over PlainHeights moves exactly as one over FilledHeights, but
/// faster.
template <typename Heights>
class BasicHeightfieldSurface {
public:
    using Terrain = typename Heights::Terrain;
    static_assert(TouchTerrain<Terrain>);

    using Vertex = HeightfieldVertex;
    using Edge = HeightfieldEdge;
    using Face = HeightfieldFace;
    using Goal = HeightfieldGoal;
    using Fan = HeightfieldFan;
    using Contact = SurfaceContact<BasicHeightfieldSurface>;
    using Cast = SurfaceCast<BasicHeightfieldSurface>;
    using Spoke = SurfaceSpoke<BasicHeightfieldSurface>;
    using Wing = SurfaceWing<BasicHeightfieldSurface>;

    using Facet = HeightfieldFacet;

    static constexpr bool kIsBorderWall = true;
    /// Heights beyond this, in meters and not exaggerated, are refused as goals, like values that
    /// are not finite. Horizontally every goal is clamped.
    static constexpr double kGoalMaxM = 1e12;

    /// `exaggeration` > 0 and finite; the frame is invertible. The terrain has fewer than 2^30
    /// columns and rows, and samples that `Heights` can read.
    BasicHeightfieldSurface(std::shared_ptr<const Terrain> terrain,
                            const SceneFrame& frame,
                            double exaggeration);

    const std::shared_ptr<const Terrain>& terrain() const noexcept { return terrain_; }
    const SceneFrame& frame() const noexcept { return frame_; }
    double exaggeration() const noexcept { return exaggeration_; }

    /// Height of the surface in scene meters at a grid position, which is clamped to the grid.
    double height(GridPoint grid) const noexcept { return heightAt(cellOf(grid)); }
    /// Whether a void sample contributes to the surface at or below `point`.
    bool isOverVoid(const ScenePoint& point) const noexcept;

    std::optional<Goal> goal(const ScenePoint& point) const noexcept
    {
        if (!(std::abs(point.z) <= kGoalMaxM * std::max(exaggeration_, 1.0))) {
            return std::nullopt;
        }
        return clamped(frame_.toGrid(point), point);
    }
    ScenePoint goalPoint(const Goal& goal) const noexcept { return goal.scene; }
    bool isAbove(const Goal& goal) const noexcept { return goal.scene.z > height(goal.grid); }
    Goal along(const Goal& from, const Goal& to, double share) const noexcept
    {
        if (share >= 1.0) {
            return to;
        }
        const double c = from.grid.column + share * (to.grid.column - from.grid.column);
        const double r = from.grid.row + share * (to.grid.row - from.grid.row);
        return {{c, r}, from.scene + (to.scene - from.scene) * share};
    }
    SurfaceLegs<BasicHeightfieldSurface> legs(const ScenePoint& from,
                                              const ScenePoint& to) const noexcept;

    Contact contactAt(const Goal& goal) const noexcept
    {
        const InCell at = cellOf(goal.grid);
        return contactIn(at, at.u >= at.v);
    }
    /// The sample in the middle.
    Contact initialContact() const noexcept;

    Vec3 toGoal(Vertex from, const Goal& goal) const noexcept
    {
        return offset(goal.grid.column - static_cast<double>(from.column),
                      goal.grid.row - static_cast<double>(from.row), goal.scene.z - heightOf(from));
    }
    Vec3 between(Vertex from, Vertex to) const noexcept
    {
        return offset(static_cast<double>(to.column - from.column),
                      static_cast<double>(to.row - from.row), heightOf(to) - heightOf(from));
    }
    Vec3 toGoal(const Facet& from, std::size_t i, const Goal& goal) const noexcept
    {
        const auto [column, row] = from.vertices[i];
        return offset(goal.grid.column - static_cast<double>(column),
                      goal.grid.row - static_cast<double>(row), goal.scene.z - from.heights[i]);
    }
    Vec3 between(const Facet& facet, std::size_t from, std::size_t to) const noexcept
    {
        const Vertex& a = facet.vertices[from];
        const Vertex& b = facet.vertices[to];
        return offset(static_cast<double>(b.column - a.column), static_cast<double>(b.row - a.row),
                      facet.heights[to] - facet.heights[from]);
    }
    std::array<Vertex, 3> corners(Face face) const noexcept
    {
        const Vertex upper_left{face.column, face.row};
        const Vertex lower_right{face.column + 1, face.row + 1};
        const Vertex third{face.is_upper ? face.column + 1 : face.column,
                           face.is_upper ? face.row : face.row + 1};
        return face.is_upper != is_mirrored_ ? std::array{upper_left, lower_right, third}
                                             : std::array{upper_left, third, lower_right};
    }
    [[gnu::always_inline]] inline Facet facet(Face face, std::size_t first) const noexcept
    {
        const auto [a, b, c] = corners(face);
        const std::array<Vertex, 5> around{a, b, c, a, b};
        const std::array<Vertex, 3> vertices{around[first], around[first + 1], around[first + 2]};
        const std::array<std::uint8_t, 3> kinds{kindOf(vertices[1], vertices[2]),
                                                kindOf(vertices[2], vertices[0]),
                                                kindOf(vertices[0], vertices[1])};
        if constexpr (requires { heights_.cell(face.column, face.row); }) {
            const CellHeights z = heights_.cell(face.column, face.row);
            const double third = face.is_upper ? z.upper_right : z.lower_left;
            const bool is_third_last = face.is_upper != is_mirrored_;
            const std::array<double, 5> corner{z.upper_left, is_third_last ? z.lower_right : third,
                                               is_third_last ? third : z.lower_right, z.upper_left,
                                               is_third_last ? z.lower_right : third};
            return facetOf(vertices, kinds, {corner[first], corner[first + 1], corner[first + 2]});
        }
        return facetOf(vertices, kinds,
                       {heightOf(vertices[0]), heightOf(vertices[1]), heightOf(vertices[2])});
    }
    // The two faces of an edge make a parallelogram.
    bool hasBeyond(const Facet& facet, std::size_t opposite) const noexcept
    {
        return isInside(mirrored(facet, opposite));
    }
    [[gnu::always_inline]] inline Facet beyond(const Facet& facet,
                                               std::size_t opposite) const noexcept
    {
        const std::size_t next = (opposite + 1) % 3;
        const std::size_t last = (opposite + 2) % 3;
        const Vertex there = mirrored(facet, opposite);
        return facetOf({there, facet.vertices[last], facet.vertices[next]},
                       {facet.kinds[opposite], facet.kinds[next], facet.kinds[last]},
                       {heightOf(there), facet.heights[last], facet.heights[next]});
    }
    static int bend(const Facet& facet, std::size_t opposite, const Facet& beyond) noexcept
    {
        const double edge_sum =
            facet.heights[(opposite + 1) % 3] + facet.heights[(opposite + 2) % 3];
        const double far_sum = facet.heights[opposite] + beyond.heights[0];
        const double difference = far_sum - edge_sum;
        constexpr double kTolerance = 4.0 * std::numeric_limits<double>::epsilon();
        if (std::abs(difference) <= kTolerance * (std::abs(edge_sum) + std::abs(far_sum))) {
            return 0;
        }
        return difference > 0.0 ? 1 : -1;
    }
    SurfaceEdgeFacets<BasicHeightfieldSurface> edgeFacets(Edge edge) const noexcept;
    Face faceOf(const Facet& facet) const noexcept
    {
        const auto& [a, b, c] = facet.vertices;
        const std::int32_t column = std::min({a.column, b.column, c.column});
        const std::int32_t row = std::min({a.row, b.row, c.row});
        // The upper face has two corners in its upper row.
        return {column, row, a.row + b.row + c.row == 3 * row + 1};
    }
    std::array<Vertex, 2> ends(Edge edge) const noexcept
    {
        return {edge.first,
                {edge.first.column + (edge.kind != Edge::Kind::AlongColumn ? 1 : 0),
                 edge.first.row + (edge.kind != Edge::Kind::AlongRow ? 1 : 0)}};
    }
    Edge edgeBetween(Vertex a, Vertex b) const noexcept
    {
        const bool is_a_first = a.column < b.column || a.row < b.row;
        return {is_a_first ? a : b, a.row == b.row         ? Edge::Kind::AlongRow
                                    : a.column == b.column ? Edge::Kind::AlongColumn
                                                           : Edge::Kind::Diagonal};
    }
    [[gnu::always_inline]] inline std::array<std::optional<Wing>, 2>
    wings(Edge edge) const noexcept;

    [[gnu::always_inline]] inline Fan fan(Vertex v) const noexcept;
    template <typename F>
    void eachSpoke(const Fan& fan, F&& function) const noexcept
    {
        for (std::size_t i = 0; i < 6; ++i) {
            if (fan.exists[i]) {
                function(spoke(fan, i));
            }
        }
    }
    template <typename F>
    void eachSector(const Fan& fan, F&& function) const noexcept
    {
        for (std::size_t i = 0; i < 6; ++i) {
            const std::size_t next = (i + 1) % 6;
            if (fan.exists[i] && fan.exists[next]) {
                const auto& [columns, rows, is_upper] = kSectors[i];
                function(Face{fan.vertex.column + columns, fan.vertex.row + rows, is_upper},
                         spoke(fan, i), spoke(fan, next));
            }
        }
    }
    Vec3 toGoal(const Fan& from, const Goal& goal) const noexcept
    {
        return offset(goal.grid.column - static_cast<double>(from.vertex.column),
                      goal.grid.row - static_cast<double>(from.vertex.row),
                      goal.scene.z - from.height);
    }

    ScenePoint point(const Contact& contact) const noexcept;
    /// The grid position of a contact.
    GridPoint gridPoint(const Contact& contact) const noexcept;

    [[gnu::always_inline]] inline std::optional<Face> wayOut(const Fan& fan,
                                                             const Goal& goal) const noexcept;
    std::optional<Face> wayOut(const Contact& contact, const Goal& goal) const noexcept;
    Cast castFrom(const Contact& contact, Face over, const Goal& goal) const noexcept;
    Cast castFree(const Goal& from, const Goal& to) const noexcept;

    std::uint32_t stepsMax() const noexcept { return steps_max_; }
    std::uint32_t stepsAlong(double way) const noexcept
    {
        constexpr double kStepsMin = 4096.0;
        constexpr double kStepsACell = 24.0; // eight times the features on a straight path
        const double cell = std::sqrt(std::min(dot(column_, column_), dot(row_, row_)));
        const double steps = kStepsMin + kStepsACell * way / cell;
        return steps < static_cast<double>(steps_max_) ? static_cast<std::uint32_t>(steps)
                                                       : steps_max_;
    }

private:
    // A position in a cell: fractions of a column and of a row in [0, 1].
    struct InCell {
        std::int32_t column;
        std::int32_t row;
        double u;
        double v;
    };
    friend class HeightfieldCast<Heights>;

    // Around a sample: to the right, right below, below, left, left above, above.
    static constexpr std::array<Vertex, 6> kSpokes{
        {{1, 0}, {1, 1}, {0, 1}, {-1, 0}, {-1, -1}, {0, -1}}};
    // The face between a spoke and the next.
    static constexpr std::array<Face, 6> kSectors{{{0, 0, true},
                                                   {0, 0, false},
                                                   {-1, 0, true},
                                                   {-1, -1, false},
                                                   {-1, -1, true},
                                                   {0, -1, false}}};

    // Whether the goal is above a plane by more than rounding error. The plane's height at the goal
    // is the sum of the last three.
    static bool isAbovePlane(double goal, double base, double across, double down) noexcept
    {
        constexpr double kTolerance = 16.0 * std::numeric_limits<double>::epsilon();
        const double magnitude =
            std::abs(goal) + std::abs(base) + std::abs(across) + std::abs(down);
        return goal - (base + across + down) > kTolerance * magnitude;
    }

    std::optional<Goal> clamped(GridPoint grid, const ScenePoint& point) const noexcept
    {
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
    Vec3 offset(double columns, double rows, double up) const noexcept
    {
        return {columns * column_.x + rows * row_.x, columns * column_.y + rows * row_.y, up};
    }
    Spoke spoke(const Fan& fan, std::size_t i) const noexcept
    {
        return {{fan.vertex.column + kSpokes[i].column, fan.vertex.row + kSpokes[i].row},
                {spokes_[i].x, spokes_[i].y, fan.around[i] - fan.height}};
    }
    bool isInside(Vertex v) const noexcept
    {
        // Unsigned, so that negative values are too large.
        return static_cast<std::uint32_t>(v.column) <= static_cast<std::uint32_t>(last_column_) &&
               static_cast<std::uint32_t>(v.row) <= static_cast<std::uint32_t>(last_row_);
    }
    static std::uint8_t kindOf(Vertex a, Vertex b) noexcept
    {
        return static_cast<std::uint8_t>(a.row == b.row         ? Edge::Kind::AlongRow
                                         : a.column == b.column ? Edge::Kind::AlongColumn
                                                                : Edge::Kind::Diagonal);
    }
    static Vertex mirrored(const Facet& facet, std::size_t opposite) noexcept
    {
        const Vertex here = facet.vertices[opposite];
        const Vertex a = facet.vertices[(opposite + 1) % 3];
        const Vertex b = facet.vertices[(opposite + 2) % 3];
        return {a.column + b.column - here.column, a.row + b.row - here.row};
    }
    [[gnu::always_inline]] inline Facet facetOf(const std::array<Vertex, 3>& vertices,
                                                const std::array<std::uint8_t, 3>& kinds,
                                                const std::array<double, 3>& heights) const noexcept
    {
        const double a_up = heights[1] - heights[0];
        const double b_up = heights[2] - heights[0];
        const double m_ab = metric_[kinds[0]].mixed;
        const double f_a = metric_[kinds[1]].length * a_up + m_ab * b_up;
        const double f_b = m_ab * a_up + metric_[kinds[2]].length * b_up;
        const auto& [first, second, third] = vertices;
        const auto along = [this](std::int32_t from, std::int32_t to) {
            return turn_ * static_cast<double>(to - from);
        };
        return {vertices,
                kinds,
                heights,
                1.0 + (a_up * f_a + b_up * f_b),
                a_up,
                b_up,
                f_a,
                f_b,
                static_cast<double>(first.column),
                static_cast<double>(first.row),
                along(first.row, third.row),
                along(first.column, third.column),
                along(first.row, second.row),
                along(first.column, second.column)};
    }
    double heightOf(Vertex v) const noexcept { return heights_.at(v.column, v.row); }
    CellHeights cellHeights(std::int32_t column, std::int32_t row) const noexcept
    {
        if constexpr (requires { heights_.cell(column, row); }) {
            return heights_.cell(column, row);
        }
        return {heights_.at(column, row), heights_.at(column + 1, row),
                heights_.at(column, row + 1), heights_.at(column + 1, row + 1)};
    }
    InCell cellOf(GridPoint grid) const noexcept
    {
        const double c = std::clamp(grid.column, 0.0, static_cast<double>(last_column_));
        const double r = std::clamp(grid.row, 0.0, static_cast<double>(last_row_));
        // The last sample belongs to the last cell.
        const auto column = std::min(static_cast<std::int32_t>(c), last_column_ - 1);
        const auto row = std::min(static_cast<std::int32_t>(r), last_row_ - 1);
        return {column, row, c - static_cast<double>(column), r - static_cast<double>(row)};
    }
    InCell within(const Contact& contact, Face face) const noexcept;
    Face someFaceOf(const Contact& contact) const noexcept;
    double heightAt(const InCell& at) const noexcept
    {
        return heightInCell(cellHeights(at.column, at.row), at.u, at.v);
    }
    Contact contactIn(const InCell& at, bool is_upper) const noexcept;

    std::shared_ptr<const Terrain> terrain_;
    Heights heights_;
    SceneFrame frame_;
    double exaggeration_;
    std::int32_t last_column_;
    std::int32_t last_row_;
    bool is_mirrored_;
    double turn_; // of a face's corners, in columns and rows: 1 or -1
    // Where corners() puts the sample that is neither upper left nor lower right, and lower right.
    std::array<int, 2> third_corner_; // of lower and upper faces
    std::array<int, 2> lower_right_corner_;
    Vec3 column_; // one column to the right, horizontally
    Vec3 row_;
    std::array<Vec3, 6> spokes_;
    // By the kind of an edge: its length squared, and minus the dot product of the two other edges
    // of a face from their common corner, both by the square of a cell's area.
    struct EdgeMetric {
        double length;
        double mixed;
    };
    std::array<EdgeMetric, 3> metric_;
    std::uint32_t steps_max_;
};

template <typename Heights>
auto BasicHeightfieldSurface<Heights>::edgeFacets(Edge edge) const noexcept
    -> SurfaceEdgeFacets<BasicHeightfieldSurface>
{
    // The corner opposite the edge that turns from its first end to its second as columns turn to
    // rows, and the other one.
    const auto [from, to] = ends(edge);
    Vertex positive{};
    Vertex negative{};
    switch (edge.kind) {
    case Edge::Kind::AlongRow:
        positive = {to.column, to.row + 1};
        negative = {from.column, from.row - 1};
        break;
    case Edge::Kind::AlongColumn:
        positive = {from.column - 1, from.row};
        negative = {to.column + 1, to.row};
        break;
    case Edge::Kind::Diagonal:
        positive = {from.column, to.row};
        negative = {to.column, from.row};
        break;
    }
    const Vertex second = is_mirrored_ ? from : to;
    const Vertex third = is_mirrored_ ? to : from;
    const double second_height = heightOf(second);
    const double third_height = heightOf(third);
    // Opposite the ends are the two other kinds; a step from `positive` to `from`, say, is parallel
    // to one from `to` to `negative`.
    const auto kind = static_cast<std::uint8_t>(edge.kind);
    const auto facet_at = [&](Vertex far, Vertex b, Vertex c, double b_height, double c_height) {
        return facetOf({far, b, c}, {kind, kindOf(c, far), kindOf(far, b)},
                       {heightOf(far), b_height, c_height});
    };
    SurfaceEdgeFacets<BasicHeightfieldSurface> facets;
    const bool has_positive = isInside(positive);
    const bool has_negative = isInside(negative);
    facets.has_right = has_positive && has_negative;
    if (has_positive) {
        facets.left = facet_at(positive, second, third, second_height, third_height);
        if (has_negative) {
            facets.right = facet_at(negative, third, second, third_height, second_height);
        }
    } else {
        facets.left = facet_at(negative, third, second, third_height, second_height);
    }
    return facets;
}

template <typename Heights>
auto BasicHeightfieldSurface<Heights>::contactIn(const InCell& at, bool is_upper) const noexcept
    -> Contact
{
    // Zero exactly if the position is on an edge. Rounding may have put it beyond the diagonal.
    const double upper_left = 1.0 - (is_upper ? at.u : at.v);
    const double lower_right = is_upper ? at.v : at.u;
    const double third = std::max(is_upper ? at.u - at.v : at.v - at.u, 0.0);
    const Face face{at.column, at.row, is_upper};
    return contactOnFace(*this, face,
                         is_upper != is_mirrored_ ? std::array{upper_left, lower_right, third}
                                                  : std::array{upper_left, third, lower_right});
}

template <typename Heights>
auto BasicHeightfieldSurface<Heights>::wings(Edge edge) const noexcept
    -> std::array<std::optional<Wing>, 2>
{
    const auto [column, row] = edge.first;
    std::array<std::optional<Wing>, 2> wings;
    switch (edge.kind) {
    case Edge::Kind::AlongRow:
        if (row < last_row_) {
            wings[0] = Wing{{column, row, true}, lower_right_corner_[1]};
        }
        if (row > 0) {
            wings[1] = Wing{{column, row - 1, false}, 0};
        }
        break;
    case Edge::Kind::AlongColumn:
        if (column < last_column_) {
            wings[0] = Wing{{column, row, false}, lower_right_corner_[0]};
        }
        if (column > 0) {
            wings[1] = Wing{{column - 1, row, true}, 0};
        }
        break;
    case Edge::Kind::Diagonal:
        wings[0] = Wing{{column, row, true}, third_corner_[1]};
        wings[1] = Wing{{column, row, false}, third_corner_[0]};
        break;
    }
    return wings;
}

template <typename Heights>
auto BasicHeightfieldSurface<Heights>::within(const Contact& contact, Face face) const noexcept
    -> InCell
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
        const std::size_t kind = face.is_upper ? 1 : 0;
        const double third = contact.weights[static_cast<std::size_t>(third_corner_[kind])];
        const double lower_right =
            contact.weights[static_cast<std::size_t>(lower_right_corner_[kind])];
        at.u = std::min(lower_right + (face.is_upper ? third : 0.0), 1.0);
        at.v = std::min(lower_right + (face.is_upper ? 0.0 : third), 1.0);
        break;
    }
    }
    return at;
}

template <typename Heights>
auto BasicHeightfieldSurface<Heights>::someFaceOf(const Contact& contact) const noexcept -> Face
{
    if (contact.feature == ContactFeature::Face) {
        return contact.face;
    }
    if (contact.feature == ContactFeature::Edge) {
        const auto wings = this->wings(contact.edge);
        return wings[0] ? wings[0]->face : wings[1]->face;
    }
    const std::int32_t column = std::min(contact.vertex.column, last_column_ - 1);
    const std::int32_t row = std::min(contact.vertex.row, last_row_ - 1);
    return {column, row, contact.vertex.column - column >= contact.vertex.row - row};
}

template <typename Heights>
GridPoint BasicHeightfieldSurface<Heights>::gridPoint(const Contact& contact) const noexcept
{
    const InCell at = within(contact, someFaceOf(contact));
    return {static_cast<double>(at.column) + at.u, static_cast<double>(at.row) + at.v};
}

template <typename Heights>
ScenePoint BasicHeightfieldSurface<Heights>::point(const Contact& contact) const noexcept
{
    const InCell at = within(contact, someFaceOf(contact));
    return frame_.toScene(
        {static_cast<double>(at.column) + at.u, static_cast<double>(at.row) + at.v}, heightAt(at));
}

template <typename Heights>
auto BasicHeightfieldSurface<Heights>::fan(Vertex v) const noexcept -> Fan
{
    const bool has_right = v.column < last_column_;
    const bool has_below = v.row < last_row_;
    const bool has_left = v.column > 0;
    const bool has_above = v.row > 0;
    if constexpr (requires(Fan around) {
                      heights_.around(v.column, v.row, around.height, around.around);
                  }) {
        Fan within{v, 0.0, {}, {true, true, true, true, true, true}};
        if (has_right && has_below && has_left && has_above &&
            heights_.around(v.column, v.row, within.height, within.around)) {
            return within;
        }
    }
    // Neighbors that do not exist are read from inside the grid and not used.
    const std::int32_t right = v.column + (has_right ? 1 : 0);
    const std::int32_t below = v.row + (has_below ? 1 : 0);
    const std::int32_t left = v.column - (has_left ? 1 : 0);
    const std::int32_t above = v.row - (has_above ? 1 : 0);
    return {
        v,
        heightOf(v),
        {heights_.at(right, v.row), heights_.at(right, below), heights_.at(v.column, below),
         heights_.at(left, v.row), heights_.at(left, above), heights_.at(v.column, above)},
        {has_right, has_right && has_below, has_below, has_left, has_left && has_above, has_above}};
}

template <typename Heights>
auto BasicHeightfieldSurface<Heights>::wayOut(const Fan& fan, const Goal& goal) const noexcept
    -> std::optional<Face>
{
    // The face over which the path begins. Seen from above, the direction gives the quadrant and
    // the side of the diagonal. Along an edge either face will do; straight up, any face.
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

template <typename Heights>
auto BasicHeightfieldSurface<Heights>::wayOut(const Contact& contact,
                                              const Goal& goal) const noexcept
    -> std::optional<Face>
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

// Instantiated once, in heightfield_surface.cpp and heightfield_cast.cpp.
extern template class BasicHeightfieldSurface<FilledHeights>;
extern template class BasicHeightfieldSurface<PlainHeights<std::int16_t>>;
extern template class BasicHeightfieldSurface<PlainHeights<float>>;

/// Any terrain. PlainHeightfieldSurface is faster if PlainHeights<T>::canRead(terrain).
using HeightfieldSurface = BasicHeightfieldSurface<FilledHeights>;
template <typename T>
using PlainHeightfieldSurface = BasicHeightfieldSurface<PlainHeights<T>>;

static_assert(ContactSurface<HeightfieldSurface>);
static_assert(ContactSurface<PlainHeightfieldSurface<std::int16_t>>);
static_assert(ContactSurface<PlainHeightfieldSurface<float>>);

} // namespace marsview
