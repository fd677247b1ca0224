// Selects the parts of a map to draw and their level of detail for a given error in the picture.
//
// The scheme is that of CDLOD (Filip Strugar, "Continuous Distance-Dependent Level of Detail for
// Rendering Heightmaps", 2010), with distances from measured errors instead of fixed ones. A vertex
// of level k begins to morph to level k + 1 at a range R, a length that varies over the map:
// between R and kMorphEnd · R its position moves to that of level k + 1. R is interpolated between
// the corners of the nodes of level k + 1; for an error e there it is
//
//     R = K · e · exaggeration / error_px,    K = picture height / (2 tan(field of view / 2)),
//
// so 99 of 100 pixels of the picture are off by at most error_px, and none by more than
// DetailErrors::kPeak times that, by the definition of a node's error. A node is drawn at its level
// if all of it is farther away than kMorphEnd · R. The drawn surface then depends only on position
// and camera: on an edge between two nodes all vertices have morphed to those of the coarser node,
// to the bit.
//
// Two levels of morphing are enough in any node: ranges R grow by at least DetailErrors::kGrowth
// from one level to the next, and two levels up they are at least kRangeTwoBelow times the size of
// the nodes below. If node k is drawn because its parent, of size s, was too near, any point of it
// is nearer than 1.2 R(k+1) + s. If s <= 1.03 R(k+1) that is at most 2.23 R(k+1), and R(k+3) >=
// 2.25 R(k+1) is more; otherwise it is less than 2.17 s, and R(k+3) >= 2.19 s is more.
#pragma once

#include "core/geo/scene_frame.h"
#include "core/terrain/surface_analysis.h"
#include "core/view/camera.h"
#include "core/view/node_space.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// The end of the morph to the next level, in ranges.
inline constexpr double kMorphEnd = 1.2;

/// Minimum range of a level, in diagonals of its nodes: a picture at rest has cells of at most 18
/// pixels, however flat they are, so that the texture on them moves by less than the error. A
/// picture in motion, with an error above kErrorPxAtRest, may have twice that.
inline constexpr double kRangePerSize = 1.0;
inline constexpr double kRangePerSizeMoving = 0.5;
inline constexpr double kErrorPxAtRest = 1.0;

/// Minimum range of a level, in diagonals of the nodes two levels below it.
inline constexpr double kRangeTwoBelow = 2.19;

/// Texels along a side of the relief of a node; see SelectedNode::relief.
inline constexpr std::size_t kReliefTexels = 256;

/// The level of nodes whose relief has one texel per sample: finer ones would show nothing new.
inline constexpr std::size_t kReliefLevelMin = 3;

/// A map in the picture.
struct DetailView {
    OrbitCamera camera;
    Viewport viewport;
    double exaggeration = 1.0;
    std::optional<PixelArea> part{};  // of the viewport that is drawn; nothing for all of it
    std::optional<CameraPose> pose{}; // replaces `camera` in the scene of a body
};

/// The requested quality.
struct DetailTarget {
    double error_px = 1.0;         // maximum error of the surface in the picture; > 0
    double texel_px = 1.0;         // a texel of the relief is at most this large; > 0
    bool has_every_sample = false; // draw the full resolution at any cost
};

/// Ranges in scene meters at the corners of a node: upper left, upper right, lower left, lower
/// right.
using CornerRanges = std::array<float, 4>;

/// The quadrants of a node: upper left, upper right, lower left, lower right, one bit each.
inline constexpr std::size_t kQuadrantCount = 4;
inline constexpr std::uint8_t kAllQuadrants = 0b1111;

struct SelectedNode {
    DetailNode node;
    std::uint8_t quadrants = kAllQuadrants; // those in the picture that are not void
    CornerRanges parent_ranges_m{};         // of the node one level up, at its own corners
    CornerRanges grandparent_ranges_m{};    // two levels up
    DetailNode relief;                      // the node whose relief is used: itself or an ancestor
    double distance_m = 0.0;                // of its nearest point from the eye
};

struct DetailSelection {
    std::vector<SelectedNode> nodes; // nearest first
    std::size_t triangle_count = 0;
    double error_px = 0.0; // by the errors of its nodes, at most the requested one
};

/// Selects detail of one map. For one thread at a time.
class DetailSelector {
public:
    /// `heightfield` and `frame` are those of `analysis`.
    DetailSelector(std::shared_ptr<const SurfaceAnalysis> analysis,
                   std::size_t columns,
                   std::size_t rows,
                   const SceneFrame& frame);
    /// `space` is of the map of `analysis`.
    DetailSelector(std::shared_ptr<const SurfaceAnalysis> analysis,
                   std::unique_ptr<NodeSpace> space);

    /// Everything that is in the picture and not void.
    DetailSelection select(const DetailView& view, const DetailTarget& target);

private:
    struct Pass;
    // Properties that a node inherits from its ancestors.
    struct Above {
        bool has_relief = false;
        bool is_inside = false; // the picture
    };

    using SizeRanges = std::vector<CornerGrid>; // by level
    const SizeRanges& sizeRangesFor(const DetailTarget& target);
    SizeRanges sizeRanges(double range_per_size) const;
    std::uint8_t quadrantsIn(const Pass& pass, const DetailNode& node, bool is_inside) const;
    std::size_t triangleCount(const SelectedNode& selected) const;
    void visit(const DetailNode& node, Above above, SelectedNode& selected, Pass& pass) const;
    float rangeAt(std::size_t level, std::size_t column, std::size_t row, const Pass& pass) const;
    float
    ownRangeAt(std::size_t level, std::size_t column, std::size_t row, const Pass& pass) const;
    CornerRanges rangesOf(const DetailNode& node, const Pass& pass) const;

    std::shared_ptr<const SurfaceAnalysis> analysis_;
    std::unique_ptr<NodeSpace> space_;
    double exaggeration_ = 0.0;
    SizeRanges at_rest_m_; // for exaggeration_; empty until requested
    SizeRanges moving_m_;
};

} // namespace marsview
