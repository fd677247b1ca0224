#include "ui/recent_files.h"

#include "core/raster/remote_raster.h"

#include <QDir>
#include <QFileInfo>
#include <QMenu>
#include <QSettings>

#include <algorithm>

namespace marsview {
namespace {

constexpr qsizetype kCountMax = 10;

QString settingsKey()
{
    return QStringLiteral("files/recent");
}

// What a menu takes for the mark of a key is a letter in a file's name.
QString withoutMnemonics(QString text)
{
    return text.replace(QLatin1Char('&'), QStringLiteral("&&"));
}

} // namespace

bool isAddress(const QString& file)
{
    return file.contains(QStringLiteral("://")) && remoteNameFor(file.toStdString()).has_value();
}

RecentFiles::RecentFiles(QMenu& menu, Memory memory, QObject* parent)
    : QObject(parent)
    , menu_(menu)
    , memory_(memory)
{
    menu_.setToolTipsVisible(true);
    if (memory_ == Memory::Settings) {
        files_ = QSettings().value(settingsKey()).toStringList().mid(0, kCountMax);
    }
    connect(&menu_, &QMenu::aboutToShow, this, &RecentFiles::fillMenu);
    menu_.setEnabled(!files_.isEmpty());
}

void RecentFiles::add(const QString& file)
{
    const QString path = QFileInfo(file).exists() ? QFileInfo(file).absoluteFilePath() : file;
    files_.removeAll(path);
    files_.prepend(path);
    files_ = files_.mid(0, kCountMax);
    changed();
}

void RecentFiles::clear()
{
    files_.clear();
    changed();
}

void RecentFiles::changed()
{
    menu_.setEnabled(!files_.isEmpty());
    if (memory_ == Memory::Settings) {
        QSettings().setValue(settingsKey(), files_);
    }
}

void RecentFiles::fillMenu()
{
    menu_.clear();
    QStringList ordered = files_;
    const auto gone = std::stable_partition(ordered.begin(), ordered.end(), [](const QString& f) {
        return isAddress(f) || QFileInfo::exists(f);
    });
    for (auto file = ordered.begin(); file != ordered.end(); ++file) {
        const QString name = withoutMnemonics(QFileInfo(*file).fileName());
        QAction* action = menu_.addAction(
            //: In the list of recent files: %1 is a file that is no longer there
            file < gone ? name : tr("%1 (missing)").arg(name), this,
            [this, path = *file] { Q_EMIT chosen(path); });
        action->setToolTip(isAddress(*file) ? *file : QDir::toNativeSeparators(*file));
        action->setEnabled(file < gone);
    }
    menu_.addSeparator();
    menu_.addAction(tr("&Clear Menu"), this, &RecentFiles::clear);
}

} // namespace marsview
