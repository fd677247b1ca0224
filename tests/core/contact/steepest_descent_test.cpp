#include "core/contact/continuous_walk.h"
#include "core/contact/heightfield_surface.h"
#include "core/contact/proxy_graph.h"
#include "core/contact/surface_walk.h"
#include "tests/core/contact/contact_terrain.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

namespace marsview {
namespace {

using Walk = SurfaceWalk<HeightfieldSurface>;

// Around a sample: to the right, right below, below, left, left above, above. Two that follow each
// other are the edges of a face.
constexpr std::array<std::array<int, 2>, 6> kAround{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 0}, {-1, -1}, {0, -1}}};

// The edge or face of a vertex on which the distance to the goal decreases fastest, per meter of
// way, which is the cosine of the angle to the goal's direction: by normal vectors, in contrast to
// the walk. For a face, the foot of the goal if that lies on it.
struct Steepest {
    double cosine = 0.0;
    double next_cosine = 0.0; // of the second steepest
    std::optional<ScenePoint> foot;

    void consider(double its_cosine, const std::optional<ScenePoint>& its_foot)
    {
        if (its_cosine > cosine) {
            next_cosine = cosine;
            cosine = its_cosine;
            foot = its_foot;
        } else {
            next_cosine = std::max(next_cosine, its_cosine);
        }
    }
};

Steepest steepestAt(const HeightfieldSurface& surface, int column, int row, const ScenePoint& goal)
{
    const auto point = [&](int c, int r) {
        const GridPoint grid{static_cast<double>(c), static_cast<double>(r)};
        return surface.frame().toScene(grid, test::bruteHeight(surface, grid));
    };
    const ScenePoint here = point(column, row);
    const Vec3 to_goal = goal - here;
    std::array<Vec3, 6> edges;
    for (std::size_t i = 0; i < 6; ++i) {
        edges[i] = point(column + kAround[i][0], row + kAround[i][1]) - here;
    }
    Steepest steepest;
    for (std::size_t i = 0; i < 6; ++i) {
        const Vec3& a = edges[i];
        const Vec3& b = edges[(i + 1) % 6];
        steepest.consider(dot(normalized(a), normalized(to_goal)), std::nullopt);
        const Vec3 normal = normalized(cross(a, b));
        const Vec3 to_foot = to_goal - normal * dot(normal, to_goal);
        // Within the angle between a and b, and if so, before the edge between their ends.
        const double from_a = dot(cross(a, to_foot), normal);
        const double from_b = dot(cross(to_foot, b), normal);
        if (from_a > 0.0 && from_b > 0.0) {
            const bool is_on_face = from_a + from_b < dot(cross(a, b), normal);
            steepest.consider(length(to_foot) / length(to_goal),
                              is_on_face ? std::optional(here + to_foot) : std::nullopt);
        }
    }
    return steepest;
}

// Straight below a sample the walk begins there. If the steepest way is over a face on which the
// goal's foot lies, the walk ends there, also where other faces and edges lead closer too. Returns
// how often that was so.
int endsAtSteepestFeet(const HeightfieldSurface& surface)
{
    Walk walk(surface);
    int feet = 0;
    for (int row = 1; row < 59; ++row) {
        for (int column = 1; column < 59; ++column) {
            for (const double depth_m : {0.3, 0.6, 1.2}) {
                const GridPoint grid{static_cast<double>(column), static_cast<double>(row)};
                const ScenePoint goal =
                    surface.frame().toScene(grid, surface.height(grid) - depth_m);
                const Steepest steepest = steepestAt(surface, column, row, goal);
                constexpr double kClearly = 1e-9;
                if (steepest.foot && steepest.cosine > steepest.next_cosine + kClearly) {
                    ++feet;
                    const ContactState state = walk.place(goal);
                    EXPECT_NEAR(test::distance(state.proxy, *steepest.foot), 0.0, 1e-9)
                        << column << " " << row << " " << depth_m;
                    EXPECT_EQ(state.feature, ContactFeature::Face);
                    // In one straight step over that face, not by way of an edge or a vertex.
                    EXPECT_EQ(state.counters.vertices, 1U);
                    EXPECT_EQ(state.counters.faces, 1U);
                }
            }
        }
    }
    return feet;
}

TEST(SteepestDescent, LeavesAVertexOverTheFaceThatLeadsCloserFastest)
{
    test::Random random;
    std::vector<float> heights;
    for (int i = 0; i < 60 * 60; ++i) {
        heights.push_back(static_cast<float>(random.uniform(-0.7, 0.7)));
    }
    const auto terrain = test::filledTerrain(60, heights);
    // Sheared, faces have edges that meet at obtuse angles. In these frames positions of samples
    // convert without rounding.
    for (const double east_per_row : {0.0, 0.75, -0.75, 1.5, -1.5}) {
        SceneFrame frame = test::unitFrame(*terrain);
        frame.east_per_row = east_per_row;
        EXPECT_GT(endsAtSteepestFeet({terrain, frame, 1.0}), 500) << east_per_row;
    }
    SceneFrame dense = test::unitFrame(*terrain); // faces of less than half a square meter
    dense.east_per_column = 0.5;
    dense.north_per_row = -0.5;
    EXPECT_GT(endsAtSteepestFeet({terrain, dense, 1.0}), 500);
}

// From samples around the middle one, except along `first` and `second`, the way to a deep goal
// leads into a pit.
HeightfieldSurface levelAmongPits(const std::array<int, 2>& first, const std::array<int, 2>& second)
{
    std::vector<float> heights(std::size_t{9} * 9, -1.0F);
    const auto level = [&](int column, int row) {
        heights[static_cast<std::size_t>((4 + row) * 9 + 4 + column)] = 0.0F;
    };
    level(0, 0);
    level(first[0] + second[0], first[1] + second[1]);
    for (const auto& [column, row] : kAround) {
        level(column, row);
    }
    return test::surfaceOver(test::filledTerrain(9, heights));
}

// A path through the middle sample goes on into the opposite face. It begins in a face of that
// sample or in the next one.
template <typename Model>
void crossesTheMiddle(const std::vector<double>& radii)
{
    for (std::size_t i = 0; i < 6; ++i) {
        const std::array<int, 2>& a = kAround[i];
        const std::array<int, 2>& b = kAround[(i + 1) % 6];
        for (const double share : {0.25, 0.5, 0.75}) {
            for (const double radius : radii) {
                const auto at = [&](double away, double z) {
                    return ScenePoint{away * (a[0] * share + b[0] * (1.0 - share)),
                                      -away * (a[1] * share + b[1] * (1.0 - share)), z};
                };
                Model model(levelAmongPits(a, b));
                ASSERT_EQ(model.place(at(radius, -0.125)).proxy, at(radius, 0.0));
                const ContactState state = model.update(at(-0.25, -6.0));
                EXPECT_NEAR(test::distance(state.proxy, at(-0.25, 0.0)), 0.0, 1e-12)
                    << i << ' ' << share << ' ' << radius;
                EXPECT_EQ(state.feature, ContactFeature::Face);
            }
        }
    }
}

TEST(SteepestDescent, APathThroughASampleGoesOnBeyondIt)
{
    crossesTheMiddle<Walk>({0.5, 1.25});
    crossesTheMiddle<ContinuousWalk<HeightfieldSurface>>({0.5, 1.25});
    crossesTheMiddle<ProxyGraph<HeightfieldSurface>>({0.5}); // from edges on it turns aside
}

// Straight below a position on an edge a descent begins there. Where both faces lead closer it
// takes the one on which the distance decreases faster, and ends at the goal's foot if that lies on
// it.
template <typename Model>
int leavesEdges(const HeightfieldSurface& surface)
{
    const auto point = [&](GridPoint grid) {
        return surface.frame().toScene(grid, test::bruteHeight(surface, grid));
    };
    Model model(surface);
    int feet = 0;
    for (int row = 1; row < 58; ++row) {
        for (int column = 1; column < 58; ++column) {
            const std::size_t kind = static_cast<std::size_t>(column + row) % 3;
            const auto sample = [&](const std::array<int, 2>& step) {
                return point(
                    {static_cast<double>(column + step[0]), static_cast<double>(row + step[1])});
            };
            const ScenePoint from = sample({0, 0});
            const Vec3 edge = sample(kAround[kind]) - from;
            const GridPoint grid{column + 0.375 * kAround[kind][0], row + 0.375 * kAround[kind][1]};
            const ScenePoint here = point(grid);
            for (const double depth_m : {0.25, 0.5, 1.0}) {
                const ScenePoint goal = surface.frame().toScene(grid, here.z - depth_m);
                Steepest steepest;
                int leads = 0;
                for (const std::size_t side : {(kind + 1) % 6, (kind + 5) % 6}) {
                    const Vec3 across = sample(kAround[side]) - from;
                    const Vec3 normal = normalized(cross(edge, across));
                    const Vec3 to_foot = (goal - here) - normal * dot(normal, goal - here);
                    // Signed areas of the triangles that the foot forms with the edges.
                    const Vec3 foot = (here + to_foot) - from;
                    const double in = dot(cross(edge, foot), normal);
                    const double before = dot(cross(foot, across), normal);
                    if (in > 0.0) {
                        ++leads;
                        const bool is_on_face =
                            before > 0.0 && in + before < dot(cross(edge, across), normal);
                        steepest.consider(length(to_foot) / depth_m,
                                          is_on_face ? std::optional(here + to_foot)
                                                     : std::nullopt);
                    }
                }
                // The proxy graph first takes the place on the edge that is nearest to the goal.
                const double along = dot(goal - from, edge) / dot(edge, edge);
                const bool is_beside = std::is_same_v<Model, Walk> || std::abs(along - 0.5) < 0.5;
                if (leads == 2 && is_beside && steepest.foot &&
                    steepest.cosine > steepest.next_cosine + 1e-9) {
                    ++feet;
                    EXPECT_NEAR(test::distance(model.place(goal).proxy, *steepest.foot), 0.0, 1e-9)
                        << column << ' ' << row << ' ' << depth_m;
                }
            }
        }
    }
    return feet;
}

TEST(SteepestDescent, LeavesAnEdgeOverTheFaceThatLeadsCloserFaster)
{
    test::Random random;
    std::vector<float> heights;
    for (int i = 0; i < 60 * 60; ++i) {
        heights.push_back(static_cast<float>(random.uniform(-0.5, 0.5)));
    }
    const auto terrain = test::filledTerrain(60, heights);
    for (const double east_per_row : {0.0, 0.75, -0.75}) {
        SceneFrame frame = test::unitFrame(*terrain);
        frame.east_per_row = east_per_row;
        const HeightfieldSurface surface(terrain, frame, 1.0);
        EXPECT_GT(leavesEdges<Walk>(surface), 200) << east_per_row;
        EXPECT_GT(leavesEdges<ProxyGraph<HeightfieldSurface>>(surface), 200) << east_per_row;
    }
}

// The height of a plane at a position in the grid, in meters.
double planeHeight(GridPoint at, double cell_m)
{
    return cell_m * (0.25 * at.column - 0.5 * at.row);
}

// Whole numbers between two others.
std::uint32_t wholeBetween(double a, double b)
{
    return static_cast<std::uint32_t>(
        std::max(0.0, std::ceil(std::max(a, b)) - std::floor(std::min(a, b)) - 1.0));
}

// On a plane the proxy goes straight from the foot of the last goal to that of the next, over as
// many edges as the grid's columns, rows and diagonals cross this line. Beginnings on an edge are
// exact where a cell has a meter.
template <typename Model>
void goesStraight(const HeightfieldSurface& surface, double cell_m, std::uint32_t more_faces)
{
    const SceneFrame& frame = surface.frame();
    const auto foot = [&](GridPoint at) { return frame.toScene(at, planeHeight(at, cell_m)); };
    const ScenePoint origin = foot({0.0, 0.0});
    Vec3 normal = normalized(cross(foot({1.0, 0.0}) - origin, foot({0.0, 1.0}) - origin));
    normal = normal.z < 0.0 ? -normal : normal;
    test::Random random;
    for (int i = 0; i < 300; ++i) {
        const auto within = [&] { return random.uniform(8.0, 32.0); };
        GridPoint from{within(), within()};
        if (cell_m == 1.0 && i % 4 > 0) {
            const double share = (std::floor(random.uniform(0.0, 8.0)) + 0.5) / 8.0;
            from = {std::floor(from.column), std::floor(from.row)};
            from.column += i % 4 != 1 ? share : 0.0;
            from.row += i % 4 != 2 ? share : 0.0;
        }
        const GridPoint to{within(), within()};
        const auto below = [&](GridPoint at, double depth) {
            return foot(at) - normal * (depth * cell_m / normal.z);
        };
        Model model(surface);
        model.place(below(from, 0.5));
        ASSERT_NEAR(test::distance(model.update(below(from, 0.5)).proxy, foot(from)), 0.0,
                    1e-9 * cell_m);
        const ContactState state = model.update(below(to, random.uniform(0.25, 2.0)));
        EXPECT_NEAR(test::distance(state.proxy, foot(to)), 0.0, 1e-9 * cell_m);
        EXPECT_EQ(state.counters.faces,
                  wholeBetween(from.column, to.column) + wholeBetween(from.row, to.row) +
                      wholeBetween(from.column - from.row, to.column - to.row) + more_faces)
            << i << ": " << from.column << ' ' << from.row << " to " << to.column << ' ' << to.row;
        EXPECT_EQ(state.counters.vertices, 0U);
    }
}

// The walk counts the last face, too; the continuous walk only those that it leaves.
TEST(SteepestDescent, OnAPlaneTheWayIsStraight)
{
    const auto plane = [](double cell_m) {
        std::vector<float> heights;
        for (int i = 0; i < 41 * 41; ++i) {
            const GridPoint at{static_cast<double>(i % 41), static_cast<double>(i / 41)};
            heights.push_back(static_cast<float>(planeHeight(at, cell_m)));
        }
        return test::filledTerrain(41, heights);
    };
    const auto check = [](const HeightfieldSurface& surface, double cell_m) {
        goesStraight<Walk>(surface, cell_m, 1);
        goesStraight<ContinuousWalk<HeightfieldSurface>>(surface, cell_m, 0);
    };
    check(test::surfaceOver(plane(1.0)), 1.0);
    for (const double cell_m : {0.125, 1024.0}) {
        const auto terrain = plane(cell_m);
        SceneFrame frame = test::unitFrame(*terrain);
        frame.east_per_column = 0.75 * cell_m;
        frame.north_per_column = 0.5 * cell_m;
        frame.east_per_row = 0.25 * cell_m;
        frame.north_per_row = cell_m < 1.0 ? cell_m : -cell_m; // mirrored or not
        check({terrain, frame, 1.0}, cell_m);
    }
}

// Only the faces below a straight path are level: a walk that leaves one of them over another edge
// than the path falls into a pit.
template <typename Model>
void keepsToTheCorridor()
{
    constexpr int kSide = 24;
    test::Random random;
    for (int i = 0; i < 120; ++i) {
        const auto within = [&] { return random.uniform(7.0, 16.0); };
        const GridPoint from{within(), within()};
        const GridPoint to{within(), within()};
        std::vector<float> heights(std::size_t{kSide} * kSide, -1.0F);
        const auto level = [&](double column, double row) {
            const int c = static_cast<int>(column);
            const int r = static_cast<int>(row);
            const bool is_upper = column - c >= row - r;
            for (const auto& [x, y] :
                 {std::array{c, r}, std::array{c + 1, r + 1},
                  std::array{c + (is_upper ? 1 : 0), r + (is_upper ? 0 : 1)}}) {
                heights[static_cast<std::size_t>(y * kSide + x)] = 0.0F;
            }
        };
        for (int k = 0; k <= 2000; ++k) {
            constexpr double kBeside = 0.005; // also faces of which the path only passes a corner
            for (const double x : {-kBeside, kBeside}) {
                for (const double y : {-kBeside, kBeside}) {
                    level(from.column + k / 2000.0 * (to.column - from.column) + x,
                          from.row + k / 2000.0 * (to.row - from.row) + y);
                }
            }
        }
        const HeightfieldSurface surface = test::surfaceOver(test::filledTerrain(kSide, heights));
        const auto at = [&](GridPoint grid, double z) { return surface.frame().toScene(grid, z); };
        Model model(surface);
        model.place(at(from, -1e-3));
        ASSERT_NEAR(test::distance(model.update(at(from, -1e-3)).proxy, at(from, 0.0)), 0.0, 1e-12);
        EXPECT_NEAR(test::distance(model.update(at(to, -30.0)).proxy, at(to, 0.0)), 0.0, 1e-12)
            << i << ": " << from.column << ' ' << from.row << " to " << to.column << ' ' << to.row;
    }
}

TEST(SteepestDescent, LeavesEveryFaceWhereTheStraightWayDoes)
{
    keepsToTheCorridor<Walk>();
    keepsToTheCorridor<ContinuousWalk<HeightfieldSurface>>();
}

} // namespace
} // namespace marsview
