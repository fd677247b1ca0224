// What the window is busy with: loading, building overviews, saving pictures, recordings, reports.
#pragma once

#include "ui/pictures/picture_scenes.h"

#include <QObject>

namespace marsview {

class FileWork;
class FlyThroughRecorder;
class LoadStatus;
class PictureSaver;
class ReportExporter;
class SessionController;
class TerrainView;
class WindowMessages;
struct WindowActions;

/// Shows it in the status bar and lets the user cancel it. GUI thread; must not outlive its parts.
class WorkProgress final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        const WindowActions& actions;
        SessionController& session;
        TerrainView& view;
        PictureScenes scenes;
        PictureSaver& pictures;
        FlyThroughRecorder& recordings;
        ReportExporter& reports;
        FileWork& files;
        LoadStatus& status;
        WindowMessages& messages;
    };

    explicit WorkProgress(const Parts& parts);

    /// Whether nothing is loading or being prepared, and the picture in the window shows all there
    /// is, or there is nothing to load.
    bool isIdle() const;
    /// Emits settled() if it is idle.
    void settleIfIdle();

Q_SIGNALS:
    /// isIdle() has become true, or a picture was completed while it was.
    void settled();

private:
    void followLoading();
    void followFiles();
    void followPreparing();
    void followSaving();
    template <typename Saver>
    void follow(Saver& saver, const QString& failure_title);
    bool isSaving() const;
    void showCancel();
    void showSavePicture();

    Parts parts_;
};

} // namespace marsview
