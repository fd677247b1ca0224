// Contact over maps in tiles: the same as over the map in memory if all tiles are resident, and
// valid if some are missing.
#include "core/contact/contact_model.h"
#include "core/contact/continuous_walk.h"
#include "core/contact/proxy_graph.h"
#include "core/contact/surface_walk.h"
#include "core/levels/waiting_terrain.h"
#include "haptics/terrain/resident_terrain.h"
#include "tests/core/contact/contact_judge.h"
#include "tests/core/contact/contact_terrain.h"
#include "tests/core/contact/stress_goals.h"
#include "tests/haptics/terrain/arriving_tiles.h"
#include "tests/haptics/terrain/tiled_map.h"
#include "tests/support/fractal_terrain.h"
#include "tests/support/make_terrain.h"
#include "tests/support/random.h"
#include "tests/support/reference_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace marsview {
namespace {

using test::Arriving;
using test::Random;
using test::samplesTile;
using test::TiledMap;

enum class Samples { Int16, Float32, Float32Voids, UInt16 };

TiledMap fractalMap(std::size_t columns, std::size_t rows, Samples samples, double scale)
{
    const auto heights = test::fractalHeights(columns, rows, 31);
    const auto height = [&](std::size_t column, std::size_t row) {
        return scale * static_cast<double>(heights[row * columns + column]);
    };
    switch (samples) {
    case Samples::Int16:
        return test::tiledMap(test::int16Terrain(columns, rows, {.gain = 1.0 / 64.0}, height));
    case Samples::Float32:
        return test::tiledMap(test::floatTerrain(columns, rows, height));
    case Samples::Float32Voids:
        return test::tiledMap(
            test::floatTerrain(columns, rows, [&](std::size_t column, std::size_t row) {
                const bool is_void = (column / 60) % 5 == 2 && (row / 50) % 4 == 1;
                return is_void ? std::numeric_limits<double>::quiet_NaN() : height(column, row);
            }));
    case Samples::UInt16: {
        SampleGrid grid = SampleGrid::create(SampleType::UInt16, columns, rows).value();
        for (std::size_t row = 0; row < rows; ++row) {
            for (std::size_t column = 0; column < columns; ++column) {
                const auto value =
                    static_cast<std::uint16_t>(std::lround(height(column, row) * 32.0) + 20000);
                std::memcpy(grid.rowData(row) + 2 * column, &value, 2);
            }
        }
        const SampleStatistics statistics = grid.applyRule({}, 0, rows);
        return test::tiledMap(Heightfield(std::make_shared<const SampleGrid>(std::move(grid)),
                                          statistics, {.gain = 1.0 / 32.0, .offset_m = -600.0}));
    }
    }
    return {};
}

/// A goal that sweeps over the map at a speed in cells per update, into and out of the surface.
std::vector<ScenePoint>
swipe(Random& random, const HeightfieldSurface& surface, double cells, std::size_t count)
{
    const double columns = static_cast<double>(surface.terrain()->columns());
    const double rows = static_cast<double>(surface.terrain()->rows());
    GridPoint at{random.uniform(0.0, columns), random.uniform(0.0, rows)};
    double heading = random.uniform(0.0, 6.0);
    std::vector<ScenePoint> goals;
    for (std::size_t i = 0; i < count; ++i) {
        heading += random.uniform(-0.1, 0.1);
        at.column += cells * std::cos(heading);
        at.row += cells * std::sin(heading);
        if (at.column < -20.0 || at.row < -20.0 || at.column > columns + 20.0 ||
            at.row > rows + 20.0) {
            heading = std::atan2(0.5 * rows - at.row, 0.5 * columns - at.column);
        }
        const double above = -4.0 + 7.0 * std::sin(0.3 * static_cast<double>(i));
        goals.push_back(surface.frame().toScene(at, surface.height(at) + above));
    }
    return goals;
}

std::string kindName(const testing::TestParamInfo<ContactModelKind>& model)
{
    std::string name(contactModelName(model.param));
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

bool isSame(const ContactState& a, const ContactState& b)
{
    const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
    return bits(a.proxy.x) == bits(b.proxy.x) && bits(a.proxy.y) == bits(b.proxy.y) &&
           bits(a.proxy.z) == bits(b.proxy.z) && a.feature == b.feature &&
           a.is_in_contact == b.is_in_contact && a.counters.cells == b.counters.cells &&
           a.counters.faces == b.counters.faces && a.counters.vertices == b.counters.vertices;
}

class TiledContact : public testing::TestWithParam<ContactModelKind> {};

TEST_P(TiledContact, EndsWhereItEndsOverTheMapInMemoryToTheBit)
{
    Random random;
    for (const Samples samples :
         {Samples::Int16, Samples::Float32, Samples::Float32Voids, Samples::UInt16}) {
        static std::vector<TiledMap> maps = [] {
            std::vector<TiledMap> all;
            for (const Samples kind :
                 {Samples::Int16, Samples::Float32, Samples::Float32Voids, Samples::UInt16}) {
                all.push_back(fractalMap(2048, 1500, kind, 1.0));
            }
            return all;
        }();
        const TiledMap& map = maps[static_cast<std::size_t>(samples)];
        // The cache has room for at most four of the 48 tiles; the terrain holds four more.
        const TileCache cache({.bytes_max = std::size_t{512} << 10, .loader_threads = 1});
        const auto waiting =
            std::make_shared<const WaitingTerrain>(TiledRaster(cache, map.source), map.heights, 4);
        const std::uint64_t read_before = map.source->readCount();
        Clipmap window = map.window({1024.0, 750.0});
        for (const TileId& id : test::tilesOf(window)) {
            if (id.level == 0) {
                window.put(map.tile(id), 0.0);
            }
        }
        const auto resident = std::make_shared<const ResidentTerrain>(window, map.heights);
        const SceneFrame frame = test::unitFrame(*map.filled);
        for (const double exaggeration : {1.0, 3.0}) {
            const HeightfieldSurface surface(map.filled, frame, exaggeration);
            const ContactModelOptions options{.radius_m = 0.3};
            for (const double cells : {1.0, 10.0, 50.0, 200.0}) {
                const auto memory = makeContactModel(GetParam(), surface, options);
                const auto late = makeContactModel(
                    GetParam(), TiledHeightfieldSurface(waiting, frame, exaggeration), options);
                const auto at_once = makeContactModel(
                    GetParam(), TiledHeightfieldSurface(resident, frame, exaggeration), options);
                for (const ScenePoint& goal : swipe(random, surface, cells, 150)) {
                    const ContactState truth = memory->update(goal);
                    ASSERT_TRUE(isSame(late->update(goal), truth)) << cells << " cells per update";
                    ASSERT_TRUE(isSame(at_once->update(goal), truth))
                        << cells << " cells per update";
                }
            }
        }
        EXPECT_FALSE(waiting->error().has_value());
        EXPECT_GT(map.source->readCount() - read_before, 100U) << "the cache held the whole map";
        EXPECT_EQ(resident->misses().count, 0U);
    }
}

template <template <typename> class Model>
void judgeOverWhatIsFelt(const test::ModelTraits& traits)
{
    Random random;
    const TiledMap map = fractalMap(600, 520, Samples::Float32Voids, 3.0);
    Arriving arriving(random, map, 50.0);
    const SceneFrame frame = test::unitFrame(*map.filled);
    const TiledHeightfieldSurface surface(arriving.terrain(), frame, 2.0);
    Model<TiledHeightfieldSurface> model(surface);
    GridPoint hand{300.0, 260.0};
    test::Findings findings;
    for (int round = 0; round < 40; ++round) {
        if (arriving.isAnyMissing() && round % 3 == 0) {
            arriving.arrive(hand);
        }
        arriving.terrain()->advance(hand, 0.02);
        model.setSurface(surface); // as for terrainChanged
        test::Judge<Model<TiledHeightfieldSurface>> judge(surface, arriving.felt(), traits);
        const ScenePoint moved = model.state().proxy;
        ASSERT_GE(moved.z, static_cast<double>(judge.truth().height(test::longVec(moved))) - 1e-9);
        test::StressGoals goals(random, judge.truth());
        for (int i = 0; i < 60 && !testing::Test::HasFatalFailure(); ++i) {
            judge.check(model, goals.next());
        }
        ASSERT_FALSE(testing::Test::HasFatalFailure()) << "round " << round;
        hand = frame.toGrid(model.state().proxy);
        findings.add(judge.findings());
    }
    EXPECT_GT(findings.contacts, 500);
    EXPECT_GT(findings.passages, 100);
    EXPECT_GT(arriving.terrain()->misses().count, 1000U);
}

TEST(ResidentContact, ContinuousWalkIsRightOnWhatIsFelt)
{
    judgeOverWhatIsFelt<ContinuousWalk>({});
}

TEST(ResidentContact, SurfaceWalkIsRightOnWhatIsFelt)
{
    judgeOverWhatIsFelt<SurfaceWalk>({});
}

TEST(ResidentContact, ProxyGraphIsNeverBelowWhatIsFelt)
{
    judgeOverWhatIsFelt<ProxyGraph>({.is_blunt_on_slivers = true});
}

/// Scene height of the touched surface in meters, from the plane through three samples.
double feltHeight(const TiledTerrain& terrain, GridPoint grid, double exaggeration)
{
    const auto cell = [](double position, std::size_t samples) {
        return static_cast<std::size_t>(
            std::clamp(std::floor(position), 0.0, static_cast<double>(samples) - 2.0));
    };
    const std::size_t c = cell(grid.column, terrain.columns());
    const std::size_t r = cell(grid.row, terrain.rows());
    const auto sample = [&](std::size_t column, std::size_t row) {
        return static_cast<long double>(terrain.sample(column, row));
    };
    return static_cast<double>(
        test::planeHeight({sample(c, r), sample(c + 1, r), sample(c, r + 1), sample(c + 1, r + 1)},
                          static_cast<long double>(grid.column) - static_cast<long double>(c),
                          static_cast<long double>(grid.row) - static_cast<long double>(r)) *
        static_cast<long double>(exaggeration));
}

TEST_P(TiledContact, ProxyStaysOnWhatIsFeltAndMovesNoFasterThanTheRateWhenTilesArrive)
{
    Random random;
    const TiledMap map = fractalMap(1100, 900, Samples::Int16, 2.0);
    const SceneFrame frame = test::unitFrame(*map.filled);
    constexpr double kExaggeration = 1.5;
    constexpr double kRate = 8.0;
    constexpr double kTick = 0.001;
    const HeightfieldSurface truth(map.filled, frame, kExaggeration);
    // A model that floats, or is held away from the surface, falls onto a changed surface.
    const bool may_float = GetParam() == ContactModelKind::GodObject ||
                           GetParam() == ContactModelKind::GodObjectRelease;
    double fastest = 0.0;
    for (const double cells : {0.0, 0.3, 10.0}) {
        Arriving arriving(random, map, kRate);
        ResidentTerrain& terrain = *arriving.terrain();
        const auto model = makeContactModel(
            GetParam(), TiledHeightfieldSurface(arriving.terrain(), frame, kExaggeration),
            {.radius_m = 0.3});
        GridPoint at{random.uniform(200.0, 900.0), random.uniform(200.0, 700.0)};
        double heading = 1.0;
        for (int tick = 0; tick < 3000; ++tick) {
            heading += random.uniform(-0.05, 0.05);
            at.column = std::clamp(at.column + cells * std::cos(heading), 0.0, 1099.0);
            at.row = std::clamp(at.row + cells * std::sin(heading), 0.0, 899.0);
            const GridPoint hand = frame.toGrid(model->state().proxy);
            const ContactState before = model->state();
            if (tick % 50 == 0 && arriving.isAnyMissing() && tick > 0) {
                arriving.arrive(hand);
            }
            if (terrain.advance(hand, kTick)) {
                model->terrainChanged();
                const ContactState moved = model->state();
                if (before.is_in_contact && !may_float && tick > 0) {
                    const double jump = length(moved.proxy - before.proxy);
                    ASSERT_LE(jump, kRate * kTick * kExaggeration + 1e-8) << "tick " << tick;
                    fastest = std::max(fastest, jump / (kRate * kTick * kExaggeration));
                }
            }
            const double above = -3.0 + (cells > 0.0 ? 4.0 * std::sin(0.05 * tick) : 0.0);
            const ContactState state =
                model->update(frame.toScene(at, truth.height(at) + above * kExaggeration));
            ASSERT_GE(state.proxy.z,
                      feltHeight(terrain, frame.toGrid(state.proxy), kExaggeration) - 1e-8)
                << "tick " << tick;
        }
        EXPECT_GT(terrain.misses().count, 100U);
    }
    EXPECT_TRUE(may_float || fastest > 0.1) << "nothing was blended";
}

// Terrain that another thread may be changing.
class UntouchedTerrain final : public TiledTerrain {
public:
    explicit UntouchedTerrain(std::shared_ptr<const TileHeights> heights)
        : TiledTerrain(std::move(heights))
    {}
    bool isVoid(std::size_t /*column*/, std::size_t /*row*/) const noexcept override
    {
        return false;
    }
    int readCount() const { return read_count_; }

private:
    double sampleElsewhere(std::size_t /*column*/, std::size_t /*row*/) const noexcept override
    {
        ++read_count_;
        return 0.0;
    }
    mutable int read_count_ = 0;
};

TEST_P(TiledContact, IsMadeWithoutReadingAHeight)
{
    for (const Samples samples : {Samples::Int16, Samples::Float32, Samples::UInt16}) {
        const auto terrain =
            std::make_shared<const UntouchedTerrain>(fractalMap(300, 300, samples, 1.0).heights);
        const auto model = makeContactModel(
            GetParam(), TiledHeightfieldSurface(terrain, SceneFrame{.origin = {150.0, 150.0}}, 2.0),
            {.radius_m = 0.5});
        EXPECT_EQ(terrain->readCount(), 0);
        model->update({0.0, 0.0, -1.0});
        EXPECT_GT(terrain->readCount(), 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Models, TiledContact, testing::ValuesIn(kContactModelKinds), kindName);

} // namespace
} // namespace marsview
