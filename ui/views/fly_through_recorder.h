// Recording a fly-through as numbered pictures or as a video.
#pragma once

#include "core/base/job_monitor.h"
#include "core/flight/camera_path.h"
#include "ui/controllers/detached_jobs.h"
#include "ui/pictures/picture_scenes.h"
#include "ui/render/terrain_renderer.h"

#include <QObject>
#include <QProcess>
#include <QSize>
#include <QString>
#include <QStringList>

#include <memory>
#include <optional>

namespace marsview {

class PictureDrawing;

struct RecordingOptions {
    QSize size{1920, 1080}; // pixels; even for videos
    int frames_per_s = 30;  // > 0
    int frame_count = 2;    // at least 2
    bool has_legend = true;
    bool has_labels = false; // and lines: names, graticule, measurements
};

/// Draws frame after frame at full detail between the events of the GUI thread and encodes them on
/// others: as FILE_0001.png and so on, or by the program ffmpeg for the extension .mp4. The look is
/// that at the start. Nothing is left behind unless all is written. One recording at a time. Lives
/// in the GUI thread; the scenes outlive it.
class FlyThroughRecorder final : public QObject {
    Q_OBJECT

public:
    explicit FlyThroughRecorder(const PictureScenes& scenes, QObject* parent = nullptr);
    ~FlyThroughRecorder() override;

    /// The path of ffmpeg; empty if it is not installed.
    static QString videoProgram();
    /// "flight_0001.png" for "flight.png" and number 1, in the same folder.
    static QString frameFile(const QString& file, int number);

    /// failed() follows if a picture of that name exists already. Not while isRecording().
    void start(CameraPath path, const QString& file, const RecordingOptions& options);
    bool isRecording() const noexcept { return monitor_ != nullptr; }
    /// canceled() follows.
    void cancel();

Q_SIGNALS:
    /// `share` of it is done.
    void progressed(const QString& file, double share);
    // One of these ends it.
    void saved(const QString& file);
    void failed(const QString& problem);
    void canceled();

private:
    PictureScene& scene() const;
    bool isVideo() const;
    void startVideo();
    void drawNext();
    void take(QImage picture);
    void writeFrame(QImage picture);
    void frameWritten();
    void finishVideo(int exit_code);
    void fail(const QString& problem);
    void end(bool is_complete);

    PictureScenes scenes_;
    std::optional<CameraPath> path_;
    QString file_;
    RecordingOptions options_;
    DrawStyle style_;
    const Map* map_ = nullptr;                // on top at the start
    int next_ = 0;                            // frame
    QStringList written_;                     // files, to be removed unless all is written
    std::unique_ptr<PictureDrawing> drawing_; // null while a frame is encoded
    std::unique_ptr<QProcess> video_;
    QByteArray video_errors_;
    std::shared_ptr<JobMonitor> monitor_; // null unless isRecording()
    DetachedJobs jobs_;
};

} // namespace marsview
