// Contact models with difficult numbers: ties, cliffs, slivers, huge and tiny cells, far goals.
//
// Prints one line per case and model with the largest residuals, in meters, and in parentheses the
// share of the rounding allowance. MARSVIEW_STRESS_UPDATES=N makes the runs N times as long.
#include "core/contact/continuous_walk.h"
#include "core/contact/heightfield_surface.h"
#include "core/contact/proxy_graph.h"
#include "core/contact/surface_walk.h"
#include "core/session/map.h"
#include "core/session/scene_surface.h"
#include "tests/core/contact/contact_judge.h"
#include "tests/core/contact/contact_terrain.h"
#include "tests/core/contact/stress_goals.h"
#include "tests/support/fractal_terrain.h"
#include "tests/support/make_raster.h"
#include "tests/support/map_maker.h"
#include "tests/support/nan.h"
#include "tests/support/shared_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

namespace marsview {
namespace {

using test::Findings;
using test::Judge;
using test::ModelTraits;
using test::Random;

constexpr double kInf = std::numeric_limits<double>::infinity();

struct Scenery {
    std::shared_ptr<const FilledHeightfield> terrain;
    SceneFrame frame;
    double exaggeration = 1.0;

    HeightfieldSurface surface() const { return {terrain, frame, exaggeration}; }
};

long stressed(long updates)
{
    const char* text = std::getenv("MARSVIEW_STRESS_UPDATES"); // NOLINT(concurrency-mt-unsafe)
    return updates * std::max(text != nullptr ? std::strtol(text, nullptr, 10) : 1L, 1L);
}

// Models

struct Subject {
    std::string name;
    Findings (*wander)(const Scenery&, Random&, long updates);
    Findings (*follow)(const Scenery&, const std::vector<ScenePoint>&);
    Findings (*place)(const Scenery&, Random&, long times);
    void (*refuse)(const Scenery&);
    void (*compare_plain)(const Scenery&, Random&, long updates);

    friend std::ostream& operator<<(std::ostream& out, const Subject& s) { return out << s.name; }
};

template <template <typename> class Model, ModelTraits kTraits>
struct Runs {
    using General = Model<HeightfieldSurface>;

    static Findings wander(const Scenery& scenery, Random& random, long updates)
    {
        const HeightfieldSurface surface = scenery.surface();
        General model(surface);
        Judge<General> judge(surface, kTraits);
        test::StressGoals goals(random, judge.truth());
        for (long i = 0; i < updates && !testing::Test::HasFatalFailure(); ++i) {
            judge.check(model, goals.next());
        }
        return judge.findings();
    }

    static Findings follow(const Scenery& scenery, const std::vector<ScenePoint>& goals)
    {
        const HeightfieldSurface surface = scenery.surface();
        General model(surface);
        Judge<General> judge(surface, kTraits);
        for (const ScenePoint& goal : goals) {
            if (!testing::Test::HasFatalFailure()) {
                judge.check(model, goal);
            }
        }
        return judge.findings();
    }

    static Findings place(const Scenery& scenery, Random& random, long times)
    {
        const HeightfieldSurface surface = scenery.surface();
        General model(surface);
        Judge<General> judge(surface, kTraits);
        test::StressGoals goals(random, judge.truth());
        for (long i = 0; i < times && !testing::Test::HasFatalFailure(); ++i) {
            judge.checkPlaced(model, goals.next());
        }
        return judge.findings();
    }

    static void refuse(const Scenery& scenery)
    {
        const HeightfieldSurface surface = scenery.surface();
        General model(surface);
        const ScenePoint beneath = scenery.frame.toScene({0.8, 0.6}, -20.0);
        const ScenePoint above = scenery.frame.toScene({0.8, 0.6}, 1e4);
        for (const ScenePoint& goal : {beneath, above}) {
            const ContactState held = model.update(goal);
            ASSERT_EQ(held.is_in_contact, goal == beneath);
            const double too_high_m = 1.0001e12 * std::max(scenery.exaggeration, 1.0);
            for (const double bad : {kNan, kInf, -kInf, 1e300, too_high_m, -too_high_m}) {
                std::vector<ScenePoint> refusals{{1.0, 1.0, bad}, {bad, bad, bad}};
                if (!std::isfinite(bad)) {
                    refusals.insert(refusals.end(), {{bad, 1.0, 1.0}, {1.0, bad, 1.0}});
                }
                for (const ScenePoint& refused : refusals) {
                    for (const ContactState& state :
                         {model.update(refused), model.place(refused)}) {
                        EXPECT_EQ(state.counters.refused, 1U);
                        EXPECT_EQ(state.proxy, held.proxy);
                        EXPECT_EQ(state.feature, held.feature);
                        EXPECT_EQ(state.is_in_contact, held.is_in_contact);
                    }
                }
            }
            const ContactState again = model.update(goal);
            EXPECT_EQ(again.counters.refused, 0U);
            EXPECT_EQ(again.proxy, held.proxy) << "unchanged by the invalid goal";
        }
    }

    template <typename T>
    static void compare(const Scenery& scenery, Random& random, long updates)
    {
        if (!PlainHeights<T>::canRead(*scenery.terrain)) {
            return;
        }
        const PlainHeightfieldSurface<T> plain_surface(scenery.terrain, scenery.frame,
                                                       scenery.exaggeration);
        General general(scenery.surface());
        Model<PlainHeightfieldSurface<T>> plain(plain_surface);
        const test::HeightfieldTruth truth(scenery.terrain, scenery.frame, scenery.exaggeration);
        test::StressGoals goals(random, truth);
        for (long i = 0; i < updates; ++i) {
            const ScenePoint goal = goals.next();
            const ContactState one = general.update(goal);
            const ContactState other = plain.update(goal);
            ASSERT_EQ(one.proxy, other.proxy) << i;
            ASSERT_EQ(one.feature, other.feature);
            ASSERT_EQ(one.counters.faces, other.counters.faces);
            ASSERT_EQ(one.counters.vertices, other.counters.vertices);
        }
    }
    static void comparePlain(const Scenery& scenery, Random& random, long updates)
    {
        ASSERT_TRUE(PlainHeights<std::int16_t>::canRead(*scenery.terrain) ||
                    PlainHeights<float>::canRead(*scenery.terrain));
        compare<std::int16_t>(scenery, random, updates);
        compare<float>(scenery, random, updates);
    }
};

template <template <typename> class Model, ModelTraits kTraits = ModelTraits{}>
Subject subject(std::string name)
{
    using Run = Runs<Model, kTraits>;
    return {std::move(name), Run::wander, Run::follow, Run::place, Run::refuse, Run::comparePlain};
}

std::vector<Subject> subjects()
{
    return {
        subject<ProxyGraph, ModelTraits{.is_blunt_on_slivers = true}>("ProxyGraph"),
        subject<SurfaceWalk>("SurfaceWalk"),
        subject<ContinuousWalk>("ContinuousWalk"),
    };
}

// Terrains

template <typename T>
std::shared_ptr<const FilledHeightfield>
terrainOf(std::size_t columns, const std::vector<T>& samples, const VoidRule& rule = {})
{
    const std::size_t rows = samples.size() / columns;
    constexpr SampleType kType = std::is_same_v<T, std::int16_t> ? SampleType::Int16
                                 : std::is_same_v<T, float>      ? SampleType::Float32
                                                                 : SampleType::Float64;
    SampleGrid grid = SampleGrid::create(kType, columns, rows).value();
    for (std::size_t row = 0; row < rows; ++row) {
        std::memcpy(grid.rowData(row), samples.data() + row * columns, columns * sizeof(T));
    }
    const SampleStatistics statistics = grid.applyRule(rule, 0, rows);
    return test::filledTerrain(
        Heightfield(std::make_shared<const SampleGrid>(std::move(grid)), statistics, {}));
}

using Shape = double (*)(double column, double row); // from the center

template <typename T = double>
Scenery shaped(std::size_t columns, std::size_t rows, Shape shape)
{
    const double center_column = std::floor(static_cast<double>(columns) / 2.0);
    const double center_row = std::floor(static_cast<double>(rows) / 2.0);
    std::vector<T> samples;
    for (std::size_t r = 0; r < rows; ++r) {
        for (std::size_t c = 0; c < columns; ++c) {
            samples.push_back(static_cast<T>(shape(static_cast<double>(c) - center_column,
                                                   static_cast<double>(r) - center_row)));
        }
    }
    const auto terrain = terrainOf(columns, samples);
    return {terrain, test::unitFrame(*terrain)};
}

Scenery fractal(std::size_t columns, std::size_t rows, double scale, bool is_whole = false)
{
    std::vector<double> samples;
    for (const float height : test::fractalHeights(columns, rows, 11)) {
        const double scaled = static_cast<double>(height) * scale;
        samples.push_back(is_whole ? std::round(scaled) : scaled);
    }
    const auto terrain = terrainOf(columns, samples);
    return {terrain, test::unitFrame(*terrain)};
}

SceneFrame framed(const Scenery& scenery, double ec, double er, double nc, double nr)
{
    return {scenery.frame.origin, ec, er, nc, nr};
}

std::vector<Scenery> inFrames(const Scenery& scenery, const std::vector<std::array<double, 4>>& all)
{
    std::vector<Scenery> sceneries;
    sceneries.reserve(all.size());
    for (const auto& [ec, er, nc, nr] : all) {
        sceneries.push_back({scenery.terrain, framed(scenery, ec, er, nc, nr)});
    }
    return sceneries;
}

// A map of 0.01 m cells, far from the origin of its coordinates; once alone and once as the second
// map of a scene, where its frame is derived from those coordinates.
std::vector<Scenery> centimetersInUtm()
{
    test::MapMaker maker;
    const std::vector<float> heights = test::fractalHeights(60, 50, 5);
    const test::MapMaker::Place small{
        .columns = 60,
        .rows = 50,
        .transform = {5e5 + 1.0 / 3.0, 0.01, 0.0, 5e6 + 0.1, 0.0, -0.01},
        .srs = "EPSG:32633"};
    const std::shared_ptr<const Map> map = maker.make(small, [&](std::size_t c, std::size_t r) {
        return 0.01 * static_cast<double>(heights[r * 60 + c]) + 1234.5;
    });
    const test::MapMaker::Place large{.columns = 20,
                                      .rows = 20,
                                      .transform = {4.99e5, 100.0, 0.0, 5.001e6, 0.0, -100.0},
                                      .srs = "EPSG:32633"};
    const std::shared_ptr<const Map> around =
        maker.make(large, [](std::size_t c, std::size_t r) { return double(c) + double(r); });
    const SceneSurface scene({around, map});
    return {{map->filled(), map->georeference().sceneFrame()},
            {map->filled(), scene.maps()[1].frame},
            {map->filled(), scene.maps()[1].frame, 20.0}};
}

std::vector<Scenery> randomFrames()
{
    Random random;
    std::vector<Scenery> sceneries;
    const Scenery rough = fractal(50, 60, 1.0);
    for (int i = 0; i < 24; ++i) {
        const double angle = random.uniform(0.0, 6.3);
        const double cell_m = std::pow(10.0, random.uniform(-3.0, 5.0));
        const double aspect = std::pow(10.0, random.uniform(-1.0, 1.0));
        const double between = (i % 2 == 0 ? 1.0 : -1.0) * random.uniform(0.2, 2.9); // mirrored
        sceneries.push_back(
            {rough.terrain,
             framed(rough, cell_m * std::cos(angle), cell_m * aspect * std::cos(angle + between),
                    cell_m * std::sin(angle), cell_m * aspect * std::sin(angle + between)),
             cell_m * std::pow(10.0, random.uniform(-1.0, 1.3))});
    }
    return sceneries;
}

std::vector<Scenery> withVoids()
{
    constexpr std::int16_t kVoid = -32768;
    std::vector<std::int16_t> samples;
    Random random;
    for (int r = 0; r < 50; ++r) {
        for (int c = 0; c < 70; ++c) {
            const bool is_void = (c - 30) * (c - 30) + (r - 20) * (r - 20) < 150 ||
                                 random.chance(0.05) || r == 49 || c == 0;
            samples.push_back(
                is_void ? kVoid
                        : static_cast<std::int16_t>(std::lround(20.0 * std::sin(c * 0.3) + r)));
        }
    }
    // Once as voids, which are filled, and once as samples: holes 32 km deep.
    const auto filled = terrainOf(70, samples, {.nodata = kVoid});
    const auto holes = terrainOf(70, samples);
    return {{filled, test::unitFrame(*filled)}, {holes, test::unitFrame(*holes)}};
}

// Voids that are NaN.
Scenery withHoles()
{
    std::vector<float> samples;
    for (int r = 0; r < 50; ++r) {
        for (int c = 0; c < 70; ++c) {
            const bool is_void = (c - 30) * (c - 30) + (r - 20) * (r - 20) < 150;
            samples.push_back(is_void ? kNanFloat : static_cast<float>(std::sin(c * 0.3) + r));
        }
    }
    const auto filled = terrainOf(70, samples);
    return {filled, test::unitFrame(*filled)};
}

struct Case {
    std::string name;
    std::function<std::vector<Scenery>()> make;

    friend std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }
};

std::vector<Case> cases()
{
    const auto one = [](const std::string& name, auto make) {
        return Case{name, [make] { return std::vector<Scenery>{make()}; }};
    };
    const auto shape = [&](const std::string& name, Shape s) {
        return one(name, [s] { return shaped(41, 37, s); });
    };
    std::vector<Case> all{
        shape("Flat", [](double, double) { return 5.0; }),
        shape("Plane", [](double c, double r) { return 0.5 * c - 0.25 * r; }),
        shape("PlaneOfThirds", [](double c, double r) { return c / 3.0 - r / 7.0 + 1e3; }),
        shape("ValleyAlongColumns", [](double c, double) { return std::abs(c); }),
        shape("ValleyAlongRows", [](double, double r) { return 0.3 * std::abs(r); }),
        shape("ValleyAlongDiagonals", [](double c, double r) { return std::abs(c - r); }),
        shape("ValleyAcrossDiagonals", [](double c, double r) { return std::abs(c + r); }),
        shape("RidgeAlongColumns", [](double c, double) { return -std::abs(c); }),
        shape("RidgeAlongRows", [](double, double r) { return -0.3 * std::abs(r); }),
        shape("RidgeAlongDiagonals", [](double c, double r) { return -std::abs(c - r); }),
        shape("RidgeAcrossDiagonals", [](double c, double r) { return -std::abs(c + r); }),
        shape("Cone", [](double c, double r) { return -std::hypot(c, r); }),
        shape("Funnel", [](double c, double r) { return std::hypot(c, r); }),
        shape("Pyramid", [](double c, double r) { return -std::max(std::abs(c), std::abs(r)); }),
        shape("Bowl", [](double c, double r) { return 0.05 * (c * c + r * r); }),
        shape("Dome", [](double c, double r) { return -0.05 * (c * c + r * r); }),
        shape("Saddle", [](double c, double r) { return 0.05 * (c * c - r * r); }),
        shape("Cliff", [](double c, double) { return c < 0 ? 0.0 : 30000.0; }),
        shape("CliffAcrossDiagonals",
              [](double c, double r) { return c + r < 0.5 ? 0.0 : 1000.0; }),
        shape("Checkerboard",
              [](double c, double r) { return std::remainder(c + r, 2.0) == 0.0 ? 20.0 : -20.0; }),
        shape("Spikes",
              [](double c, double r) {
                  return std::remainder(c, 5.0) == 0.0 && std::remainder(r, 5.0) == 0.0 ? 50.0
                                                                                        : 0.0;
              }),
        shape("Holes",
              [](double c, double r) {
                  return std::remainder(c, 5.0) == 0.0 && std::remainder(r, 5.0) == 0.0 ? -50.0
                                                                                        : 0.0;
              }),
        one("StairsOfTies",
            [] {
                return shaped<std::int16_t>(
                    41, 37, [](double c, double r) { return std::floor((c + 2.0 * r) / 7.0); });
            }),
        one("TerracesOfTies",
            [] {
                return shaped<std::int16_t>(41, 37, [](double c, double r) {
                    return std::round(3.0 * std::sin(c * 0.4) * std::cos(r * 0.3));
                });
            }),
        one("OneSampleUp20km",
            [] {
                return shaped<std::int16_t>(41, 37, [](double c, double r) {
                    return c == 1.0 && r == -2.0 ? 20000.0 : std::round(2.0 * std::sin(c + r));
                });
            }),
        one("OneSampleDown20km",
            [] {
                return shaped<std::int16_t>(41, 37, [](double c, double r) {
                    return c == 1.0 && r == -2.0 ? -20000.0 : std::round(2.0 * std::sin(c + r));
                });
            }),
        {"Steps20km",
         [] {
             Random random;
             std::vector<std::int16_t> samples;
             samples.reserve(1600);
             for (int i = 0; i < 40 * 40; ++i) {
                 samples.push_back(random.chance(0.1) ? 20000 : 0);
             }
             const auto terrain = terrainOf(40, samples);
             return std::vector<Scenery>{{terrain, test::unitFrame(*terrain)}};
         }},
        {"Noise",
         [] {
             Random random;
             std::vector<std::int16_t> samples;
             samples.reserve(1600);
             for (int i = 0; i < 40 * 40; ++i) {
                 samples.push_back(static_cast<std::int16_t>(random.below(65536)));
             }
             const auto terrain = terrainOf(40, samples);
             return std::vector<Scenery>{{terrain, test::unitFrame(*terrain)},
                                         {terrain, test::unitFrame(*terrain), 1e-4}};
         }},
        {"CentimetresInUtm", centimetersInUtm},
        {"MillimetresBesideKilometres",
         [] {
             std::vector<Scenery> sceneries;
             for (const double scale : {1e-3, 1.0, 1e3}) {
                 for (Scenery& s : inFrames(fractal(40, 40, scale),
                                            {{1e-3, 0.0, 0.0, -1e3}, {1e3, 0.0, 0.0, -1e-3}})) {
                     sceneries.push_back(std::move(s));
                 }
             }
             return sceneries;
         }},
        {"RotatedShearedMirrored", randomFrames},
        {"Slivers",
         [] { // cells almost flattened to a line
             return inFrames(fractal(30, 30, 1.0),
                             {{1.0, 0.999, 0.0, -0.001}, {1.0, -0.99, 0.3, -0.3}});
         }},
        {"TwoByTwo",
         [] {
             std::vector<Scenery> sceneries;
             for (const std::array<double, 4>& z : {std::array{1.0, 0.0, 0.0, 1.0},
                                                    {0.0, 1.0, 1.0, 0.0},
                                                    {0.0, 0.0, 0.0, 0.0},
                                                    {0.0, 1.0, 2.0, 3.0},
                                                    {0.0, 0.0, 0.0, 1e4},
                                                    {5.0, 0.0, 0.0, 0.0}}) {
                 const auto terrain = terrainOf<double>(2, {z[0], z[1], z[2], z[3]});
                 sceneries.push_back({terrain, test::unitFrame(*terrain)});
             }
             return sceneries;
         }},
        {"TwoByMany",
         [] {
             return std::vector<Scenery>{
                 shaped(2, 40, [](double c, double r) { return std::sin(r) + c; }),
                 shaped(40, 2, [](double c, double r) { return std::sin(c) + r; }),
                 shaped(3, 3, [](double c, double r) { return c * r; })};
         }},
        {"Voids", withVoids},
    };
    for (const auto& [name, scale] : {std::pair{"1e-6", 1e-6},
                                      {"1e-3", 1e-3},
                                      {"0.1", 0.1},
                                      {"1", 1.0},
                                      {"5", 5.0},
                                      {"20", 20.0},
                                      {"1e3", 1e3},
                                      {"1e6", 1e6}}) {
        std::string plain = std::string("FractalTimes") + name;
        std::replace_if(
            plain.begin(), plain.end(), [](char c) { return c == '-' || c == '.'; }, '_');
        all.push_back(one(plain, [scale = scale] { return fractal(90, 70, scale); }));
    }
    for (const auto& [name, file] :
         {std::pair{"Mars", "mars_mola_4ppd.tif"}, {"MountStHelens", "mount_st_helens_30m.tif"}}) {
        all.push_back({name, [file = file] {
                           JobMonitor monitor;
                           const auto dataset =
                               readMap(RasterSpec{(test::bundledSamples() / file).string()},
                                       monitor, std::size_t{1} << 30U)
                                   .value();
                           const auto terrain = test::filledTerrain(dataset->heightfield());
                           std::vector<Scenery> sceneries;
                           for (const double exaggeration : {0.1, 1.0, 5.0, 20.0}) {
                               sceneries.push_back(
                                   {terrain, dataset->georeference().sceneFrame(), exaggeration});
                           }
                           return sceneries;
                       }});
    }
    all.push_back(one("WholeFractal", [] { return fractal(90, 70, 5.0, true); }));
    all.push_back(one("WholeFractalSteep", [] { return fractal(90, 70, 1000.0, true); }));
    return all;
}

using Parameter = std::tuple<Subject, Case>;

class Stability : public testing::TestWithParam<Parameter> {};

TEST_P(Stability, KeepsItsPromises)
{
    const auto& [subject, terrain] = GetParam();
    Random random;
    const std::vector<Scenery> sceneries = terrain.make();
    constexpr long kUpdates = 60000;
    Findings sum;
    for (std::size_t i = 0; i < sceneries.size() && !HasFatalFailure(); ++i) {
        SCOPED_TRACE(terrain.name + " " + std::to_string(i));
        const auto n = static_cast<long>(sceneries.size());
        sum.add(subject.wander(sceneries[i], random, stressed(kUpdates / n)));
    }
    sum.print(subject.name + " " + terrain.name);
    EXPECT_GT(sum.contacts, sum.updates / 4);
}

INSTANTIATE_TEST_SUITE_P(Of,
                         Stability,
                         testing::Combine(testing::ValuesIn(subjects()),
                                          testing::ValuesIn(cases())),
                         [](const auto& pair) {
                             return std::get<0>(pair.param).name + std::get<1>(pair.param).name;
                         });

class StabilityOfModels : public testing::TestWithParam<Subject> {};

TEST_P(StabilityOfModels, RefusesInvalidGoals)
{
    GetParam().refuse(fractal(40, 40, 3.0));
    GetParam().refuse(shaped(2, 2, [](double c, double) { return c; }));
}

TEST_P(StabilityOfModels, CanBePlacedAnywhere)
{
    Random random;
    Findings sum;
    for (const Scenery& scenery : {fractal(60, 50, 5.0), fractal(60, 50, 20.0, true)}) {
        sum.add(GetParam().place(scenery, random, stressed(20000)));
    }
    sum.print(GetParam().name + " placed");
}

TEST_P(StabilityOfModels, CrossesAContinentInOneUpdate)
{
    // A thousand kilometers of 1 km cells, with the relief of a planet and five times that.
    Random random;
    const std::vector<float> heights = test::fractalHeights(1000, 800, 2);
    std::vector<std::int16_t> samples;
    samples.reserve(heights.size());
    for (const float height : heights) {
        samples.push_back(static_cast<std::int16_t>(std::lround(100.0F * height)));
    }
    const auto terrain = terrainOf(1000, samples);
    SceneFrame frame = test::unitFrame(*terrain);
    frame.east_per_column = 1000.0;
    frame.north_per_row = -1000.0;
    for (const double exaggeration : {1.0, 5.0}) {
        const Scenery scenery{terrain, frame, exaggeration};
        std::vector<ScenePoint> goals;
        for (long i = 0; i < stressed(300); ++i) {
            const bool is_east = i % 2 == 0;
            const GridPoint to{is_east ? random.uniform(950.0, 999.0) : random.uniform(0.0, 50.0),
                               random.uniform(0.0, 799.0)};
            // Deep enough to drag the proxy along, or high above the terrain.
            goals.push_back(frame.toScene(
                to, i % 7 == 6 ? 1e5 : -random.uniform(1.0, 100.0) * 1000.0 * exaggeration));
        }
        const Findings findings = GetParam().follow(scenery, goals);
        findings.print(GetParam().name + " across a continent × " + std::to_string(exaggeration));
    }
}

TEST_P(StabilityOfModels, MovesTheSameOverSamplesReadInTheirOwnType)
{
    Random random;
    GetParam().compare_plain(shaped<std::int16_t>(41, 37,
                                                  [](double c, double r) {
                                                      return std::round(9.0 * std::sin(c * 0.4) *
                                                                        std::cos(r));
                                                  }),
                             random, stressed(20000));
    GetParam().compare_plain(
        shaped<float>(41, 37,
                      [](double c, double r) { return 9.0 * std::sin(c * 0.4) * std::cos(r); }),
        random, stressed(20000));
    // Voids are filled.
    GetParam().compare_plain(withVoids().front(), random, stressed(20000));
    GetParam().compare_plain(withHoles(), random, stressed(20000));
}

INSTANTIATE_TEST_SUITE_P(Of, StabilityOfModels, testing::ValuesIn(subjects()), [](const auto& one) {
    return one.param.name;
});

TEST(StabilityOfMaps, OneRowOrColumnIsRefusedInOneSentence)
{
    const test::TempFolder folder;
    for (const std::size_t columns : {std::size_t{1}, std::size_t{30}}) {
        const std::string path =
            test::writeRaster(folder, std::to_string(columns) + ".tif", "GTiff",
                              test::recipeFor(columns, std::vector<float>(30, 1.0F)));
        JobMonitor monitor;
        const auto dataset = readMap(RasterSpec{path, 1, {}}, monitor, std::size_t{1} << 30);
        ASSERT_FALSE(dataset);
        const std::string& message = dataset.error().message;
        EXPECT_THAT(message, testing::HasSubstr(columns == 1 ? "1 × 30" : "30 × 1"));
        EXPECT_THAT(message,
                    testing::Not(testing::AnyOf(testing::HasSubstr("\n"), testing::EndsWith("."))));
    }
}

} // namespace
} // namespace marsview
