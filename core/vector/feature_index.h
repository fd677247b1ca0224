// A spatial index of features in a plane that also simplifies them to what a picture can show.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace marsview {

struct PlanePoint {
    double x = 0.0;
    double y = 0.0;
    bool operator==(const PlanePoint&) const = default;
};

struct PlaneBox {
    double min_x = std::numeric_limits<double>::infinity();
    double min_y = std::numeric_limits<double>::infinity();
    double max_x = -std::numeric_limits<double>::infinity();
    double max_y = -std::numeric_limits<double>::infinity();

    void include(const PlanePoint& point) noexcept;
    void include(const PlaneBox& box) noexcept;
    /// 0 inside.
    double distance(const PlanePoint& point) const noexcept;
};

enum class PlaneShape : std::uint8_t { Dot, Line, Ring };

/// The parts of features in a plane, in any unit. All coordinates are finite.
struct PlaneFeatures {
    struct Part {
        std::uint32_t feature = 0; // a number of the caller's
        PlaneShape shape = PlaneShape::Dot;
        std::size_t begin = 0; // of `points`
        std::size_t end = 0;
    };
    std::vector<PlanePoint> points;
    std::vector<Part> parts;
    /// Of `points` up to the last one of these that a line only has for its course; nothing places
    /// a vertex there.
    std::vector<bool> is_course;

    void addDot(std::uint32_t feature, const PlanePoint& point);
    /// A line or a ring, which ends with its first point. At least two points.
    /// `is_course_of_path` is as long as the path, or empty.
    void add(std::uint32_t feature,
             PlaneShape shape,
             std::span<const PlanePoint> path,
             const std::vector<bool>& is_course_of_path = {});
};

/// Immutable; any thread. The parts are sorted along a Z-order curve and packed into a tree of
/// boxes (as a packed R-tree); each line is a tree of strips (D. H. Ballard 1981, Strip trees,
/// Comm. ACM 24, 310–321), so that any stretch of it is available at any resolution. Building takes
/// about a second for a million points.
class FeatureIndex {
public:
    FeatureIndex() = default;
    explicit FeatureIndex(PlaneFeatures features);

    /// The size of the smallest visible detail in a box, > 0; infinity where nothing is visible.
    using Resolution = std::function<double(const PlaneBox&)>;

    /// What is visible. A dot is a piece of one point, a line of at least two.
    struct Selection {
        struct Piece {
            std::uint32_t feature = 0;
            PlaneShape shape = PlaneShape::Dot;
            std::size_t begin = 0; // of `points`
            std::size_t end = 0;
            std::uint32_t part = 0; // of the features, below partCount()
        };
        std::vector<PlanePoint> points;
        std::vector<Piece> pieces;
        /// How much coarser than requested; 1 unless `points_max` required it.
        double coarsening = 1.0;
    };

    /// The visible features with at most `points_max` points. Lines are simplified: no vertex is
    /// farther from the result than the resolution. Where several features lie in a box whose sides
    /// are not longer than the resolution, one of them represents all; those that are selected at
    /// some resolution are also selected at finer ones.
    /// `likely_coarsening`, that of a picture of a moment ago for example, saves time and changes
    /// nothing.
    Selection select(const Resolution& resolution,
                     std::size_t points_max,
                     double likely_coarsening = 1.0) const;

    /// The feature at a place: the nearest dot within `reach`, or else the nearest line or border
    /// within it, or else the smallest polygon around the place, by the even-odd rule over all
    /// rings of a feature. Empty if there is none.
    std::optional<std::uint32_t> find(const PlanePoint& place, double reach) const;

    /// The vertex that is nearest to a place, of dots, lines and borders, if it is within `reach`.
    std::optional<PlanePoint> nearestVertex(const PlanePoint& place, double reach) const;

    /// Of all parts of a feature; takes as long as there are parts.
    PlaneBox boxOf(std::uint32_t feature) const;

    std::size_t partCount() const noexcept { return features_.parts.size(); }

private:
    // The vertices first … last of a line. The halves of an inner strip are the next one and
    // `right`.
    struct Strip {
        PlaneBox box;
        double deviation = 0.0; // of its vertices from the straight line between first and last
        std::size_t right = 0;
    };
    class Selector;
    class Finder;
    class VertexFinder;

    std::size_t addStrip(std::size_t first, std::size_t last);
    PlaneBox boxOfItem(std::size_t item) const;
    PlaneBox boxOfNode(std::size_t level, std::size_t index) const;
    // Of level − 1: the first one, and the one after the last. `level` > 0.
    std::pair<std::size_t, std::size_t> nodesBelow(std::size_t level, std::size_t index) const;

    PlaneFeatures features_;
    std::vector<std::uint32_t> order_; // parts along the curve: the items
    std::vector<std::size_t> roots_;   // of each part: its first strip
    std::vector<Strip> strips_;
    std::vector<std::vector<PlaneBox>> boxes_; // by level, of 8 nodes below each; [0]: of 8 items
};

} // namespace marsview
