#include "ui/window/window_messages.h"

#include "ui/text/number_text.h"
#include "ui/text/sentence.h"
#include "ui/widgets/notice_center.h"

#include <QDir>
#include <QMainWindow>
#include <QStatusBar>

#include <algorithm>

namespace marsview {

WindowMessages::WindowMessages(QMainWindow& window, NoticeCenter& notices, Failures failures)
    : window_(window)
    , notices_(notices)
    , failures_(failures)
{}

void WindowMessages::show(const QString& message)
{
    constexpr int kDurationMs = 4000;
    window_.statusBar()->showMessage(message, kDurationMs);
}

void WindowMessages::showSaved(const QString& file)
{
    forgetFailures(); // such as that of the attempt before
    //: In the status bar, for a few seconds; %1 is a file
    show(tr("Saved %1").arg(isolated(QDir::toNativeSeparators(file))));
}

void WindowMessages::report(const QString& title, const QString& problem)
{
    Q_EMIT reported(problem);
    if (failures_ != Failures::AsNotices) {
        return;
    }
    const Notice notice{.id = QStringLiteral("failure %1").arg(++count_),
                        //: A failure: %1 is what was not done, such as "Cannot Open Map", %2 why
                        .text = tr("%1: %2").arg(title, isolated(translatedMessage(problem)))};
    // Closed ones are forgotten, and the same again replaces what it repeats.
    const QList<Notice> open = notices_.open();
    reported_.removeIf([&open, &notice](const Notice& earlier) {
        return earlier.text == notice.text ||
               std::none_of(open.begin(), open.end(),
                            [&earlier](const Notice& shown) { return shown.id == earlier.id; });
    });
    reported_.prepend(notice);
    notices_.setNotices(NoticeSource::Failure, reported_);
}

void WindowMessages::forgetFailures()
{
    reported_.clear();
    notices_.setNotices(NoticeSource::Failure, reported_);
}

} // namespace marsview
