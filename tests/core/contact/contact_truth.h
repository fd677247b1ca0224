// Reference results for a place on a heightfield and a goal, in long double, from the samples
// alone.
#pragma once

#include "core/contact/contact_surface.h"
#include "core/geo/scene_frame.h"
#include "core/terrain/filled_heightfield.h"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace marsview::test {

/// A vector, or a point of the scene, in meters.
struct LongVec {
    long double x = 0.0L;
    long double y = 0.0L;
    long double z = 0.0L;

    LongVec operator+(const LongVec& o) const { return {x + o.x, y + o.y, z + o.z}; }
    LongVec operator-(const LongVec& o) const { return {x - o.x, y - o.y, z - o.z}; }
    LongVec operator*(long double s) const { return {x * s, y * s, z * s}; }
};

long double dot(const LongVec& a, const LongVec& b);
long double length(const LongVec& a);
LongVec longVec(const Vec3& a);

/// A place on the mesh: one to three connected samples with their shares, all > 0, with sum 1.
struct MeshPlace {
    struct Part {
        int column;
        int row;
        long double share;
    };
    std::array<Part, 3> parts{};
    std::size_t count = 0;
};

/// The place that a model reports; nullopt if its numbers are not valid shares.
template <typename S>
std::optional<MeshPlace> meshPlace(const S& surface, const SurfaceContact<S>& contact)
{
    MeshPlace place;
    long double sum = 0.0L;
    bool is_share = true;
    const auto add = [&](typename S::Vertex vertex, long double share) {
        is_share = is_share && share >= 0.0L && share <= 1.0L;
        sum += share;
        if (share > 0.0L) {
            place.parts.at(place.count++) = {vertex.column, vertex.row, share};
        }
    };
    switch (contact.feature) {
    case ContactFeature::Vertex:
        add(contact.vertex, 1.0L);
        break;
    case ContactFeature::Edge: {
        const auto ends = surface.ends(contact.edge);
        add(ends[0], 1.0L - static_cast<long double>(contact.along));
        add(ends[1], static_cast<long double>(contact.along));
        break;
    }
    case ContactFeature::Face: {
        const auto corners = surface.corners(contact.face);
        for (std::size_t i = 0; i < 3; ++i) {
            add(corners[i], static_cast<long double>(contact.weights[i]));
        }
        break;
    }
    case ContactFeature::Free:
        return std::nullopt;
    }
    if (!is_share || !(std::abs(sum - 1.0L) < 1e-15L)) {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < place.count; ++i) {
        place.parts.at(i).share /= sum;
    }
    return place;
}

/// A heightfield in the scene. Stores no place and depends on no contact model.
class HeightfieldTruth {
public:
    HeightfieldTruth(std::shared_ptr<const FilledHeightfield> terrain,
                     const SceneFrame& frame,
                     double exaggeration);

    const FilledHeightfield& terrain() const { return *terrain_; }
    const SceneFrame& frame() const { return frame_; }
    double exaggeration() const { return exaggeration_; }
    /// The largest difference between samples of one cell, and the largest absolute height, in
    /// scene meters.
    double step() const { return step_m_; }
    double highest() const { return highest_m_; }

    /// The goal as a model uses it: clamped to the grid, in grid coordinates.
    LongVec goal(const ScenePoint& goal) const;
    /// Whether the goal is within the outermost samples, to double precision.
    bool isInside(const ScenePoint& goal) const;
    /// The largest distance, in meters, between that point and the goal after conversion in
    /// doubles.
    long double goalError(const ScenePoint& goal) const;

    /// The path length of the clamped goal while the goal moves straight from one point to another.
    long double wayOfGoal(const ScenePoint& from, const ScenePoint& to) const;

    LongVec point(const MeshPlace& place) const;
    /// Height of the surface straight above or below a point. Points outside use the nearest point
    /// inside.
    long double height(const LongVec& point) const;
    /// The largest depth below the surface on the straight path from one point to another; negative
    /// if the whole path is above.
    long double depth(const LongVec& from, const LongVec& to) const;

    struct Rest {
        /// The remaining pull of the goal: the length of the vector to the goal, projected onto the
        /// tangent cone of the space on and above the surface. 0 at a minimum; on a face or edge,
        /// the distance from its foot.
        long double pull_m;
        long double longest_m;   // longest edge of the adjacent faces
        long double slenderness; // of these faces: the largest ratio of longest edge to height
        long double highest_m;   // largest absolute height nearby
        std::size_t faces;
    };
    Rest rest(const MeshPlace& place, const LongVec& goal) const;

private:
    LongVec corner(int column, int row) const;
    LongVec clamped(const LongVec& point) const;
    LongVec toScene(long double column, long double row, long double z) const;
    std::array<long double, 2> toGrid(const LongVec& point) const;
    long double heightAtGrid(long double column, long double row) const;

    std::shared_ptr<const FilledHeightfield> terrain_;
    SceneFrame frame_;
    double exaggeration_;
    double step_m_ = 0.0;
    double highest_m_ = 0.0;
};

} // namespace marsview::test
