// The proxy graph as published, compared with a second implementation of the paper's sentences.
#include "core/contact/heightfield_surface.h"
#include "core/contact/proxy_graph_2003.h"
#include "tests/core/contact/contact_judge.h"
#include "tests/core/contact/contact_terrain.h"
#include "tests/support/fractal_terrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace marsview {
namespace {

using test::distance;
using test::LongVec;
using test::longVec;
using test::surfaceOver;

using Model = ProxyGraph2003<HeightfieldSurface>;

constexpr test::ModelTraits kTraits{.begins_at_vertices = true};

LongVec crossed(const LongVec& a, const LongVec& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Sections 3.2 to 3.4 on coordinates alone, in long double. Casts test every triangle of the map.
class SecondImplementation {
public:
    explicit SecondImplementation(const HeightfieldSurface& surface)
        : surface_(surface)
        , columns_(static_cast<int>(surface.terrain()->columns()))
        , rows_(static_cast<int>(surface.terrain()->rows()))
    {}

    int casts = 0;
    int vertices = 0;
    int far_edges = 0;

    // Free at a point above the surface.
    void putAt(const ScenePoint& point)
    {
        at_.clear();
        proxy_ = longVec(point);
    }
    LongVec proxy() const { return proxy_; }

    void update(const ScenePoint& goal)
    {
        goal_ = longVec(goal);
        casts = 0;
        vertices = 0;
        far_edges = 0;
        crossings_.clear();
        left_ = std::numeric_limits<long double>::infinity();
        // "A single collision test is used to advance the proxy until it either reaches the goal or
        // contacts a triangle in the scene."
        if (!cast()) {
            return;
        }
        while (step()) {
        }
    }

private:
    struct Sample {
        int column;
        int row;
        bool operator==(const Sample&) const = default;
    };
    using Triangle = std::array<Sample, 3>;

    LongVec of(Sample s) const
    {
        const ScenePoint p =
            surface_.frame().toScene({static_cast<double>(s.column), static_cast<double>(s.row)},
                                     surface_.terrain()->sample(static_cast<std::size_t>(s.column),
                                                                static_cast<std::size_t>(s.row)) *
                                         surface_.exaggeration());
        return longVec(p);
    }
    bool exists(Sample s) const
    {
        return s.column >= 0 && s.row >= 0 && s.column < columns_ && s.row < rows_;
    }
    long double toGoal(Sample s) const { return length(goal_ - of(s)); }
    std::vector<Triangle> triangles() const
    {
        std::vector<Triangle> all;
        for (int r = 0; r + 1 < rows_; ++r) {
            for (int c = 0; c + 1 < columns_; ++c) {
                all.push_back({{{c, r}, {c + 1, r + 1}, {c + 1, r}}});
                all.push_back({{{c, r}, {c, r + 1}, {c + 1, r + 1}}});
            }
        }
        return all;
    }
    static bool has(const Triangle& t, const std::vector<Sample>& samples)
    {
        return std::all_of(samples.begin(), samples.end(), [&](const Sample& s) {
            return std::find(t.begin(), t.end(), s) != t.end();
        });
    }
    LongVec upward(const Triangle& t) const
    {
        const LongVec n = crossed(of(t[1]) - of(t[0]), of(t[2]) - of(t[0]));
        return n.z < 0.0L ? n * -1.0L : n;
    }
    // The shares of the corners at a horizontal position.
    std::array<long double, 3> sharesAbove(const Triangle& t, const LongVec& p) const
    {
        const auto flat = [](LongVec v) { return LongVec{v.x, v.y, 0.0L}; };
        const LongVec a = flat(of(t[1]) - of(t[0]));
        const LongVec b = flat(of(t[2]) - of(t[0]));
        const LongVec to = flat(p - of(t[0]));
        const long double area = crossed(a, b).z;
        const long double second = crossed(to, b).z / area;
        const long double third = crossed(a, to).z / area;
        return {1.0L - second - third, second, third};
    }
    // The triangle beside the proxy over which the path to the goal begins, seen from above.
    Triangle ahead() const
    {
        std::optional<Triangle> best;
        long double most = -std::numeric_limits<long double>::infinity();
        for (const Triangle& t : triangles()) {
            if (has(t, at_)) {
                // A short step from the proxy stays within it.
                const auto shares =
                    sharesAbove(t, proxy_ + (goal_ - proxy_) * (1e-6L / length(goal_ - proxy_)));
                const long double least = std::min({shares[0], shares[1], shares[2]});
                if (least > most) {
                    most = least;
                    best = t;
                }
            }
        }
        return *best;
    }
    bool isFreeAhead() const
    {
        const Triangle t = ahead();
        return dot(upward(t), goal_ - of(t[0])) > 0.0L;
    }

    // From the proxy to the goal. False if it arrives there; else the proxy is at the vertex where
    // it goes on.
    bool cast()
    {
        ++casts;
        if (!at_.empty() && !isFreeAhead()) {
            startAt(ahead());
            return true;
        }
        long double nearest = 2.0L;
        Triangle hit{};
        for (const Triangle& t : triangles()) {
            if (!at_.empty() && has(t, at_)) {
                continue;
            }
            const LongVec n = upward(t);
            const long double begin = dot(n, proxy_ - of(t[0]));
            const long double end = dot(n, goal_ - of(t[0]));
            if (begin < 0.0L || end >= 0.0L) {
                continue;
            }
            const long double time = begin / (begin - end);
            const auto shares = sharesAbove(t, proxy_ + (goal_ - proxy_) * time);
            if (std::min({shares[0], shares[1], shares[2]}) >= 0.0L && time < nearest) {
                nearest = time;
                hit = t;
            }
        }
        if (nearest > 1.0L) {
            at_.clear();
            proxy_ = goal_;
            return false;
        }
        at_.clear();
        startAt(hit);
        return true;
    }
    // "beginning with the collision triangle vertex that is closest to the goal"
    void startAt(const Triangle& t)
    {
        if (at_.size() != 1) {
            rest(*std::min_element(t.begin(), t.end(), [this](const Sample& a, const Sample& b) {
                return toGoal(a) < toGoal(b);
            }));
        }
    }
    void rest(Sample s)
    {
        at_ = {s};
        proxy_ = of(s);
    }

    // One step from a vertex; false at the end of the update.
    bool step()
    {
        ++vertices;
        if (isFreeAhead()) {
            return leaves();
        }
        const Sample here = at_[0];
        std::optional<Sample> best;
        long double smallest = 0.0L;
        for (const Sample& by : {Sample{1, 0}, Sample{1, 1}, Sample{0, 1}, Sample{-1, 0},
                                 Sample{-1, -1}, Sample{0, -1}}) {
            const Sample to{here.column + by.column, here.row + by.row};
            if (exists(to)) {
                const LongVec along = of(to) - of(here);
                const long double gradient = dot(along, of(here) - goal_) / length(along);
                if (gradient < smallest) {
                    smallest = gradient;
                    best = to;
                }
            }
        }
        if (!best) {
            return false; // "the current vertex is the local minimum"
        }
        if (toGoal(*best) < toGoal(here)) {
            rest(*best);
            return true;
        }
        return searchBeside(here, *best);
    }

    // Equation 1, for the line from a to b.
    static std::pair<LongVec, long double>
    foot(const LongVec& a, const LongVec& b, const LongVec& goal)
    {
        const long double share = dot(b - a, goal - a) / dot(b - a, b - a);
        return {a + (b - a) * share, share};
    }

    bool searchBeside(Sample a, Sample b)
    {
        const LongVec on_edge = foot(of(a), of(b), goal_).first;
        std::vector<Sample> at{a, b};
        LongVec proxy = on_edge;
        std::optional<Triangle> far;
        LongVec far_minimum{};
        std::vector<Sample> far_at;
        bool has_face = false;
        for (const Triangle& t : triangles()) {
            if (!has(t, {a, b})) {
                continue;
            }
            const Sample c = *std::find_if(t.begin(), t.end(),
                                           [&](const Sample& s) { return !(s == a) && !(s == b); });
            // Equation 2.
            const LongVec n = upward(t) * (1.0L / length(upward(t)));
            const LongVec p = goal_ - n * dot(n, goal_ - of(a));
            const auto shares = sharesAbove({a, b, c}, p);
            if (shares[0] >= 0.0L && shares[1] >= 0.0L && shares[2] >= 0.0L) {
                if (length(goal_ - p) < length(goal_ - proxy)) {
                    proxy = p;
                    at = {a, b, c};
                    has_face = true;
                }
            } else if (shares[0] < 0.0L && shares[1] >= 0.0L && shares[2] >= 0.0L) {
                auto [minimum, share] = foot(of(b), of(c), goal_);
                std::vector<Sample> samples{b, c};
                if (!(share > 0.0L && share < 1.0L)) {
                    samples = {share > 0.5L ? c : b};
                    minimum = of(samples[0]);
                }
                if (!far || length(goal_ - minimum) < length(goal_ - far_minimum)) {
                    far = Triangle{a, b, c};
                    far_minimum = minimum;
                    far_at = samples;
                }
            }
        }
        if (far && !has_face) {
            ++far_edges;
            if (std::find(crossings_.begin(), crossings_.end(), a) != crossings_.end()) {
                at_ = far_at;
                proxy_ = far_minimum;
                return false;
            }
            crossings_.push_back(a);
            rest(toGoal((*far)[1]) <= toGoal((*far)[2]) ? (*far)[1] : (*far)[2]);
            return true;
        }
        at_ = at;
        proxy_ = proxy;
        return isFreeAhead() && leaves();
    }

    bool leaves()
    {
        const long double here = length(goal_ - proxy_);
        if (!(here < left_)) {
            return false;
        }
        left_ = here;
        return cast();
    }

    const HeightfieldSurface& surface_;
    int columns_;
    int rows_;
    std::vector<Sample> at_; // the corners of the feature that the proxy is on; empty while free
    LongVec proxy_{};
    LongVec goal_{};
    std::vector<Sample> crossings_;
    long double left_ = 0.0L;
};

TEST(ProxyGraph2003, MovesAsASecondImplementationOfThePaper)
{
    test::Random random;
    long updates = 0;
    long far_edges = 0;
    long casts = 0;
    for (const double scale : {0.3, 1.0, 3.0, 10.0}) {
        const auto terrain = test::filledTerrain(14, test::fractalHeights(14, 14, 6));
        for (const double shear : {0.0, 0.6}) {
            SceneFrame frame = test::unitFrame(*terrain);
            frame.east_per_row = shear;
            const HeightfieldSurface surface(terrain, frame, scale);
            Model model(surface);
            SecondImplementation second(surface);
            for (int i = 0; i < 1200; ++i) {
                const GridPoint grid{random.uniform(0.5, 12.5), random.uniform(0.5, 12.5)};
                const double top = surface.height(grid);
                const ScenePoint goal =
                    frame.toScene(grid, top + (i % 50 == 0 ? 30.0 : random.uniform(-4.0, 0.7)));
                if (i == 0) {
                    model.place(goal);
                    second.putAt(goal);
                    continue;
                }
                const ContactState state = model.update(goal);
                second.update(goal);
                const LongVec off = longVec(state.proxy) - second.proxy();
                ASSERT_LE(length(off), 1e-10L) << "scale " << scale << ", update " << i;
                ASSERT_EQ(state.counters.casts, static_cast<std::uint32_t>(second.casts));
                ASSERT_EQ(state.counters.vertices, static_cast<std::uint32_t>(second.vertices));
                ASSERT_EQ(state.counters.far_edges, static_cast<std::uint32_t>(second.far_edges));
                ++updates;
                far_edges += second.far_edges;
                casts += second.casts;
            }
        }
    }
    std::printf("the paper twice: %ld updates, %ld casts, %ld far edges\n", updates, casts,
                far_edges);
    EXPECT_GT(far_edges, 100);
    EXPECT_GT(casts, updates);
}

test::Findings
wander(const HeightfieldSurface& surface, test::Random& random, int updates, double step_cells)
{
    Model model(surface);
    test::Judge<Model> judge(surface, kTraits);
    test::judgeWandering(judge, model, surface, random, updates, step_cells);
    return judge.findings();
}

TEST(ProxyGraph2003, EndsEveryUpdateOnTheSurfaceOrAtTheGoal)
{
    test::ModelTraits traits = kTraits;
    traits.is_minimum = false; // not after loops
    test::Random random;
    test::Findings sum;
    for (const auto& [name, terrain] : test::syntheticTerrains()) {
        SCOPED_TRACE(name);
        const HeightfieldSurface surface = surfaceOver(terrain);
        for (const double step_cells : {0.1, 1.0, 12.0}) {
            Model model(surface);
            test::Judge<Model> judge(surface, traits);
            ScenePoint goal{};
            for (int i = 0; i < 1000 && !HasFatalFailure(); ++i) {
                goal = test::wanderingGoal(random, surface, goal, step_cells);
                judge.check(model, goal);
            }
            sum.add(judge.findings());
        }
    }
    sum.print("2003, synthetic terrains");
    EXPECT_EQ(sum.cut_short, 0);
}

TEST(ProxyGraph2003, CrossesNoFarEdgeAtTrueHeightsAndSomeOnSteepGround)
{
    // Section 4.4: none on the unscaled data, in 3.5 % of updates with heights × 20.
    test::Random random;
    const auto [name, terrain, frame] = test::bundledMap("mars_mola_4ppd.tif");
    for (const double scale : {1.0, 20.0, 200.0}) {
        const HeightfieldSurface surface(terrain, frame, scale);
        const test::Findings findings = wander(surface, random, 4000, 1.0);
        findings.print("2003, Mars, heights × " + std::to_string(scale));
        EXPECT_EQ(findings.far_edges > 0, scale > 1.0);
        EXPECT_GE(findings.casts, findings.updates);
        if (scale == 1.0) {
            EXPECT_EQ(findings.growths, 0);
        }
    }
}

TEST(ProxyGraph2003, CastsOnceAnUpdateOnGentleGround)
{
    const auto terrain = test::filledTerrain(130, test::fractalHeights(130, 97, 4));
    const HeightfieldSurface surface = surfaceOver(terrain, 0.1);
    Model model(surface);
    test::Random random;
    ScenePoint goal{};
    for (int i = 0; i < 2000; ++i) {
        goal = {std::clamp(goal.x + random.uniform(-4.0, 4.0), -40.0, 40.0),
                std::clamp(goal.y + random.uniform(-4.0, 4.0), -40.0, 40.0), 0.0};
        goal.z = surface.height(surface.frame().toGrid(goal)) - random.uniform(1.0, 4.0);
        const ContactState state = model.update(goal);
        ASSERT_TRUE(state.is_in_contact);
        ASSERT_EQ(state.counters.casts, 1U);
    }
}

TEST(ProxyGraph2003, EndsALoopOfFarEdgesOnTheFarEdge)
{
    // The terrain of the loops of proxy_graph_test.cpp: long, thin triangles.
    const auto terrain =
        test::filledTerrain(3, {-1.21333F, 3.49152F, -0.913293F, 4.44917F, -4.16928F, 3.62006F,
                                2.66074F, 0.927445F, -1.91758F});
    SceneFrame frame = test::unitFrame(*terrain);
    frame.east_per_row = 0.107905;
    frame.north_per_row = -0.118043;
    const HeightfieldSurface surface(terrain, frame, 1.0);
    Model model(surface);
    SecondImplementation second(surface);
    test::Random random;
    long loops = 0;
    for (int i = 0; i < 3000; ++i) {
        const ScenePoint above =
            frame.toScene({random.uniform(0.2, 1.8), random.uniform(0.2, 1.8)}, 30.0);
        const ScenePoint goal =
            ScenePoint{-0.73034, -0.10105, 0.15222} +
            Vec3{random.uniform(-0.2, 0.2), random.uniform(-0.02, 0.02), random.uniform(-0.2, 0.2)};
        model.place(above);
        second.putAt(above);
        const ContactState state = model.update(goal);
        second.update(test::clampedGoal(surface, goal));
        ASSERT_LE(length(longVec(state.proxy) - second.proxy()), 1e-10L) << i;
        ASSERT_LE(state.counters.far_loops, 1U);
        if (state.counters.far_loops > 0) {
            ++loops;
            ASSERT_NE(state.feature, ContactFeature::Face);
        }
    }
    EXPECT_GT(loops, 10);
}

} // namespace
} // namespace marsview
