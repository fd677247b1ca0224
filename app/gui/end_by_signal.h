// The program ends in order where the system asks it to.
#pragma once

#include <QSocketNotifier>

#include <array>
#include <csignal>
#include <memory>

namespace marsview {

/// While it lives, SIGTERM, SIGINT and SIGHUP quit the application as its menu does: devices are
/// let go of and closed, recordings finished, and the next start finds nothing odd. Pipes that
/// nobody reads any more end nothing. One at a time,
/// in the GUI's thread.
class EndBySignal {
public:
    EndBySignal();
    ~EndBySignal();
    EndBySignal(const EndBySignal&) = delete;
    EndBySignal& operator=(const EndBySignal&) = delete;

private:
    static void tell(int number);

    std::array<int, 2> pipe_{-1, -1}; // a handler may do no more than write
    std::unique_ptr<QSocketNotifier> notifier_;
    static volatile std::sig_atomic_t told_;
};

} // namespace marsview
