#include "core/base/result.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace marsview {
namespace {

Result<std::unique_ptr<int>> half(int number)
{
    if (number % 2 != 0) {
        return Error{ErrorCode::Invalid, "odd"};
    }
    return std::make_unique<int>(number / 2);
}

TEST(Result, HoldsAValueOrAnErrorAndReportsWhich)
{
    EXPECT_TRUE(half(4));
    EXPECT_EQ(**half(4), 2);
    EXPECT_FALSE(half(3));
    EXPECT_EQ(half(3).error().code, ErrorCode::Invalid);
    EXPECT_EQ(half(3).error().message, "odd");
}

TEST(Result, MovesItsValueOut)
{
    const std::unique_ptr<int> owned = half(10).value();
    EXPECT_EQ(*owned, 5);
}

TEST(ResultDeathTest, AccessingTheMissingAlternativeIsABug)
{
    EXPECT_DEATH((void)half(3).value(), "check failed");
    EXPECT_DEATH((void)half(4).error(), "check failed");
}

} // namespace
} // namespace marsview
