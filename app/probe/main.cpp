// marsview-probe: opens a raster for marsview and marsview-cli, which read the raster only if this
// process does not crash. Not intended for direct use.
#include "core/files/open_probe.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <sys/prctl.h>
#include <unistd.h>
#include <vector>

// marsview-probe BYTES SECONDS: limits of memory and time.
int main(int argc, char** argv)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL); // when the thread that waits for it ends
    close_range(STDERR_FILENO + 1, ~0U, 0);
    int status = 1;
    try {
        status = marsview::probeMain(std::vector<std::string>(argv + 1, argv + argc));
    } catch (const std::exception&) {
        std::abort();
    }
    std::fflush(stdout);
    _exit(status); // skips exit handlers of libraries, which may crash
}
