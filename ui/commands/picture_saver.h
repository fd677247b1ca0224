// Saving a picture of the map: size, contents, file.
#pragma once

#include "core/base/job_monitor.h"
#include "ui/controllers/detached_jobs.h"
#include "ui/dialogs/save_picture_dialog.h"
#include "ui/pictures/picture_scenes.h"

#include <QImage>
#include <QObject>
#include <QString>

#include <functional>
#include <memory>
#include <vector>

namespace marsview {

class PictureDrawing;

/// Asks for size and contents, then for a file, and writes the picture of the scene that was shown
/// when it asked: drawn between the events of the GUI thread, written on another one. One picture
/// at a time. Lives in the GUI thread; the scenes and the parent outlive it.
class PictureSaver final : public QObject {
    Q_OBJECT

public:
    enum class Memory { Settings, WindowOnly };

    PictureSaver(const PictureScenes& scenes, Memory memory, QWidget* parent);
    ~PictureSaver() override;

    /// `name` is offered for the file, without ending. Not while isSaving().
    void start(const QString& name);
    /// Draws and writes one without asking. Not while isSaving().
    void save(const QString& file, const SceneCamera& camera, const PictureChoice& choice);

    bool isSaving() const noexcept { return monitor_ != nullptr; }
    /// No file is written, or replaced. canceled() follows.
    void cancel();

    /// The folder of the last picture, at first the user's folder of pictures.
    QString folder() const;

Q_SIGNALS:
    /// `share` of the picture is drawn; 1 while it is written.
    void progressed(const QString& file, double share);
    // One of these ends it.
    void saved(const QString& file);
    void failed(const QString& problem);
    void canceled();

private:
    void chooseFile(SavePictureDialog& sizes, const QString& name, const SceneCamera& camera);
    void refuse(const QString& problem,
                SavePictureDialog& sizes,
                const std::function<void()>& ask_again);
    void write(QImage picture);
    void end();

    PictureScenes scenes_;
    Memory memory_;
    QWidget* window_ = nullptr;
    QString folder_;
    QString file_; // that is being saved
    std::vector<PicturePart> parts_;
    std::unique_ptr<PictureDrawing> drawing_; // null while it is being written
    std::shared_ptr<JobMonitor> monitor_;     // null unless isSaving()
    DetachedJobs jobs_;
};

} // namespace marsview
