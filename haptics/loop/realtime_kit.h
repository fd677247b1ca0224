// RealtimeKit: the service that grants real-time scheduling to unprivileged programs.
#pragma once

#include <string>

namespace marsview {

/// Asks the service to schedule the calling thread with SCHED_FIFO at `priority`, or at the highest
/// priority that it grants. Returns an empty string, or why it failed as a phrase for people. The
/// service requires that no real-time thread of the process then computes longer than its limit
/// (0.2 s) without sleeping. Waits for the service, at most a second, and allocates: call it before
/// the first turn.
std::string askRealtimeKit(int priority);

} // namespace marsview
