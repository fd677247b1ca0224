#include "tests/support/random.h"
#include "ui/drawing/dot_index.h"
#include "ui/drawing/drawn_dots.h"
#include "ui/drawing/handle_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace marsview {
namespace {

constexpr Viewport kViewport{.width = 1280, .height = 800};
constexpr double kScale = 1.25; // pixels per point
constexpr double kExaggeration = 3.0;
const QRectF kArea(0.0, 0.0, 1280.0 / kScale, 800.0 / kScale);

std::vector<DotIndex::Dot> someDots(test::Random& random, std::uint32_t count)
{
    std::vector<DotIndex::Dot> dots;
    for (std::uint32_t id = 1; id <= count; ++id) {
        dots.push_back({.id = id,
                        .place = {random.uniform(-1e5, 1e5), random.uniform(-5e4, 5e4),
                                  random.uniform(-2e3, 2e3)}});
    }
    return dots;
}

OrbitCamera someCamera(test::Random& random)
{
    return {.target = {random.uniform(-8e4, 8e4), random.uniform(-4e4, 4e4), 0.0},
            .distance_m = std::pow(10.0, random.uniform(3.5, 5.5)),
            .azimuth = Angle::degrees(random.uniform(0.0, 360.0)),
            .tilt = Angle::degrees(random.uniform(0.0, 85.0))};
}

// By the camera's own projection.
std::optional<QPointF> placeOf(const DotIndex::Dot& dot, const OrbitCamera& camera)
{
    const auto pixel =
        project(camera, kViewport, {dot.place.x, dot.place.y, dot.place.z * kExaggeration});
    return pixel ? std::optional(QPointF(pixel->x, pixel->y) / kScale) : std::nullopt;
}

// A point, or a line where it has two vertices.
struct Thing {
    std::uint32_t id = 0;
    std::vector<DrawnVertex> vertices;

    bool operator==(const Thing&) const = default;
    bool isSingle() const { return vertices.size() == 1; }
};

Thing someThing(std::uint32_t id, test::Random& random)
{
    Thing thing{.id = id, .vertices = {}};
    for (int i = random.chance(0.1) ? 2 : 1; i > 0; --i) {
        thing.vertices.emplace_back(MapPoint{random.uniform(-1e5, 1e5), random.uniform(-5e4, 5e4)});
    }
    return thing;
}

// Nothing is shown in the west.
std::optional<ScenePoint> shownPlaceOf(const Thing& thing)
{
    const auto& point = std::get<MapPoint>(thing.vertices.front());
    return point.x > -5e4 ? std::optional(ScenePoint{point.x, point.y, 0.01 * point.x})
                          : std::nullopt;
}

std::pair<int, int> squareOf(QPointF place, double gap)
{
    return {static_cast<int>(place.x() / gap), static_cast<int>(place.y() / gap)};
}

} // namespace

TEST(DotIndex, ShowsOneDotInEachSquareThatHasAny)
{
    test::Random random(11);
    const std::vector<DotIndex::Dot> dots = someDots(random, 5000);
    const DotIndex index(dots);
    EXPECT_EQ(index.size(), dots.size());
    for (int i = 0; i < 60; ++i) {
        const OrbitCamera camera = someCamera(random);
        for (const double gap : {6.0, 14.0, 90.0}) {
            std::set<std::pair<int, int>> expected;
            for (const DotIndex::Dot& dot : dots) {
                if (const auto place = placeOf(dot, camera); place && kArea.contains(*place)) {
                    expected.insert(squareOf(*place, gap));
                }
            }
            std::set<std::pair<int, int>> found;
            HandleGrid grid(kArea, gap);
            index.thinned(DotSight(camera, kViewport, kScale, kExaggeration, kArea), grid,
                          [&](const DotIndex::Dot& dot, QPointF place) {
                              const auto expected_place = placeOf(dot, camera);
                              ASSERT_TRUE(expected_place);
                              EXPECT_NEAR(place.x(), expected_place->x(), 1e-6);
                              EXPECT_NEAR(place.y(), expected_place->y(), 1e-6);
                              EXPECT_TRUE(found.insert(squareOf(place, gap)).second)
                                  << "two in a square";
                          });
            EXPECT_EQ(found, expected) << "camera " << i << ", gap " << gap;
        }
    }
}

TEST(DotIndex, FindsTheNearestDotThatIsNotRemoved)
{
    test::Random random(12);
    const std::vector<DotIndex::Dot> dots = someDots(random, 3000);
    DotIndex index(dots);
    const auto is_even = [](const DotIndex::Dot& dot) { return dot.id % 2 == 0; };
    for (std::size_t i = 0; i < index.size(); ++i) {
        if (!is_even(index.dots()[i])) {
            index.remove(i);
        }
    }
    EXPECT_EQ(index.removed(), 1500U);
    int hits = 0;
    for (int i = 0; i < 400; ++i) {
        const OrbitCamera camera = someCamera(random);
        const QPointF position(random.uniform(0.0, kArea.width()),
                               random.uniform(0.0, kArea.height()));
        constexpr double kReach = 12.0;
        double away = kReach;
        std::optional<std::uint32_t> expected;
        for (const DotIndex::Dot& dot : dots) {
            const auto place = is_even(dot) ? placeOf(dot, camera) : std::nullopt;
            const double here =
                place ? std::hypot(place->x() - position.x(), place->y() - position.y()) : 1e9;
            if (here <= away) {
                away = here;
                expected = dot.id;
            }
        }
        const auto found = index.nearest(DotSight(camera, kViewport, kScale, kExaggeration, kArea),
                                         position, kReach);
        ASSERT_EQ(found.has_value(), expected.has_value());
        if (found) {
            ++hits;
            EXPECT_EQ(found->dot.id, *expected);
            EXPECT_NEAR(found->away, away, 1e-6);
        }
    }
    EXPECT_GT(hits, 20);
}

// Against a list that is made again after every change, small ones and large ones.
TEST(DrawnDots, FollowAListThroughItsChanges)
{
    test::Random random(13);
    ItemList<Thing> list;
    std::uint32_t next = 1;
    DrawnDots<Thing> dots;
    std::vector<ItemList<Thing>> kept; // as undo keeps them
    for (int round = 0; round < 120; ++round) {
        const std::size_t added = round % 20 == 0 ? 1500 : random.below(3);
        for (std::size_t i = 0; i < added; ++i) {
            list.push_back(someThing(next++, random));
        }
        for (std::size_t i = random.below(4); i > 0; --i) {
            const auto id = static_cast<std::uint32_t>(1 + random.below(next));
            if (Thing* thing = list.edit(id); thing != nullptr && random.chance(0.5)) {
                *thing = someThing(id, random);
            } else {
                list.eraseIf([id](const Thing& each) { return each.id == id; });
            }
        }
        kept.push_back(list);
        if (random.chance(0.2)) {
            list = kept[random.below(kept.size())];
        }
        if (round % 50 == 49) {
            dots.forgetPlaces();
        }
        dots.follow(list, shownPlaceOf);

        const OrbitCamera camera = someCamera(random);
        const DotSight sight(camera, kViewport, kScale, kExaggeration, kArea);
        const double gap = 20.0;
        std::set<std::pair<int, int>> expected;
        std::vector<std::uint32_t> others;
        const QPointF position(random.uniform(0.0, kArea.width()),
                               random.uniform(0.0, kArea.height()));
        double away = 40.0;
        std::uint32_t nearest = 0;
        for (const Thing& thing : list) {
            if (!thing.isSingle()) {
                others.push_back(thing.id);
                continue;
            }
            const auto scene = shownPlaceOf(thing);
            const auto place =
                scene ? placeOf({.id = thing.id, .place = *scene}, camera) : std::nullopt;
            if (!place) {
                continue;
            }
            if (kArea.contains(*place)) {
                expected.insert(squareOf(*place, gap));
            }
            const double here = std::hypot(place->x() - position.x(), place->y() - position.y());
            if (here <= away) {
                away = here;
                nearest = thing.id;
            }
        }
        EXPECT_EQ(dots.others(), others);
        std::set<std::pair<int, int>> found;
        HandleGrid grid(kArea, gap);
        dots.thinned(sight, grid, [&](const DotIndex::Dot& dot, QPointF place) {
            const Thing* thing = list.find(dot.id);
            ASSERT_NE(thing, nullptr);
            EXPECT_EQ(dot.place, shownPlaceOf(*thing));
            found.insert(squareOf(place, gap));
        });
        EXPECT_EQ(found, expected) << "round " << round;
        const auto near = dots.nearest(sight, position, 40.0);
        EXPECT_EQ(near ? near->dot.id : 0, nearest) << "round " << round;
    }
}

TEST(DotIndex, HasNothingWithoutDots)
{
    HandleGrid grid(kArea, 6.0);
    const DotSight sight(OrbitCamera{}, kViewport, kScale, 1.0, kArea);
    DotIndex().thinned(sight, grid, [](const DotIndex::Dot&, QPointF) { ADD_FAILURE(); });
    EXPECT_FALSE(DotIndex().nearest(sight, {10.0, 10.0}, 1e9));
}

} // namespace marsview
