// What the window is busy with: loading, building overviews, saving pictures, recordings, reports.
#pragma once

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
        PictureSaver& pictures;
        FlyThroughRecorder& recordings;
        ReportExporter& reports;
        FileWork& files;
        LoadStatus& status;
        WindowMessages& messages;
    };

    explicit WorkProgress(const Parts& parts);

    /// Emits settled() if nothing is going on.
    void settleIfIdle();

Q_SIGNALS:
    /// Nothing is loading or being prepared, and the picture shows all there is, or there is
    /// nothing to load.
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

    Parts parts_;
};

} // namespace marsview
