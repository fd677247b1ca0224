#include "core/base/bounded_text.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace marsview::test {
namespace {

constexpr TextBounds kSmall{.bytes_max = 200'000, .line_bytes_max = 1000};

} // namespace

TEST(BoundedText, ReturnsATextWithinItsBoundsByteForByte)
{
    std::string text;
    for (int i = 0; i < 1000; ++i) {
        text += std::string(static_cast<std::size_t>(i % 150), 'x') + "\r\n";
    }
    std::istringstream in(text);
    const Result<std::string> read = readBoundedText(in, "text", kSmall);
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, text);
}

TEST(BoundedText, RefusesEndlessStreamsByTheirFirstLine)
{
    std::ifstream zero("/dev/zero", std::ios::binary);
    const Result<std::string> read = readBoundedText(zero, "/dev/zero", kSmall);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::TooLarge);
    EXPECT_TRUE(read.error().message.starts_with("/dev/zero: line 1 is longer than "))
        << read.error().message;
}

TEST(BoundedText, RefusesTextsWithTooManyShortLines)
{
    std::string text;
    while (text.size() <= kSmall.bytes_max) {
        text += "1,2,3\n";
    }
    std::istringstream in(text);
    const Result<std::string> read = readBoundedText(in, "goals.csv", kSmall);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::TooLarge);
}

TEST(BoundedText, ReadsLinesAsGetlineDoesUntilOneIsTooLong)
{
    std::istringstream in("one\n\nthree\n" + std::string(50, 'x') + "\nlast");
    std::string line;
    EXPECT_EQ(readBoundedLine(in, line, 20), LineOutcome::Line);
    EXPECT_EQ(line, "one");
    EXPECT_EQ(readBoundedLine(in, line, 20), LineOutcome::Line);
    EXPECT_EQ(line, "");
    EXPECT_EQ(readBoundedLine(in, line, 20), LineOutcome::Line);
    EXPECT_EQ(line, "three");
    EXPECT_EQ(readBoundedLine(in, line, 20), LineOutcome::TooLong);
    std::istringstream end("last");
    EXPECT_EQ(readBoundedLine(end, line, 20), LineOutcome::Line);
    EXPECT_EQ(line, "last");
    EXPECT_EQ(readBoundedLine(end, line, 20), LineOutcome::End);
}

} // namespace marsview::test
