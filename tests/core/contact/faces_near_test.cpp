#include "core/contact/faces_near.h"
#include "core/contact/heightfield_surface.h"
#include "tests/core/contact/contact_terrain.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <tuple>
#include <vector>

namespace marsview {
namespace {

constexpr int kColumns = 75;
constexpr int kRows = 50;
constexpr std::uint32_t kLooksMax = 1'000'000;

using Found = std::tuple<int, int, bool>; // column, row, upper

// Whether the boxes of a face, of whole heights, and of the search meet, also if they only touch.
bool meets(const HeightfieldSurface& surface, const Found& face, const SceneBounds& box)
{
    const auto& [column, row, is_upper] = face;
    const auto z = [&](int c, int r) {
        return surface.height({static_cast<double>(c), static_cast<double>(r)});
    };
    const std::array<double, 3> heights{
        z(column, row), is_upper ? z(column + 1, row) : z(column, row + 1), z(column + 1, row + 1)};
    const auto [lowest, highest] = std::minmax_element(heights.begin(), heights.end());
    const double x = column - (kColumns - 1) / 2.0;
    const double y = (kRows - 1) / 2.0 - row;
    return x <= box.high.x && x + 1.0 >= box.low.x && y - 1.0 <= box.high.y && y >= box.low.y &&
           *lowest <= box.high.z && *highest >= box.low.z;
}

// Of boxes whose sides are whole, half or any numbers, all over the map and beyond it.
TEST(FacesNear, FindsEachFaceWhoseBoxMeetsTheBoxOnce)
{
    test::Random random;
    std::vector<float> heights;
    for (int i = 0; i < kColumns * kRows; ++i) {
        heights.push_back(static_cast<float>(random.below(8)));
    }
    const HeightfieldSurface surface = test::surfaceOver(test::filledTerrain(kColumns, heights));
    std::size_t count = 0;
    for (int i = 0; i < 200; ++i) {
        const auto range = [&](double reach, double& low, double& high) {
            const double unit = i % 3 == 0 ? 1.0 : i % 3 == 1 ? 0.5 : 0x1p-20;
            low = unit * std::floor(random.uniform(-reach, reach) / unit);
            high = low + unit * std::floor(random.uniform(0.0, i % 7 == 0 ? 60.0 : 4.0) / unit);
        };
        SceneBounds box{};
        range(40.0, box.low.x, box.high.x);
        range(28.0, box.low.y, box.high.y);
        range(9.0, box.low.z, box.high.z);
        std::set<Found> found;
        std::uint32_t looks = kLooksMax;
        EXPECT_TRUE(eachFaceNear(
            surface, box, looks,
            [&](const HeightfieldFace& face, const std::array<ScenePoint, 3>& corners) {
                EXPECT_TRUE(found.emplace(face.column, face.row, face.is_upper).second);
                const auto vertices = surface.corners(face);
                for (std::size_t k = 0; k < 3; ++k) {
                    const GridPoint grid{static_cast<double>(vertices[k].column),
                                         static_cast<double>(vertices[k].row)};
                    EXPECT_EQ(corners[k], surface.frame().toScene(grid, surface.height(grid)));
                }
                return true;
            }));
        std::set<Found> expected;
        for (int row = 0; row < kRows - 1; ++row) {
            for (int column = 0; column < kColumns - 1; ++column) {
                for (const bool is_upper : {false, true}) {
                    if (meets(surface, {column, row, is_upper}, box)) {
                        expected.emplace(column, row, is_upper);
                    }
                }
            }
        }
        EXPECT_EQ(found, expected) << "box " << i;
        count += expected.size();
    }
    EXPECT_GT(count, 2000U);
}

TEST(FacesNear, StopsWhereItIsTold)
{
    const HeightfieldSurface surface = test::surfaceOver(
        test::filledTerrain(kColumns, std::vector<float>(kColumns * kRows, 1.0F)));
    const SceneBounds box{{-5.5, -5.5, 0.0}, {5.5, 5.5, 2.0}};
    std::uint32_t looks = kLooksMax;
    int faces = 0;
    EXPECT_FALSE(
        eachFaceNear(surface, box, looks, [&](const auto&, const auto&) { return ++faces < 7; }));
    EXPECT_EQ(faces, 7);
    // A limit of looks ends it, wherever it is reached; the search needs more than its 132 cells.
    looks = kLooksMax;
    EXPECT_TRUE(eachFaceNear(surface, box, looks, [](const auto&, const auto&) { return true; }));
    const std::uint32_t needed = kLooksMax - looks;
    EXPECT_GT(needed, 132U);
    for (std::uint32_t limit = 0; limit <= needed; ++limit) {
        looks = limit;
        EXPECT_EQ(eachFaceNear(surface, box, looks, [](const auto&, const auto&) { return true; }),
                  limit == needed);
        EXPECT_EQ(looks, 0U);
    }
}

} // namespace
} // namespace marsview
