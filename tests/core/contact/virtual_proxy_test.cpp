#include "core/contact/heightfield_surface.h"
#include "core/contact/virtual_proxy.h"
#include "tests/core/contact/contact_terrain.h"
#include "tests/support/fractal_terrain.h"
#include "tests/support/nan.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

namespace marsview {
namespace {

using test::distance;
using test::surfaceOver;

using Model = VirtualProxy<HeightfieldSurface>;

// Every instantiation, for all sample types.
static_assert(noexcept(
    std::declval<VirtualProxy<PlainHeightfieldSurface<std::int16_t>>&>().update(ScenePoint{})));
static_assert(
    noexcept(std::declval<VirtualProxy<PlainHeightfieldSurface<float>>&>().update(ScenePoint{})));

// --- the truth, in long double and by other means than the model's

struct Long3 {
    long double x = 0;
    long double y = 0;
    long double z = 0;
    Long3 operator+(const Long3& o) const { return {x + o.x, y + o.y, z + o.z}; }
    Long3 operator-(const Long3& o) const { return {x - o.x, y - o.y, z - o.z}; }
    Long3 operator*(long double s) const { return {x * s, y * s, z * s}; }
};

long double dot(const Long3& a, const Long3& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// The point of a triangle nearest to p, by the Voronoi regions of corners, edges and inside.
Long3 nearestOf(const Long3& p, const Long3& a, const Long3& b, const Long3& c)
{
    const Long3 ab = b - a;
    const Long3 ac = c - a;
    const Long3 ap = p - a;
    const long double d1 = dot(ab, ap);
    const long double d2 = dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) {
        return a;
    }
    const Long3 bp = p - b;
    const long double d3 = dot(ab, bp);
    const long double d4 = dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) {
        return b;
    }
    const long double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) {
        return a + ab * (d1 / (d1 - d3));
    }
    const Long3 cp = p - c;
    const long double d5 = dot(ab, cp);
    const long double d6 = dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) {
        return c;
    }
    const long double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) {
        return a + ac * (d2 / (d2 - d6));
    }
    const long double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    const long double all = va + vb + vc;
    return a + ab * (vb / all) + ac * (vc / all);
}

// A few times the resolution of double coordinates.
double ulps(const ScenePoint& p)
{
    return 0x1p-48 * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
}

struct Near {
    Vec3 normal; // toward the center
    double distance;
};

// The triangles closer to a center than `reach`, searched in all cells below it.
std::vector<Near>
trianglesNear(const HeightfieldSurface& surface, const ScenePoint& center, double reach)
{
    const FilledHeightfield& terrain = *surface.terrain();
    const SceneFrame& frame = surface.frame();
    double low_c = 1e9;
    double high_c = -1e9;
    double low_r = 1e9;
    double high_r = -1e9;
    for (const double x : {-reach, reach}) {
        for (const double y : {-reach, reach}) {
            const GridPoint grid = frame.toGrid({center.x + x, center.y + y, 0.0});
            low_c = std::min(low_c, grid.column);
            high_c = std::max(high_c, grid.column);
            low_r = std::min(low_r, grid.row);
            high_r = std::max(high_r, grid.row);
        }
    }
    std::vector<Near> near;
    const Long3 p{center.x, center.y, center.z};
    const int last_c = static_cast<int>(terrain.columns()) - 2;
    const int last_r = static_cast<int>(terrain.rows()) - 2;
    for (int r = std::max(static_cast<int>(low_r) - 1, 0);
         r <= std::min(static_cast<int>(high_r) + 1, last_r); ++r) {
        for (int c = std::max(static_cast<int>(low_c) - 1, 0);
             c <= std::min(static_cast<int>(high_c) + 1, last_c); ++c) {
            const auto at = [&](int column, int row) -> Long3 {
                const ScenePoint q = frame.toScene(
                    {static_cast<double>(column), static_cast<double>(row)},
                    surface.exaggeration() * terrain.sample(static_cast<std::size_t>(column),
                                                            static_cast<std::size_t>(row)));
                return {q.x, q.y, q.z};
            };
            for (const bool is_upper : {true, false}) {
                const Long3 q = nearestOf(p, at(c, r), at(c + 1, r + 1),
                                          is_upper ? at(c + 1, r) : at(c, r + 1));
                const Long3 to = p - q;
                const double d = static_cast<double>(std::sqrt(dot(to, to)));
                if (d <= reach) {
                    near.push_back({{static_cast<double>(to.x) / d, static_cast<double>(to.y) / d,
                                     static_cast<double>(to.z) / d},
                                    d});
                }
            }
        }
    }
    return near;
}

// The part of the vector to the goal that tangent planes with these normals do not block: the
// smallest remainder after adding nonnegative multiples of one, two or three of the normals. More
// normals would not make it smaller. 0 at a local minimum.
double unheld(const Vec3& to_goal, const std::vector<Vec3>& normals)
{
    std::vector<Long3> n;
    for (const Vec3& normal : normals) {
        n.push_back({normal.x, normal.y, normal.z});
    }
    const Long3 way{to_goal.x, to_goal.y, to_goal.z};
    long double least = dot(way, way);
    const auto det = [](const Long3& a, const Long3& b, const Long3& c) {
        return a.x * (b.y * c.z - b.z * c.y) - a.y * (b.x * c.z - b.z * c.x) +
               a.z * (b.x * c.y - b.y * c.x);
    };
    for (std::size_t i = 0; i < n.size(); ++i) {
        const long double one = -dot(n[i], way);
        if (one >= 0) {
            const Long3 rest = way + n[i] * one;
            least = std::min(least, dot(rest, rest));
        }
        for (std::size_t j = 0; j < i; ++j) {
            const long double cosine = dot(n[i], n[j]);
            const long double sine_squared = 1 - cosine * cosine;
            if (sine_squared < 1e-16L) {
                continue;
            }
            const long double a = (-dot(n[i], way) + cosine * dot(n[j], way)) / sine_squared;
            const long double b = (-dot(n[j], way) + cosine * dot(n[i], way)) / sine_squared;
            if (a >= 0 && b >= 0) {
                const Long3 rest = way + n[i] * a + n[j] * b;
                least = std::min(least, dot(rest, rest));
            }
            for (std::size_t k = 0; k < j; ++k) {
                const long double all = det(n[i], n[j], n[k]);
                const Long3 back = way * -1;
                if (std::abs(all) > 1e-9L && det(back, n[j], n[k]) / all >= 0 &&
                    det(n[i], back, n[k]) / all >= 0 && det(n[i], n[j], back) / all >= 0) {
                    return 0.0;
                }
            }
        }
    }
    return static_cast<double>(std::sqrt(least));
}

struct Tally {
    long updates = 0;
    long contacts = 0;
    long casts = 0;
    long faces = 0;
    long most_casts = 0;
    long cut_short = 0;
    long not_minimal = 0;
    double worst_unheld = 0.0; // of the way to the goal
    double worst_depth = 0.0;  // of the radius
    double worst_gap = 0.0;    // of the radius
    double worst_growth = 0.0; // of the radius

    void add(const Tally& other)
    {
        updates += other.updates;
        contacts += other.contacts;
        casts += other.casts;
        faces += other.faces;
        most_casts = std::max(most_casts, other.most_casts);
        cut_short += other.cut_short;
        not_minimal += other.not_minimal;
        worst_unheld = std::max(worst_unheld, other.worst_unheld);
        worst_depth = std::max(worst_depth, other.worst_depth);
        worst_gap = std::max(worst_gap, other.worst_gap);
        worst_growth = std::max(worst_growth, other.worst_growth);
    }
    void print(const std::string& name) const
    {
        const double n = static_cast<double>(std::max(contacts, 1L));
        std::printf(
            "%s: %ld updates, %ld in contact; %.2f sweeps (at most %ld), %.1f faces a "
            "contact; %ld not minimal, %ld cut short; of the way unheld %.2g; of the "
            "radius: depth %.2g, gap %.2g, growth %.2g\n",
            name.c_str(), updates, contacts, static_cast<double>(casts) / n, most_casts,
            static_cast<double>(faces) / n, not_minimal, cut_short, worst_unheld, worst_depth,
            worst_gap, worst_growth);
    }
};

class Judge {
public:
    explicit Judge(const HeightfieldSurface& surface)
        : surface_(surface)
    {}

    void check(Model& model, const ScenePoint& goal)
    {
        const ContactState state = model.update(goal);
        const ScenePoint seen = test::clampedGoal(surface_, goal);
        const Vec3 to_goal = seen - state.proxy;
        const double radius = model.radius();
        const double tolerance = model.tolerance(state.proxy);
        ++tally_.updates;
        tally_.casts += state.counters.casts;
        tally_.faces += state.counters.faces;
        tally_.most_casts = std::max<long>(tally_.most_casts, state.counters.casts);
        tally_.cut_short += state.counters.cut_short;
        EXPECT_EQ(state.is_in_contact, state.feature != ContactFeature::Free);
        const GridPoint grid = surface_.frame().toGrid(state.proxy);
        ASSERT_GT(state.proxy.z, test::bruteHeight(surface_, grid)) << "below the surface";
        // Triangles that are farther than rounding error are not in contact; their tangent planes
        // do not count.
        const double touching = 0.01 * tolerance + ulps(state.proxy);
        const auto near = trianglesNear(surface_, state.proxy, radius + tolerance);
        double nearest = std::numeric_limits<double>::infinity();
        std::vector<Vec3> normals;
        for (const Near& each : near) {
            nearest = std::min(nearest, each.distance);
            if (each.distance <= radius + touching) {
                normals.push_back(each.normal);
            }
        }
        tally_.worst_depth = std::max(tally_.worst_depth, (radius - nearest) / radius);
        ASSERT_GE(nearest, radius - tolerance) << "in the surface";
        if (!state.is_in_contact) {
            ASSERT_TRUE(state.proxy == seen || length(to_goal) < 1e-9);
        } else {
            ++tally_.contacts;
            ASSERT_LE(nearest, radius + tolerance) << "off the surface";
            tally_.worst_gap = std::max(tally_.worst_gap, (nearest - radius) / radius);
            const double last_c = static_cast<double>(surface_.terrain()->columns() - 1);
            const double last_r = static_cast<double>(surface_.terrain()->rows() - 1);
            const auto add_wall = [&](bool is_at, Vec3 along, GridPoint inside) {
                if (is_at) {
                    Vec3 normal = normalized(Vec3{-along.y, along.x, 0.0});
                    if (dot(normal, surface_.frame().toScene(inside, 0.0) - state.proxy) < 0.0) {
                        normal = -normal;
                    }
                    normals.push_back(normal);
                }
            };
            const SceneFrame& frame = surface_.frame();
            const Vec3 row{frame.east_per_row, frame.north_per_row, 0.0};
            const Vec3 column{frame.east_per_column, frame.north_per_column, 0.0};
            const GridPoint middle{0.5 * last_c, 0.5 * last_r};
            constexpr double kOn = 1e-8;
            add_wall(grid.column < kOn || grid.column > last_c - kOn, row, middle);
            add_wall(grid.row < kOn || grid.row > last_r - kOn, column, middle);
            const double rest = unheld(to_goal, normals);
            const double allowed =
                (1e-6 + 4.0 * std::sqrt(ulps(state.proxy) / radius)) * length(to_goal) +
                8.0 * ulps(state.proxy) * (1.0 + length(to_goal) / radius) + 1e-9 * radius;
            tally_.worst_unheld = std::max(tally_.worst_unheld, rest / (length(to_goal) + radius));
            if (rest > allowed && state.counters.cut_short == 0) {
                ++tally_.not_minimal;
                ADD_FAILURE() << rest << " m unheld of " << length(to_goal) << " at " << grid.column
                              << ", " << grid.row << ", " << normals.size() << " planes";
            }
        }
        if (has_last_) {
            const double growth = (length(to_goal) - last_distance_) - distance(seen, last_goal_);
            tally_.worst_growth = std::max(tally_.worst_growth, growth / radius);
            ASSERT_LE(growth, 4.0 * tolerance + 1e-9 * length(to_goal));
        }
        has_last_ = true;
        last_goal_ = seen;
        last_distance_ = length(to_goal);
    }
    const Tally& tally() const { return tally_; }

private:
    const HeightfieldSurface& surface_;
    Tally tally_;
    ScenePoint last_goal_;
    double last_distance_ = 0.0;
    bool has_last_ = false;
};

Tally wander(const HeightfieldSurface& surface,
             double radius_m,
             test::Random& random,
             int updates,
             double step_cells)
{
    Model model(surface, radius_m);
    Judge judge(surface);
    test::judgeWandering(judge, model, surface, random, updates, step_cells);
    return judge.tally();
}

void expectPromisesKept(const Tally& tally, const std::string& name)
{
    tally.print(name);
    EXPECT_GT(tally.contacts, 0);
    EXPECT_EQ(tally.not_minimal, 0);
    EXPECT_EQ(tally.cut_short, 0);
}

TEST(VirtualProxy, MeetsItsGuaranteesOnEverySyntheticTerrain)
{
    test::Random random;
    for (const double radius_m : {0.05, 0.7, 3.0}) {
        Tally sum;
        for (const auto& [name, terrain] : test::syntheticTerrains()) {
            SCOPED_TRACE(name);
            const HeightfieldSurface surface = surfaceOver(terrain);
            for (const double step_cells : {0.1, 1.0, 12.0}) {
                sum.add(wander(surface, radius_m, random, 300, step_cells));
            }
        }
        expectPromisesKept(sum, "synthetic terrains, radius " + std::to_string(radius_m));
    }
}

TEST(VirtualProxy, MeetsItsGuaranteesInShearedFramesAndAtAnyExaggeration)
{
    test::Random random;
    const auto terrain = test::filledTerrain(90, test::fractalHeights(90, 110, 8));
    Tally sum;
    for (int i = 0; i < 24; ++i) {
        const auto [frame, cell_m] = test::shearedFrame(*terrain, random, i % 2 == 0);
        const HeightfieldSurface surface(terrain, frame, cell_m * random.uniform(0.1, 20.0));
        sum.add(wander(surface, cell_m * random.uniform(0.1, 2.0), random, 400, 2.0));
    }
    expectPromisesKept(sum, "sheared frames");
}

TEST(VirtualProxy, MeetsItsGuaranteesOnTheBundledMaps)
{
    test::Random random;
    Tally sum;
    for (const auto& [name, terrain, frame] : test::bundledMaps()) {
        SCOPED_TRACE(name);
        const double cell_m = std::hypot(frame.east_per_column, frame.north_per_column);
        for (const double exaggeration : {1.0, 5.0, 20.0}) {
            const HeightfieldSurface surface(terrain, frame, exaggeration);
            sum.add(wander(surface, 0.7 * cell_m, random, 800, 0.5));
            sum.add(wander(surface, 0.7 * cell_m, random, 800, 10.0));
        }
    }
    expectPromisesKept(sum, "bundled maps");
}

TEST(VirtualProxy, MeetsItsGuaranteesWithARadiusOfManyCells)
{
    test::Random random;
    const auto terrain = test::filledTerrain(130, test::fractalHeights(130, 97, 4));
    const HeightfieldSurface surface = surfaceOver(terrain, 5.0);
    expectPromisesKept(wander(surface, 20.0, random, 200, 3.0), "radius of 20 cells");
}

// Terrain that is constant along y.
HeightfieldSurface ruled(double (*height)(double x))
{
    std::vector<float> heights;
    for (int r = 0; r < 41; ++r) {
        for (int c = 0; c < 41; ++c) {
            heights.push_back(static_cast<float>(height(c - 20.0)));
        }
    }
    return surfaceOver(test::filledTerrain(41, heights));
}

// The paper's figure 3, in configuration space.
TEST(VirtualProxy, RestsARadiusOffTheFootOfTheGoalOnAPlane)
{
    Model model(ruled([](double x) { return 0.5 * x; }), 0.8);
    const Vec3 up = normalized(Vec3{-1.0, 0.0, 2.0});
    EXPECT_EQ(model.update({-3.0, 0.25, 5.0}).proxy, (ScenePoint{-3.0, 0.25, 5.0}));
    const Vec3 foot{4.0, 0.25, 2.0};
    const ContactState at = model.update(foot - up * 3.0);
    EXPECT_TRUE(at.is_in_contact);
    EXPECT_EQ(at.feature, ContactFeature::Face);
    EXPECT_NEAR(distance(at.proxy, foot + up * 0.8), 0.0, 1e-9);
}

TEST(VirtualProxy, DoesNotReachTheBottomOfAValley)
{
    Model model(ruled([](double x) { return std::abs(x); }), 0.8);
    const ContactState at = model.update({0.3, 0.25, -4.0});
    EXPECT_NEAR(distance(at.proxy, {0.0, 0.25, 0.8 * std::sqrt(2.0)}), 0.0, 1e-9);
    EXPECT_EQ(at.feature, ContactFeature::Face);
}

TEST(VirtualProxy, RollsOverARidgeToTheOtherSide)
{
    Model model(ruled([](double x) { return -std::abs(x); }), 0.8);
    const Vec3 up = normalized(Vec3{1.0, 0.0, 1.0});
    model.update({-3.0, 0.25, -4.0});
    // Pulled over the top, and from there down the other side.
    const ContactState top = model.update({0.0, 0.25, 0.5});
    EXPECT_NEAR(distance(top.proxy, {0.0, 0.25, 0.8}), 0.0, 1e-6);
    EXPECT_EQ(top.feature, ContactFeature::Edge);
    const Vec3 foot{4.0, 0.25, -4.0};
    const ContactState other = model.update(foot - up * 2.0);
    EXPECT_NEAR(distance(other.proxy, foot + up * 0.8), 0.0, 1e-9);
}

TEST(VirtualProxy, StaysOnTheRimOfAHoleThatIsTooNarrow)
{
    std::vector<float> heights(std::size_t{41} * 41, 0.0F);
    heights[std::size_t{20} * 41 + 20] = -9.0F;
    const auto terrain = test::filledTerrain(41, heights);
    Model narrow(surfaceOver(terrain), 0.05);
    Model wide(surfaceOver(terrain), 1.5);
    const ScenePoint goal{0.0, 0.0, -8.5};
    EXPECT_LT(narrow.update(goal).proxy.z, -7.5);
    const ContactState on_rim = wide.update(goal);
    EXPECT_GT(on_rim.proxy.z, 0.5);
    EXPECT_TRUE(on_rim.is_in_contact);
}

TEST(VirtualProxy, IsPlacedWhereASphereComesDownOntoTheTerrain)
{
    const auto terrain = test::filledTerrain(41, std::vector<float>(std::size_t{41} * 41, 7.0F));
    Model model(surfaceOver(terrain), 1.25);
    const ContactState below = model.place({2.5, 3.25, -40.0});
    EXPECT_NEAR(distance(below.proxy, {2.5, 3.25, 8.25}), 0.0, 1e-9);
    // Above the surface, but by less than the radius.
    const ContactState inside = model.place({2.5, 3.25, 7.5});
    EXPECT_NEAR(distance(inside.proxy, {2.5, 3.25, 8.25}), 0.0, 1e-9);
    EXPECT_TRUE(inside.is_in_contact);
    const ContactState free = model.place({2.5, 3.25, 8.5});
    EXPECT_EQ(free.proxy, (ScenePoint{2.5, 3.25, 8.5}));
    EXPECT_FALSE(free.is_in_contact);
}

TEST(VirtualProxy, VisitsNoCellsFarAboveTheTerrain)
{
    const auto terrain = test::filledTerrain(513, test::fractalHeights(513, 513, 1));
    Model model(surfaceOver(terrain), 0.5);
    test::Random random;
    model.update({0.0, 0.0, 300.0});
    for (int i = 0; i < 1000; ++i) {
        const ScenePoint goal{random.uniform(-250, 250), random.uniform(-250, 250), 300.0};
        const ContactState state = model.update(goal);
        EXPECT_EQ(state.proxy, goal);
        EXPECT_EQ(state.counters.faces, 0U);
        EXPECT_LE(state.counters.cells, 4U);
    }
}

TEST(VirtualProxy, VisitsOnlyCellsNearALongPath)
{
    const auto terrain = test::filledTerrain(1025, test::fractalHeights(1025, 1025, 1));
    Model model(surfaceOver(terrain), 0.5);
    model.update({-500.0, -500.0, 2000.0});
    const ContactState state = model.update({500.0, 500.0, -2000.0});
    std::printf("across the map, down to it: %u looks, %u faces, %u sweeps\n", state.counters.cells,
                state.counters.faces, state.counters.casts);
    EXPECT_TRUE(state.is_in_contact);
    EXPECT_EQ(state.counters.cut_short, 0U);
    EXPECT_LT(state.counters.cells, 1025U * 1025U / 4U);
}

TEST(VirtualProxy, KeepsItsCenterWithinTheBorderOfTheMap)
{
    Model model(ruled([](double x) { return -x; }), 0.5);
    const ContactState below = model.update({500.0, 300.0, -200.0});
    EXPECT_NEAR(below.proxy.x, 20.0, 1e-9);
    EXPECT_NEAR(below.proxy.y, 20.0, 1e-9);
    EXPECT_TRUE(below.is_in_contact);
    const ContactState above = model.update({500.0, 3.0, 10.0});
    EXPECT_EQ(above.proxy, (ScenePoint{20.0, 3.0, 10.0}));
}

TEST(VirtualProxy, KeepsItsPositionForAnInvalidGoal)
{
    const auto terrain = test::filledTerrain(41, test::fractalHeights(41, 41, 3));
    const HeightfieldSurface surface = surfaceOver(terrain);
    Model model(surface, 0.5);
    const ContactState unplaced = model.update({kNan, 0.0, 0.0});
    EXPECT_TRUE(unplaced.is_in_contact);
    EXPECT_EQ(unplaced.counters.refused, 1U);
    const ContactState held = model.update({1.5, 2.5, -10.0});
    for (const double bad : {kNan, std::numeric_limits<double>::infinity(), -1e300}) {
        const ContactState state = model.update({1.0, 1.0, bad});
        EXPECT_EQ(state.proxy, held.proxy);
        EXPECT_EQ(state.feature, held.feature);
        EXPECT_EQ(state.counters.refused, 1U);
        EXPECT_EQ(state.counters.casts, 0U);
    }
    for (const double far_m : {1e12, -1e12}) {
        EXPECT_EQ(model.update({far_m, -far_m, far_m}).counters.cut_short, 0U);
    }
}

TEST(VirtualProxy, IsLiftedByASurfaceThatRises)
{
    const auto terrain = test::filledTerrain(41, std::vector<float>(std::size_t{41} * 41, 10.0F));
    Model model(surfaceOver(terrain), 0.5);
    model.update({1.0, 2.0, 12.0});
    model.setSurface(surfaceOver(terrain, 1.1));
    const ContactState free = model.update({kNan, 0.0, 0.0});
    EXPECT_EQ(free.proxy, (ScenePoint{1.0, 2.0, 12.0}));
    EXPECT_FALSE(free.is_in_contact);
    model.setSurface(surfaceOver(terrain, 3.0));
    const ContactState lifted = model.update({kNan, 0.0, 0.0});
    EXPECT_NEAR(distance(lifted.proxy, {1.0, 2.0, 30.5}), 0.0, 1e-9);
    EXPECT_TRUE(lifted.is_in_contact);
}

TEST(VirtualProxy, SinksWithTheSurfaceThatItTouches)
{
    const auto terrain = test::filledTerrain(41, std::vector<float>(std::size_t{41} * 41, 10.0F));
    Model model(surfaceOver(terrain), 0.5);
    model.update({1.0, 2.0, 8.0});
    model.setSurface(surfaceOver(terrain, 0.1));
    const ContactState sunk = model.update({kNan, 0.0, 0.0});
    EXPECT_NEAR(distance(sunk.proxy, {1.0, 2.0, 1.5}), 0.0, 1e-9);
    EXPECT_TRUE(sunk.is_in_contact);
}

TEST(VirtualProxyDeathTest, RefusesARadiusThatIsNotPositiveAndFinite)
{
    const auto terrain = test::filledTerrain(3, std::vector<float>(9, 1.0F));
    for (const double radius_m : {0.0, -1.0, kNan, std::numeric_limits<double>::infinity()}) {
        EXPECT_DEATH(Model(surfaceOver(terrain), radius_m), "check failed") << radius_m;
    }
}

} // namespace
} // namespace marsview
