// The triangles that close a map around its body at a pole.
#pragma once

#include <array>
#include <cstdint>

namespace marsview {

/// Which triangles lie between a circle of samples and the pole, for any number of samples. Rings
/// of half as many vertices each lie between them, so that no vertex has more than eight neighbors
/// and triangles are as long along a ring as the steps of the circle. Without these rings,
/// triangles would either all meet at the pole, or lie across it from sample to sample, so close
/// together that the terrain of the circle would become cliffs.
///
/// Vertices below the size of the circle are its samples, in their order; then come those of the
/// rings, from the outermost on, and the pole. A *corner* is 3 × face + 0, 1 or 2. Seen from
/// outside the body, with the circle in counter-clockwise order, so are the corners of each face.
/// Allocates nothing; any thread.
class PoleCap {
public:
    PoleCap() = default;
    /// `size` > 1 (> 2 to enclose a pole) is the number of samples of the circle.
    explicit PoleCap(std::uint32_t size) noexcept;

    std::uint32_t faceCount() const noexcept { return face_count_; }
    /// Of the rings and the pole.
    std::uint32_t innerVertexCount() const noexcept { return pole_ - rings_[0].size + 1; }

    std::array<std::uint32_t, 3> face(std::uint32_t face) const noexcept;
    /// What lies beyond the edge opposite a corner: the corner opposite it on the other side, or,
    /// beyond the circle, the number of the sample at the beginning of the edge.
    struct Beyond {
        std::uint32_t at;
        bool is_outside;
    };
    Beyond across(std::uint32_t corner) const noexcept;
    /// The corner opposite the edge from a sample of the circle to the next one.
    std::uint32_t cornerAtCircle(std::uint32_t sample) const noexcept
    {
        return cornerAtEdge(0, sample);
    }
    /// Some corner at a vertex that is not of the circle.
    std::uint32_t cornerAt(std::uint32_t vertex) const noexcept;

    /// A vertex lies between the pole and a sample of the circle: this share of the way from the
    /// pole.
    struct Place {
        std::uint32_t sample;
        double share;
    };
    Place placeOf(std::uint32_t vertex) const noexcept;

    /// The height of the pole is the mean of up to eight evenly spaced samples of the circle. That
    /// of a vertex between a sample and the pole is linear along the way.
    std::uint32_t poleSampleCount() const noexcept
    {
        return rings_[0].size < kPoleSamplesMax ? rings_[0].size : kPoleSamplesMax;
    }
    std::uint32_t poleSample(std::uint32_t number) const noexcept
    {
        return static_cast<std::uint32_t>(std::uint64_t{number} * rings_[0].size /
                                          poleSampleCount());
    }

private:
    static constexpr std::uint32_t kPoleSamplesMax = 8;
    static constexpr std::uint32_t kInnermostMax = 8;
    static constexpr std::uint32_t kRingsMax = 32;

    struct Ring {
        std::uint32_t size = 0;
        std::uint32_t first_vertex = 0;
        std::uint32_t first_face = 0; // of those between it and the next one, or the pole
    };
    // The faces between two rings come in groups, for each vertex of the inner one: that at an even
    // step of the outer ring, one at the step of the inner ring, and that at an odd step, which an
    // outer ring of odd size lacks in the end.
    enum Part : std::uint32_t { kEven, kInner, kOdd, kParts };

    bool isInnermost(std::uint32_t ring) const noexcept { return ring + 1 == ring_count_; }
    std::uint32_t ringOfFace(std::uint32_t face) const noexcept;
    std::uint32_t ringOfVertex(std::uint32_t vertex) const noexcept;
    std::uint32_t cornerOf(std::uint32_t ring,
                           std::uint32_t group,
                           Part part,
                           std::uint32_t number) const noexcept
    {
        return 3 * (rings_[ring].first_face + kParts * group + part) + number;
    }
    // Inside an edge of a ring, and outside of it.
    std::uint32_t cornerAtEdge(std::uint32_t ring, std::uint32_t step) const noexcept;
    Beyond outside(std::uint32_t ring, std::uint32_t step) const noexcept;
    Beyond
    acrossAtPole(std::uint32_t ring, std::uint32_t step, std::uint32_t number) const noexcept;

    std::array<Ring, kRingsMax> rings_{}; // the circle first
    std::uint32_t ring_count_ = 0;
    std::uint32_t pole_ = 0;
    std::uint32_t face_count_ = 0;
};

} // namespace marsview
