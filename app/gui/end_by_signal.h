// Ends the program normally when the system asks it to.
#pragma once

#include <QSocketNotifier>

#include <array>
#include <csignal>
#include <memory>

namespace marsview {

/// During its lifetime SIGTERM, SIGINT and SIGHUP quit the application like the menu does: devices
/// are released and closed, recordings are finished, and the next start finds no trace of a crash.
/// Writing to a pipe without a reader does not end the program. One at a time, in the GUI thread.
class EndBySignal {
public:
    EndBySignal();
    ~EndBySignal();
    EndBySignal(const EndBySignal&) = delete;
    EndBySignal& operator=(const EndBySignal&) = delete;

private:
    static void onSignal(int number);

    std::array<int, 2> pipe_{-1, -1}; // a signal handler may only write to it
    std::unique_ptr<QSocketNotifier> notifier_;
    static volatile std::sig_atomic_t pipe_end_;
};

} // namespace marsview
