// Running another program within limits, and stopping it.
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
    std::vector<std::string> arguments; // without the program's name
    std::string input;                  // what it reads on stdin
    std::chrono::milliseconds time_max{10'000};
    /// Of stdout and of stderr; what is beyond is read and dropped.
    std::size_t output_bytes_max = std::size_t{4} << 20;
    /// Where it is cancelled, the program is killed. May be null.
    const JobMonitor* job = nullptr;
};

enum class ChildEnd {
    Exited,
    Killed,    // by a signal that was not ours
    TimedOut,  // and was killed
    Cancelled, // and was killed
};

struct ChildOutcome {
    ChildEnd end = ChildEnd::Exited;
    int exit_status = 0; // where it exited
    int signal = 0;      // where it was killed
    std::string out;
    std::string err;
};

/// Starts the program and waits for its end. It gets a process group of its own, so that Ctrl-C in
/// a terminal does not reach it, and no signal is blocked in it. Unreadable where it cannot be
/// started. Any thread.
Result<ChildOutcome> runChild(const ChildProgram& program);

} // namespace marsview
