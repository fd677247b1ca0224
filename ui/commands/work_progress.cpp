#include "ui/commands/work_progress.h"

#include "ui/canvas/terrain_view.h"
#include "ui/commands/picture_saver.h"
#include "ui/controllers/file_work.h"
#include "ui/controllers/session_controller.h"
#include "ui/report/report_exporter.h"
#include "ui/text/number_text.h"
#include "ui/views/fly_through_recorder.h"
#include "ui/window/load_status.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_messages.h"

#include <QAction>
#include <QFileInfo>

namespace marsview {

WorkProgress::WorkProgress(const Parts& parts)
    : parts_(parts)
{
    connect(parts_.actions.cancel_loading, &QAction::triggered, this, [this] {
        if (parts_.session.isBusy()) {
            parts_.session.cancel();
            return;
        }
        parts_.files.cancel();
        parts_.pictures.cancel();
        parts_.recordings.cancel();
        parts_.reports.cancel();
    });
    connect(&parts_.view, &TerrainView::ready, this, &WorkProgress::settleIfIdle,
            Qt::QueuedConnection);
    for (PictureScene* scene : {&parts_.scenes.flat, &parts_.scenes.globe}) {
        connect(scene, &PictureScene::pictureCompleted, this, &WorkProgress::settleIfIdle);
    }
    followLoading();
    followFiles();
    followPreparing();
    followSaving();
}

void WorkProgress::followLoading()
{
    SessionController& session = parts_.session;
    connect(&parts_.status, &LoadStatus::cancelRequested, &session, &SessionController::cancel);
    connect(&session, &SessionController::loadProgressed, this, [this](const LoadReport& report) {
        parts_.status.showReport(report);
        //: Shown in the middle of the window while the first map comes; %1 is a file
        parts_.view.setHint(tr("Opening %1…").arg(isolated(QFileInfo(report.file).fileName())));
        showCancel();
    });
    connect(&session, &SessionController::loadingEnded, this, [this] {
        parts_.status.endLoading();
        parts_.view.setHint({});
        showCancel();
        settleIfIdle();
    });
    connect(&session, &SessionController::loadingCanceled, this, [this] {
        //: In the status bar, for a few seconds
        parts_.messages.show(tr("Loading canceled"));
    });
    connect(&session, &SessionController::failed, this, [this](const QString& problem) {
        parts_.messages.report(tr("Cannot Open Map"), problem);
    });
}

void WorkProgress::followFiles()
{
    connect(&parts_.status, &LoadStatus::cancelFileWorkRequested, &parts_.files, &FileWork::cancel);
    connect(&parts_.files, &FileWork::progressed, this,
            [this](const QString& text, const QString& file, double share) {
                parts_.status.showFileWork(text, file, share);
                if (parts_.session.session().layers.empty()) { // a project comes
                    parts_.view.setHint(text);
                }
                showCancel();
            });
    connect(&parts_.files, &FileWork::ended, this, [this] {
        parts_.status.endFileWork();
        if (!parts_.session.isBusy()) {
            parts_.view.setHint({});
        }
        showCancel();
    });
    connect(&parts_.files, &FileWork::idle, this, &WorkProgress::settleIfIdle);
}

void WorkProgress::followPreparing()
{
    SessionController& session = parts_.session;
    connect(&parts_.status, &LoadStatus::stopPreparingRequested, &session,
            &SessionController::stopPreparing);
    connect(parts_.actions.stop_preparing, &QAction::triggered, &session,
            &SessionController::stopPreparing);
    connect(&session, &SessionController::preparingProgressed, this,
            [this](const PrepareProgress& progress) {
                parts_.status.showPreparing(progress);
                parts_.actions.stop_preparing->setEnabled(true);
            });
    connect(&session, &SessionController::preparingEnded, this, [this] {
        parts_.status.endPreparing();
        parts_.actions.stop_preparing->setEnabled(false);
        settleIfIdle();
    });
}

void WorkProgress::followSaving()
{
    connect(&parts_.session, &SessionController::sessionChanged, this,
            &WorkProgress::showSavePicture);
    showSavePicture();
    connect(parts_.actions.save_picture, &QAction::triggered, this, [this] {
        const Layer* active = activeLayer(parts_.session.session());
        parts_.pictures.start(
            active != nullptr ? QFileInfo(QString::fromStdString(active->name)).completeBaseName()
                              : tr("map"));
    });
    follow(parts_.pictures, tr("Cannot Save Picture"));
    follow(parts_.recordings, tr("Cannot Record Fly-Through"));
    follow(parts_.reports, tr("Cannot Export Report"));
}

template <typename Saver>
void WorkProgress::follow(Saver& saver, const QString& failure_title)
{
    connect(&parts_.status, &LoadStatus::cancelSavingRequested, &saver, &Saver::cancel);
    connect(&saver, &Saver::progressed, this, [this](const QString& file, double share) {
        parts_.status.showSaving(file, share);
        showCancel();
    });
    const auto end_saving = [this] {
        parts_.status.endSaving();
        showCancel();
    };
    connect(&saver, &Saver::failed, this, end_saving);
    connect(&saver, &Saver::saved, this, end_saving);
    connect(&saver, &Saver::canceled, this, end_saving);
    connect(&saver, &Saver::canceled, this, [this] {
        //: In the status bar, for a few seconds
        parts_.messages.show(tr("Saving canceled"));
    });
    connect(&saver, &Saver::saved, &parts_.messages, &WindowMessages::showSaved);
    connect(&saver, &Saver::failed, this, [this, failure_title](const QString& problem) {
        parts_.messages.report(failure_title, problem);
    });
}

bool WorkProgress::isSaving() const
{
    return parts_.pictures.isSaving() || parts_.recordings.isRecording() ||
           parts_.reports.isExporting();
}

void WorkProgress::showCancel()
{
    const bool is_loading = parts_.session.isBusy();
    const bool is_saving = isSaving();
    QAction& cancel = *parts_.actions.cancel_loading;
    const bool is_at_files = parts_.files.isReported();
    cancel.setEnabled(is_loading || is_at_files || is_saving);
    cancel.setText(is_loading    ? tr("&Cancel Loading")
                   : is_at_files ? tr("&Cancel")
                   : is_saving   ? tr("&Cancel Saving")
                                 : tr("&Cancel Loading"));
    showSavePicture();
}

void WorkProgress::showSavePicture()
{
    parts_.actions.save_picture->setEnabled(!parts_.pictures.isSaving() &&
                                            !shownLayers(parts_.session.session()).empty());
}

bool WorkProgress::isIdle() const
{
    const SessionController& session = parts_.session;
    return !session.isBusy() && !session.isPreparing() && !parts_.files.isBusy() &&
           (shownLayers(session.session()).empty() ? parts_.view.isReady()
                                                   : parts_.scenes.shown().isComplete());
}

void WorkProgress::settleIfIdle()
{
    if (isIdle()) {
        Q_EMIT settled();
    }
}

} // namespace marsview
