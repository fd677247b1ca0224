#include "core/base/time_left.h"

#include <gtest/gtest.h>

#include <chrono>

namespace marsview {
namespace {

using namespace std::chrono_literals;

// Reports `fraction(s)` ten times a second from `begin_s` to `end_s`.
template <typename Fraction>
void run(TimeLeft& estimate, double begin_s, double end_s, const Fraction& fraction)
{
    for (int i = 0; begin_s + 0.1 * i <= end_s; ++i) {
        const double s = begin_s + 0.1 * i;
        estimate.report(fraction(s), std::chrono::nanoseconds(static_cast<std::int64_t>(s * 1e9)));
    }
}

TEST(TimeLeft, IsEmptyBeforeProgressIsSeen)
{
    TimeLeft estimate;
    EXPECT_FALSE(estimate.left());
    run(estimate, 0.0, 2.0, [](double s) { return s / 100.0; });
    EXPECT_FALSE(estimate.left());
}

TEST(TimeLeft, IsExactForSteadyProgress)
{
    TimeLeft estimate;
    const auto steady = [](double s) { return s / 600.0; };
    run(estimate, 0.0, 10.0, steady);
    ASSERT_TRUE(estimate.left());
    EXPECT_NEAR(static_cast<double>(estimate.left()->count()), 590.0, 2.0);
    run(estimate, 10.1, 590.0, steady);
    EXPECT_NEAR(static_cast<double>(estimate.left()->count()), 10.0, 2.0);
    run(estimate, 590.1, 600.0, steady);
    EXPECT_LE(*estimate.left(), 1s);
}

// Work finished by an earlier attempt appears at once. It must not count toward the speed.
TEST(TimeLeft, IgnoresWorkFinishedByAnEarlierAttempt)
{
    TimeLeft estimate;
    run(estimate, 0.0, 20.0, [](double s) { return s < 0.5 ? 0.0 : 0.6 + s / 1000.0; });
    ASSERT_TRUE(estimate.left());
    EXPECT_NEAR(static_cast<double>(estimate.left()->count()), 380.0, 4.0);
}

TEST(TimeLeft, FollowsAChangeOfPaceWithinMinutes)
{
    TimeLeft estimate;
    run(estimate, 0.0, 60.0, [](double s) { return s / 200.0; }); // 0.3
    const auto slower = [](double s) { return 0.3 + (s - 60.0) / 2000.0; };
    run(estimate, 60.1, 180.0, slower); // 0.36
    ASSERT_TRUE(estimate.left());
    EXPECT_NEAR(static_cast<double>(estimate.left()->count()), 0.64 * 2000.0, 0.5 * 0.64 * 2000.0);
    run(estimate, 180.1, 360.0, slower); // 0.45
    EXPECT_NEAR(static_cast<double>(estimate.left()->count()), 0.55 * 2000.0, 0.05 * 1100.0);
}

TEST(TimeLeft, GrowsWithoutProgressAndStaysFinite)
{
    TimeLeft estimate;
    run(estimate, 0.0, 30.0, [](double s) { return s / 100.0; });
    const auto before = *estimate.left();
    run(estimate, 30.1, 40.0, [](double) { return 0.3; });
    EXPECT_GT(*estimate.left(), before);
    run(estimate, 40.1, 40'000.0, [](double) { return 0.3; });
    EXPECT_TRUE(!estimate.left() || *estimate.left() <= 24h * 366);
}

} // namespace
} // namespace marsview
