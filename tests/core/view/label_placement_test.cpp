#include "core/view/label_placement.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace marsview {
namespace {

LabelRequest area(double x, double y)
{
    return {.place = {x, y}, .width_px = 40.0, .height_px = 10.0};
}

bool wanted(std::size_t /*request*/)
{
    return true;
}

} // namespace

TEST(LabelPlacement, TheMoreImportantLabelTakesTheRoom)
{
    const std::vector<LabelRequest> requests{area(50.0, 50.0), area(55.0, 50.0), area(55.0, 50.0),
                                             area(55.0, 50.0), area(200.0, 50.0)};
    const auto placed =
        placeLabels(requests, {.viewport = {300, 100}, .gap_px = 0.0, .count_max = 10}, wanted);
    // The second and third go below and above; there is no room for the fourth.
    ASSERT_EQ(placed.size(), 4U);
    EXPECT_EQ(placed[0].request, 0U);
    EXPECT_DOUBLE_EQ(placed[0].box.top, 45.0);
    EXPECT_DOUBLE_EQ(placed[1].box.top, 55.0);
    EXPECT_DOUBLE_EQ(placed[2].box.top, 35.0);
    EXPECT_EQ(placed[3].request, 4U);
}

TEST(LabelPlacement, LabelsOfPointsLieBesideThem)
{
    const std::vector<LabelRequest> requests{{.place = {50.0, 50.0},
                                              .width_px = 40.0,
                                              .height_px = 10.0,
                                              .anchor = LabelAnchor::Point,
                                              .clear_px = 4.0},
                                             {.place = {290.0, 20.0},
                                              .width_px = 40.0,
                                              .height_px = 10.0,
                                              .anchor = LabelAnchor::Point,
                                              .clear_px = 4.0}};
    const auto placed = placeLabels(requests, {.viewport = {300, 100}, .count_max = 10}, wanted);
    ASSERT_EQ(placed.size(), 2U);
    EXPECT_DOUBLE_EQ(placed[0].box.left, 54.0);
    EXPECT_DOUBLE_EQ(placed[1].box.right, 286.0); // no room to the right
}

TEST(LabelPlacement, ALabelThatIsNotWantedTakesNoRoom)
{
    const std::vector<LabelRequest> requests{area(50.0, 50.0), area(50.0, 50.0)};
    const auto placed = placeLabels(requests, {.viewport = {100, 100}, .count_max = 1},
                                    [](std::size_t request) { return request == 1; });
    ASSERT_EQ(placed.size(), 1U);
    EXPECT_DOUBLE_EQ(placed[0].box.top, 45.0);
}

TEST(LabelPlacement, RandomLabelsNeverOverlapAndStayInThePicture)
{
    test::Random random;
    for (int round = 0; round < 200; ++round) {
        std::vector<LabelRequest> requests;
        for (int i = 0; i < 200; ++i) {
            requests.push_back(
                {.place = {random.uniform(-50.0, 850.0), random.uniform(-50.0, 650.0)},
                 .width_px = random.uniform(10.0, 150.0),
                 .height_px = random.uniform(8.0, 30.0),
                 .anchor = random.chance(0.5) ? LabelAnchor::Area : LabelAnchor::Point,
                 .clear_px = random.uniform(0.0, 8.0)});
        }
        const std::vector<LabelBox> obstacles{{600.0, 0.0, 800.0, 150.0}};
        const auto placed = placeLabels(
            requests,
            {.viewport = {800, 600}, .gap_px = 3.0, .count_max = 100, .obstacles = obstacles},
            wanted);
        EXPECT_GT(placed.size(), 20U);
        for (std::size_t i = 0; i < placed.size(); ++i) {
            const LabelBox& a = placed[i].box;
            ASSERT_TRUE(a.left >= 0.0 && a.top >= 0.0 && a.right <= 800.0 && a.bottom <= 600.0);
            ASSERT_FALSE(a.overlaps(obstacles.front()));
            const LabelBox wide{a.left - 3.0, a.top - 3.0, a.right + 3.0, a.bottom + 3.0};
            for (std::size_t k = 0; k < i; ++k) {
                ASSERT_FALSE(wide.overlaps(placed[k].box));
            }
        }
    }
}

} // namespace marsview
