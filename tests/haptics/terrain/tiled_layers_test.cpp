// Contact over maps in tiles that are joined with each other and with maps in memory: whichever
// tiles are in memory, that over all maps in memory with the same heights, which other tests prove
// by brute force.
#include "core/body/pinned_samples.h"
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
#include <iterator>
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
using test::NestedMaps;
using test::Random;
using test::TiledLayers;

struct Layers {
    NestedMaps maps;
    std::vector<std::size_t> in_tiles;
};

NestedMap wholeMars(std::size_t columns, std::size_t rows, double raised_m)
{
    BodyMap map = test::wholeMars(columns, rows);
    map.crs = "+proj=longlat +R=3396190";
    return {map, raised_m};
}

const char* const kTransverse = "+proj=tmerc +lat_0=18 +lon_0=226 +R=3396190 +units=m";
const char* const kPolar = "+proj=stere +lat_0=90 +lon_0=0 +R=3396190 +units=m";
const char* const kPlate = "+proj=longlat +R=3396190";

// Of four tiles each: above, below and across the surface of a coarse map, in a cell of it, over a
// pole, mirrored, and around the body, where a belt ends at two circles.
std::vector<Layers> uppermostInTiles()
{
    const GeoTransform::Terms kilometers{-150000, 1000, 0, 140000, 0, -1000};
    const auto layers = [](const BodyMap& fine, const NestedMap& coarse) {
        return Layers{{fine.name, {{fine}, coarse}}, {0}};
    };
    return {
        layers({"Above", kTransverse, 300, 280, kilometers, 500.0}, wholeMars(72, 36, -6000.0)),
        layers({"Below", kTransverse, 300, 280, kilometers, 500.0}, wholeMars(72, 36, 6000.0)),
        layers({"Across", kTransverse, 300, 280, kilometers, 5000.0}, wholeMars(360, 180, 0.0)),
        layers({"InACell", kTransverse, 300, 280, {-15000, 100, 0, 14000, 0, -100}, 50.0},
               wholeMars(36, 18, -3000.0)),
        layers({"OverThePole", kPolar, 300, 280, {-150000, 1000, 0, 130000, 0, -1000}, 500.0},
               wholeMars(72, 36, -100.0)),
        layers({"Mirrored", kTransverse, 300, 280, {-150000, 1000, 0, -140000, 0, 1000}, 500.0},
               wholeMars(72, 36, -6000.0)),
        layers({"Belt", kPlate, 480, 270, {-180, 0.75, 0, 70, 0, -0.25}, 3000.0},
               wholeMars(36, 18, -500.0)),
    };
}

// All of Mars in six tiles, below a map in memory: across the corner of four tiles, below it and
// above it, with voids, in a cell, over a pole, across the first column, with samples at the same
// places, coarser than the map below it; in between two maps; and with voids of its own.
std::vector<Layers> lowerInTiles()
{
    const NestedMap planet = wholeMars(520, 270, 0.0);
    const auto tmerc = [](double longitude, double latitude) {
        return "+proj=tmerc +lat_0=" + std::to_string(latitude) +
               " +lon_0=" + std::to_string(longitude) + " +R=3396190 +units=m";
    };
    // Column 256 and row 256 are the first of other tiles.
    const std::string at_corner = tmerc(256.5 * 360.0 / 520.0, 90.0 - 256.5 * 180.0 / 270.0);
    const GeoTransform::Terms tens{-205000, 10000, 0, 165000, 0, -10000};
    const auto fine = [&](const std::string& crs, double relief_m) {
        return BodyMap{"Fine", crs, 41, 33, tens, relief_m};
    };
    NestedMap planet_with_voids = planet;
    planet_with_voids.has_voids = true;
    const double column = 360.0 / 520.0;
    const double row = 180.0 / 270.0;
    const BodyMap aligned{"Aligned",
                          kPlate,
                          11,
                          9,
                          {254.0 * column, 2.0 * column, 0, 90.0 - 250.0 * row, 0, -2.0 * row},
                          2000.0};
    return {
        {{"AboveTiles", {{fine(at_corner, 500.0), 6000.0}, planet}}, {1}},
        {{"BelowTiles", {{fine(at_corner, 500.0), -6000.0}, planet}}, {1}},
        {{"AcrossTiles", {{fine(at_corner, 5000.0), 0.0}, planet}}, {1}},
        {{"WithVoids", {{fine(at_corner, 500.0), 200.0, true}, planet}}, {1}},
        {{"InACellOfTiles",
          {{{"Fine", at_corner, 23, 21, {-2300, 200, 0, 2100, 0, -200}, 50.0}, 3000.0}, planet}},
         {1}},
        {{"OverThePoleOfTiles",
          {{{"Polar", kPolar, 31, 27, {-150000, 10000, 0, 130000, 0, -10000}, 2000.0}, 200.0},
           planet}},
         {1}},
        {{"OverTheFirstColumn", {{fine(tmerc(0.0, 20.0), 500.0), 200.0}, planet}}, {1}},
        {{"AlignedWithTiles", {{aligned, 200.0}, planet}}, {1}},
        {{"TheSameHeights", {{aligned, 0.0, true, true}, {planet.map, 0.0, false, true}}}, {1}},
        {{"CoarseOverTiles",
          {{{"Coarse", at_corner, 5, 4, {-1250000, 500000, 0, 1000000, 0, -500000}, 500.0}, 900.0},
           planet}},
         {1}},
        {{"InBetween",
          {{{"Finest", kTransverse, 41, 33, {-20500, 1000, 0, 16500, 0, -1000}, 300.0},
            200.0,
            true},
           {{"Middle", kTransverse, 300, 280, {-150000, 1000, 0, 140000, 0, -1000}, 500.0}, -500.0},
           wholeMars(72, 36, 0.0)}},
         {1}},
        {{"VoidsInTiles", {{fine(tmerc(5.0, 86.0), 500.0), 200.0}, planet_with_voids}}, {1}},
    };
}

// In pairs and threes, of different projections: the upper one far above, far below and across the
// lower one, around the body, over a pole with voids below it, with a map in memory between them
// whose border is apart from theirs or crosses them, and with borders that cross, in both orders.
std::vector<Layers> severalInTiles()
{
    const GeoTransform::Terms kilometers{-150000, 1000, 0, 140000, 0, -1000};
    const NestedMap planet = wholeMars(520, 270, 0.0);
    const auto fine = [&](double relief_m, double raised_m) {
        return NestedMap{{"Fine", kTransverse, 300, 280, kilometers, relief_m}, raised_m};
    };
    const NestedMap crossing{
        {"Crossing", kPlate, 280, 300, {226.5, 0.02, 0, 19.5, 0, -0.02}, 3000.0}, 700.0};
    const auto middle = [](double left_m) {
        return NestedMap{
            {"Middle", kTransverse, 41, 33, {left_m, 10000, 0, 165000, 0, -10000}, 500.0},
            -300.0,
            true};
    };
    NestedMap planet_with_voids = planet;
    planet_with_voids.has_voids = true;
    const NestedMap polar{{"Polar", kPolar, 300, 280, {-150000, 1000, 0, 130000, 0, -1000}, 500.0},
                          -400.0};
    return {
        {{"BothFarAbove", {fine(500.0, 6000.0), planet}}, {0, 1}},
        {{"BothFarBelow", {fine(500.0, -2000.0), planet}}, {0, 1}},
        {{"BothAcross", {fine(5000.0, 0.0), planet}}, {0, 1}},
        {{"BeltOverTiles",
          {{{"Belt", kPlate, 480, 270, {-180, 0.75, 0, 70, 0, -0.25}, 3000.0}, 200.0}, planet}},
         {0, 1}},
        {{"PolarOverVoids", {polar, planet_with_voids}}, {0, 1}},
        {{"MemoryBetween", {fine(500.0, 100.0), middle(-205000.0), planet}}, {0, 2}},
        {{"MemoryAcross", {fine(500.0, 100.0), middle(-55000.0), planet}}, {0, 2}},
        {{"Crossing", {fine(500.0, 100.0), crossing, wholeMars(72, 36, 0.0)}}, {0, 1}},
        {{"CrossingInTheOtherOrder", {crossing, fine(500.0, 100.0), wholeMars(72, 36, 0.0)}},
         {0, 1}},
        {{"ThreeInTiles", {fine(500.0, 100.0), crossing, planet}}, {0, 1, 2}},
    };
}

std::vector<Layers> layers()
{
    std::vector<Layers> all = uppermostInTiles();
    for (auto more : {lowerInTiles(), severalInTiles()}) {
        std::move(more.begin(), more.end(), std::back_inserter(all));
    }
    return all;
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

// One per map in tiles.
class ArrivingOn {
public:
    ArrivingOn(const TiledLayers& on, Random& random)
        : random_(random)
    {
        for (const test::TiledLayerMap& one : on.tiles) {
            maps_.push_back(std::make_unique<Arriving>(random, one.map, 1e9));
        }
    }

    TiledLayers::Terrains terrains() const
    {
        TiledLayers::Terrains terrains;
        for (const auto& map : maps_) {
            terrains.push_back(map->terrain());
        }
        return terrains;
    }
    bool isAnyMissing() const
    {
        return std::any_of(maps_.begin(), maps_.end(),
                           [](const auto& map) { return map->isAnyMissing(); });
    }
    void arrive()
    {
        std::size_t i = random_.below(maps_.size());
        while (!maps_[i]->isAnyMissing()) {
            i = (i + 1) % maps_.size();
        }
        maps_[i]->arrive({0.0, 0.0});
    }
    // All tiles of one map.
    void complete(std::size_t i)
    {
        while (maps_[i]->isAnyMissing()) {
            maps_[i]->arrive({0.0, 0.0});
        }
        maps_[i]->terrain()->advance({0.0, 0.0}, 1.0);
    }
    void advance(double seconds)
    {
        for (const auto& map : maps_) {
            map->terrain()->advance({0.0, 0.0}, seconds);
        }
    }

private:
    Random& random_;
    std::vector<std::unique_ptr<Arriving>> maps_;
};

class TiledLayersOf : public testing::TestWithParam<Layers> {};

TEST_P(TiledLayersOf, HaveTheTrianglesOfTheSameHeightsInMemoryWhicheverTilesHaveArrived)
{
    const TiledLayers on(GetParam().maps, GetParam().in_tiles, 3.0);
    // Those around the borders, and no other samples.
    for (std::size_t i = 0; i < on.tiles.size(); ++i) {
        const TileLayout& layout = on.tiles[i].map.layout();
        EXPECT_GT(on.pins(i).size(), 4U);
        EXPECT_LT(on.pins(i).size(), layout.columns * layout.rows / 10);
    }
    Random random(3);
    ArrivingOn arriving(on, random);
    const auto mesh = on.over(arriving.terrains());
    bool is_coarse = true;
    for (int state = 0; is_coarse; ++state) {
        is_coarse = arriving.isAnyMissing();
        // Partly blended in now and then.
        arriving.advance(state % 2 == 0 || !is_coarse ? 1.0 : 1e-8);
        const auto felt = on.inMemory(on.felt(arriving.terrains()));
        ASSERT_NO_FATAL_FAILURE(expectSameTriangles(*mesh, *felt)) << state;
        for (std::size_t i = 0; i < 3 * on.tiles.size() && arriving.isAnyMissing(); ++i) {
            arriving.arrive();
        }
    }
    for (std::size_t i = 0; i < on.tiles.size(); ++i) {
        EXPECT_EQ(arriving.terrains()[i]->sample(41, 43), on.tiles[i].map.filled->sample(41, 43));
    }
    // At full resolution.
    expectSameTriangles(*on.over(on.waiting()), *on.inMemory(on.filled()));
}

INSTANTIATE_TEST_SUITE_P(AllLayers,
                         TiledLayersOf,
                         testing::ValuesIn(layers()),
                         [](const testing::TestParamInfo<Layers>& tested) {
                             return tested.param.maps.name;
                         });

const auto kNameOf = [](const testing::TestParamInfo<Layers>& tested) {
    return tested.param.maps.name;
};

class SeveralTiledLayers : public testing::TestWithParam<Layers> {};

INSTANTIATE_TEST_SUITE_P(AllLayers,
                         SeveralTiledLayers,
                         testing::ValuesIn(severalInTiles()),
                         kNameOf);

// The other maps have all of theirs.
TEST_P(SeveralTiledLayers, HaveTheTrianglesInMemoryWhileTheTilesOfOneMapAreHeldBack)
{
    const TiledLayers on(GetParam().maps, GetParam().in_tiles, 3.0);
    for (std::size_t held = 0; held < on.tiles.size(); ++held) {
        Random random(7);
        ArrivingOn arriving(on, random);
        for (std::size_t i = 0; i < on.tiles.size(); ++i) {
            if (i != held) {
                arriving.complete(i);
            }
        }
        const TiledLayers::Terrains terrains = arriving.terrains();
        std::size_t coarse = 0; // samples of the map that is held back
        for (std::size_t i = 0; i < on.tiles.size(); ++i) {
            const TileLayout& layout = on.tiles[i].map.layout();
            std::size_t other = 0;
            for (std::size_t row = 0; row < layout.rows; ++row) {
                for (std::size_t column = 0; column < layout.columns; ++column) {
                    other += terrains[i]->sample(column, row) !=
                                     on.tiles[i].map.filled->sample(column, row)
                                 ? 1U
                                 : 0U;
                }
            }
            if (i == held) {
                coarse = other;
            } else {
                EXPECT_EQ(other, 0U) << i;
            }
        }
        EXPECT_GT(coarse, 1000U) << held;
        ASSERT_NO_FATAL_FAILURE(
            expectSameTriangles(*on.over(terrains), *on.inMemory(on.felt(terrains))))
            << held;
    }
}

// Each map asked by itself, over all of its faces, in long double.
TEST_P(SeveralTiledLayers, LieAtEachPlaceWhereTheUppermostMapLies)
{
    const TiledLayers on(GetParam().maps, GetParam().in_tiles, 1.0);
    const auto mesh = on.over(on.waiting());
    const auto maps = test::meshesOf(GetParam().maps);
    Random random(11);
    double cell_m = 0.0;
    for (const auto& map : maps) {
        cell_m = std::max(cell_m, test::cellOf(*map));
    }
    // An edge that is straight in space is not quite one over the ellipsoid: by a share of how far
    // it lies below that.
    const double exact_m = 1e-6 * cell_m + 3e-4 * cell_m * cell_m / (8.0 * 3396190.0);
    std::vector<int> on_map(maps.size());
    int near_border = 0;
    constexpr std::size_t kPlaces = 60;
    for (std::size_t i = 0; i < kPlaces; ++i) {
        const ScenePoint place = test::placeNear(*maps[i % (maps.size() - 1)], random);
        const auto found = test::below(*mesh, place);
        const auto expected = test::uppermostBelow(maps, place);
        ASSERT_TRUE(found && expected) << i;
        ++on_map[expected->map];
        near_border += std::abs(found->height_m - expected->height_m) > exact_m ? 1 : 0;
    }
    for (const int count : on_map) {
        EXPECT_GT(count, 2);
    }
    EXPECT_LE(near_border, 1);
}

using Case = std::tuple<ContactModelKind, Layers>;
class TiledLayersContact : public testing::TestWithParam<Case> {};

// Back and forth over walls and cut faces, while tiles arrive.
TEST_P(TiledLayersContact, HasTheProxiesOfTheSameHeightsInMemoryWhileTilesArrive)
{
    const auto& [kind, tested] = GetParam();
    const TiledLayers on(tested.maps, tested.in_tiles, 2.0);
    Random random(5);
    ArrivingOn arriving(on, random);
    const auto mesh = on.over(arriving.terrains());
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
        const auto felt = on.inMemory(on.felt(arriving.terrains()));
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
        for (std::size_t i = 0; i < 2 * on.tiles.size() && arriving.isAnyMissing(); ++i) {
            arriving.arrive();
        }
        arriving.advance(1.0);
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
            cases.emplace_back(kind, uppermostInTiles().front());
            cases.emplace_back(kind, lowerInTiles().front());
            cases.emplace_back(kind, severalInTiles().front());
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
                             return name + "_" + std::get<1>(tested.param).maps.name;
                         });

// The samples of tiles that were read once, whatever is in memory later.
TEST(TiledLayersPins, AreTheSamplesAroundTheBorderOfTheUpperMap)
{
    const Layers layers = lowerInTiles().front();
    const TiledLayers on(layers.maps, layers.in_tiles, 1.0);
    const test::TiledLayerMap& planet = on.tiles.front();
    const BodyPositions& positions = planet.tiled->grid()->positions();
    const auto cell_m = test::cellOf(*on.joined->map(planet.index));
    // All samples of the upper map's border, on the ellipsoid.
    std::vector<ScenePoint> border;
    on.meshes[0]->eachVertexAtBorder([&](BodyIndex vertex) {
        const ScenePoint at = on.meshes[0]->vertex(vertex);
        const BodyVertical vertical = verticalAt(on.ellipsoid(), at);
        border.push_back(at - vertical.up * vertical.height_m);
    });
    ASSERT_EQ(border.size(), 2U * (41 + 33) - 4);
    for (const ScenePoint& point : border) {
        const auto at = planet.tiled->locator()->find(point, std::nullopt);
        ASSERT_TRUE(at);
        const auto column = static_cast<std::size_t>(at->column);
        const auto row = static_cast<std::size_t>(at->row) - positions.firstRow();
        for (const std::size_t corner : {0U, 1U, 2U, 3U}) {
            ASSERT_TRUE(on.pins(0).find(column + corner % 2, row + corner / 2))
                << at->column << " " << at->row;
        }
    }
    std::size_t pinned = 0;
    for (std::size_t row = 0; row < positions.rows(); ++row) {
        for (std::size_t column = 0; column < positions.columns(); ++column) {
            const double* height_m = on.pins(0).find(column, row);
            if (height_m == nullptr) {
                continue;
            }
            ++pinned;
            ASSERT_EQ(*height_m, planet.map.filled->sample(column, row + positions.firstRow()));
            const ScenePoint at = positions.at(column, row, 0.0);
            double nearest_m = std::numeric_limits<double>::infinity();
            for (const ScenePoint& point : border) {
                nearest_m = std::min(nearest_m, length(at - point));
            }
            ASSERT_LT(nearest_m, 4.5 * cell_m) << column << " " << row;
        }
    }
    EXPECT_EQ(pinned, on.pins(0).size());
}

// More than a table's places: none is lost, and no others are found.
TEST(TiledLayersPins, FindTheirSamplesAndNoOthers)
{
    Random random(23);
    for (const std::size_t columns : {std::size_t{7}, std::size_t{4096}, std::size_t{106'694}}) {
        std::vector<PinnedSamples::Sample> samples;
        // The border of a rectangle, two samples wide.
        const auto width = static_cast<std::uint32_t>(std::min<std::size_t>(columns, 3000));
        for (std::uint32_t row = 50'000; row < 51'000; ++row) {
            for (std::uint32_t column = 0; column < width; ++column) {
                if (row < 50'002 || row > 50'997 || column < 2 || column + 2 >= width) {
                    samples.push_back({column, row, random.uniform(-1.0, 1.0)});
                }
            }
        }
        const PinnedSamples pins(columns, samples);
        EXPECT_EQ(pins.size(), samples.size());
        std::size_t next = 0;
        for (std::uint32_t row = 49'990; row < 51'010; ++row) {
            for (std::uint32_t column = 0; column < width; ++column) {
                const double* found = pins.find(column, row);
                if (next < samples.size() && samples[next].column == column &&
                    samples[next].row == row) {
                    ASSERT_TRUE(found) << column << " " << row;
                    ASSERT_EQ(*found, samples[next++].height_m);
                } else {
                    ASSERT_FALSE(found) << column << " " << row;
                }
            }
        }
        EXPECT_EQ(next, samples.size());
    }
}

TEST(TiledLayersRefused, AMapInTilesWithVoidsAboveOthers)
{
    SampleGrid samples = SampleGrid::create(SampleType::Float32, 4, 4).value();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(samples.rowData(1), &nan, sizeof nan);
    const SampleStatistics statistics = samples.applyRule({}, 0, 4);
    const test::TiledMap with_void = test::tiledMap(
        Heightfield(std::make_shared<const SampleGrid>(std::move(samples)), statistics, {}));
    EXPECT_FALSE(LayeredMesh::canBeCutOut(*with_void.heights));
    const Layers layers = lowerInTiles().back(); // with voids in tiles
    ASSERT_EQ(layers.maps.name, "VoidsInTiles");
    const TiledLayers on(layers.maps, layers.in_tiles, 1.0);
    EXPECT_FALSE(LayeredMesh::canBeCutOut(*on.tiles.front().map.heights));
    auto maps = on.meshesOver(on.waiting());
    std::swap(maps[0], maps[1]);
    JobMonitor monitor;
    const auto refused = LayeredMesh::build(maps, monitor);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Unsupported);
}

TEST(TiledLayersRefused, MoreThanTheLimitsOfMapsInTiles)
{
    const Layers layers = lowerInTiles().front();
    const TiledLayers on(layers.maps, layers.in_tiles, 1.0);
    const auto maps = on.meshesOver(on.waiting());
    JobMonitor monitor;
    std::size_t covered = 0;
    for (BodyIndex face = 0; face < on.joined->firstCutFace(); ++face) {
        covered += on.joined->isGone(face) ? 1U : 0U;
    }
    EXPECT_TRUE(LayeredMesh::build(maps, monitor, {.covered_faces_max = 10 * covered}));
    for (const LayerLimits& limits :
         {LayerLimits{.covered_faces_max = covered / 10}, LayerLimits{.cut_faces_max = 100}}) {
        const auto refused = LayeredMesh::build(maps, monitor, limits);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::TooLarge);
        // Maps in memory have no such limits.
        EXPECT_TRUE(LayeredMesh::build(test::meshesOf(layers.maps), monitor, limits));
    }
    monitor.cancel();
    const auto canceled = LayeredMesh::build(maps, monitor);
    ASSERT_FALSE(canceled);
    EXPECT_EQ(canceled.error().code, ErrorCode::Canceled);
}

// Each has a thread that loads its tiles.
TEST(TiledLayersRefused, MoreMapsInTilesThanCanBeLoadedAtOnce)
{
    const Layers layers = lowerInTiles().front();
    const TiledLayers on(layers.maps, layers.in_tiles, 1.0);
    const auto tiled = on.meshesOver(on.waiting()).back();
    JobMonitor monitor;
    for (const std::size_t count : {LayeredMesh::kTiledMax, LayeredMesh::kTiledMax + 1}) {
        // The same map again and again covers all of those below it.
        const auto built =
            LayeredMesh::build(std::vector<std::shared_ptr<const BodyMesh>>(count, tiled), monitor);
        ASSERT_EQ(static_cast<bool>(built), count == LayeredMesh::kTiledMax);
        EXPECT_TRUE(built || built.error().code == ErrorCode::TooLarge);
    }
}

// A tile that cannot be read is the error of the terrain that the maps are joined over.
TEST(TiledLayersRefused, ABorderThatCannotBeRead)
{
    const Layers layers = lowerInTiles().front();
    const TiledLayers on(layers.maps, layers.in_tiles, 1.0);
    for (const std::size_t column : {std::size_t{0}, std::size_t{2}}) {
        const test::TiledMap damaged = test::tiledMap(
            on.tiles.front().map.filled->heightfield(), {.before_read = [column](const TileId& id) {
                return id == test::samplesTile(0, column, 1)
                           ? std::optional(Error{ErrorCode::Invalid, "a damaged tile"})
                           : std::nullopt;
            }});
        TileCache cache({.bytes_max = std::size_t{8} << 20, .loader_threads = 1});
        const auto missing = std::make_shared<const WaitingTerrain>(
            TiledRaster(cache, damaged.source), on.tiles.front().map.heights);
        JobMonitor monitor;
        const auto built = LayeredMesh::build(on.meshesOver({missing}), monitor);
        // The tile at the seam is far from the border.
        EXPECT_EQ(missing->error().has_value(), column == 0);
        EXPECT_TRUE(built);
    }
}

} // namespace
} // namespace marsview
