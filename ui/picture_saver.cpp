#include "ui/picture_saver.h"

#include "ui/canvas/picture_writer.h"
#include "ui/canvas/terrain_view.h"
#include "ui/overlay/map_overlays.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QGuiApplication>
#include <QRegularExpression>
#include <QSettings>
#include <QStandardPaths>

#include <algorithm>

namespace marsview {
namespace {

QString folderKeyOfPictures()
{
    return QStringLiteral("files/pictureFolder");
}

} // namespace

PictureSaver::PictureSaver(TerrainView& view, MapOverlays& overlays, Memory memory, QWidget* parent)
    : QObject(parent)
    , view_(view)
    , overlays_(overlays)
    , memory_(memory)
    , window_(parent)
{
    if (memory_ == Memory::Settings) {
        folder_ = QSettings().value(folderKeyOfPictures()).toString();
    }
}

QString PictureSaver::folder() const
{
    if (!folder_.isEmpty() && QFileInfo(folder_).isDir()) {
        return folder_;
    }
    const QString pictures = QStandardPaths::writableLocation(QStandardPaths::PicturesLocation);
    return QFileInfo(pictures).isDir() ? pictures : QDir::homePath();
}

void PictureSaver::start(const QString& name)
{
    const Viewport size = view_.viewport();
    PictureLimits limits;
    limits.side_max = std::max(view_.pictureSideMax(), std::max(size.width, size.height));
    // Of what is seen now: a device may move the map while the dialog is open.
    const OrbitCamera camera = view_.camera();
    auto* dialog = new SavePictureDialog({size.width, size.height}, limits, window_);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QDialog::accepted, this,
            [this, dialog, name, camera] { chooseFile(name, camera, dialog->choice()); });
    dialog->open();
}

void PictureSaver::chooseFile(const QString& name,
                              const OrbitCamera& camera,
                              const PictureChoice& choice)
{
    auto* dialog = new QFileDialog(window_, tr("Save Picture"), folder());
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setNameFilters({tr("PNG picture (*.png)"), tr("JPEG picture (*.jpg *.jpeg)"),
                            tr("TIFF picture (*.tif *.tiff)")});
    dialog->setDefaultSuffix(QStringLiteral("png"));
    dialog->selectFile(name + QStringLiteral(".png"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    // The name that is offered has the ending of the format.
    connect(dialog, &QFileDialog::filterSelected, dialog, [dialog, name](const QString& filter) {
        const QString ending = filter.section(QStringLiteral("*."), 1, 1)
                                   .section(QRegularExpression(QStringLiteral("[ )]")), 0, 0);
        dialog->setDefaultSuffix(ending);
        const QStringList files = dialog->selectedFiles();
        const QString base =
            files.isEmpty() ? name : QFileInfo(files.constFirst()).completeBaseName();
        dialog->selectFile(base + QLatin1Char('.') + ending);
    });
    connect(dialog, &QFileDialog::fileSelected, this,
            [this, camera, choice](const QString& file) { save(file, camera, choice); });
    dialog->open();
}

QImage PictureSaver::picture(const OrbitCamera& camera, const PictureChoice& choice)
{
    Result<QImage> picture = view_.drawnPicture(camera, choice.size);
    if (!picture) {
        Q_EMIT failed(QString::fromStdString(picture.error().message));
        return {};
    }
    overlays_.paintOver(*picture, {.has_legend = choice.has_legend, .has_scale = choice.has_scale});
    return *picture;
}

void PictureSaver::save(const QString& file, const OrbitCamera& camera, const PictureChoice& choice)
{
    QGuiApplication::setOverrideCursor(Qt::WaitCursor);
    const QImage picture = this->picture(camera, choice);
    const Status written = picture.isNull() ? Status(Done{}) : writePictureFile(picture, file);
    QGuiApplication::restoreOverrideCursor();
    if (picture.isNull()) {
        return; // failed() was emitted
    }
    if (!written) {
        Q_EMIT failed(QString::fromStdString(written.error().message));
        return;
    }
    folder_ = QFileInfo(file).absolutePath();
    if (memory_ == Memory::Settings) {
        QSettings().setValue(folderKeyOfPictures(), folder_);
    }
    Q_EMIT saved(file);
}

} // namespace marsview
