// Contact over a map in tiles that is joined with a map below it: whichever tiles are in memory,
// that over both maps in memory with the same heights, which other tests prove by brute force.
#include "core/body/tiled_rim.h"
#include "core/contact/contact_model.h"
#include "core/contact/layered_surface.h"
#include "core/levels/waiting_terrain.h"
#include "haptics/terrain/resident_terrain.h"
#include "tests/core/mesh/mesh_shapes.h"
#include "tests/haptics/terrain/arriving_tiles.h"
#include "tests/haptics/terrain/tiled_layers.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace marsview {
namespace {

using test::Arriving;
using test::BodyMap;
using test::NestedMap;
using test::Random;
using test::TiledLayers;

struct Layers {
    BodyMap fine;
    NestedMap coarse;
};

NestedMap wholeMars(std::size_t columns, std::size_t rows, double raised_m)
{
    BodyMap map = test::wholeMars(columns, rows);
    map.crs = "+proj=longlat +R=3396190";
    return {map, raised_m};
}

// Of four tiles each: above, below and across the surface of a coarse map, in a cell of it, over a
// pole, mirrored, and around the body, where a belt ends at two circles.
std::vector<Layers> layers()
{
    const char* const transverse = "+proj=tmerc +lat_0=18 +lon_0=226 +R=3396190 +units=m";
    const char* const polar = "+proj=stere +lat_0=90 +lon_0=0 +R=3396190 +units=m";
    const char* const plate = "+proj=longlat +R=3396190";
    const GeoTransform::Terms kilometers{-150000, 1000, 0, 140000, 0, -1000};
    return {
        {{"Above", transverse, 300, 280, kilometers, 500.0}, wholeMars(72, 36, -6000.0)},
        {{"Below", transverse, 300, 280, kilometers, 500.0}, wholeMars(72, 36, 6000.0)},
        {{"Across", transverse, 300, 280, kilometers, 5000.0}, wholeMars(360, 180, 0.0)},
        {{"InACell", transverse, 300, 280, {-15000, 100, 0, 14000, 0, -100}, 50.0},
         wholeMars(36, 18, -3000.0)},
        {{"OverThePole", polar, 300, 280, {-150000, 1000, 0, 130000, 0, -1000}, 500.0},
         wholeMars(72, 36, -100.0)},
        {{"Mirrored", transverse, 300, 280, {-150000, 1000, 0, -140000, 0, 1000}, 500.0},
         wholeMars(72, 36, -6000.0)},
        {{"Belt", plate, 480, 270, {-180, 0.75, 0, 70, 0, -0.25}, 3000.0},
         wholeMars(36, 18, -500.0)},
    };
}

void expectSameTriangles(const LayeredMesh& mesh, const LayeredMesh& expected)
{
    ASSERT_EQ(mesh.faceCount(), expected.faceCount());
    ASSERT_EQ(mesh.vertexCount(), expected.vertexCount());
    ASSERT_GT(mesh.faceCount(), mesh.firstCutFace());
    for (BodyIndex face = 0; face < mesh.faceCount(); ++face) {
        ASSERT_EQ(mesh.isGone(face), expected.isGone(face)) << face;
        if (mesh.isGone(face)) {
            continue;
        }
        ASSERT_EQ(mesh.isWall(face), expected.isWall(face));
        ASSERT_EQ(mesh.face(face), expected.face(face)) << face;
        ASSERT_EQ(mesh.points(face), expected.points(face)) << face;
        for (BodyIndex corner = 3 * face; corner < 3 * face + 3; ++corner) {
            const BodyIndex beyond = mesh.across(corner);
            ASSERT_EQ(beyond, expected.across(corner)) << face;
            ASSERT_NE(beyond, LayeredMesh::kNone) << face; // closed
            ASSERT_EQ(mesh.across(beyond), corner) << face;
            const LayeredFan fan = mesh.fan(mesh.vertexAt(corner));
            const LayeredFan other = expected.fan(expected.vertexAt(corner));
            ASSERT_TRUE(std::equal(fan.begin(), fan.end(), other.begin(), other.end())) << face;
        }
    }
}

class TiledLayersOf : public testing::TestWithParam<Layers> {};

TEST_P(TiledLayersOf, HaveTheTrianglesOfTheSameHeightsInMemoryWhicheverTilesHaveArrived)
{
    const TiledLayers on(GetParam().fine, GetParam().coarse, 3.0);
    Random random(3);
    Arriving arriving(random, on.map, 1e9);
    const auto mesh = on.over(arriving.terrain());
    bool is_coarse = true;
    for (int state = 0; is_coarse; ++state) {
        is_coarse = arriving.isAnyMissing();
        // Partly blended in now and then.
        arriving.terrain()->advance({0.0, 0.0}, state % 2 == 0 || !is_coarse ? 1.0 : 1e-8);
        const auto felt = on.inMemory(on.felt(*arriving.terrain()));
        ASSERT_NO_FATAL_FAILURE(expectSameTriangles(*mesh, *felt)) << state;
        for (int i = 0; i < 3 && arriving.isAnyMissing(); ++i) {
            arriving.arrive({0.0, 0.0});
        }
    }
    EXPECT_EQ(arriving.terrain()->sample(41, 43), on.map.filled->sample(41, 43));
    // At full resolution.
    const TileCache cache({.bytes_max = std::size_t{8} << 20, .loader_threads = 1});
    const auto waiting =
        std::make_shared<const WaitingTerrain>(TiledRaster(cache, on.map.source), on.map.heights);
    expectSameTriangles(*on.over(waiting), *on.inMemory(on.map.filled));
}

INSTANTIATE_TEST_SUITE_P(AllLayers,
                         TiledLayersOf,
                         testing::ValuesIn(layers()),
                         [](const testing::TestParamInfo<Layers>& tested) {
                             return tested.param.fine.name;
                         });

using Case = std::tuple<ContactModelKind, Layers>;
class TiledLayersContact : public testing::TestWithParam<Case> {};

// Back and forth over walls and cut faces, while tiles arrive.
TEST_P(TiledLayersContact, HasTheProxiesOfTheSameHeightsInMemoryWhileTilesArrive)
{
    const auto& [kind, tested] = GetParam();
    const TiledLayers on(tested.fine, tested.coarse, 2.0);
    Random random(5);
    Arriving arriving(random, on.map, 1e9);
    const auto mesh = on.over(arriving.terrain());
    const double cell_m = test::cellOf(*mesh->map(0));
    const ContactModelOptions options{.radius_m = 0.3 * cell_m};
    const auto model = makeContactModel(kind, LayeredSurface(mesh), options);
    const std::size_t cut_faces = mesh->faceCount() - mesh->firstCutFace();
    const bool may_leave = kind == ContactModelKind::GodObject ||
                           kind == ContactModelKind::GodObjectRelease ||
                           kind == ContactModelKind::VirtualProxy;
    int contacts = 0;
    int on_walls = 0;
    for (int state = 0; state < 4; ++state) {
        const auto felt = on.inMemory(on.felt(*arriving.terrain()));
        const auto truth = makeContactModel(kind, LayeredSurface(felt), options);
        ScenePoint goal = mesh->vertex(mesh->face(mesh->firstCutFace())[0]);
        goal = mesh->highAbove(goal);
        model->place(goal);
        truth->place(goal);
        for (int i = 0; i < 150; ++i) {
            const auto face =
                mesh->firstCutFace() + static_cast<std::uint32_t>(random.below(cut_faces));
            const auto [a, b, c] = mesh->points(face);
            const ScenePoint middle = a + ((b - a) + (c - a)) * (1.0 / 3.0);
            const Vec3 up = verticalAt(mesh->ellipsoid(), middle).up;
            // Far away now and then, mostly a few cells.
            const Vec3 way = middle - goal;
            const double step =
                i % 25 == 0 ? 1.0 : std::min(1.0, random.uniform(0.0, 8.0) * cell_m / length(way));
            goal = goal + way * step + up * (cell_m * random.uniform(-0.2, 0.1));
            const ContactState here = model->update(goal);
            const ContactState there = truth->update(goal);
            ASSERT_LE(length(here.proxy - there.proxy), 1e-9 * cell_m) << state << " " << i;
            ASSERT_EQ(here.is_in_contact, there.is_in_contact) << state << " " << i;
            contacts += here.is_in_contact ? 1 : 0;
            mesh->tree().inBox(here.proxy, here.proxy, [&](BodyIndex near) {
                on_walls += here.is_in_contact && mesh->isWall(near) ? 1 : 0;
            });
        }
        // A proxy that rests follows the surface that changes below it.
        for (int i = 0; i < 2 && arriving.isAnyMissing(); ++i) {
            arriving.arrive({0.0, 0.0});
        }
        arriving.terrain()->advance({0.0, 0.0}, 1.0);
        model->terrainChanged();
        const ContactState after = model->state();
        double distance_m = std::numeric_limits<double>::infinity();
        for (BodyIndex face = 0; face < mesh->faceCount(); ++face) {
            if (!mesh->isGone(face)) {
                distance_m =
                    std::min(distance_m, test::bruteDistance(mesh->points(face), after.proxy));
            }
        }
        EXPECT_TRUE(may_leave || !after.is_in_contact || distance_m <= 1e-6) << distance_m;
    }
    EXPECT_GT(contacts, 100);
    EXPECT_GT(on_walls, 10);
}

std::vector<Case> cases()
{
    std::vector<Case> cases;
    for (const Layers& tested : layers()) {
        cases.emplace_back(kContactModelDefault, tested);
    }
    for (const ContactModelKind kind : kContactModelKinds) {
        if (kind != kContactModelDefault) {
            cases.emplace_back(kind, layers().front());
        }
    }
    return cases;
}

INSTANTIATE_TEST_SUITE_P(AllModels,
                         TiledLayersContact,
                         testing::ValuesIn(cases()),
                         [](const testing::TestParamInfo<Case>& tested) {
                             std::string name(contactModelName(std::get<0>(tested.param)));
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name + "_" + std::get<1>(tested.param).fine.name;
                         });

TEST(TiledLayersRefused, AMapInTilesBelowOthersOrWithoutARim)
{
    const TiledLayers on(layers().front().fine, layers().front().coarse, 1.0);
    const auto waiting = std::make_shared<const WaitingTerrain>(
        TiledRaster(on.cache, on.map.source), on.map.heights);
    JobMonitor monitor;
    for (const auto& maps : {std::vector{on.tiled->over(waiting), on.lower},
                             std::vector{on.lower, on.joined->map(0)}}) {
        const auto refused = LayeredMesh::build(maps, monitor);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::Unsupported);
    }
}

TEST(TiledLayersRefused, ABorderThatCannotBeRead)
{
    const TiledLayers on(layers().front().fine, layers().front().coarse, 1.0);
    const BodyPositions& positions = on.tiled->grid()->positions();
    const test::TiledMap damaged =
        test::tiledMap(on.map.filled->heightfield(), {.before_read = [](const TileId& id) {
                           return id == test::samplesTile(0, 1, 0)
                                      ? std::optional(Error{ErrorCode::Invalid, "a damaged tile"})
                                      : std::nullopt;
                       }});
    JobMonitor monitor;
    const WaitingTerrain missing(TiledRaster(on.cache, damaged.source), on.map.heights);
    const auto failed = TiledRim::read(positions, missing, monitor);
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().message, "a damaged tile");
    monitor.cancel();
    const WaitingTerrain whole(TiledRaster(on.cache, on.map.source), on.map.heights);
    const auto canceled = TiledRim::read(positions, whole, monitor);
    ASSERT_FALSE(canceled);
    EXPECT_EQ(canceled.error().code, ErrorCode::Canceled);
    // A map with voids has no rim.
    EXPECT_TRUE(TiledRim::canRead(*on.map.heights));
    SampleGrid samples = SampleGrid::create(SampleType::Float32, 4, 4).value();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(samples.rowData(1), &nan, sizeof nan);
    const SampleStatistics statistics = samples.applyRule({}, 0, 4);
    const test::TiledMap with_void = test::tiledMap(
        Heightfield(std::make_shared<const SampleGrid>(std::move(samples)), statistics, {}));
    EXPECT_FALSE(TiledRim::canRead(*with_void.heights));
}

} // namespace
} // namespace marsview
