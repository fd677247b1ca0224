#include "ui/commands/picture_saver.h"

#include "ui/canvas/picture_writer.h"
#include "ui/pictures/picture_drawing.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QPainter>
#include <QRegularExpression>
#include <QSettings>
#include <QStandardPaths>

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

QString folderKeyOfPictures()
{
    return QStringLiteral("files/pictureFolder");
}

} // namespace

PictureSaver::PictureSaver(const PictureScenes& scenes, Memory memory, QWidget* parent)
    : QObject(parent)
    , scenes_(scenes)
    , memory_(memory)
    , window_(parent)
    , jobs_(*this)
{
    if (memory_ == Memory::Settings) {
        folder_ = QSettings().value(folderKeyOfPictures()).toString();
    }
}

PictureSaver::~PictureSaver()
{
    end();
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
    PictureScene& scene = scenes_.shown();
    const Viewport size = scene.viewport();
    PictureLimits limits;
    limits.side_max = std::max(scene.sideMax(), std::max(size.width, size.height));
    // The current camera: a device may move the map while the dialog is open.
    const SceneCamera camera = scene.camera();
    auto* dialog = new SavePictureDialog({size.width, size.height}, limits, window_);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &SavePictureDialog::fileRequested, this,
            [this, dialog, name, camera] { chooseFile(*dialog, name, camera); });
    dialog->open();
}

// Over the dialog of sizes: who chooses no file is back there.
void PictureSaver::chooseFile(SavePictureDialog& sizes,
                              const QString& name,
                              const SceneCamera& camera)
{
    auto* dialog = new QFileDialog(&sizes, tr("Save Picture"), folder());
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
    connect(dialog, &QFileDialog::fileSelected, this, [this, &sizes, camera](const QString& file) {
        // Native dialogs cannot be made to check the ending.
        if (const Status known = checkPictureName(file); !known) {
            refuse(QString::fromStdString(known.error().message), sizes,
                   [this, &sizes, file, camera] {
                       chooseFile(sizes, QFileInfo(file).completeBaseName(), camera);
                   });
            return;
        }
        sizes.accept();
        save(file, camera, sizes.choice());
    });
    dialog->open();
}

// Before anything is drawn, which may take long. The name is asked for again then.
void PictureSaver::refuse(const QString& problem,
                          SavePictureDialog& sizes,
                          const std::function<void()>& ask_again)
{
    auto* box =
        new QMessageBox(QMessageBox::Warning, tr("Save Picture"), problem, QMessageBox::Ok, &sizes);
    box->setObjectName(QStringLiteral("pictureRefused"));
    box->setTextFormat(Qt::PlainText);
    box->setAttribute(Qt::WA_DeleteOnClose);
    connect(box, &QMessageBox::finished, &sizes, ask_again);
    box->open();
}

void PictureSaver::save(const QString& file, const SceneCamera& camera, const PictureChoice& choice)
{
    file_ = file;
    PictureScene& scene = scenes_.of(camera);
    parts_ = scene.partsFor(camera, choice.size,
                            {.has_legend = choice.has_legend,
                             .has_scale = choice.has_scale,
                             .has_labels = choice.has_labels,
                             .has_marks = choice.has_labels});
    monitor_ = std::make_shared<JobMonitor>();
    drawing_ = std::make_unique<PictureDrawing>(scene, camera, choice.size,
                                                choice.has_labels ? PictureLines::Drawn
                                                                  : PictureLines::Omitted);
    connect(drawing_.get(), &PictureDrawing::progressed, this,
            [this](double share) { Q_EMIT progressed(file_, share); });
    // Queued: the drawing is deleted when it ends.
    connect(drawing_.get(), &PictureDrawing::finished, this, &PictureSaver::write,
            Qt::QueuedConnection);
    connect(
        drawing_.get(), &PictureDrawing::failed, this,
        [this](const QString& problem) {
            end();
            Q_EMIT failed(problem);
        },
        Qt::QueuedConnection);
    Q_EMIT progressed(file_, 0.0);
}

void PictureSaver::write(QImage picture)
{
    if (!drawing_) {
        return; // it was canceled as it was finished
    }
    drawing_.reset();
    QPainter painter(&picture);
    for (const PicturePart& part : parts_) {
        painter.drawImage(part.at, part.image);
    }
    painter.end();
    parts_.clear();
    jobs_.run(
        [this, picture = std::move(picture), file = file_, monitor = monitor_](const auto& outlet) {
            const Status written = writePictureFile(picture, file, monitor.get());
            const QString problem =
                written ? QString() : QString::fromStdString(written.error().message);
            outlet->post([this, file, problem, monitor] {
                if (monitor != monitor_) {
                    return; // canceled
                }
                end();
                if (!problem.isEmpty()) {
                    Q_EMIT failed(problem);
                    return;
                }
                folder_ = QFileInfo(file).absolutePath();
                if (memory_ == Memory::Settings) {
                    QSettings().setValue(folderKeyOfPictures(), folder_);
                }
                Q_EMIT saved(file);
            });
        });
}

void PictureSaver::cancel()
{
    if (isSaving()) {
        end();
        Q_EMIT canceled();
    }
}

void PictureSaver::end()
{
    if (monitor_) {
        monitor_->cancel();
    }
    monitor_.reset();
    drawing_.reset();
    parts_.clear();
}

} // namespace marsview
