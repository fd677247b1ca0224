// The contour interval, and contours as vector files, in the window.
#pragma once

#include "core/contours/contour_export.h"
#include "ui/pictures/picture_scenes.h"

#include <QObject>
#include <QString>
#include <QThreadPool>
#include <QTimer>

#include <memory>

class QAction;
class QMainWindow;
class QProgressDialog;

namespace marsview {

class SessionController;

/// Asks for the interval of the contour lines, and exports the contours of the active layer on a
/// thread of its own. GUI thread; must not outlive its parts.
class ContourTools final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        QMainWindow& window;
        SessionController& session;
        PictureScenes scenes;
        QAction& interval;
        QAction& export_contours;
    };

    explicit ContourTools(const Parts& parts, QObject* parent = nullptr);
    /// Cancels the export and waits for it.
    ~ContourTools() override;

    /// Writes the contours of the active layer, `interval_m` (> 0) apart.
    void exportTo(const QString& file, double interval_m);
    bool isExporting() const noexcept { return monitor_ != nullptr; }

Q_SIGNALS:
    void exported(const QString& file);
    /// "FILE: WHY"
    void failed(const QString& problem);

private:
    void askInterval();
    void askFile();
    double shownInterval() const;
    void end(const QString& file, const Result<ContourReport>& report);

    Parts parts_;
    QThreadPool pool_;
    std::shared_ptr<JobMonitor> monitor_; // while an export runs
    QProgressDialog* progress_ = nullptr;
    QTimer poll_timer_;
};

} // namespace marsview
