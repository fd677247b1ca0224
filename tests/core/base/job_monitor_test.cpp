#include "core/base/job_monitor.h"

#include <gtest/gtest.h>

namespace marsview {
namespace {

TEST(JobMonitor, ProgressCoversTheWholeWork)
{
    JobMonitor monitor;
    monitor.report(0.5);
    EXPECT_DOUBLE_EQ(monitor.fraction(), 0.5);
    monitor.beginStage(0.25, 0.75);
    monitor.report(0.5);
    EXPECT_DOUBLE_EQ(monitor.fraction(), 0.5);
    monitor.report(1.0);
    EXPECT_DOUBLE_EQ(monitor.fraction(), 0.75);
}

TEST(JobMonitor, StagesOfAPartAreWithinIt)
{
    JobMonitor monitor;
    const auto work_in_two_stages = [&monitor] {
        monitor.beginStage(0.0, 0.5);
        monitor.report(1.0);
        const double middle = monitor.fraction();
        monitor.beginStage(0.5, 1.0);
        monitor.report(1.0);
        return middle;
    };
    {
        const JobPart part(monitor, 0.0, 0.2);
        EXPECT_DOUBLE_EQ(work_in_two_stages(), 0.1);
        EXPECT_DOUBLE_EQ(monitor.fraction(), 0.2);
    }
    {
        const JobPart part(monitor, 0.2, 1.0);
        monitor.report(0.25); // without stages, one stage
        EXPECT_DOUBLE_EQ(monitor.fraction(), 0.4);
        const JobPart inner(monitor, 0.5, 1.0);
        EXPECT_DOUBLE_EQ(work_in_two_stages(), 0.8);
        EXPECT_DOUBLE_EQ(monitor.fraction(), 1.0);
    }
    EXPECT_DOUBLE_EQ(work_in_two_stages(), 0.5); // the stage has ended
}

} // namespace
} // namespace marsview
