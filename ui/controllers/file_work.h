// Files that are read or written in the background, for the status bar.
#pragma once

#include "core/base/job_monitor.h"

#include <QElapsedTimer>
#include <QObject>
#include <QString>
#include <QTimer>

#include <memory>
#include <vector>

namespace marsview {

/// The jobs that run, with their progress. Jobs that end within a moment are not reported. GUI
/// thread.
class FileWork final : public QObject {
    Q_OBJECT

public:
    explicit FileWork(QObject* parent = nullptr);

    /// A job of `owner` begins, with the monitor that is returned. `text` says what is done with
    /// the file: "Reading FILE".
    std::shared_ptr<JobMonitor>
    begin(const QObject& owner, const QString& text, const QString& file);
    /// The job with that monitor has ended.
    void end(const std::shared_ptr<JobMonitor>& monitor);
    bool isBusy() const noexcept { return !jobs_.empty(); }
    /// Whether progressed() was emitted, and ended() not yet.
    bool isReported() const noexcept { return is_reported_; }
    /// Cancels all of them.
    void cancel();
    /// Those of an owner that goes.
    void cancelOf(const QObject& owner);

Q_SIGNALS:
    /// Of the job that began first: `share` of it is done.
    void progressed(const QString& text, const QString& file, double share);
    /// No job runs, after progressed() was emitted.
    void ended();
    /// No job runs.
    void idle();

private:
    struct Job {
        const QObject* owner = nullptr;
        QString text;
        QString file;
        std::shared_ptr<JobMonitor> monitor;
        QElapsedTimer since;
    };

    void report();

    std::vector<Job> jobs_;
    QTimer timer_; // runs while jobs do
    bool is_reported_ = false;
};

} // namespace marsview
