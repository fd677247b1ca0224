// RealtimeKit: the service that gives programs without privileges real-time threads.
#pragma once

#include <string>

namespace marsview {

/// Asks the service to schedule the calling thread with SCHED_FIFO at `priority`, or the highest
/// that it gives. Empty where it did; otherwise why not, a phrase for people. As the service
/// demands, the process may from then on not compute for longer than it allows (0.2 s) without
/// sleeping, in any real-time thread. Waits for the service, a second at most, and allocates:
/// before the first turn.
std::string askRealtimeKit(int priority);

} // namespace marsview
