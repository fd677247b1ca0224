#include "haptics/sync/page_lock.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <linux/capability.h>
#include <string>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <vector>

namespace marsview::test {
namespace {

#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
constexpr bool kLocksNothing = true;
#else
constexpr bool kLocksNothing = false;
#endif

// The value in kB of a line of /proc/self/status: VmLck, VmSize.
long statusOf(const std::string& name)
{
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with(name + ":")) {
            return std::stol(line.substr(name.size() + 1));
        }
    }
    return -1;
}

void mayLockOnly(rlim_t bytes)
{
    __user_cap_header_struct header{};
    header.version = _LINUX_CAPABILITY_VERSION_3;
    std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> sets{};
    syscall(SYS_capget, &header, sets.data());
    sets[CAP_TO_INDEX(CAP_IPC_LOCK)].effective &= ~CAP_TO_MASK(CAP_IPC_LOCK);
    syscall(SYS_capset, &header, sets.data());
    const rlimit limit{bytes, bytes};
    setrlimit(RLIMIT_MEMLOCK, &limit);
}

// Whether the process can allocate and use `bytes` more.
bool getsMemory(std::size_t bytes)
{
    void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) { // NOLINT
        return false;
    }
    munmap(memory, bytes);
    return true;
}

// 0, or the number of the failed expectation. Runs in a separate process, because limits can only
// be lowered.
int boundedLocking()
{
    const auto room = static_cast<rlim_t>(statusOf("VmSize")) * 1024 + (16U << 20);
    mayLockOnly(room);
    const std::vector<char> used(1U << 20);
    const std::array ranges{MemoryRange{used.data(), used.size()}};
    {
        const ProcessLock lock(ranges);
        if (lock.refusal().find("only 1024 kB") == std::string::npos) {
            return 1;
        }
        if (statusOf("VmLck") < 1024 || statusOf("VmLck") > 1100) {
            return 2;
        }
        if (!getsMemory(std::size_t{256} << 20)) {
            return 3;
        }
    }
    return statusOf("VmLck") <= 8 ? 0 : 4; // the pages at both ends are shared with other data
}

TEST(ProcessLock, WhereLockingIsBoundedLaterMemoryIsNotRefused)
{
    if (kLocksNothing) {
        GTEST_SKIP() << "with sanitizers, mlock does nothing";
    }
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(std::exit(boundedLocking()), testing::ExitedWithCode(0), ""); // NOLINT
}

// The same where the process may lock all its memory.
int wholeLocking()
{
    {
        const ProcessLock lock({});
        if (!lock.refusal().empty()) {
            return 5; // the system does not grant it
        }
        const ProcessLock again({});
        if (statusOf("VmLck") <= 0) {
            return 1;
        }
        if (!getsMemory(std::size_t{256} << 20)) {
            return 2;
        }
    }
    return statusOf("VmLck") == 0 ? 0 : 3;
}

TEST(ProcessLock, EndsWithItsLastUser)
{
    if (kLocksNothing) {
        GTEST_SKIP() << "with sanitizers, mlock does nothing";
    }
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(
        std::exit(wholeLocking()), // NOLINT
        [](int status) {
            return WIFEXITED(status) && (WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == 5);
        },
        "");
}

} // namespace
} // namespace marsview::test
