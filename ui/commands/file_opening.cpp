#include "ui/commands/file_opening.h"

#include "core/files/file_address.h"
#include "core/files/raster_path.h"
#include "core/vector/vector_file.h"
#include "ui/commands/vector_tools.h"
#include "ui/controllers/recent_files.h"
#include "ui/controllers/session_controller.h"
#include "ui/dialogs/address_dialog.h"
#include "ui/project/project_menu.h"
#include "ui/window/window_actions.h"

#include <QAction>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMainWindow>
#include <QMenu>
#include <QMimeData>
#include <QSettings>
#include <QUrl>

#include <algorithm>
#include <array>

namespace marsview {
namespace {

QString folderKey()
{
    return QStringLiteral("files/folder");
}

struct BundledMap {
    const char* file;
    const char* title;
};

constexpr std::array kBundledMaps{
    BundledMap{"mars_mola_4ppd.tif",
               QT_TRANSLATE_NOOP("marsview::FileOpening", "&Mars, Global (MOLA, 15 km)")},
    BundledMap{"mount_st_helens_30m.tif",
               QT_TRANSLATE_NOOP("marsview::FileOpening", "Mount &St. Helens, Earth (30 m)")},
};

} // namespace

QStringList filesIn(const QMimeData& data)
{
    QStringList files;
    for (const QUrl& url : data.urls()) {
        if (const auto path = localPathOf(url.toString(QUrl::FullyEncoded).toStdString());
            url.isLocalFile() && path) {
            // A folder has no slash at its end.
            files.append(QDir::cleanPath(QString::fromStdString(*path)));
        } else if (problemOfAddress(url.toString()).isEmpty()) {
            files.append(url.toString());
        }
    }
    return files;
}

FileOpening::FileOpening(const Parts& parts)
    : parts_(parts)
    , recent_(new RecentFiles(*parts.actions.recent,
                              parts.is_remembered ? RecentFiles::Memory::Settings
                                                  : RecentFiles::Memory::WindowOnly,
                              this))
{
    if (parts_.is_remembered) {
        last_folder_ = QSettings().value(folderKey()).toString();
    }
    connect(parts_.actions.open, &QAction::triggered, this, &FileOpening::chooseFile);
    connect(parts_.actions.open_folder, &QAction::triggered, this, &FileOpening::chooseFolder);
    connect(parts_.actions.open_address, &QAction::triggered, this, &FileOpening::chooseAddress);
    connect(recent_, &RecentFiles::chosen, this, [this](const QString& file) { open({file}); });
    fillBundledMaps();
    connect(&parts_.session, &SessionController::opened, this, &FileOpening::remember);
}

void FileOpening::open(const QStringList& files)
{
    openFiles(files, &SessionController::open);
}

void FileOpening::openAtStart(const QStringList& files)
{
    openFiles(files, &SessionController::openAtStart);
}

void FileOpening::openFiles(const QStringList& files, OpenMaps open_maps)
{
    Q_EMIT requested();
    QStringList maps;
    QStringList vector_files;
    for (const QString& file : files) {
        (!isAddress(file) && isVectorFile(file.toStdString()) ? vector_files : maps).append(file);
    }
    if (!maps.isEmpty()) {
        openMaps(maps, open_maps);
    }
    parts_.vector_files.open(vector_files);
}

void FileOpening::openMaps(QStringList maps, OpenMaps open_maps)
{
    const auto project = std::find_if(maps.begin(), maps.end(), [](const QString& file) {
        return isProjectPath(file.toStdString()) && !isAddress(file);
    });
    if (project == maps.end()) {
        (parts_.session.*open_maps)(maps);
        return;
    }
    const QString file = *project;
    maps.erase(project);
    parts_.projects.open(file, maps);
}

void FileOpening::fillBundledMaps()
{
    QMenu& menu = *parts_.actions.bundled;
    for (const BundledMap& map : kBundledMaps) {
        const QString file = QDir(parts_.bundled_maps).filePath(QString::fromLatin1(map.file));
        if (!parts_.bundled_maps.isEmpty() && QFileInfo::exists(file)) {
            connect(menu.addAction(tr(map.title)), &QAction::triggered, this,
                    [this, file] { openBundledMap(file); });
        }
    }
    menu.menuAction()->setVisible(!menu.isEmpty());
}

// Once: it is the same map.
void FileOpening::openBundledMap(const QString& file)
{
    for (const Layer& layer : parts_.session.session().layers) {
        if (QFileInfo(QString::fromStdString(layer.map->info().path)) == QFileInfo(file)) {
            const LayerId id = layer.id;
            parts_.session.setVisible(id, true);
            parts_.session.activate(id);
            return;
        }
    }
    open({file});
}

bool FileOpening::isBundled(const QString& file) const
{
    return !parts_.bundled_maps.isEmpty() &&
           QFileInfo(file).absolutePath() == QFileInfo(parts_.bundled_maps).absoluteFilePath();
}

void FileOpening::remember(const QString& file)
{
    if (isBundled(file)) {
        return; // has its own menu, and its folder is the program's
    }
    recent_->add(file);
    if (isAddress(file) || isGdalName(file.toStdString())) {
        return;
    }
    last_folder_ = QFileInfo(file).absolutePath();
    if (parts_.is_remembered) {
        QSettings().setValue(folderKey(), last_folder_);
    }
}

QStringList FileOpening::rasterFilters()
{
    return {tr("Elevation maps and projects (*.mvproj *.tif *.tiff *.lbl *.img *.cub *.hgt *.dem "
               "*.asc *.flt *.hdr *.bil "
               "*.nc *.cdf *.dt0 *.dt1 *.dt2 *.vrt *.xml *.zip)"),
            tr("All files (*)")};
}

void FileOpening::chooseFile()
{
    auto* dialog = new QFileDialog(&parts_.window, tr("Open Map"), last_folder_);
    dialog->setFileMode(QFileDialog::ExistingFiles);
    dialog->setNameFilters(rasterFilters());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::filesSelected, this, &FileOpening::open);
    dialog->open();
}

void FileOpening::chooseFolder()
{
    auto* dialog = new QFileDialog(&parts_.window, tr("Open Folder of Rasters"), last_folder_);
    dialog->setFileMode(QFileDialog::Directory);
    // Most dialogs of desktops hide the files of a folder; people choose it by its files.
    dialog->setOption(QFileDialog::DontUseNativeDialog);
    dialog->setOption(QFileDialog::ShowDirsOnly, false);
    dialog->setNameFilters(rasterFilters());
    //: On a button: open all rasters in a folder as one map
    dialog->setLabelText(QFileDialog::Accept, tr("Open Folder"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::filesSelected, &parts_.session, &SessionController::open);
    dialog->open();
}

void FileOpening::chooseAddress()
{
    QStringList history;
    for (const QString& file : recent_->files()) {
        if (isAddress(file)) {
            history.append(file);
        }
    }
    auto* dialog = new AddressDialog(history, &parts_.window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &AddressDialog::addressChosen, this,
            [this](const QString& address) { open({address}); });
    dialog->open();
}

} // namespace marsview
