// The reference that contact models are compared with: slow, plain, and without shared code.
#pragma once

#include "core/contact/heightfield_surface.h"

#include <cstdint>
#include <optional>

namespace marsview {

/// The proxy that follows the goal's straight motion continuously. The motion since the last update
/// is cut into small pieces; after each the proxy takes the steepest descent to a local minimum of
/// the distance to the goal, which is fixed in the meantime: straight through free space, over
/// faces, along edges. The shorter the pieces, the closer to the limit of infinitely many.
///
/// Every step is geometry in long double on the triangles around the proxy, which is stored as a
/// cell and a position in it. It uses only the samples, the frame and the exaggeration of the
/// surface: no casts, no hierarchy, no adjacency.
///
/// A few tenths of a microsecond per piece. One thread at a time; allocates nothing.
class ReferenceProxy {
public:
    /// Measurements and error bounds of the other models are quoted against 1/128 of a cell.
    static constexpr double kPieceCells = 1.0 / 128.0;

    struct State {
        ScenePoint proxy;
        bool is_in_contact = false;
    };

    /// `piece_cells` > 0: the longest piece of the motion, in units of the mean of a cell's two
    /// sides.
    explicit ReferenceProxy(const HeightfieldSurface& surface, double piece_cells = kPieceCells);

    /// As ContactModel: the goal is clamped to the grid; one that HeightfieldSurface::goal refuses
    /// changes nothing.
    State place(const ScenePoint& goal);
    State update(const ScenePoint& goal);

    /// Descents that ended at the step limit instead of a minimum. A nonzero count is an error of
    /// this class.
    std::uint64_t unfinishedCount() const noexcept { return unfinished_count_; }

    /// Length of a cell in meters, as used here: the mean of its two sides.
    static double cellMeters(const SceneFrame& frame);

private:
    using Real = long double;

    struct Vector {
        Real x;
        Real y;
        Real z;
    };
    // Within the outermost samples, the height in scene meters.
    struct Aim {
        Real column;
        Real row;
        Real z;
    };
    // Fractions of a column and of a row in [0, 1]; 0, 1 and equal values are exact.
    struct Place {
        std::int32_t column;
        std::int32_t row;
        Real u;
        Real v;
    };
    struct Triangle {
        std::int32_t column; // of its cell
        std::int32_t row;
        bool is_upper;
        Real u; // the proxy's position in that cell
        Real v;
        Real z; // of the plane at the cell's corner
        Real per_column;
        Real per_row;

        Real height(Real at_u, Real at_v) const { return z + per_column * at_u + per_row * at_v; }
        bool holds(Real du, Real dv) const;
    };
    struct Around {
        Triangle triangles[8];
        int count = 0;
    };
    struct Move {
        Real gain_squared = 0.0L; // the part of the distance to the goal along this direction
        Place to{};
    };

    static Real dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
    Vector offset(Real columns, Real rows, Real up) const;

    static Place onFeature(Place place);
    Aim aimAt(Real column, Real row, Real z) const;
    Triangle triangleAt(std::int32_t column, std::int32_t row, bool is_upper, Real u, Real v) const;
    Around around(const Place& place) const;
    Real heightAt(Real column, Real row) const;
    Place placeBelow(const Aim& aim) const;

    void follow(const ScenePoint& goal);
    void followLeg(const Aim& from, const Aim& to);
    void settle();
    bool stepDown();
    Real rounding(const Around& around) const;
    bool release(const Around& around, const Vector& to_goal);
    static Place alongFace(const Triangle& triangle, Real du, Real dv);
    std::optional<Place> cast(Aim from, const Aim& to, Real& cells) const;
    State state() const;

    HeightfieldSurface surface_;
    Real piece_m_;
    Real cell_m_;
    Vector column_; // one column to the right, horizontally
    Vector row_;
    Real last_column_;
    Real last_row_;

    bool is_placed_ = false;
    ScenePoint goal_{}; // as given
    Aim aim_{};         // as clamped
    bool is_free_ = true;
    Place place_{}; // if not free
    std::uint64_t unfinished_count_ = 0;
};

} // namespace marsview
