#include "core/contact/contact_model.h"
#include "core/contact/layered_surface.h"
#include "tests/core/contact/nested_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

namespace marsview {
namespace {

std::shared_ptr<const LayeredMesh> layered(const std::vector<std::shared_ptr<const BodyMesh>>& maps)
{
    JobMonitor monitor;
    const auto mesh = LayeredMesh::build(maps, monitor);
    EXPECT_TRUE(mesh) << (mesh ? "" : mesh.error().message);
    return *mesh;
}

using LayeredCase = std::tuple<ContactModelKind, test::NestedMaps>;
class LayeredContact : public testing::TestWithParam<LayeredCase> {};

// The list of the same triangles has the contact that tests of meshes prove by brute force.
TEST_P(LayeredContact, ItsProxiesAreThoseOnAListOfTheSameTriangles)
{
    const auto& [kind, nested] = GetParam();
    const auto maps = test::meshesOf(nested);
    const auto mesh = layered(maps);
    EXPECT_GT(test::contactsAsOnList(mesh, *maps.front(), kind), 60);
}

INSTANTIATE_TEST_SUITE_P(
    LayeredSurface,
    LayeredContact,
    testing::Combine(
        testing::Values(ContactModelKind::ProxyGraph, ContactModelKind::ContinuousWalk),
        testing::ValuesIn(test::nestedMaps({"FineWithVoids", "FineInACell", "OverThePoleWithVoids",
                                            "TheSameHeightsWithVoids"}))),
    [](const auto& tested) {
        std::string name(contactModelName(std::get<0>(tested.param)));
        std::erase(name, '-');
        return name + std::get<1>(tested.param).name;
    });

// Level maps, one 200 m above the other: a stroke over the border and back meets that step.
class LevelSteps : public testing::Test {
protected:
    LevelSteps()
    {
        // Beside the middle of the eastern border, on the ellipsoid, so many meters outside.
        const BodyPositions& positions = maps_[0]->positions();
        border_ = positions.at(40, 16, 0.0);
        outward_ = normalized(border_ - positions.at(39, 16, 0.0));
        up_ = verticalAt(mesh_->ellipsoid(), border_).up;
    }
    ScenePoint at(double outside_m, double height_m) const
    {
        return border_ + outward_ * outside_m + up_ * height_m;
    }
    double outsideM(const ScenePoint& point) const { return dot(point - border_, outward_); }
    double heightM(const ScenePoint& point) const { return dot(point - border_, up_); }

    std::vector<std::shared_ptr<const BodyMesh>> maps_ = test::meshesOf(test::levelStep());
    std::shared_ptr<const LayeredMesh> mesh_ = layered(maps_);
    std::unique_ptr<ContactModel> model_ =
        makeContactModel(kContactModelDefault, LayeredSurface(mesh_));
    ScenePoint border_;
    Vec3 outward_;
    Vec3 up_;
};

TEST_F(LevelSteps, AWallStopsAProxyFromBelowAndPushesByItsWholeDepth)
{
    const double low_m = test::below(*mesh_, at(1.0, 0.0))->height_m;
    model_->place(at(500.0, 100.0));
    for (double outside_m = 500.0; outside_m >= -1000.0; outside_m -= 2.0) {
        const ScenePoint goal = at(outside_m, low_m - 30.0);
        const ContactState state = model_->update(goal);
        ASSERT_TRUE(state.is_in_contact);
        if (outside_m > 50.0) {
            // On the lower map, which is not quite level: its cells are flat.
            ASSERT_NEAR(outsideM(state.proxy), outside_m, 5.0);
            ASSERT_NEAR(heightM(state.proxy), low_m, 10.0);
        } else if (outside_m < -50.0) {
            // At the foot of the wall.
            // Along it the proxy follows a goal that is not aimed quite straight.
            ASSERT_NEAR(outsideM(state.proxy), 0.0, 0.5);
            ASSERT_NEAR(heightM(state.proxy), low_m, 0.1);
            ASSERT_NEAR(length(state.proxy - goal), std::hypot(outside_m, 30.0), 0.5);
        }
    }
}

TEST_F(LevelSteps, AProxyLeavesTheUpperMapAtItsBorderAndLandsOnTheLowerOne)
{
    const double low_m = test::below(*mesh_, at(1.0, 0.0))->height_m;
    const double high_m = test::below(*mesh_, at(-1.0, 0.0))->height_m;
    // The cells of both maps are flat: the lower one's lie further below the ellipsoid.
    EXPECT_NEAR(high_m, 200.0, 10.0);
    EXPECT_GT(high_m - low_m, 200.0);
    model_->place(at(-500.0, 300.0));
    for (double outside_m = -500.0; outside_m <= 100.0; outside_m += 2.0) {
        const ScenePoint goal = at(outside_m, high_m - 30.0);
        const ContactState state = model_->update(goal);
        if (outside_m < -10.0) {
            ASSERT_TRUE(state.is_in_contact);
            ASSERT_NEAR(heightM(state.proxy), high_m, 1.0);
        } else if (outside_m > 10.0) {
            ASSERT_FALSE(state.is_in_contact);
            ASSERT_EQ(length(state.proxy - goal), 0.0);
        }
    }
    const ScenePoint down = at(100.0, low_m - 30.0);
    const ContactState state = model_->update(down);
    ASSERT_TRUE(state.is_in_contact);
    EXPECT_NEAR(heightM(state.proxy), low_m, 2.0);
    // And up again along the wall: nothing to hold the proxy.
    EXPECT_FALSE(model_->update(at(5.0, high_m + 10.0)).is_in_contact);
    const ContactState back = model_->update(at(-100.0, high_m - 5.0));
    ASSERT_TRUE(back.is_in_contact);
    EXPECT_NEAR(heightM(back.proxy), high_m, 1.0);
}

TEST_F(LevelSteps, WhatLiesBelowChangesByTheStepAtTheBorder)
{
    const LayeredSurface surface(mesh_);
    const double over_high_m = clearanceOver(surface, at(-0.5, 1000.0));
    const double over_low_m = clearanceOver(surface, at(0.5, 1000.0));
    EXPECT_NEAR(1000.0 - over_high_m, test::below(*mesh_, at(-0.5, 0.0))->height_m, 1e-3);
    EXPECT_NEAR(1000.0 - over_low_m, test::below(*mesh_, at(0.5, 0.0))->height_m, 1e-3);
    EXPECT_GT(over_low_m - over_high_m, 200.0);
    EXPECT_FALSE(belowOn(surface, at(0.5, 1000.0)).is_beside);
}

} // namespace
} // namespace marsview
