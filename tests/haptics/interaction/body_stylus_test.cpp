#include "core/contact/body_surface.h"
#include "core/globe/body_camera.h"
#include "haptics/interaction/body_stylus.h"
#include "tests/core/contact/body_maps.h"
#include "tests/core/contact/nested_maps.h"

#include <gtest/gtest.h>

#include <cmath>

namespace marsview {
namespace {

constexpr double kPointM = 2e4;

class BodyStylusTest : public testing::Test {
protected:
    void SetUp() override
    {
        mesh_ = test::bodyMesh(test::wholeMars(120, 60), 2.0);
        stylus_.setGround({{.mesh = mesh_, .radius_m = 1e4}}, {});
    }
    const Ellipsoid& body() const { return mesh_->positions().ellipsoid(); }
    // The terrain along the vertical of a place.
    BodyAim aimAt(double longitude_deg, double latitude_deg) const
    {
        const BodyCamera place{.target = {.longitude = Angle::degrees(longitude_deg),
                                          .latitude = Angle::degrees(latitude_deg)},
                               .height_m = -1e5};
        const Vec3 up = localAxes(body(), place.target).up;
        const auto model =
            makeContactModel(kContactModelDefault, BodySurface(mesh_), ContactModelOptions{});
        // A proxy placed from below is straight above.
        const ScenePoint below = targetOf(place, body());
        const ContactState state = model->place(below);
        return {.index = 0, .point = below + up * dot(state.proxy - below, up), .up = up};
    }

    std::shared_ptr<const BodyMesh> mesh_;
    BodyStylus stylus_;
};

TEST_F(BodyStylusTest, HoversAlongTheVerticalAndPressesAgainstIt)
{
    const BodyAim at = aimAt(20.0, 50.0);
    stylus_.aim(at, {}, kPointM);
    ASSERT_TRUE(stylus_.pose());
    EXPECT_EQ(stylus_.pose()->mode, StylusMode::Hover);
    EXPECT_FALSE(stylus_.pose()->is_in_contact);
    EXPECT_NEAR(length(stylus_.pose()->proxy - (at.point + at.up * (26.0 * kPointM))), 0.0, 1e-3);
    stylus_.aim(at, {.is_pressing = true}, kPointM);
    EXPECT_EQ(stylus_.pose()->mode, StylusMode::Press);
    EXPECT_TRUE(stylus_.pose()->is_in_contact);
    EXPECT_NEAR(length(stylus_.pose()->goal - (at.point - at.up * (30.0 * kPointM))), 0.0, 1e-3);
    EXPECT_GT(dot(stylus_.pose()->force_n, at.up), 0.5 * length(stylus_.pose()->force_n));
    stylus_.aim(at, {}, kPointM);
    EXPECT_FALSE(stylus_.pose()->is_in_contact);
    EXPECT_EQ(length(stylus_.pose()->force_n), 0.0);
    stylus_.lift();
    EXPECT_FALSE(stylus_.pose());
}

TEST_F(BodyStylusTest, StrokesOverTheSeamAndOverThePoleWithoutAJump)
{
    const auto stroke = [&](auto aim_of) {
        std::optional<ScenePoint> last;
        for (int i = 0; i <= 400; ++i) {
            stylus_.aim(aim_of(i), {.is_pressing = true}, kPointM);
            ASSERT_TRUE(stylus_.pose()->is_in_contact) << i;
            const ScenePoint proxy = stylus_.pose()->proxy;
            // A tenth of a degree on Mars is 6 km; the proxy of a deep goal is pulled along ridges.
            EXPECT_LT(last ? length(proxy - *last) : 0.0, 4e5) << i;
            last = proxy;
        }
    };
    stroke([&](int i) { return aimAt(340.0 + 0.1 * i, 10.0); });
    stylus_.lift();
    stroke([&](int i) {
        const double latitude = 70.0 + 0.1 * i;
        return latitude <= 90.0 ? aimAt(30.0, latitude) : aimAt(210.0, 180.0 - latitude);
    });
}

TEST_F(BodyStylusTest, WithoutASurfaceItHoversAlone)
{
    const BodyAim at = aimAt(20.0, 50.0);
    stylus_.setGround({}, {});
    stylus_.aim(at, {.is_pressing = true}, kPointM);
    EXPECT_FALSE(stylus_.pose()->is_in_contact);
    EXPECT_EQ(length(stylus_.pose()->proxy - at.point), 0.0);
}

TEST_F(BodyStylusTest, IsNotPressedWhereAnotherSurfaceIsTheTerrain)
{
    const BodyAim at = aimAt(20.0, 50.0);
    const auto proxyAt = [&](double share) {
        return makeContactModel(kContactModelDefault, BodySurface(mesh_), ContactModelOptions{})
            ->place(at.point - at.up * (30.0 * kPointM * share))
            .proxy;
    };
    // Farther than this the full depth and half of it would lead.
    const double reach_m = 0.9 * length(proxyAt(0.5) - at.point);
    ASSERT_GT(reach_m, 1.0);
    ASSERT_GT(length(proxyAt(1.0) - at.point), reach_m);
    stylus_.setGround({{.mesh = mesh_, .radius_m = 1e4}},
                      [&](const ScenePoint& point) -> std::optional<std::size_t> {
                          return length(point - at.point) < reach_m ? 0U : 1U;
                      });
    stylus_.aim(at, {.is_pressing = true}, kPointM);
    // It is pressed as deep as that allows, by halves.
    double share = 0.25;
    while (share > 1e-3 && length(proxyAt(share) - at.point) >= reach_m) {
        share *= 0.5;
    }
    ASSERT_LT(length(proxyAt(share) - at.point), reach_m);
    EXPECT_NEAR(length(stylus_.pose()->proxy - proxyAt(share)), 0.0, 1e-3);
}

TEST_F(BodyStylusTest, AGrabHoldsWhatItGrabbed)
{
    const BodyAim at = aimAt(20.0, 50.0);
    const BodyAim beside = aimAt(25.0, 50.0);
    stylus_.aim(at, {.is_grabbing = true}, kPointM);
    EXPECT_EQ(stylus_.pose()->mode, StylusMode::Zoom); // in free space
    const ScenePoint hovering = stylus_.pose()->goal;
    stylus_.aim(beside, {.is_grabbing = true}, kPointM);
    EXPECT_EQ(stylus_.pose()->goal, hovering);
    stylus_.lift();
    stylus_.aim(at, {.is_pressing = true}, kPointM);
    const StylusPose pressed = *stylus_.pose();
    stylus_.aim(beside, {.is_pressing = true, .is_grabbing = true}, kPointM);
    EXPECT_EQ(stylus_.pose()->mode, StylusMode::Pan);
    EXPECT_EQ(stylus_.pose()->goal, pressed.goal);
    EXPECT_EQ(stylus_.pose()->proxy, pressed.proxy);
}

TEST_F(BodyStylusTest, PressesDeeperWithinBounds)
{
    const BodyAim at = aimAt(20.0, 50.0);
    const auto depth = [&] {
        stylus_.aim(at, {.is_pressing = true}, kPointM);
        return length(stylus_.pose()->goal - at.point) / kPointM;
    };
    stylus_.deepen(1.2);
    EXPECT_NEAR(depth(), 36.0, 1e-6);
    stylus_.deepen(1e9);
    EXPECT_NEAR(depth(), kStylusDepthMax, 1e-6);
    stylus_.deepen(1e-9);
    EXPECT_NEAR(depth(), kStylusDepthMin, 1e-6);
}

// A proxy that stayed with the first surface would lie below the second.
TEST_F(BodyStylusTest, PressesTheSurfaceThatItIsAimedAt)
{
    const auto higher = test::bodyMesh(test::wholeMars(120, 60), 4.0);
    stylus_.setGround({{.mesh = mesh_}, {.mesh = higher}}, {});
    BodyAim at = aimAt(20.0, 50.0);
    stylus_.aim(at, {.is_pressing = true}, kPointM);
    const ScenePoint first = stylus_.pose()->proxy;
    at.index = 1;
    stylus_.aim(at, {.is_pressing = true}, kPointM);
    const auto model =
        makeContactModel(kContactModelDefault, BodySurface(higher), ContactModelOptions{});
    const ScenePoint second = model->place(stylus_.pose()->goal).proxy;
    EXPECT_GT(length(second - first), 100.0);
    EXPECT_NEAR(length(stylus_.pose()->proxy - second), 0.0, 1e-3);
}

TEST_F(BodyStylusTest, AnotherModelContinuesFromTheProxy)
{
    const BodyAim at = aimAt(-60.0, -20.0);
    stylus_.aim(at, {.is_pressing = true}, kPointM);
    const ScenePoint before = stylus_.pose()->proxy;
    stylus_.setModel(ContactModelKind::SurfaceWalk);
    EXPECT_EQ(stylus_.model(), ContactModelKind::SurfaceWalk);
    EXPECT_LT(length(stylus_.pose()->proxy - before), 1.0);
    // The center of a sphere on the surface is its radius away from every point of it.
    stylus_.setModel(ContactModelKind::VirtualProxy);
    EXPECT_GT(length(stylus_.pose()->proxy - before), 1e4 - 1.0);
}

// Joined, two maps are one surface: over the border a proxy rests on what lies uppermost.
TEST(BodyStylusOnJoinedMaps, PressesBothMapsOnOneSurface)
{
    const auto maps = test::meshesOf(test::levelStep());
    JobMonitor monitor;
    const auto joined = LayeredMesh::build(maps, monitor);
    ASSERT_TRUE(joined) << joined.error().message;
    BodyStylus stylus;
    const BodyPositions& upper = maps[0]->positions();
    const auto is_inside = [&upper](const ScenePoint& point) {
        return dot(point - upper.at(40, 16, 0.0), upper.at(40, 16, 0.0) - upper.at(0, 16, 0.0)) <
               0.0;
    };
    stylus.setGround({{.mesh = maps[0], .joined = *joined}, {.mesh = maps[1], .joined = *joined}},
                     [&](const ScenePoint& point) -> std::optional<std::size_t> {
                         return is_inside(point) ? 0U : 1U;
                     });
    // Along a row of the upper map and beyond its border.
    for (int i = -20; i <= 20; ++i) {
        const ScenePoint place = upper.at(40, 16, 0.0) +
                                 (upper.at(40, 16, 0.0) - upper.at(39, 16, 0.0)) * (0.1 * i + 0.05);
        const BodyVertical vertical = verticalAt((*joined)->ellipsoid(), place);
        const auto ground = test::below(**joined, place - vertical.up * vertical.height_m);
        ASSERT_TRUE(ground);
        const ScenePoint point = place + vertical.up * (ground->height_m - vertical.height_m);
        stylus.aim({.index = i < 0 ? 0U : 1U, .point = point, .up = vertical.up},
                   {.is_pressing = true}, 0.1); // by 3 m
        ASSERT_TRUE(stylus.pose()->is_in_contact) << i;
        // Both maps are level, apart from their curvature.
        EXPECT_LT(length(stylus.pose()->proxy - point), 0.1) << i;
    }
}

} // namespace
} // namespace marsview
