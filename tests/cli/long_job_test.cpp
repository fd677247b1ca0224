#include "app/console/long_job.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>

namespace marsview::test {

TEST(LongJob, CtrlCCancelsTheRunningJob)
{
    LongJob job("testing");
    EXPECT_FALSE(job.monitor().isCanceled());
    std::raise(SIGINT);
    EXPECT_TRUE(job.monitor().isCanceled());
}

TEST(LongJob, RestoresCtrlCWhenItEnds)
{
    {
        const LongJob job("testing");
    }
    EXPECT_EXIT(std::raise(SIGINT), testing::KilledBySignal(SIGINT), "");
}

TEST(LongJob, EstimatesTheTimeLeftFromThisRunOnly)
{
    using Seconds = std::chrono::duration<double>;
    EXPECT_EQ(LongJob::timeLeft(0.0, 0.5, Seconds(60.0)), "about 60 s left");
    EXPECT_EQ(LongJob::timeLeft(0.5, 0.6, Seconds(60.0)), "about 4 min left"); // resumed at 0.5
    EXPECT_EQ(LongJob::timeLeft(0.0, 0.01, Seconds(180.0)), "about 5.0 h left");
    EXPECT_EQ(LongJob::timeLeft(0.0, 0.001, Seconds(1.0)), ""); // too early for an estimate
    EXPECT_EQ(LongJob::timeLeft(0.0, 0.99, Seconds(60.0)), ""); // almost no time
    EXPECT_EQ(LongJob::timeLeft(0.5, 0.5, Seconds(60.0)), "");
}

} // namespace marsview::test
