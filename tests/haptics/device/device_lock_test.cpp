#include "haptics/device/device_lock.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

namespace marsview::test {

TEST(DeviceLock, IsHeldByOneAtATime)
{
    const TempFolder folder;
    const auto first = lockDevice("x:/dev/hidraw1", folder.path() / "locks");
    ASSERT_TRUE(first && *first);
    const auto second = lockDevice("x:/dev/hidraw1", folder.path() / "locks");
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().message,
              "x:/dev/hidraw1: is in use by this program already; close it there first");
    EXPECT_TRUE(lockDevice("x:/dev/hidraw2", folder.path() / "locks"));
    EXPECT_TRUE(lockDevice("x:/dev_hidraw1", folder.path() / "locks"));
}

TEST(DeviceLock, NamesTheProgramThatHasTheDeviceUntilItEnds)
{
    const TempFolder folder;
    int ready[2];
    int done[2];
    ASSERT_EQ(pipe(ready), 0);
    ASSERT_EQ(pipe(done), 0);
    const pid_t other = fork();
    if (other == 0) {
        const auto lock = lockDevice("x:1", folder.path());
        char byte = lock && *lock ? 'y' : 'n';
        (void)!write(ready[1], &byte, 1);
        (void)!read(done[0], &byte, 1);
        _exit(0); // without releasing the lock
    }
    char byte = 0;
    ASSERT_EQ(read(ready[0], &byte, 1), 1);
    ASSERT_EQ(byte, 'y');
    const auto refused = lockDevice("x:1", folder.path());
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message,
                testing::MatchesRegex(fmt::format(
                    "x:1: is in use by [^ ]+ \\(process {}\\); close it there first", other)));
    ASSERT_EQ(write(done[1], &byte, 1), 1);
    ASSERT_EQ(waitpid(other, nullptr, 0), other);
    EXPECT_TRUE(lockDevice("x:1", folder.path()));
    for (const int end : {ready[0], ready[1], done[0], done[1]}) {
        close(end);
    }
}

TEST(DeviceLock, IsSkippedIfNoFileCanBeCreated)
{
    const auto lock = lockDevice("x:1", "/proc/nothing/here");
    ASSERT_TRUE(lock);
    EXPECT_FALSE(*lock);
}

} // namespace marsview::test
