// The stylus over whole scenes, moved as a mouse would move it.
#include "core/view/navigation.h"
#include "haptics/interaction/stylus.h"
#include "tests/support/fractal_terrain.h"
#include "tests/support/map_maker.h"
#include "tests/support/random.h"
#include "tests/support/shared_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace marsview {
namespace {

using test::MapMaker;

constexpr Viewport kViewport{900, 700};
constexpr std::array kExaggerations{0.2, 1.0, 4.0, 25.0, 200.0};

double reliefOf(const SceneSurface& ground)
{
    const SceneBox box = ground.box(1.0);
    return box.maximum.z - box.minimum.z;
}

// A sphere's center is above the terrain that it touches, and kept constraints may hold a
// god-object in the air.
bool restsOnGround(ContactModelKind model)
{
    return model != ContactModelKind::VirtualProxy && model != ContactModelKind::GodObject;
}

// The effect of a mouse and its camera on a stylus, and the invariants after every step.
class Hand {
public:
    Hand(const SceneSurface& ground, double exaggeration, ContactModelKind model)
        : ground_(ground)
        , exaggeration_(exaggeration)
    {
        stylus_.setModel(model);
        stylus_.setGround(ground_, exaggeration_);
        look();
    }

    void look()
    {
        camera_ = homeCamera(ground_.box(exaggeration_), kViewport);
        camera_.target = ground_.box(exaggeration_).center();
        camera_.azimuth = Angle::degrees(random_.uniform(-180.0, 180.0));
        camera_.tilt = Angle::degrees(random_.uniform(0.0, 80.0));
        camera_.distance_m *= std::exp(random_.uniform(-4.0, 0.0));
    }
    void movePointer()
    {
        if (random_.chance(0.02)) {
            pixel_ = {random_.uniform(0.0, 900.0), random_.uniform(0.0, 700.0)};
            return;
        }
        const double step = random_.chance(0.5) ? 2.0 : 40.0;
        pixel_.x = std::clamp(pixel_.x + random_.uniform(-step, step), 0.0, 900.0);
        pixel_.y = std::clamp(pixel_.y + random_.uniform(-step, step), 0.0, 700.0);
    }
    // True if the pointer was over terrain.
    bool aim()
    {
        const Ray ray = pickRay(camera_, kViewport, pixel_);
        const auto at = ground_.cast(ray, exaggeration_);
        if (!at) {
            return false;
        }
        const double depth_m =
            dot(ray.at(at->distance_m) - eyeOf(camera_), axesOf(camera_).forward);
        const double point_m =
            2.0 * depth_m * std::tan(camera_.field_of_view.radians() / 2.0) / kViewport.height;
        const auto before = stylus_.pose();
        stylus_.aim(*at, buttons_, point_m);
        follow(before);
        if (mode_ == StylusMode::Press || mode_ == StylusMode::Hover) {
            at_ = *at;
            point_m_ = point_m;
            aimed_depth_points_ = depth_points_;
        }
        return true;
    }
    void doSomething()
    {
        switch (random_.below(12)) {
        case 0:
            buttons_.is_pressing = !buttons_.is_pressing;
            break;
        case 1:
            if (random_.chance(0.3)) {
                buttons_.is_grabbing = !buttons_.is_grabbing;
            }
            break;
        case 2:
            stretch(kExaggerations[random_.below(kExaggerations.size())]);
            break;
        case 3:
            turnWheel(std::pow(1.15, random_.uniform(-5.0, 5.0)));
            break;
        case 4:
            if (random_.chance(0.2)) {
                look();
            }
            break;
        case 5:
            if (random_.chance(0.1)) {
                stylus_.lift();
                is_lifted_ = true;
                mode_ = StylusMode::Hover;
            }
            break;
        default:
            movePointer();
        }
        if (aim()) {
            ++aims_;
        } else if (random_.chance(0.1)) {
            look();
        }
        expectAllIsWell();
    }

    void turnWheel(double factor)
    {
        stylus_.deepen(factor);
        depth_points_ = std::clamp(depth_points_ * factor, kStylusDepthMin, kStylusDepthMax);
    }

    // Changes the exaggeration without moving anything else.
    void stretch(double exaggeration)
    {
        const auto before = stylus_.pose();
        const double factor = exaggeration / exaggeration_;
        exaggeration_ = exaggeration;
        stylus_.setGround(ground_, exaggeration_);
        const auto& after = stylus_.pose();
        ASSERT_EQ(before.has_value(), after.has_value());
        if (!before) {
            return;
        }
        aimed_depth_points_ = depth_points_;
        EXPECT_EQ(after->mode, before->mode);
        EXPECT_EQ(after->is_in_contact, before->is_in_contact);
        const double slack = 1e-9 * ground_.box(1.0).extent_m();
        EXPECT_NEAR(after->proxy.x, before->proxy.x, slack);
        EXPECT_NEAR(after->proxy.y, before->proxy.y, slack);
        EXPECT_NEAR(after->goal.x, before->goal.x, slack);
        EXPECT_NEAR(after->goal.y, before->goal.y, slack);
        if (before->is_in_contact && restsOnGround(stylus_.model())) {
            EXPECT_NEAR(after->proxy.z, before->proxy.z * factor,
                        1e-9 * std::abs(after->proxy.z) + slack);
        }
        expectAllIsWell();
    }

    // Changes the contact model without moving anything else.
    void changeModel(ContactModelKind model)
    {
        const auto before = stylus_.pose();
        stylus_.setModel(model);
        const auto& after = stylus_.pose();
        ASSERT_EQ(stylus_.model(), model);
        ASSERT_EQ(before.has_value(), after.has_value());
        if (!before) {
            return;
        }
        EXPECT_EQ(after->mode, before->mode);
        EXPECT_EQ(after->is_in_contact, before->is_in_contact);
        EXPECT_EQ(after->goal, before->goal);
        if (before->is_in_contact) {
            ++changes_in_contact_;
        }
        expectAllIsWell();
    }
    int changesInContact() const { return changes_in_contact_; }

    void expectAllIsWell() const
    {
        const auto& pose = stylus_.pose();
        if (!pose) {
            return;
        }
        ASSERT_EQ(pose->mode, mode_);
        ASSERT_TRUE(std::isfinite(pose->proxy.x) && std::isfinite(pose->proxy.y) &&
                    std::isfinite(pose->proxy.z));
        if (mode_ == StylusMode::Press || mode_ == StylusMode::Hover) {
            if (mode_ == StylusMode::Press && stylus_.model() == ContactModelKind::ProxyGraph2003) {
                // The published model begins every update at a vertex, up to a cell away. Where
                // that lies on another map, there is no touch at all.
                releases_ += pose->is_in_contact ? 0 : 1;
            } else {
                ASSERT_EQ(pose->is_in_contact, mode_ == StylusMode::Press);
            }
            // Depth and height are those of the goal.
            const ScenePoint ground =
                ground_.maps()[at_.index].frame.toScene(at_.grid, at_.height_m * exaggeration_);
            const double up = (pose->goal.z - ground.z) / point_m_;
            const double rounding = 1e-12 * (1.0 + std::abs(ground.z) / point_m_);
            ASSERT_NEAR(
                up, mode_ == StylusMode::Press ? -aimed_depth_points_ : StylusReach{}.hover_points,
                1e-9 + 1e3 * rounding);
        }
        const double tolerance_m =
            1e-6 * reliefOf(ground_) * exaggeration_ + 1e-12 * std::abs(pose->proxy.z);
        const double ground_m = ground_.height(pose->proxy.x, pose->proxy.y) * exaggeration_;
        if (std::isfinite(ground_m)) {
            ASSERT_GE(pose->proxy.z, ground_m - tolerance_m) << "below the surface";
            if (pose->is_in_contact && restsOnGround(stylus_.model())) {
                ASSERT_LE(pose->proxy.z, ground_m + tolerance_m) << "in contact without a surface";
            }
        }
        ASSERT_LE(length(pose->force_n), kForceNMax * (1.0 + 1e-12));
        if (!pose->is_in_contact) {
            ASSERT_EQ(length(pose->force_n), 0.0);
        }
    }

    int aims() const { return aims_; }
    /// Inputs that pressed the stylus and left it without contact.
    int releases() const { return releases_; }

private:
    // The rules in words: a grab that starts in contact is a pan, otherwise a zoom; without a grab
    // the button decides.
    void follow(const std::optional<StylusPose>& before)
    {
        const bool was_grabbed = mode_ == StylusMode::Pan || mode_ == StylusMode::Zoom;
        if (is_lifted_ || !buttons_.is_grabbing || !was_grabbed) {
            const bool was_touching =
                before && before->is_in_contact && mode_ == StylusMode::Press && !is_lifted_;
            mode_ = buttons_.is_grabbing
                        ? (was_touching ? StylusMode::Pan : StylusMode::Zoom)
                        : (buttons_.is_pressing ? StylusMode::Press : StylusMode::Hover);
        }
        if (before && (mode_ == StylusMode::Pan || mode_ == StylusMode::Zoom)) {
            EXPECT_EQ(stylus_.pose()->proxy, before->proxy) << "held while grabbed";
            EXPECT_EQ(stylus_.pose()->goal, before->goal);
        }
        is_lifted_ = false;
    }

    test::Random random_;
    SceneSurface ground_;
    double exaggeration_;
    Stylus stylus_;
    OrbitCamera camera_;
    PixelPoint pixel_{450.0, 350.0};
    StylusButtons buttons_;
    StylusMode mode_ = StylusMode::Hover;
    GroundPoint at_;
    double point_m_ = 1.0;
    double depth_points_ = StylusReach{}.depth_points;
    double aimed_depth_points_ = depth_points_; // the wheel takes effect at the next aim
    bool is_lifted_ = true;
    int aims_ = 0;
    int changes_in_contact_ = 0;
    mutable int releases_ = 0;
};

// One scene each, created on first use.
SceneSurface scene(const std::string& name)
{
    MapMaker maker;
    const auto single = [&](const MapMaker::Height& height) {
        return SceneSurface({maker.make({.columns = 61, .rows = 47}, height)});
    };
    const auto at = [](std::size_t i) { return static_cast<double>(i); };
    if (name == "Flat") {
        return single([](std::size_t, std::size_t) { return 1234.5; });
    }
    if (name == "Plane") {
        return single([&](std::size_t c, std::size_t r) { return 20.0 * at(c) - 7.0 * at(r); });
    }
    if (name == "Fractal") {
        const std::vector<float> heights = test::fractalHeights(61, 47, 3);
        return single([&](std::size_t c, std::size_t r) {
            return 30.0 * static_cast<double>(heights[r * 61 + c]);
        });
    }
    if (name == "Cliffs") {
        return single(
            [&](std::size_t c, std::size_t r) { return c % 9 < 4 ? 900.0 : 3.0 * at(r); });
    }
    if (name == "Needles") {
        return single(
            [](std::size_t c, std::size_t r) { return c % 3 == 1 && r % 3 == 1 ? 700.0 : -100.0; });
    }
    if (name == "Voids") {
        return single([&](std::size_t c, std::size_t r) {
            return std::hypot(at(c) - 30.0, at(r) - 20.0) < 9.0 || (c * r) % 17 == 5
                       ? std::nan("")
                       : 400.0 * std::sin(at(c) / 5.0) + 30.0 * at(r);
        });
    }
    if (name == "Layers") {
        // A holed map over a finer one at another height, turned, over one that reaches beyond.
        const std::shared_ptr<const Map> top =
            maker.make({.columns = 31, .rows = 25}, [&](std::size_t c, std::size_t r) {
                return std::hypot(at(c) - 12.0, at(r) - 12.0) < 6.0
                           ? std::nan("")
                           : 500.0 + 90.0 * std::sin(at(c));
            });
        const std::shared_ptr<const Map> middle = maker.make(
            {.columns = 70, .rows = 70, .transform = {500100.0, 9.0, 4.0, 3999900.0, 4.0, -9.0}},
            [&](std::size_t c, std::size_t r) {
                return 900.0 + 150.0 * std::cos(at(c) / 6.0) * std::sin(at(r) / 5.0);
            });
        const std::shared_ptr<const Map> bottom = maker.make(
            {.columns = 40, .rows = 40, .transform = {499000.0, 70.0, 0.0, 4000700.0, 0.0, -70.0}},
            [&](std::size_t c, std::size_t r) {
                return 300.0 * std::sin(at(c * 3 + r)) + 40.0 * at(r);
            });
        return SceneSurface({top, middle, bottom});
    }
    return SceneSurface({test::loadedMap((test::bundledSamples() / name).string())});
}

// GoogleTest accepts letters, digits and underscores.
std::string testName(ContactModelKind model)
{
    std::string name(contactModelName(model));
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

using SceneAndModel = std::tuple<std::string, ContactModelKind>;

class StylusWalk : public testing::TestWithParam<SceneAndModel> {};

TEST_P(StylusWalk, StaysOnTheGroundThroughAnythingAMouseDoes)
{
    constexpr int kInputs = 30000;
    const auto& [name, model] = GetParam();
    const SceneSurface ground = scene(name);
    Hand hand(ground, 1.0, model);
    for (int i = 0; i < kInputs; ++i) {
        hand.doSomething();
        if (HasFailure()) {
            FAIL() << "input " << i;
        }
    }
    std::printf("%d of %d inputs over ground\n", hand.aims(), kInputs);
    EXPECT_GT(hand.aims(), kInputs / 8);
    EXPECT_LE(hand.releases(), kInputs / 3000);
}

INSTANTIATE_TEST_SUITE_P(Scenes,
                         StylusWalk,
                         testing::Combine(testing::Values("Flat",
                                                          "Plane",
                                                          "Fractal",
                                                          "Cliffs",
                                                          "Needles",
                                                          "Voids",
                                                          "Layers",
                                                          "mars_mola_4ppd.tif",
                                                          "mount_st_helens_30m.tif"),
                                          testing::ValuesIn(kContactModelKinds)),
                         [](const auto& walk) {
                             const std::string name = std::get<0>(walk.param);
                             return name.substr(0, name.find('_')) + "_" +
                                    testName(std::get<1>(walk.param));
                         });

// Switches between all models, whatever the stylus is doing.
TEST(Stylus, KeepsContactWhenItsModelChanges)
{
    constexpr int kInputs = 20000;
    for (const char* name : {"Fractal", "Cliffs", "Needles", "Layers"}) {
        SCOPED_TRACE(name);
        test::Random random;
        Hand hand(scene(name), 1.0, kContactModelDefault);
        for (int i = 0; i < kInputs; ++i) {
            hand.doSomething();
            if (random.chance(0.2)) {
                hand.changeModel(kContactModelKinds[random.below(kContactModelKinds.size())]);
            }
            if (::testing::Test::HasFailure()) {
                FAIL() << "input " << i;
            }
        }
        std::printf("%s: %d changes in contact\n", name, hand.changesInContact());
        EXPECT_GT(hand.changesInContact(), kInputs / 100);
    }
}

TEST(Stylus, IsLiftedUntilItIsAimed)
{
    Stylus stylus;
    EXPECT_FALSE(stylus.pose());
    stylus.setGround(scene("Plane"), 2.0);
    EXPECT_FALSE(stylus.pose());
    stylus.deepen(2.0);
    stylus.lift();
    EXPECT_FALSE(stylus.pose());
}

TEST(Stylus, IsLiftedByAnotherGround)
{
    Stylus stylus;
    stylus.setGround(scene("Plane"), 1.0);
    for (const SceneSurface& other : {scene("Plane"), SceneSurface()}) {
        stylus.setGround(scene("Flat"), 1.0);
        stylus.aim({.index = 0, .grid = {5.0, 7.0}, .height_m = 1234.5}, {.is_pressing = true},
                   1.0);
        ASSERT_TRUE(stylus.pose());
        stylus.setGround(other, 1.0);
        EXPECT_FALSE(stylus.pose());
    }
}

class StylusModel : public testing::TestWithParam<ContactModelKind> {};

// For every model: a proxy stopped by a wall stays on its side of the wall when the model changes.
TEST_P(StylusModel, StaysWhereItIsWhenTheModelBecomesAnother)
{
    MapMaker maker;
    const SceneSurface ground({maker.make({}, [](std::size_t c, std::size_t) {
        return c == 10 ? 5000.0 : 10.0 * static_cast<double>(c);
    })});
    const SceneFrame& frame = ground.maps()[0].frame;
    const auto at = [](double column) {
        return GroundPoint{.index = 0, .grid = {column, 7.2}, .height_m = 10.0 * column};
    };
    for (const ContactModelKind other : kContactModelKinds) {
        SCOPED_TRACE(contactModelName(other));
        Stylus stylus;
        stylus.setModel(GetParam());
        stylus.setGround(ground, 1.0);
        for (const double column : {15.0, 13.0, 11.0, 9.0, 7.0, 5.0}) {
            stylus.aim(at(column), {.is_pressing = true}, 0.1);
        }
        const StylusPose before = *stylus.pose();
        ASSERT_GT(frame.toGrid(before.proxy).column, 9.9);
        stylus.setModel(other);
        const StylusPose after = *stylus.pose();
        EXPECT_EQ(stylus.model(), other);
        EXPECT_TRUE(after.is_in_contact);
        EXPECT_EQ(after.mode, StylusMode::Press);
        EXPECT_EQ(after.goal, before.goal);
        const bool is_sphere =
            GetParam() == ContactModelKind::VirtualProxy || other == ContactModelKind::VirtualProxy;
        EXPECT_GT(frame.toGrid(after.proxy).column, 9.9) << "the wall is still in the way";
        if (!is_sphere) {
            EXPECT_LT(length(after.proxy - before.proxy), 1e-3);
        }
        // And it continues from there.
        stylus.aim(at(16.0), {.is_pressing = true}, 0.1);
        EXPECT_TRUE(stylus.pose()->is_in_contact);
    }
}

TEST_P(StylusModel, KeepsItsPlaceOnTheMapWhenHeightsAreStretched)
{
    const SceneSurface ground = scene("Fractal");
    test::Random random;
    Stylus stylus;
    stylus.setModel(GetParam());
    stylus.setGround(ground, 1.0);
    for (int i = 0; i < 300; ++i) {
        const GridPoint grid{random.uniform(1.0, 59.0), random.uniform(1.0, 45.0)};
        const ScenePoint place = ground.maps()[0].frame.toScene(grid, 0.0);
        stylus.aim({.index = 0, .grid = grid, .height_m = ground.height(place.x, place.y)},
                   {.is_pressing = true}, random.uniform(0.1, 5.0));
        const StylusPose before = *stylus.pose();
        const double exaggeration = kExaggerations[random.below(kExaggerations.size())];
        stylus.setGround(ground, exaggeration);
        const StylusPose after = *stylus.pose();
        ASSERT_TRUE(after.is_in_contact);
        const double slack = 1e-9 * ground.box(1.0).extent_m();
        EXPECT_NEAR(after.proxy.x, before.proxy.x, slack);
        EXPECT_NEAR(after.proxy.y, before.proxy.y, slack);
        EXPECT_GE(after.proxy.z, ground.height(after.proxy.x, after.proxy.y) * exaggeration - 1e-6);
        if (HasFailure()) {
            FAIL() << "input " << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Models,
                         StylusModel,
                         testing::ValuesIn(kContactModelKinds),
                         [](const auto& model) { return testName(model.param); });

TEST(Stylus, ChangesItsModelWhileItIsLiftedOrHovers)
{
    Stylus stylus;
    EXPECT_EQ(stylus.model(), kContactModelDefault);
    stylus.setModel(ContactModelKind::SurfaceWalk);
    EXPECT_EQ(stylus.model(), ContactModelKind::SurfaceWalk);
    EXPECT_FALSE(stylus.pose());
    stylus.setGround(scene("Flat"), 1.0);
    stylus.aim({.index = 0, .grid = {5.0, 7.0}, .height_m = 1234.5}, {}, 1.0);
    const ScenePoint proxy = stylus.pose()->proxy;
    stylus.setModel(ContactModelKind::ProxyGraph);
    EXPECT_EQ(stylus.pose()->mode, StylusMode::Hover);
    EXPECT_FALSE(stylus.pose()->is_in_contact);
    EXPECT_EQ(stylus.pose()->proxy, proxy);
}

// Hovers from one side of a wall to the other, and releases the button behind one.
TEST(Stylus, IsCaughtByNoRidgeWhileItHovers)
{
    MapMaker maker;
    const SceneSurface ground(
        {maker.make({}, [](std::size_t c, std::size_t) { return c == 10 ? 5000.0 : 0.0; })});
    const auto at = [](double column) {
        return GroundPoint{.index = 0, .grid = {column, 7.0}, .height_m = 0.0, .distance_m = 1.0};
    };
    Stylus stylus;
    stylus.setGround(ground, 1.0);
    stylus.aim(at(5.0), {}, 0.1);
    stylus.aim(at(15.0), {}, 0.1);
    EXPECT_FALSE(stylus.pose()->is_in_contact);
    EXPECT_EQ(stylus.pose()->proxy, stylus.pose()->goal);
    stylus.aim(at(15.0), {.is_pressing = true}, 0.1);
    stylus.aim(at(5.0), {.is_pressing = true}, 0.1);
    EXPECT_GT(ground.maps()[0].frame.toGrid(stylus.pose()->proxy).column, 9.0)
        << "while the button is pressed, the wall is in the way";
    stylus.aim(at(5.0), {}, 0.1);
    EXPECT_FALSE(stylus.pose()->is_in_contact);
}

TEST(Stylus, MeetsTheGroundRightBelowWhereItIsPressedFirst)
{
    MapMaker maker;
    const SceneSurface ground(
        {maker.make({}, [](std::size_t c, std::size_t) { return c == 10 ? 5000.0 : 0.0; })});
    Stylus stylus;
    stylus.setGround(ground, 1.0);
    // As on a touch screen: the previous pointer position was behind the wall.
    stylus.aim({.index = 0, .grid = {5.0, 7.0}}, {}, 0.1);
    stylus.aim({.index = 0, .grid = {15.5, 7.25}}, {.is_pressing = true}, 0.1);
    const GridPoint grid = ground.maps()[0].frame.toGrid(stylus.pose()->proxy);
    EXPECT_NEAR(grid.column, 15.5, 1e-9);
    EXPECT_NEAR(grid.row, 7.25, 1e-9);
    EXPECT_NEAR(stylus.pose()->proxy.z, 0.0, 1e-9);
    // 30 points of 0.2 mm at 300 N/m.
    EXPECT_NEAR(stylus.pose()->force_n.z, 30.0 * 2e-4 * 300.0, 1e-9);
}

TEST(Stylus, PressesAsDeepAsTheWheelSets)
{
    const SceneSurface ground = scene("Flat");
    Stylus stylus;
    stylus.setGround(ground, 1.0);
    const GroundPoint at{.index = 0, .grid = {20.0, 20.0}, .height_m = 1234.5};
    const auto depth = [&] {
        stylus.aim(at, {.is_pressing = true}, 0.5);
        return (stylus.pose()->proxy.z - stylus.pose()->goal.z) / 0.5;
    };
    EXPECT_NEAR(depth(), 30.0, 1e-9);
    stylus.deepen(1.5);
    EXPECT_NEAR(depth(), 45.0, 1e-9);
    stylus.deepen(1e9);
    EXPECT_NEAR(depth(), kStylusDepthMax, 1e-9);
    stylus.deepen(1e-9);
    EXPECT_NEAR(depth(), kStylusDepthMin, 1e-9);
}

// From an upper map across its edge onto a lower one, and back, with the button down.
TEST(Stylus, StepsFromMapToMapWhilePressed)
{
    const SceneSurface ground = scene("Layers");
    Stylus stylus;
    const double exaggeration = 3.0;
    stylus.setGround(ground, exaggeration);
    std::map<std::size_t, int> visits;
    const SceneBox box = ground.box(exaggeration);
    for (int line = 0; line < 40; ++line) {
        for (int step = 0; step <= 400; ++step) {
            const double x = box.minimum.x + (box.maximum.x - box.minimum.x) * step / 400.0;
            const double y = box.minimum.y + (box.maximum.y - box.minimum.y) * line / 40.0;
            const auto at =
                ground.cast({.origin = {x, y, 1e6}, .direction = {0.0, 0.0, -1.0}}, exaggeration);
            if (!at) {
                continue;
            }
            stylus.aim(*at, {.is_pressing = true}, 1.0 + line % 5 * 4.0);
            const StylusPose& pose = *stylus.pose();
            ASSERT_TRUE(pose.is_in_contact);
            ++visits[at->index];
            const double ground_m = ground.height(pose.proxy.x, pose.proxy.y) * exaggeration;
            if (std::isfinite(ground_m)) {
                ASSERT_NEAR(pose.proxy.z, ground_m, 1e-6 * reliefOf(ground) * exaggeration);
            }
        }
    }
    EXPECT_GT(visits[0], 500);
    EXPECT_GT(visits[1], 200);
    EXPECT_GT(visits[2], 500);
}

} // namespace
} // namespace marsview
