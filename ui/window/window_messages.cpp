#include "ui/window/window_messages.h"

#include "ui/text/number_text.h"

#include <QDir>
#include <QMainWindow>
#include <QMessageBox>
#include <QStatusBar>

namespace marsview {

WindowMessages::WindowMessages(QMainWindow& window, Failures failures)
    : window_(window)
    , failures_(failures)
{}

void WindowMessages::show(const QString& message)
{
    constexpr int kDurationMs = 4000;
    window_.statusBar()->showMessage(message, kDurationMs);
}

void WindowMessages::showSaved(const QString& file)
{
    //: In the status bar, for a few seconds; %1 is a file
    show(tr("Saved %1").arg(isolated(QDir::toNativeSeparators(file))));
}

void WindowMessages::report(const QString& title, const QString& problem)
{
    Q_EMIT reported(problem);
    if (failures_ == Failures::InDialogs) {
        auto* box = new QMessageBox(QMessageBox::Warning, title, isolated(problem), QMessageBox::Ok,
                                    &window_);
        box->setAttribute(Qt::WA_DeleteOnClose);
        box->setTextFormat(Qt::PlainText);
        box->setWindowModality(Qt::WindowModal);
        box->show();
    }
}

} // namespace marsview
