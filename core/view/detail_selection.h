// Which parts of a map are drawn, in which detail, so that no more shows than is asked for.
//
// The scheme is that of CDLOD (Filip Strugar, "Continuous Distance-Dependent Level of Detail for
// Rendering Heightmaps", 2010), with distances from measured errors instead of fixed ones. Where a
// vertex of level k begins to give way to level k + 1 is a range R, a length that varies over the
// map: between R and kMorphEnd · R its place in the picture moves to that of level k + 1. R is
// interpolated between the corners of the nodes of level k + 1, and an error e there is worth
//
//     R = K · e · exaggeration / error_px,    K = picture height / (2 tan(field of view / 2)),
//
// so 99 of 100 pixels of the picture are off by at most error_px, and none by more than
// DetailErrors::kPeak times that, since that is what a node's error stands for. A node is drawn at
// its level where all of it is further away than kMorphEnd · R. What is drawn is then a function of
// place and camera alone: on an edge between two nodes all vertices have given way to the coarser
// node's, in the same bits.
//
// Two levels of giving way are enough in any node: ranges R grow by DetailErrors::kGrowth from one
// level to the next, and two levels up are no less than kRangeTwoBelow times the size of the nodes
// below. With node k drawn because its parent, of size s, was too near, any point of it is nearer
// than 1.2 R(k+1) + s. Where s <= 1.03 R(k+1) that is at most 2.23 R(k+1), and R(k+3) >= 2.25
// R(k+1) is more; elsewhere it is less than 2.17 s, and R(k+3) >= 2.19 s is more.
#pragma once

#include "core/geo/scene_frame.h"
#include "core/terrain/surface_analysis.h"
#include "core/view/camera.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace marsview {

class Frustum;

/// Where the move to the next level ends, in ranges.
inline constexpr double kMorphEnd = 1.2;

/// Least range of a level, in diagonals of its nodes: a picture at rest has cells of at most 18
/// pixels, however flat they are, so that what is drawn on them is moved by less than the error
/// allows; one in motion, where more than kErrorPxAtRest is allowed, twice that.
inline constexpr double kRangePerSize = 1.0;
inline constexpr double kRangePerSizeMoving = 0.5;
inline constexpr double kErrorPxAtRest = 1.0;

/// Least range of a level, in diagonals of the nodes two levels below it.
inline constexpr double kRangeTwoBelow = 2.19;

/// Texels along a side of the relief of a node; see SelectedNode::relief.
inline constexpr std::size_t kReliefTexels = 256;

/// The level of nodes whose relief has a texel a sample: finer ones would show nothing new.
inline constexpr std::size_t kReliefLevelMin = 3;

/// A map in the picture.
struct DetailView {
    OrbitCamera camera;
    Viewport viewport;
    double exaggeration = 1.0;
};

/// What is asked for.
struct DetailTarget {
    double error_px = 1.0;         // the surface may be off by this much in the picture; > 0
    double texel_px = 1.0;         // a texel of the relief is at most this large; > 0
    bool has_every_sample = false; // draw all of the surface, whatever it costs
};

/// Ranges in scene metres at the corners of a node: upper left, upper right, lower left, lower
/// right.
using CornerRanges = std::array<float, 4>;

/// The quadrants of a node: upper left, upper right, lower left, lower right, a bit each.
inline constexpr std::size_t kQuadrantCount = 4;
inline constexpr std::uint8_t kAllQuadrants = 0b1111;

struct SelectedNode {
    DetailNode node;
    std::uint8_t quadrants = kAllQuadrants; // those that are in the picture and not void
    CornerRanges parent_ranges_m{};         // of the node one level up, at its own corners
    CornerRanges grandparent_ranges_m{};    // two levels up
    DetailNode relief;       // the node, itself or one around it, whose relief it wears
    double distance_m = 0.0; // of its nearest point from the eye
};

struct DetailSelection {
    std::vector<SelectedNode> nodes; // nearest first
    std::size_t triangle_count = 0;
    double error_px = 0.0; // by the errors of its nodes, up to the one asked for
};

/// Selects detail of one map. For one thread at a time.
class DetailSelector {
public:
    /// `heightfield` and `frame` are those that `analysis` was made from.
    DetailSelector(std::shared_ptr<const SurfaceAnalysis> analysis,
                   std::size_t columns,
                   std::size_t rows,
                   const SceneFrame& frame);

    /// Everything that is in the picture and not void.
    DetailSelection select(const DetailView& view, const DetailTarget& target);

private:
    struct Pass;
    // What holds for a node because it does for one above it.
    struct Above {
        bool has_relief = false;
        bool is_inside = false; // the picture
    };

    using SizeRanges = std::vector<CornerGrid>; // by level
    const SizeRanges& sizeRangesFor(const DetailTarget& target);
    SizeRanges sizeRanges(double range_per_size) const;
    SceneBox boxOf(const DetailNode& node) const;
    std::uint8_t quadrantsIn(const Frustum& frustum, const DetailNode& node, bool is_inside) const;
    std::size_t triangleCount(const SelectedNode& selected) const;
    double diagonalOf(const DetailNode& node) const;
    void visit(const DetailNode& node, Above above, SelectedNode& selected, Pass& pass) const;
    float rangeAt(std::size_t level, std::size_t column, std::size_t row, const Pass& pass) const;
    CornerRanges rangesOf(const DetailNode& node, const Pass& pass) const;

    std::shared_ptr<const SurfaceAnalysis> analysis_;
    std::size_t columns_;
    std::size_t rows_;
    SceneFrame frame_;
    double cell_m_ = 1.0; // the longer side of a cell of level 0
    double exaggeration_ = 0.0;
    SizeRanges at_rest_m_; // for exaggeration_; empty until asked for
    SizeRanges moving_m_;
};

} // namespace marsview
