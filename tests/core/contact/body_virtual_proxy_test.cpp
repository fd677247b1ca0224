#include "core/contact/body_surface.h"
#include "core/contact/contact_model.h"
#include "core/contact/layered_surface.h"
#include "core/contact/virtual_proxy.h"
#include "tests/core/contact/body_maps.h"
#include "tests/core/contact/nested_maps.h"
#include "tests/core/mesh/mesh_shapes.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace marsview {
namespace {

constexpr double kToleranceM = 1e-6; // rounding in coordinates of 3.4e6 m, many times

struct Round {
    std::string name;
    std::string crs;
};

// Mars as a sphere and as an ellipsoid, and a strongly flattened body.
class SphereOnBody : public testing::TestWithParam<Round> {
protected:
    static std::shared_ptr<const BodyMesh> mesh(double exaggeration)
    {
        test::BodyMap map = test::wholeMars(36, 18);
        map.crs = GetParam().crs;
        return test::bodyMesh(map, exaggeration);
    }

    // Both poles, both sides of the equator and the equator itself, so many meters high.
    static std::vector<ScenePoint> pointsAt(const Ellipsoid& body, double height_m)
    {
        std::vector<ScenePoint> points;
        for (const double latitude : {-90.0, -61.0, -33.0, -2.0, 0.0, 2.0, 33.0, 61.0, 90.0}) {
            for (double longitude = 3.0; longitude < 360.0; longitude += 77.0) {
                const auto foot =
                    footOf(body, {Angle::degrees(longitude), Angle::degrees(latitude)});
                points.push_back(foot.surface_m + foot.normal * height_m);
                if (std::abs(latitude) == 90.0) {
                    break;
                }
            }
        }
        return points;
    }
};

// How far two points are from being above each other.
double asideM(const Ellipsoid& body, const ScenePoint& a, const ScenePoint& b)
{
    return length(cross(b - a, verticalAt(body, a).up));
}

TEST_P(SphereOnBody, IsPlacedOutsideTheGroundAboveTheGoal)
{
    const auto body = mesh(20.0);
    const auto listed = test::listedMesh(*body);
    for (const double radius_m : {100.0, 20'000.0}) {
        // On the ground, less than a radius over it, and below it.
        for (const double height_m : {0.0, 0.7 * radius_m, -0.05 * body->ellipsoid().polar_m}) {
            for (const ScenePoint& point : pointsAt(body->ellipsoid(), 0.0)) {
                SCOPED_TRACE(testing::Message() << point.x << " " << point.y << " " << point.z
                                                << " " << height_m << " " << radius_m);
                const Vec3 up = verticalAt(body->ellipsoid(), point).up;
                const ScenePoint ground = point - up * clearanceOver(BodySurface(body), point);
                const ScenePoint goal = ground + up * height_m;
                VirtualProxy<BodySurface> model(BodySurface(body), radius_m);
                const ContactState state = model.place(goal);
                EXPECT_TRUE(state.is_in_contact);
                EXPECT_EQ(state.counters.cut_short, 0U);
                EXPECT_NEAR(test::bruteDistance(*listed, state.proxy), radius_m, kToleranceM);
                EXPECT_NEAR(test::windingNumber(*listed, state.proxy), 0.0, 1e-6);
                // It rests on this side of the body.
                EXPECT_GT(dot(normalized(state.proxy), normalized(point)), 0.9);
            }
        }
    }
}

TEST_P(SphereOnBody, RestsARadiusOffTheGodObjectOnAFace)
{
    constexpr double kRadiusM = 5.0;
    const auto body = mesh(1.0);
    const BodySurface surface(body);
    int faces = 0;
    for (const ScenePoint& point : pointsAt(body->ellipsoid(), 0.0)) {
        const Vec3 up = verticalAt(body->ellipsoid(), point).up;
        const ScenePoint goal = point - up * (clearanceOver(surface, point) + 100.0);
        const auto god = makeContactModel(ContactModelKind::GodObject, surface)->place(goal);
        const auto sphere = VirtualProxy<BodySurface>(surface, kRadiusM).place(goal);
        if (god.feature != ContactFeature::Face || sphere.feature != ContactFeature::Face) {
            continue;
        }
        ++faces;
        const Vec3 normal = normalized(god.proxy - goal);
        // Rounding in coordinates of 3.4e6 m turns the normal through the god object a little.
        EXPECT_NEAR(length(sphere.proxy - (god.proxy + normal * kRadiusM)), 0.0,
                    2e-9 * body->ellipsoid().equatorial_m);
    }
    EXPECT_GT(faces, 20);
}

TEST_P(SphereOnBody, MovesStraightUpAndDownWithTheGround)
{
    constexpr double kRadiusM = 2'000.0;
    const auto low = mesh(0.2);
    const auto high = mesh(20.0);
    const Ellipsoid& body = low->ellipsoid();
    const auto listed_low = test::listedMesh(*low);
    const auto listed_high = test::listedMesh(*high);
    constexpr double kStillM = 1e-4; // rounding on the way up from the lower ground
    for (const ScenePoint& point : pointsAt(body, -40'000.0)) {
        SCOPED_TRACE(testing::Message() << point.x << " " << point.y << " " << point.z);
        VirtualProxy<BodySurface> model(BodySurface(low), kRadiusM);
        ScenePoint before = model.place(point).proxy;
        for (const auto& [next, listed] : {std::pair(high, listed_high), {low, listed_low}}) {
            model.setSurface(BodySurface(next));
            const ContactState state = model.state();
            EXPECT_TRUE(state.is_in_contact);
            EXPECT_NEAR(asideM(body, before, state.proxy), 0.0, kStillM);
            EXPECT_NEAR(test::bruteDistance(*listed, state.proxy), kRadiusM, kToleranceM);
            EXPECT_NEAR(test::windingNumber(*listed, state.proxy), 0.0, 1e-6);
            before = state.proxy;
        }
        // A free sphere is lifted only by ground that reaches it.
        const ScenePoint free = before + verticalAt(body, before).up * 10.0;
        model.update(free);
        model.setSurface(BodySurface(high));
        const ScenePoint after = model.state().proxy;
        EXPECT_NEAR(asideM(body, free, after), 0.0, kStillM);
        EXPECT_GE(test::bruteDistance(*listed_high, after), kRadiusM - kToleranceM);
        EXPECT_NEAR(test::windingNumber(*listed_high, after), 0.0, 1e-6);
        EXPECT_EQ(model.state().is_in_contact, !(after == free));
    }
}

INSTANTIATE_TEST_SUITE_P(VirtualProxy,
                         SphereOnBody,
                         testing::Values(Round{"Sphere", "IAU_2015:49900"},
                                         Round{"Ellipsoid", "IAU_2015:49901"},
                                         Round{"Oblate",
                                               "+proj=longlat +a=3396190 +b=2400000 +no_defs"}),
                         [](const auto& tested) { return tested.param.name; });

TEST(SphereOnLayers, IsPlacedOutsideTheGroundOnAndBesideTheUpperMap)
{
    const auto maps = test::meshesOf(test::nestedMaps({"FineInACell"}).front());
    JobMonitor monitor;
    const auto mesh = LayeredMesh::build(maps, monitor);
    ASSERT_TRUE(mesh) << mesh.error().message;
    const auto listed = TriangleMesh::build(test::listOf(**mesh), monitor);
    ASSERT_TRUE(listed) << listed.error().message;
    const LayeredSurface surface(*mesh);
    const double radius_m = 0.5 * test::cellOf(*maps[0]);
    test::Random random(21);
    for (int i = 0; i < 30; ++i) {
        const ScenePoint place = test::placeNear(*maps[0], random);
        const Vec3 up = verticalAt((*mesh)->ellipsoid(), place).up;
        const ScenePoint goal = place - up * (clearanceOver(surface, place) + radius_m);
        VirtualProxy<LayeredSurface> model(surface, radius_m);
        const ContactState state = model.place(goal);
        EXPECT_TRUE(state.is_in_contact);
        EXPECT_NEAR(test::bruteDistance(**listed, state.proxy), radius_m, kToleranceM);
        EXPECT_NEAR(test::windingNumber(**listed, state.proxy), 0.0, 1e-6);
        EXPECT_LT(length(state.proxy - goal), 20.0 * radius_m);
    }
}

} // namespace
} // namespace marsview
