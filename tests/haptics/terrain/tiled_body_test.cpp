// Contact over maps in tiles on their bodies: the same as over the map in memory if all tiles are
// resident, and on what is felt if some are missing.
#include "core/body/tiled_body_mesh.h"
#include "core/contact/body_below.h"
#include "core/contact/contact_model.h"
#include "core/levels/waiting_terrain.h"
#include "core/mesh/mesh_cast_definitions.h"
#include "haptics/terrain/clipmap_plan.h"
#include "haptics/terrain/resident_terrain.h"
#include "tests/core/contact/body_maps.h"
#include "tests/haptics/terrain/arriving_tiles.h"
#include "tests/haptics/terrain/tiled_map.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace marsview {
namespace {

using test::Arriving;
using test::BodyMap;
using test::Random;
using test::samplesTile;
using test::TiledMap;

// Several tiles each: around the body, with and without rows at its poles and a column that
// repeats the first one, over a pole, and parts in two projections.
std::vector<BodyMap> maps()
{
    const double step = 360.0 / 540.0;
    BodyMap whole = test::wholeMars(600, 300);
    return {
        whole,
        {"Registered",
         "IAU_2015:49900",
         541,
         271,
         {-0.5 * step, step, 0, 90 + 0.5 * step, 0, -step},
         8000.0},
        {"Utm", "EPSG:32611", 400, 300, {390045, 30, 0, 3797505, 0, -30}, 400.0},
        {"OverThePole",
         "+proj=stere +lat_0=-90 +lon_0=0 +R=1737400 +units=m",
         420,
         400,
         {-155000, 750, 0, 150000, 0, -750},
         5000.0},
        {"Equirectangular",
         "+proj=eqc +lat_ts=30 +R=1737400 +units=m",
         500,
         300,
         {-250000, 1000, 0, 1500000, 0, -1000},
         5000.0},
    };
}

struct OnBody {
    Georeference georeference;
    TiledMap map;
    std::shared_ptr<const BodyGrid> grid;

    explicit OnBody(const BodyMap& body)
        : georeference(test::georeferenceOf(body))
        , map(test::tiledMap(test::fractalMap(body)->heightfield()))
    {
        JobMonitor monitor;
        grid = BodyGrid::make(georeference, monitor).value();
    }

    std::shared_ptr<const BodyMesh> inMemory(std::shared_ptr<const FilledHeightfield> heights,
                                             double exaggeration) const
    {
        JobMonitor monitor;
        return BodyMesh::build(std::move(heights), georeference, exaggeration, monitor).value();
    }
    std::shared_ptr<const BodyMesh>
    inTiles(std::shared_ptr<const TiledTerrain> terrain,
            double exaggeration,
            std::size_t leaves_max = TiledBodyNodes::kLeavesMax) const
    {
        JobMonitor monitor;
        return TiledBodyMesh::build(grid, map.heights, exaggeration, monitor, leaves_max)
            .value()
            ->over(std::move(terrain));
    }
};

// Made once.
const OnBody& onBody(const BodyMap& body)
{
    static std::map<std::string, OnBody> made;
    return made.try_emplace(body.name, body).first->second;
}

// The walks are the same to the bit. A god object meets edges in the order in which the trees find
// them.
bool isSameContact(ContactModelKind kind,
                   double cell_m,
                   const ContactState& a,
                   const ContactState& b)
{
    if (kind == ContactModelKind::GodObject || kind == ContactModelKind::GodObjectRelease) {
        return length(a.proxy - b.proxy) <= 1e-9 * cell_m && a.is_in_contact == b.is_in_contact;
    }
    const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
    return bits(a.proxy.x) == bits(b.proxy.x) && bits(a.proxy.y) == bits(b.proxy.y) &&
           bits(a.proxy.z) == bits(b.proxy.z) && a.feature == b.feature &&
           a.is_in_contact == b.is_in_contact && a.counters.vertices == b.counters.vertices;
}

using Case = std::tuple<ContactModelKind, BodyMap>;
class TiledBodyContact : public testing::TestWithParam<Case> {};

std::string caseName(const testing::TestParamInfo<Case>& info)
{
    std::string name(contactModelName(std::get<0>(info.param)));
    std::replace(name.begin(), name.end(), '-', '_');
    return name + "_" + std::get<1>(info.param).name;
}

TEST_P(TiledBodyContact, EndsWhereItEndsOverTheMapInMemoryToTheBit)
{
    const auto& [kind, body] = GetParam();
    const OnBody& on = onBody(body);
    const TileCache cache({.bytes_max = std::size_t{512} << 10, .loader_threads = 1});
    const auto waiting = std::make_shared<const WaitingTerrain>(TiledRaster(cache, on.map.source),
                                                                on.map.heights, 2);
    Clipmap window = on.map.window({0.0, 0.0});
    for (const TileId& id : test::tilesOf(window)) {
        if (id.level == 0) {
            window.put(on.map.tile(id), 0.0);
        }
    }
    const auto resident = std::make_shared<const ResidentTerrain>(window, on.map.heights);
    constexpr double kExaggeration = 5.0;
    const auto mesh = on.inMemory(on.map.filled, kExaggeration);
    const double cell_m = length(mesh->vertex(0) - mesh->vertex(1));
    const ContactModelOptions options{.radius_m = 0.3 * cell_m};
    const auto memory = makeContactModel(kind, BodySurface(mesh), options);
    const auto late =
        makeContactModel(kind, BodySurface(on.inTiles(waiting, kExaggeration)), options);
    // A small tree above nodes of several levels, as of a map with a million times the cells.
    const auto at_once =
        makeContactModel(kind, BodySurface(on.inTiles(resident, kExaggeration, 12)), options);
    Random random(5);
    test::BodyWalker walker{*mesh, random, 1.0, 1.0};
    int contacts = 0;
    constexpr int kUpdates = 200;
    for (int i = 0; i < kUpdates; ++i) {
        const ScenePoint goal = walker.next(i % 50 == 0 ? 300.0 : 3.0);
        const ContactState truth = i % 50 == 0 ? memory->place(goal) : memory->update(goal);
        const ContactState here = i % 50 == 0 ? late->place(goal) : late->update(goal);
        const ContactState there = i % 50 == 0 ? at_once->place(goal) : at_once->update(goal);
        ASSERT_TRUE(isSameContact(kind, cell_m, here, truth))
            << i << " " << length(here.proxy - truth.proxy);
        ASSERT_TRUE(isSameContact(kind, cell_m, there, truth))
            << i << " " << length(there.proxy - truth.proxy);
        contacts += truth.is_in_contact ? 1 : 0;
    }
    EXPECT_GT(contacts, kUpdates / 4);
    EXPECT_FALSE(waiting->error().has_value());
    EXPECT_EQ(resident->misses().count, 0U);
}

// While tiles are missing and arrive, the proxy is on what is felt, which another mesh has in
// memory, and moves with it no faster than the rate.
TEST_P(TiledBodyContact, StaysOnWhatIsFeltAndMovesNoFasterThanTheRateWhenTilesArrive)
{
    const auto& [kind, body] = GetParam();
    const OnBody& on = onBody(body);
    constexpr double kExaggeration = 2.0;
    constexpr double kTickS = 0.001;
    const double rate_m_per_s = 0.5 * body.relief_m;
    Random random(9);
    Arriving arriving(random, on.map, rate_m_per_s);
    ResidentTerrain& terrain = *arriving.terrain();
    const auto truth = on.inMemory(on.map.filled, kExaggeration);
    const double cell_m = length(truth->vertex(0) - truth->vertex(1));
    const auto model =
        makeContactModel(kind, BodySurface(on.inTiles(arriving.terrain(), kExaggeration)),
                         {.radius_m = 0.3 * cell_m});
    const bool may_leave =
        kind == ContactModelKind::GodObject || kind == ContactModelKind::GodObjectRelease;
    const bool is_closed =
        on.grid->positions().closesAtFirstRow() && on.grid->positions().closesAtLastRow();
    const BodyLocator locator(on.grid);
    double fastest = 0.0;
    test::BodyWalker walker{*truth, random, 0.5 * static_cast<double>(body.columns),
                            0.5 * static_cast<double>(body.rows)};
    for (int tick = 0; tick < 400; ++tick) {
        const ContactState before = model->state();
        const auto found = locator.find(before.proxy, std::nullopt);
        const GridPoint hand = found.value_or(GridPoint{});
        if (tick % 30 == 10 && arriving.isAnyMissing()) {
            arriving.arrive(hand);
        }
        if (terrain.advance(hand, kTickS)) {
            model->terrainChanged();
            if (before.is_in_contact && !may_leave) {
                const double jump = length(model->state().proxy - before.proxy);
                ASSERT_LE(jump, rate_m_per_s * kTickS * kExaggeration * (1.0 + 1e-9) + 1e-6)
                    << "tick " << tick;
                fastest = std::max(fastest, jump / (rate_m_per_s * kTickS * kExaggeration));
            }
        }
        if (!is_closed) { // not over the border
            constexpr double kMargin = 60.0;
            walker.column =
                std::clamp(walker.column, kMargin, static_cast<double>(body.columns) - kMargin);
            walker.row = std::clamp(walker.row, kMargin, static_cast<double>(body.rows) - kMargin);
        }
        const ContactState state = model->update(walker.next(tick % 100 == 0 ? 50.0 : 1.0));
        ASSERT_TRUE(std::isfinite(length(state.proxy)));
        if (tick % 100 == 0) {
            const auto felt_heights = arriving.felt();
            const BodySurface felt(on.inMemory(felt_heights, kExaggeration));
            const double clearance_m = clearanceOver(felt, state.proxy);
            EXPECT_GE(clearance_m, -1e-6);
            EXPECT_TRUE(may_leave || !state.is_in_contact || clearance_m <= 1e-6);
            ASSERT_FALSE(testing::Test::HasFailure()) << "tick " << tick;
        }
    }
    EXPECT_GT(terrain.misses().count, 100U);
    EXPECT_TRUE(may_leave || fastest > 0.01) << "nothing was blended";
}

std::vector<Case> cases()
{
    std::vector<Case> cases;
    for (const ContactModelKind kind : kContactModelKinds) {
        // A sphere looks for faces along the axis of the body, of which there are too many here.
        if (kind != ContactModelKind::VirtualProxy) {
            cases.emplace_back(kind, maps().front());
        }
    }
    for (const BodyMap& map : maps()) {
        if (map.name != maps().front().name) {
            cases.emplace_back(kContactModelDefault, map);
        }
    }
    return cases;
}

INSTANTIATE_TEST_SUITE_P(AllModels, TiledBodyContact, testing::ValuesIn(cases()), caseName);

// A hand at the end of a map around the body, whose window has not room for all of it.
TEST(AroundTheBody, TheWindowContinuesWithTheFirstColumn)
{
    BodyMap body = test::wholeMars(2900, 300);
    const TiledMap map = test::tiledMap(test::fractalMap(body)->heightfield());
    for (const double column : {2899.0, 0.0}) {
        const HandMotion motion{.at = {column, 150.0}, .is_active = true};
        const WindowPlanOptions options{.sides = {.wraps = true}};
        const ClipmapPlan plan = planWindow(map.layout(), motion, options);
        Clipmap window(map.heights, map.top(), plan.centers, options.sides);
        std::set<std::uint32_t> tile_columns;
        for (const TileId& id : plan.tiles) {
            ASSERT_TRUE(map.layout().contains(id));
            ASSERT_NE(window.slot(id), nullptr);
            if (id.level == 0) {
                tile_columns.insert(id.column);
                window.put(map.tile(id), window.differenceFromCoarser(id));
            }
        }
        EXPECT_TRUE(tile_columns.contains(11)); // 84 columns
        EXPECT_TRUE(tile_columns.contains(10));
        EXPECT_TRUE(tile_columns.contains(0));
        EXPECT_FALSE(tile_columns.contains(5));

        ResidentTerrain terrain(window, map.heights, {.wraps = true});
        for (const std::size_t near :
             {std::size_t{2700}, std::size_t{2899}, std::size_t{0}, std::size_t{200}}) {
            EXPECT_EQ(terrain.sample(near, 140), map.filled->sample(near, 140)) << near;
        }
        EXPECT_EQ(terrain.misses().count, 0U);
        // As a recording states it.
        std::vector<ShownTiles> squares;
        for (std::size_t k = 0; k < window.levelCount(); ++k) {
            ASSERT_TRUE(Clipmap::fits(map.layout(), k, window.shown(k)));
            squares.push_back(window.shown(k));
        }
        const Clipmap again(map.heights, map.top(), squares);
        for (const TileId& id : plan.tiles) {
            EXPECT_NE(again.slot(id), nullptr);
            EXPECT_EQ(
                window.shown(id.level).has(id.column, id.row, window.level(id.level).tile_columns),
                window.has(id));
        }
        // A tile on the other side is blended in under the hand; in the plane it is not near.
        const SampleBox other =
            ClipmapBlend::reach(map.layout(), samplesTile(0, column == 0.0 ? 11 : 0, 0));
        EXPECT_TRUE(SamplesNear(map.layout(), motion.at, 1, true).doOverlap(other));
        EXPECT_FALSE(SamplesNear(map.layout(), motion.at, 1, false).doOverlap(other));
    }
}

// Near a pole the tiles of a row are narrow: those around the hand are all that the window covers.
TEST(AroundTheBody, ManyTilesOfARowAreNearAHandNextToAPole)
{
    const TiledMap map =
        test::tiledMap(test::fractalMap(test::wholeMars(2000, 300))->heightfield());
    const auto count = [&](double column_share) {
        const ClipmapPlan plan = planWindow(
            map.layout(), {.at = {1000.0, 1.0}, .column_share = column_share, .is_active = true},
            {.sides = {.wraps = true}});
        return std::count_if(plan.tiles.begin(), plan.tiles.end(),
                             [](const TileId& id) { return id.level == 0 && id.row == 0; });
    };
    EXPECT_EQ(count(1.0), 3);
    EXPECT_EQ(count(0.01), 8);
}

class TiledBodyMeshOf : public testing::TestWithParam<BodyMap> {};

// With some tiles only, and from leaves of any size: bounds neither leave out what a segment, a box
// or a point meets, nor does a segment meet anything else.
TEST_P(TiledBodyMeshOf, FindsWhatAMeshInMemoryFindsOfTheSameHeights)
{
    const OnBody& on = onBody(GetParam());
    Random random(3);
    Arriving arriving(random, on.map, 1e9);
    for (int i = 0; i < 3; ++i) {
        arriving.arrive({0.0, 0.0});
    }
    const auto felt = on.inMemory(arriving.felt(), 3.0);
    const double cell_m = length(felt->vertex(0) - felt->vertex(1));
    for (const std::size_t leaves_max : {std::size_t{1}, TiledBodyNodes::kLeavesMax}) {
        const auto tiled = on.inTiles(arriving.terrain(), 3.0, leaves_max);
        const BodySurface here(tiled);
        const BodySurface there(felt);
        ASSERT_EQ(tiled->faceCount(), felt->faceCount());
        for (int i = 0; i < 150; ++i) {
            const auto vertex = [&] { return random.below(felt->vertexCount()); };
            const ScenePoint from = felt->highAbove(felt->vertex(vertex()));
            const ScenePoint target = felt->vertex(vertex());
            const ScenePoint to = target - (from - target) * (i % 2 == 0 ? 1e-3 : 0.5);
            const auto found = here.castFree(*here.goal(from), *here.goal(to)).contact;
            const auto expected = there.castFree(*there.goal(from), *there.goal(to)).contact;
            ASSERT_EQ(found.has_value(), expected.has_value()) << i;
            if (found) {
                ASSERT_LE(length(here.point(*found) - there.point(*expected)), 1e-6) << i;
            }
        }
        for (int i = 0; i < 30; ++i) {
            const ScenePoint at = felt->vertex(random.below(felt->vertexCount()));
            const ScenePoint beside =
                at + Vec3{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                          random.uniform(-1.0, 1.0)} *
                         (i % 3 == 0 ? 50.0 * cell_m : cell_m);
            const auto distance = [&](const BodyMesh& mesh) {
                const auto place = nearestPlace(mesh, beside);
                const auto points = mesh.points(place.face);
                return length(beside -
                              (points[0] * place.weights[0] + points[1] * place.weights[1] +
                               points[2] * place.weights[2]));
            };
            ASSERT_NEAR(distance(*tiled), distance(*felt), 1e-6) << i;

            const Vec3 around = Vec3{1.0, 1.0, 1.0} * (0.7 * cell_m);
            const auto in_box = [&](const BodyMesh& mesh) {
                std::set<BodyIndex> faces;
                mesh.tree().inBox(beside - around, beside + around, [&](BodyIndex face) {
                    TriangleTree::Bounds bounds;
                    for (const ScenePoint& point : mesh.points(face)) {
                        bounds.add(point);
                    }
                    const ScenePoint low = beside - around;
                    const ScenePoint high = beside + around;
                    if (bounds.low.x <= high.x && bounds.high.x >= low.x &&
                        bounds.low.y <= high.y && bounds.high.y >= low.y &&
                        bounds.low.z <= high.z && bounds.high.z >= low.z) {
                        faces.insert(face);
                    }
                });
                return faces;
            };
            ASSERT_EQ(in_box(*tiled), in_box(*felt)) << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(AllMaps,
                         TiledBodyMeshOf,
                         testing::ValuesIn(maps()),
                         [](const testing::TestParamInfo<BodyMap>& map) { return map.param.name; });

} // namespace
} // namespace marsview
