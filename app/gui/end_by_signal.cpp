#include "app/gui/end_by_signal.h"

#include <QCoreApplication>
#include <QVariant>

#include <cerrno>
#include <fcntl.h>
#include <unistd.h>

namespace marsview {
namespace {

constexpr std::array kSignals{SIGTERM, SIGINT, SIGHUP};

} // namespace

volatile std::sig_atomic_t EndBySignal::pipe_end_ = -1;

EndBySignal::EndBySignal()
{
    if (pipe2(pipe_.data(), O_CLOEXEC | O_NONBLOCK) != 0) {
        return; // then the signals have their default effect
    }
    pipe_end_ = pipe_[1];
    std::signal(SIGPIPE, SIG_IGN); // a recording to a closed pipe fails as on a full disk
    notifier_ = std::make_unique<QSocketNotifier>(pipe_[0], QSocketNotifier::Read);
    QObject::connect(notifier_.get(), &QSocketNotifier::activated, [this] {
        notifier_->setEnabled(false); // react only once
        // Windows then close without asking; unsaved changes are offered at the next start.
        QCoreApplication::instance()->setProperty("endsBySignal", true);
        QCoreApplication::quit();
    });
    for (const int number : kSignals) {
        if (std::signal(number, &EndBySignal::onSignal) == SIG_IGN) {
            std::signal(number, SIG_IGN); // as under nohup
        }
    }
}

EndBySignal::~EndBySignal()
{
    if (pipe_end_ < 0) {
        return;
    }
    for (const int number : kSignals) {
        std::signal(number, SIG_DFL);
    }
    pipe_end_ = -1;
    notifier_.reset();
    close(pipe_[0]);
    close(pipe_[1]);
}

void EndBySignal::onSignal(int /*number*/)
{
    const int before = errno;
    const char any = 0;
    [[maybe_unused]] const auto written = write(pipe_end_, &any, 1);
    errno = before;
}

} // namespace marsview
