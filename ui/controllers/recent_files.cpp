#include "ui/controllers/recent_files.h"

#include "core/files/raster_path.h"
#include "core/files/remote_raster.h"
#include "ui/text/number_text.h"
#include "ui/text/sentence.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <QHash>
#include <QMenu>
#include <QSet>
#include <QSettings>

#include <algorithm>

namespace marsview {
namespace {

constexpr qsizetype kCountMax = 10;

} // namespace

bool isAddress(const QString& file)
{
    return file.contains(QStringLiteral("://")) && remoteNameFor(file.toStdString()).has_value();
}

QStringList namesFor(const QStringList& files)
{
    const auto parts_of = [](const QString& file) {
        return file.split(QLatin1Char('/'), Qt::SkipEmptyParts);
    };
    // The last `depth` folders of a path.
    const auto folders_of = [&parts_of](const QString& file, qsizetype depth) {
        QStringList parts = parts_of(file);
        parts.removeLast();
        return parts.mid(std::max<qsizetype>(0, parts.size() - depth)).join(QLatin1Char('/'));
    };
    QHash<QString, QStringList> same_name;
    for (const QString& file : files) {
        same_name[QFileInfo(file).fileName()].append(file);
    }
    QStringList names;
    for (const QString& file : files) {
        const QString name = QFileInfo(file).fileName();
        const QStringList& others = same_name[name];
        if (others.size() < 2 || parts_of(file).isEmpty()) {
            names.append(name);
            continue;
        }
        qsizetype depth = 1;
        const auto is_ambiguous = [&] {
            QSet<QString> folders;
            for (const QString& other : others) {
                folders.insert(folders_of(other, depth));
            }
            return folders.size() < others.size();
        };
        const qsizetype depth_max = parts_of(file).size();
        while (depth < depth_max && is_ambiguous()) {
            ++depth;
        }
        //: In a list of files: %1 is a file's name, %2 the end of its folder's path
        names.append(QCoreApplication::translate("RecentFiles", "%1 — %2/")
                         .arg(name, folders_of(file, depth)));
    }
    return names;
}

RecentFiles::RecentFiles(QMenu& menu, Memory memory, QObject* parent, const QString& settings_key)
    : QObject(parent)
    , menu_(menu)
    , memory_(memory)
    , settings_key_(settings_key)
{
    menu_.setToolTipsVisible(true);
    if (memory_ == Memory::Settings) {
        files_ = QSettings().value(settings_key_).toStringList().mid(0, kCountMax);
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
        QSettings().setValue(settings_key_, files_);
    }
}

void RecentFiles::fillMenu()
{
    menu_.clear();
    QStringList ordered = files_;
    const auto gone = std::stable_partition(ordered.begin(), ordered.end(), [](const QString& f) {
        return isAddress(f) || isGdalName(f.toStdString()) || QFileInfo::exists(f);
    });
    const QStringList names = namesFor(ordered);
    for (auto file = ordered.begin(); file != ordered.end(); ++file) {
        const QString name = isolated(withoutMnemonics(names[file - ordered.begin()]));
        QAction* action = menu_.addAction(
            //: In the list of recent files: %1 is a file that no longer exists
            file < gone ? name : tr("%1 (missing)").arg(name), this,
            [this, path = *file] { Q_EMIT chosen(path); });
        action->setToolTip(isAddress(*file) ? *file : QDir::toNativeSeparators(*file));
        action->setEnabled(file < gone);
    }
    menu_.addSeparator();
    menu_.addAction(tr("&Clear Menu"), this, &RecentFiles::clear);
}

} // namespace marsview
