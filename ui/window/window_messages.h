// What the window says for a moment: messages in the status bar, and failures.
#pragma once

#include "ui/widgets/notice.h"

#include <QObject>
#include <QString>

class QMainWindow;

namespace marsview {

class NoticeCenter;

/// GUI thread; must not outlive the window and the notice center.
class WindowMessages final : public QObject {
    Q_OBJECT

public:
    /// Where failures are shown besides the signal.
    enum class Failures { AsNotices, BySignalOnly };

    WindowMessages(QMainWindow& window, NoticeCenter& notices, Failures failures);

    /// In the status bar, for a few seconds.
    void show(const QString& message);
    void showSaved(const QString& file);
    /// In a notice that stays until the user closes it, and by the signal. The title says what was
    /// not done, the problem why.
    void report(const QString& title, const QString& problem);
    /// Removes the notices of earlier failures: the user has asked for something else.
    void forgetFailures();

Q_SIGNALS:
    void reported(const QString& problem);

private:
    QMainWindow& window_;
    NoticeCenter& notices_;
    Failures failures_;
    QList<Notice> reported_; // the latest first
    int count_ = 0;          // of all failures
};

} // namespace marsview
