// Runs another program within limits and can stop it.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace marsview {

struct ChildProgram {
    std::string path;
    /// Runs the function of the fork server (fork_server.h), if there is one, instead of the
    /// program at `path`.
    bool may_be_forked = false;
    std::vector<std::string> arguments; // without the program's name
    std::string input;                  // the child's stdin
    std::chrono::milliseconds time_max{10'000};
    /// For stdout and stderr each; further output is read and dropped.
    std::size_t output_bytes_max = std::size_t{4} << 20;
    /// Canceling the job kills the program. May be null.
    const JobMonitor* job = nullptr;
};

enum class ChildEnd {
    Exited,
    Killed,   // by a signal we did not send
    TimedOut, // and was killed
    Canceled, // and was killed
};

struct ChildOutcome {
    ChildEnd end = ChildEnd::Exited;
    int exit_status = 0; // if Exited
    int signal = 0;      // if Killed
    std::string out;
    std::string err;
};

/// Starts the program and waits for its end. It runs in its own process group, so that Ctrl-C in a
/// terminal does not reach it, with no signals blocked. Unreadable if it cannot be started. Any
/// thread.
Result<ChildOutcome> runChild(const ChildProgram& program);

} // namespace marsview
