#include "app/cli/long_job.h"

#include <gtest/gtest.h>

#include <csignal>

namespace marsview::test {

TEST(LongJob, TurnsCtrlCIntoACancelOfTheRunningJob)
{
    LongJob job("testing");
    EXPECT_FALSE(job.monitor().isCancelled());
    std::raise(SIGINT);
    EXPECT_TRUE(job.monitor().isCancelled());
}

TEST(LongJob, GivesCtrlCBackWhenItEnds)
{
    {
        const LongJob job("testing");
    }
    EXPECT_EXIT(std::raise(SIGINT), testing::KilledBySignal(SIGINT), "");
}

} // namespace marsview::test
