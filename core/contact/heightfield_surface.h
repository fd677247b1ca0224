// A heightfield in scene metres as contact models see it (contact_surface.h).
#pragma once

#include "core/contact/contact_surface.h"
#include "core/geo/scene_frame.h"
#include "core/terrain/filled_heightfield.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace marsview {

/// Sample (c, r) lies at frame.toScene({c, r}, exaggeration × height). Cells are cut as in
/// core/terrain/triangulation.h; voids are filled (FilledHeightfield). The frame may be rotated,
/// sheared or mirrored. Beyond the outermost samples goals are clamped, horizontally and in grid
/// coordinates, to the grid.
///
/// A small immutable value that shares the terrain: cheap to copy and to make anew for another
/// exaggeration. Any thread; allocates nothing once made.
class HeightfieldSurface {
public:
    struct Vertex {
        std::int32_t column = 0;
        std::int32_t row = 0;
        bool operator==(const Vertex&) const = default;
    };
    /// From `first` one column to the right, one row down, or both.
    struct Edge {
        enum class Kind : std::uint8_t { AlongRow, AlongColumn, Diagonal };
        Vertex first;
        Kind kind = Kind::AlongRow;
    };
    /// The half of the cell (column, row) right above or left below its diagonal.
    struct Face {
        std::int32_t column = 0;
        std::int32_t row = 0;
        bool is_upper = false;
    };
    struct Goal {
        GridPoint grid; // within the outermost samples
        ScenePoint scene;
    };
    /// A sample and those at the ends of its edges, read once.
    struct Fan {
        Vertex vertex;
        double height; // in scene metres
        std::array<double, 6> around;
        std::array<bool, 6> exists;
    };
    using Contact = SurfaceContact<HeightfieldSurface>;
    using Cast = SurfaceCast<HeightfieldSurface>;
    using Spoke = SurfaceSpoke<HeightfieldSurface>;
    using Wing = SurfaceWing<HeightfieldSurface>;

    /// Coordinates beyond this, in metres, are not aimed at, like those that are not finite.
    static constexpr double kGoalMaxM = 1e12;

    /// `exaggeration` > 0 and finite; the frame is invertible. The terrain has fewer than 2^30
    /// columns and rows.
    HeightfieldSurface(std::shared_ptr<const FilledHeightfield> terrain,
                       const SceneFrame& frame,
                       double exaggeration);

    const std::shared_ptr<const FilledHeightfield>& terrain() const noexcept { return terrain_; }
    const SceneFrame& frame() const noexcept { return frame_; }
    double exaggeration() const noexcept { return exaggeration_; }

    /// Height of the surface in scene metres at a grid position; the nearest one inside is taken.
    double height(GridPoint grid) const noexcept;
    /// Whether a void sample has a say in the surface below or at `point`.
    bool isOverVoid(const ScenePoint& point) const noexcept;

    std::optional<Goal> goal(const ScenePoint& point) const noexcept;
    ScenePoint goalPoint(const Goal& goal) const noexcept { return goal.scene; }
    bool isAbove(const Goal& goal) const noexcept { return goal.scene.z > height(goal.grid); }
    Contact contactAt(const Goal& goal) const noexcept;
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
    std::array<Vertex, 3> corners(Face face) const noexcept
    {
        const Vertex upper_left{face.column, face.row};
        const Vertex lower_right{face.column + 1, face.row + 1};
        const Vertex third{face.is_upper ? face.column + 1 : face.column,
                           face.is_upper ? face.row : face.row + 1};
        return face.is_upper != is_mirrored_ ? std::array{upper_left, lower_right, third}
                                             : std::array{upper_left, third, lower_right};
    }
    SurfaceTriangle<HeightfieldSurface> triangle(Face face, const Goal& goal) const noexcept;
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
    std::array<std::optional<Wing>, 2> wings(Edge edge) const noexcept;

    Fan fan(Vertex v) const noexcept;
    template <typename F>
    void eachSpoke(const Fan& fan, F&& function) const noexcept
    {
        for (std::size_t i = 0; i < 6; ++i) {
            if (fan.exists[i]) {
                function(
                    Spoke{{fan.vertex.column + kSpokes[i].column, fan.vertex.row + kSpokes[i].row},
                          {spokes_[i].x, spokes_[i].y, fan.around[i] - fan.height}});
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

    std::optional<Face> wayOut(const Fan& fan, const Goal& goal) const noexcept;
    std::optional<Face> wayOut(const Contact& contact, const Goal& goal) const noexcept;
    Cast castFrom(const Contact& contact, Face over, const Goal& goal) const noexcept;
    Cast castFree(const Goal& from, const Goal& to) const noexcept;

    std::uint32_t stepsMax() const noexcept { return steps_max_; }

private:
    // A place in a cell: fractions of a column and of a row in [0, 1].
    struct InCell {
        std::int32_t column;
        std::int32_t row;
        double u;
        double v;
    };
    friend class HeightfieldCast;

    // Around a sample: to the right, right below, below, left, left above, above.
    static constexpr std::array<Vertex, 6> kSpokes{
        {{1, 0}, {1, 1}, {0, 1}, {-1, 0}, {-1, -1}, {0, -1}}};

    Vec3 offset(double columns, double rows, double up) const noexcept
    {
        return {columns * column_.x + rows * row_.x, columns * column_.y + rows * row_.y, up};
    }
    double heightOf(Vertex v) const noexcept
    {
        return exaggeration_ * terrain_->sample(static_cast<std::size_t>(v.column),
                                                static_cast<std::size_t>(v.row));
    }
    CellHeights cellHeights(std::int32_t column, std::int32_t row) const noexcept
    {
        const CellHeights z =
            terrain_->cell(static_cast<std::size_t>(column), static_cast<std::size_t>(row));
        return {exaggeration_ * z.upper_left, exaggeration_ * z.upper_right,
                exaggeration_ * z.lower_left, exaggeration_ * z.lower_right};
    }
    InCell cellOf(GridPoint grid) const noexcept;
    InCell within(const Contact& contact, Face face) const noexcept;
    double heightAt(const InCell& at) const noexcept
    {
        return heightInCell(cellHeights(at.column, at.row), at.u, at.v);
    }
    Contact contactIn(const InCell& at, bool is_upper) const noexcept;

    std::shared_ptr<const FilledHeightfield> terrain_;
    SceneFrame frame_;
    double exaggeration_;
    std::int32_t last_column_;
    std::int32_t last_row_;
    bool is_mirrored_;
    Vec3 column_; // one column to the right, horizontally
    Vec3 row_;
    std::array<Vec3, 6> spokes_;
    std::uint32_t steps_max_;
};

static_assert(ContactSurface<HeightfieldSurface>);

} // namespace marsview
