#include "haptics/loop/time_histogram.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace marsview {
namespace {

using std::chrono::nanoseconds;

TEST(TimeHistogram, QuantilesBoundWhatWasRecordedWithinAThirtySecond)
{
    test::Random random;
    for (const double decades : {0.5, 3.0, 11.0}) {
        TimeHistogram histogram;
        std::vector<std::int64_t> spans;
        for (int i = 0; i < 5000; ++i) {
            spans.push_back(static_cast<std::int64_t>(std::pow(10.0, random.uniform(0, decades))));
            histogram.record(nanoseconds{spans.back()});
        }
        std::sort(spans.begin(), spans.end());
        EXPECT_EQ(histogram.count(), spans.size());
        EXPECT_EQ(histogram.maximum().count(), spans.back());
        for (const double share : {0.001, 0.5, 0.9, 0.99, 0.999, 1.0}) {
            const auto place = static_cast<std::size_t>(
                std::max(std::ceil(share * static_cast<double>(spans.size())) - 1.0, 0.0));
            const auto truth = static_cast<double>(spans[place]);
            const auto found = static_cast<double>(histogram.quantile(share).count());
            EXPECT_GE(found, truth) << share;
            EXPECT_LE(found, truth * (1.0 + 1.0 / 32.0)) << share;
        }
    }
}

TEST(TimeHistogram, MergesAsIfRecordedInOne)
{
    test::Random random;
    TimeHistogram one;
    TimeHistogram parts[2];
    for (int i = 0; i < 3000; ++i) {
        const nanoseconds span{static_cast<std::int64_t>(random.below(1'000'000))};
        one.record(span);
        parts[i % 2].record(span);
    }
    parts[0].merge(parts[1]);
    EXPECT_EQ(parts[0].count(), one.count());
    EXPECT_EQ(parts[0].maximum(), one.maximum());
    EXPECT_EQ(parts[0].meanNanoseconds(), one.meanNanoseconds());
    for (int i = 0; i <= 100; ++i) {
        EXPECT_EQ(parts[0].quantile(i / 100.0), one.quantile(i / 100.0));
    }
}

TEST(TimeHistogram, ReportsTheRecordsSinceACopy)
{
    test::Random random;
    TimeHistogram all;
    TimeHistogram later;
    const auto some = [&] {
        return TimeHistogram::Span(static_cast<std::int64_t>(random.uniform(10.0, 1e6)));
    };
    for (int i = 0; i < 500; ++i) {
        all.record(some());
    }
    all.record(std::chrono::seconds(1)); // a long interval that has ended
    const TimeHistogram earlier = all;
    for (int i = 0; i < 300; ++i) {
        const auto span = some();
        all.record(span);
        later.record(span);
    }
    const TimeHistogram since = all.since(earlier);
    EXPECT_EQ(since.count(), 300U);
    EXPECT_DOUBLE_EQ(since.meanNanoseconds(), later.meanNanoseconds());
    EXPECT_EQ(since.quantile(0.5), later.quantile(0.5));
    EXPECT_GE(since.maximum(), later.maximum());
    EXPECT_LE(since.maximum().count(), later.maximum().count() * 33 / 32 + 1);
    EXPECT_EQ(all.since(all).count(), 0U);
    EXPECT_EQ(all.since(all).maximum().count(), 0);
}

TEST(TimeHistogram, TakesEverySpan)
{
    TimeHistogram histogram;
    EXPECT_EQ(histogram.quantile(0.5), nanoseconds{0});
    EXPECT_EQ(histogram.meanNanoseconds(), 0.0);
    histogram.record(nanoseconds{-5}); // from clocks that disagree
    EXPECT_EQ(histogram.maximum(), nanoseconds{0});
    histogram.record(nanoseconds::max());
    EXPECT_EQ(histogram.count(), 2U);
    EXPECT_EQ(histogram.maximum(), nanoseconds::max());
    EXPECT_EQ(histogram.quantile(0.5), nanoseconds{0});
    for (int bit = 0; bit < 63; ++bit) {
        histogram.record(nanoseconds{std::int64_t{1} << bit});
        histogram.record(nanoseconds{(std::int64_t{1} << bit) - 1});
    }
    EXPECT_EQ(histogram.count(), 2U + 2U * 63U);
}

} // namespace
} // namespace marsview
