#include "app/bench/reference/local_minimum.h"
#include "core/contact/body_goal_frame.h"
#include "core/contact/contact_model.h"
#include "tests/core/contact/body_maps.h"
#include "tests/core/contact/contact_terrain.h"
#include "tests/core/mesh/mesh_shapes.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

namespace marsview {
namespace {

using Case = std::tuple<ContactModelKind, test::BodyMap>;
class BodyContact : public testing::TestWithParam<Case> {};

// The list of the same triangles has the contact that tests of meshes prove by brute force.
TEST_P(BodyContact, ItsProxiesAreThoseOnAListOfTheSameTriangles)
{
    const auto& [kind, map] = GetParam();
    for (const double exaggeration : {0.5, 1.0, 20.0}) {
        const auto mesh = test::bodyMesh(map, exaggeration);
        const auto listed = test::listedMesh(*mesh);
        const auto model = makeContactModel(kind, BodySurface(mesh));
        const auto other = makeContactModel(kind, MeshSurface(listed));
        test::Random random(3);
        test::BodyWalker walker{*mesh, random, 1.0, 1.0};
        // Both begin in free space, so that they begin at one place.
        const ScenePoint begin = mesh->highAbove(mesh->vertex(0));
        model->update(begin);
        other->update(begin);
        int equal = 0;
        int contacts = 0;
        constexpr int kUpdates = 300;
        const double size_m = length(mesh->vertex(0) - mesh->vertex(1));
        for (int i = 0; i < kUpdates; ++i) {
            const ScenePoint goal = walker.next(i % 100 == 0 ? 5.0 : 1.0);
            const ContactState here = model->update(goal);
            const ContactState there = other->update(goal);
            equal += length(here.proxy - there.proxy) <= 1e-9 * size_m ? 1 : 0;
            contacts += here.is_in_contact ? 1 : 0;
            EXPECT_EQ(here.counters.cut_short, 0U);
            if (here.is_in_contact && i % 50 == 0) {
                EXPECT_LE(test::bruteDistance(*listed, here.proxy), 1e-6);
            }
        }
        EXPECT_GT(contacts, kUpdates / 4);
        EXPECT_EQ(equal, kUpdates) << "exaggeration " << exaggeration;
    }
}

// The check of minima, which the models do not use, on maps without a border.
TEST(BodySurface, UpdatesEndWhereNoDirectionLeadsCloser)
{
    constexpr double kCosineMax = 1e-6; // rounding
    for (const test::BodyMap& map : test::bodyMaps()) {
        const auto mesh = test::bodyMesh(map, 1.0);
        if (!mesh->positions().closesAtFirstRow() || !mesh->positions().closesAtLastRow()) {
            continue;
        }
        const Georeference georeference = test::georeferenceOf(map);
        const auto model = makeContactModel(ContactModelKind::ContinuousWalk, BodySurface(mesh));
        test::Random random(13);
        test::BodyWalker walker{*mesh, random, 1.0, 1.0};
        model->update(mesh->highAbove(mesh->vertex(0)));
        int contacts = 0;
        int minima_of_others = 0;
        for (int i = 0; i < 300; ++i) {
            const ScenePoint goal = walker.next(1.0);
            const ContactState state = model->update(goal);
            if (!state.is_in_contact) {
                continue;
            }
            ++contacts;
            ASSERT_LE(steepestCosine(*mesh, georeference, state.proxy, goal), kCosineMax)
                << map.name << " " << i;
            const ScenePoint other = walker.next(1.0);
            minima_of_others +=
                steepestCosine(*mesh, georeference, state.proxy, other) <= kCosineMax ? 1 : 0;
        }
        EXPECT_GT(contacts, 100) << map.name;
        EXPECT_LT(minima_of_others, contacts / 4) << map.name;
    }
}

// Casts leave out cells beside the path; those on the list look at all faces in its boxes.
TEST(BodySurface, CastsHitWhatCastsOnAListOfTheSameTrianglesHit)
{
    for (const test::BodyMap& map : test::bodyMaps()) {
        const auto mesh = test::bodyMesh(map, 5.0);
        const auto listed = test::listedMesh(*mesh);
        const BodySurface here(mesh);
        const MeshSurface there(listed);
        test::Random random(11);
        int hits = 0;
        constexpr int kCasts = 400;
        for (int i = 0; i < kCasts; ++i) {
            const auto vertex = [&] {
                return static_cast<std::uint32_t>(random.below(mesh->vertexCount()));
            };
            const ScenePoint from = mesh->highAbove(mesh->vertex(vertex()));
            // Into the ground: mostly under another vertex, sometimes exactly at it.
            const ScenePoint target = mesh->vertex(vertex());
            const ScenePoint to = i % 4 == 0 ? target : target * random.uniform(0.9, 1.0);
            const auto a = here.castFree({from, {}}, {to, {}});
            const auto b = there.castFree({from, {}}, {to, {}});
            ASSERT_EQ(a.contact.has_value(), b.contact.has_value()) << map.name;
            if (a.contact) {
                ++hits;
                ASSERT_EQ(here.point(*a.contact), there.point(*b.contact)) << map.name;
            }
        }
        EXPECT_GT(hits, kCasts / 2) << map.name;
    }
}

std::vector<Case> cases()
{
    std::vector<Case> all;
    for (const ContactModelKind kind : {ContactModelKind::ProxyGraph, ContactModelKind::SurfaceWalk,
                                        ContactModelKind::ContinuousWalk}) {
        for (const test::BodyMap& map : test::bodyMaps()) {
            all.emplace_back(kind, map);
        }
    }
    return all;
}

INSTANTIATE_TEST_SUITE_P(BodySurface,
                         BodyContact,
                         testing::ValuesIn(cases()),
                         [](const auto& tested) {
                             std::string name(contactModelName(std::get<0>(tested.param)));
                             std::erase(name, '-');
                             return name + std::get<1>(tested.param).name;
                         });

TEST(BodySurface, AModelIsPlacedOnTheSurfaceAlongTheNormal)
{
    const auto mesh = test::bodyMesh(test::wholeMars(180, 90), 1.0);
    const BodyGoalFrame frame(mesh->positions().ellipsoid(), 1.0, Angle::degrees(180.0));
    const BodySurface surface(mesh);
    test::Random random(5);
    for (int i = 0; i < 2000; ++i) {
        const TracePoint goal{random.uniform(0.0, 360.0), random.uniform(-89.9, 89.9), -30'000.0};
        const auto begin = surface.goal(frame.toScene(goal));
        ASSERT_TRUE(begin);
        const TracePoint placed = frame.fromScene(surface.point(surface.contactAt(*begin)));
        ASSERT_NEAR(std::remainder(placed.x - goal.x, 360.0), 0.0,
                    1e-9 / std::cos(Angle::degrees(goal.y).radians()));
        ASSERT_NEAR(placed.y, goal.y, 1e-9);
        ASSERT_GT(placed.z, -10'000.0);
    }
}

TEST(BodyGoalFrame, GoalsAndTheirPositionsConvertToEachOther)
{
    const Ellipsoid body{3396190.0, 3376200.0};
    const BodyGoalFrame frame(body, 5.0, Angle::degrees(0.0));
    test::Random random(9);
    for (int i = 0; i < 10'000; ++i) {
        const TracePoint goal{random.uniform(-180.0, 180.0), random.uniform(-90.0, 90.0),
                              random.uniform(-8000.0, 21'000.0)};
        const TracePoint back = frame.fromScene(frame.toScene(goal));
        ASSERT_NEAR(back.x, goal.x, 1e-9);
        ASSERT_NEAR(back.y, goal.y, 1e-12 * 180.0);
        ASSERT_NEAR(back.z, goal.z, 1e-7);
    }
    const BodyGoalFrame of_sphere({1737400.0, 1737400.0}, 5.0, Angle::degrees(0.0));
    for (const double latitude : {91.0, -91.0, 180.0}) {
        EXPECT_FALSE(isFinite(frame.toScene({0.0, latitude, 0.0})));
        EXPECT_FALSE(isFinite(of_sphere.toScene({0.0, latitude, 0.0})));
    }
    EXPECT_TRUE(isFinite(of_sphere.toScene({0.0, -90.0, 0.0})));
}

// In the turn of the map, whose middle is 180° here, 360° there, and 90° next to the pole, where
// the middle of the last row is at 45°.
TEST(BodyGoalFrame, LongitudesAreThoseOfTheMap)
{
    const Ellipsoid body{3396190.0, 3376200.0};
    const test::BodyMap around = test::wholeMars(36, 18);
    test::BodyMap across = around;
    across.columns = 4;
    across.terms = {340, 10, 0, 90, 0, -10};
    const test::BodyMap near_pole{"NearThePole",
                                  "+proj=stere +lat_0=90 +lon_0=0 +a=3396190 +b=3376200 +units=m",
                                  3,
                                  3,
                                  {850'000, 100'000, 0, 1'500'000, 0, -1'000'000},
                                  0.0};
    for (const auto& [map, longitudes] : {std::pair(around, std::array{5.0, 175.0, 355.0}),
                                          std::pair(across, std::array{341.0, 360.0, 379.0}),
                                          std::pair(near_pole, std::array{-80.0, 90.0, 260.0})}) {
        const BodyGoalFrame frame = bodyGoalFrame(test::georeferenceOf(map), body, 1.0);
        for (const double longitude : longitudes) {
            EXPECT_NEAR(frame.fromScene(frame.toScene({longitude, 20.0, 0.0})).x, longitude, 1e-9);
        }
    }
}

// On a map of a few kilometers the body is nearly a plane: the proxies differ by the curvature
// within a cell, c² / 8R, and by that of the goal's path.
TEST(BodySurface, ASmallMapHasTheFlatScenesProxies)
{
    const test::BodyMap map{"Utm", "EPSG:32611", 101, 101, {498500, 30, 0, 3797505, 0, -30}, 400.0};
    const auto filled = test::fractalMap(map);
    const Georeference georeference = test::georeferenceOf(map);
    JobMonitor monitor;
    const auto mesh = BodyMesh::build(filled, georeference, 1.0, monitor);
    ASSERT_TRUE(mesh);
    const BodyGoalFrame body_frame((*mesh)->positions().ellipsoid(), 1.0, Angle::degrees(-117.0));
    const auto shared = std::make_shared<const Georeference>(georeference);
    const GoalFrame flat_frame(shared, 1.0);
    const auto body = makeContactModel(ContactModelKind::ContinuousWalk, BodySurface(*mesh));
    const auto flat = makeContactModel(ContactModelKind::ContinuousWalk,
                                       HeightfieldSurface(filled, georeference.sceneFrame(), 1.0));
    test::Random random(21);
    GridPoint at{50.0, 50.0};
    double worst_m = 0.0;
    for (int i = 0; i < 2000; ++i) {
        at.column = std::clamp(at.column + random.uniform(-2.0, 2.0), 5.0, 95.0);
        at.row = std::clamp(at.row + random.uniform(-2.0, 2.0), 5.0, 95.0);
        const MapPoint point = georeference.toMap(at);
        const auto place = georeference.toGeographic(at);
        ASSERT_TRUE(place);
        const double height_m =
            filled->sample(static_cast<std::size_t>(at.column), static_cast<std::size_t>(at.row)) -
            10.0;
        const ContactState there = flat->update(flat_frame.toScene({point.x, point.y, height_m}));
        const ContactState here = body->update(
            body_frame.toScene({place->longitude.degrees(), place->latitude.degrees(), height_m}));
        const TracePoint found = body_frame.fromScene(here.proxy);
        const auto grid = georeference.toGrid(GeographicPoint{.longitude = Angle::degrees(found.x),
                                                              .latitude = Angle::degrees(found.y)});
        ASSERT_TRUE(grid);
        const ScenePoint in_flat = georeference.sceneFrame().toScene(*grid, found.z);
        worst_m = std::max(worst_m, length(in_flat - there.proxy));
    }
    RecordProperty("worst_m", std::to_string(worst_m));
    EXPECT_LT(worst_m, 1.0);
}

} // namespace
} // namespace marsview
