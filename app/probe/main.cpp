// marsview-probe: opens a raster for marsview and marsview-cli, which read the raster only if this
// process does not crash. Not intended for direct use.
#include "core/files/open_probe.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
// Sanitizers reserve shadow memory, which would count toward a limit.
#define MARSVIEW_UNLIMITED_MEMORY 1 // NOLINT(cppcoreguidelines-macro-usage)
#endif

namespace {

void limit(__rlimit_resource_t resource, rlim_t most)
{
    const rlimit bounds{most, most};
    setrlimit(resource, &bounds);
}

} // namespace

// marsview-probe BYTES SECONDS: limits of memory and time.
int main(int argc, char** argv)
{
    if (argc != 3) {
        return 2;
    }
    prctl(PR_SET_PDEATHSIG, SIGKILL); // when the thread that waits for it ends
    prctl(PR_SET_DUMPABLE, 0);
    close_range(STDERR_FILENO + 1, ~0U, 0);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, std::strtoull(argv[2], nullptr, 10) + 1);
#ifndef MARSVIEW_UNLIMITED_MEMORY
    limit(RLIMIT_DATA, std::strtoull(argv[1], nullptr, 10));
#endif
    int status = 1;
    try {
        status = marsview::runProbe();
    } catch (const std::exception&) {
        std::abort();
    }
    std::fflush(stdout);
    _exit(status); // skips exit handlers of libraries, which may crash
}
