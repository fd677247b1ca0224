#include "core/terrain/pole_cap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace marsview {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Sizes that halve evenly, with a remainder at every step, and the smallest one that a map around a
// body has.
const std::vector<std::uint32_t> kCircleSizes{3,  4,  7,  8,   9,   10,  11,   15,
                                              16, 17, 33, 100, 129, 360, 1440, 4097};

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edgeOpposite(const PoleCap& cap, std::uint32_t corner)
{
    const auto face = cap.face(corner / 3);
    return {face[(corner + 1) % 3], face[(corner + 2) % 3]};
}

TEST(PoleCap, EveryEdgeHasTheFaceOnItsOtherSideOrIsOfTheCircle)
{
    for (const std::uint32_t size : kCircleSizes) {
        const PoleCap cap(size);
        std::map<Edge, std::uint32_t> corners; // by the directed edge opposite
        for (std::uint32_t corner = 0; corner < 3 * cap.faceCount(); ++corner) {
            ASSERT_TRUE(corners.emplace(edgeOpposite(cap, corner), corner).second)
                << size << ": two faces on one side of an edge";
        }
        std::vector<bool> is_seen(size, false);
        for (const auto& [edge, corner] : corners) {
            const PoleCap::Beyond beyond = cap.across(corner);
            const auto other = corners.find({edge.second, edge.first});
            if (beyond.is_outside) {
                ASSERT_EQ(other, corners.end());
                ASSERT_EQ(edge, Edge(beyond.at, (beyond.at + 1) % size));
                ASSERT_EQ(cap.cornerAtCircle(beyond.at), corner);
                ASSERT_FALSE(is_seen[beyond.at]);
                is_seen[beyond.at] = true;
            } else {
                ASSERT_NE(other, corners.end()) << size << " " << corner;
                ASSERT_EQ(beyond.at, other->second) << size << " " << corner;
            }
        }
        EXPECT_EQ(std::count(is_seen.begin(), is_seen.end(), true), size);
    }
}

TEST(PoleCap, NoVertexHasMoreThanEightNeighborsAndEachHasACorner)
{
    for (const std::uint32_t size : kCircleSizes) {
        const PoleCap cap(size);
        std::vector<int> count(size + cap.innerVertexCount(), 0);
        for (std::uint32_t face = 0; face < cap.faceCount(); ++face) {
            for (const std::uint32_t vertex : cap.face(face)) {
                ++count.at(vertex);
            }
        }
        for (std::uint32_t vertex = 0; vertex < count.size(); ++vertex) {
            ASSERT_GE(count[vertex], 1) << size << " " << vertex;
            // A sample of the circle has at most three faces of the map in addition.
            ASSERT_LE(count[vertex], vertex < size ? 3 : 8) << size << " " << vertex;
            if (vertex >= size) {
                const std::uint32_t corner = cap.cornerAt(vertex);
                ASSERT_EQ(cap.face(corner / 3)[corner % 3], vertex);
            }
        }
    }
}

// Laid out flat, the faces cover the polygon of the circle once, and none is turned over.
TEST(PoleCap, ItsFacesCoverTheCircleOnce)
{
    for (const std::uint32_t size : kCircleSizes) {
        const PoleCap cap(size);
        const auto at = [&](std::uint32_t vertex) {
            const PoleCap::Place place =
                vertex < size ? PoleCap::Place{vertex, 1.0} : cap.placeOf(vertex);
            const double angle = 2.0 * kPi * place.sample / size;
            return std::array{place.share * std::cos(angle), place.share * std::sin(angle)};
        };
        double area = 0.0;
        for (std::uint32_t face = 0; face < cap.faceCount(); ++face) {
            const auto [a, b, c] = cap.face(face);
            const auto p = at(a);
            const auto q = at(b);
            const auto r = at(c);
            const double twice = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
            ASSERT_GT(twice, 0.0) << size << " " << face;
            area += 0.5 * twice;
        }
        EXPECT_NEAR(area, 0.5 * size * std::sin(2.0 * kPi / size), 1e-12) << size;
    }
}

} // namespace
} // namespace marsview
