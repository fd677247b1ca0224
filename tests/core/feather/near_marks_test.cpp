#include "core/feather/near_marks.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace marsview {
namespace {

TEST(NearMarks, SquaredDistancesAreThoseToTheNearestOfAllMarks)
{
    test::Random random(5);
    for (const std::size_t reach : {1U, 2U, 7U, 20U}) {
        for (int round = 0; round < 20; ++round) {
            const std::size_t columns = 1 + random.below(30);
            const std::size_t rows = 1 + random.below(30);
            const std::size_t width = columns + 2 * reach;
            const std::size_t height = rows + 2 * reach;
            std::vector<std::uint8_t> marks(width * height, 0);
            const std::size_t count = random.below(6);
            for (std::size_t i = 0; i < count; ++i) {
                marks[random.below(marks.size())] = 1;
            }
            const auto squared = squaredDistances({marks.data(), width, height}, reach);
            ASSERT_EQ(squared.size(), columns * rows);
            for (std::size_t i = 0; i < squared.size(); ++i) {
                auto least = static_cast<std::int64_t>(reach * reach);
                for (std::size_t k = 0; k < marks.size(); ++k) {
                    const auto across = static_cast<std::int64_t>(i % columns + reach) -
                                        static_cast<std::int64_t>(k % width);
                    const auto down = static_cast<std::int64_t>(i / columns + reach) -
                                      static_cast<std::int64_t>(k / width);
                    if (marks[k] != 0) {
                        least = std::min(least, across * across + down * down);
                    }
                }
                ASSERT_EQ(squared[i], least) << reach << ' ' << round << ' ' << i;
            }
        }
    }
}

} // namespace
} // namespace marsview
