#include "ui/controllers/connection_mark.h"

#include <QCoreApplication>
#include <QSettings>

#include <cerrno>
#include <csignal>

namespace marsview {
namespace {

QString key()
{
    return QStringLiteral("haptics/connectedBy"); // the number of a process
}

// Another window may have a device connected.
bool isRunning(qint64 process)
{
    return process > 0 && (::kill(static_cast<pid_t>(process), 0) == 0 || errno == EPERM);
}

} // namespace

bool ConnectionMark::takeLeft()
{
    QSettings settings;
    if (!settings.contains(key()) || isRunning(settings.value(key()).toLongLong())) {
        return false;
    }
    settings.remove(key());
    return true;
}

void ConnectionMark::set(bool is_connected)
{
    if (is_connected == is_set_) {
        return;
    }
    is_set_ = is_connected;
    QSettings settings;
    if (is_connected) {
        settings.setValue(key(), QCoreApplication::applicationPid());
    } else {
        settings.remove(key());
    }
    settings.sync();
}

} // namespace marsview
