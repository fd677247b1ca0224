// Recordings of a touch, and diagnostic logs.
#pragma once

#include "haptics/trace/session_recorder.h"
#include "ui/controllers/detached_jobs.h"
#include "ui/controllers/haptics/device_session.h"
#include "ui/text/recording_report.h"

#include <QObject>
#include <QString>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace marsview {

struct ServoMap;

/// Writes what the connected device does to a file. GUI thread; the device outlives it.
class TouchRecorder final : public QObject {
    Q_OBJECT

public:
    /// `make_map` returns a new contact model of the map that the hand touches, which nothing has
    /// touched yet. It is called only while the loop runs.
    TouchRecorder(DeviceSession& device,
                  std::function<std::shared_ptr<ServoMap>()> make_map,
                  QObject* parent = nullptr);

    /// `paths` returns the files of all open maps, shown or not; recordings never overwrite them.
    void setMapsInUse(std::function<std::vector<std::string>()> paths)
    {
        maps_in_use_ = std::move(paths);
    }

    /// Records from now on, also in the middle of a touch, until stop(). Needs a running loop;
    /// failed() follows if the recording cannot begin. The file begins with the first update of a
    /// new contact model, so that `trace --goals` reproduces the proxies bit for bit; the force is
    /// continuous.
    Status start(const QString& file);
    void stop(RecordingEnd end = RecordingEnd::AsWanted);
    bool isRecording() const noexcept { return recorder_ != nullptr; }
    const QString& file() const noexcept { return file_; }
    /// Saves a diagnostic log on another thread; ticksSaved() or savingFailed() follows.
    void saveTicks(std::vector<TickRecord> ticks, const QString& file);

Q_SIGNALS:
    /// isRecording(), or whether it could.
    void changed();
    /// "FILE: WHY" of what could not be written.
    void failed(const QString& problem);
    /// A recording of so many updates is complete.
    void recorded(const QString& file, qulonglong updates, marsview::RecordingEnd end);
    void ticksSaved(const SavedTicks& saved);
    /// "FILE: WHY".
    void savingFailed(const QString& problem);

private:
    Status checkWritable(const QString& file) const;

    DeviceSession& device_;
    std::function<std::shared_ptr<ServoMap>()> make_map_;
    std::function<std::vector<std::string>()> maps_in_use_;
    std::unique_ptr<SessionRecorder> recorder_; // before the loop ends
    QString file_;
    DetachedJobs jobs_;
};

} // namespace marsview
