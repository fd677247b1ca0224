// What the window says for a moment: messages in the status bar, and failures.
#pragma once

#include <QObject>
#include <QString>

class QMainWindow;

namespace marsview {

/// GUI thread; must not outlive the window.
class WindowMessages final : public QObject {
    Q_OBJECT

public:
    /// Where failures are shown besides the signal.
    enum class Failures { InDialogs, BySignalOnly };

    WindowMessages(QMainWindow& window, Failures failures);

    /// In the status bar, for a few seconds.
    void show(const QString& message);
    void showSaved(const QString& file);
    /// In a dialog with that title, and by the signal.
    void report(const QString& title, const QString& problem);

Q_SIGNALS:
    void reported(const QString& problem);

private:
    QMainWindow& window_;
    Failures failures_;
};

} // namespace marsview
