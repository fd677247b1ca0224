#include "ui/views/fly_through_recorder.h"

#include "ui/canvas/picture_writer.h"
#include "ui/pictures/picture_drawing.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QPainter>
#include <QStandardPaths>

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

constexpr int kErrorBytesMax = 4096;

// What ffmpeg gets for pictures of red, green and blue on its input.
QStringList videoArguments(const RecordingOptions& options, const QString& file)
{
    return {QStringLiteral("-hide_banner"),
            QStringLiteral("-loglevel"),
            QStringLiteral("error"),
            QStringLiteral("-y"),
            QStringLiteral("-f"),
            QStringLiteral("rawvideo"),
            QStringLiteral("-pixel_format"),
            QStringLiteral("rgb24"),
            QStringLiteral("-video_size"),
            QStringLiteral("%1x%2").arg(options.size.width()).arg(options.size.height()),
            QStringLiteral("-framerate"),
            QString::number(options.frames_per_s),
            QStringLiteral("-i"),
            QStringLiteral("-"),
            QStringLiteral("-c:v"),
            QStringLiteral("libx264"),
            QStringLiteral("-crf"),
            QStringLiteral("18"),
            QStringLiteral("-pix_fmt"),
            QStringLiteral("yuv420p"),
            QStringLiteral("-movflags"),
            QStringLiteral("+faststart"),
            QStringLiteral("-f"),
            QStringLiteral("mp4"),
            file};
}

} // namespace

FlyThroughRecorder::FlyThroughRecorder(const PictureScenes& scenes, QObject* parent)
    : QObject(parent)
    , scenes_(scenes)
    , jobs_(*this)
{}

FlyThroughRecorder::~FlyThroughRecorder()
{
    end(false);
}

QString FlyThroughRecorder::videoProgram()
{
    return QStandardPaths::findExecutable(QStringLiteral("ffmpeg"));
}

QString FlyThroughRecorder::frameFile(const QString& file, int number)
{
    const QFileInfo info(file);
    return info.dir().filePath(QStringLiteral("%1_%2.png")
                                   .arg(info.completeBaseName())
                                   .arg(number, 4, 10, QLatin1Char('0')));
}

PictureScene& FlyThroughRecorder::scene() const
{
    return scenes_.of(*path_);
}

bool FlyThroughRecorder::isVideo() const
{
    return QFileInfo(file_).suffix().compare(QLatin1String("mp4"), Qt::CaseInsensitive) == 0;
}

void FlyThroughRecorder::start(CameraPath path,
                               const QString& file,
                               const RecordingOptions& options)
{
    path_ = std::move(path);
    file_ = file;
    options_ = options;
    style_ = scene().style();
    map_ = scene().topmost();
    next_ = 0;
    written_.clear();
    monitor_ = std::make_shared<JobMonitor>();
    if (isVideo()) {
        startVideo();
    } else {
        for (int i = 1; i <= options_.frame_count; ++i) {
            if (const QString frame = frameFile(file_, i); QFile::exists(frame)) {
                //: %1 is a file
                fail(tr("%1 exists already; choose another name or folder").arg(frame));
                return;
            }
        }
    }
    if (isRecording()) {
        Q_EMIT progressed(file_, 0.0);
        drawNext();
    }
}

void FlyThroughRecorder::startVideo()
{
    const QString program = videoProgram();
    if (program.isEmpty()) {
        fail(tr("The program ffmpeg is not installed; install it, or save numbered pictures"));
        return;
    }
    options_.size = {options_.size.width() & ~1, options_.size.height() & ~1};
    written_ = {file_ + QStringLiteral(".part")};
    video_errors_.clear();
    video_ = std::make_unique<QProcess>();
    QProcess* video = video_.get();
    connect(video, &QProcess::readyReadStandardError, this, [this] {
        video_errors_ = (video_errors_ + video_->readAllStandardError()).right(kErrorBytesMax);
    });
    connect(video, &QProcess::readyReadStandardOutput, video,
            [video] { video->readAllStandardOutput(); });
    connect(video, &QProcess::bytesWritten, this, [this] {
        if (isRecording() && !drawing_ && next_ < options_.frame_count &&
            video_->bytesToWrite() == 0) {
            frameWritten();
        }
    });
    connect(
        video, &QProcess::finished, this,
        [this](int exit_code, QProcess::ExitStatus status) {
            if (isRecording()) {
                finishVideo(status == QProcess::NormalExit ? exit_code : -1);
            }
        },
        Qt::QueuedConnection);
    connect(
        video, &QProcess::errorOccurred, this,
        [this](QProcess::ProcessError error) {
            if (isRecording() && error == QProcess::FailedToStart) {
                fail(tr("The program ffmpeg cannot be started; save numbered pictures instead"));
            }
        },
        Qt::QueuedConnection);
    video->start(program, videoArguments(options_, written_.front()));
}

void FlyThroughRecorder::drawNext()
{
    if (scene().topmost() != map_) {
        fail(tr("Recording stopped, because another layer is on top now"));
        return;
    }
    const double share = static_cast<double>(next_) / (options_.frame_count - 1);
    drawing_ = std::make_unique<PictureDrawing>(
        scene(), scene().cameraOn(*path_, share), options_.size,
        options_.has_labels ? PictureLines::Drawn : PictureLines::Omitted);
    drawing_->setStyle(style_);
    // Queued: the drawing is deleted when it ends.
    connect(drawing_.get(), &PictureDrawing::finished, this, &FlyThroughRecorder::take,
            Qt::QueuedConnection);
    connect(drawing_.get(), &PictureDrawing::failed, this, &FlyThroughRecorder::fail,
            Qt::QueuedConnection);
}

void FlyThroughRecorder::take(QImage picture)
{
    if (!drawing_) {
        return; // it was canceled as it was finished
    }
    drawing_.reset();
    const double share = static_cast<double>(next_) / (options_.frame_count - 1);
    QPainter painter(&picture);
    for (const PicturePart& part : scene().partsFor(scene().cameraOn(*path_, share), options_.size,
                                                    {.has_legend = options_.has_legend,
                                                    .has_scale = false, // of the window's camera
                                                     .has_labels = options_.has_labels,
                                                    .has_marks = false})) {
        painter.drawImage(part.at, part.image);
    }
    painter.end();
    writeFrame(std::move(picture));
}

void FlyThroughRecorder::writeFrame(QImage picture)
{
    if (video_) {
        const auto line = static_cast<qsizetype>(picture.width()) * 3;
        QByteArray pixels;
        pixels.reserve(line * picture.height());
        for (int y = 0; y < picture.height(); ++y) {
            pixels.append(reinterpret_cast<const char*>(picture.constScanLine(y)), line);
        }
        video_->write(pixels); // bytesWritten() goes on
        return;
    }
    const QString file = frameFile(file_, next_ + 1);
    written_.append(file);
    jobs_.run([this, picture = std::move(picture), file, monitor = monitor_](const auto& outlet) {
        const Status written = writePictureFile(picture, file, monitor.get());
        const QString problem =
            written ? QString() : QString::fromStdString(written.error().message);
        if (monitor->isCanceled()) {
            QFile::remove(file);
        }
        outlet->post([this, problem, monitor] {
            if (monitor != monitor_) {
                return; // canceled
            }
            if (!problem.isEmpty()) {
                fail(problem);
                return;
            }
            frameWritten();
        });
    });
}

void FlyThroughRecorder::frameWritten()
{
    ++next_;
    Q_EMIT progressed(file_, static_cast<double>(next_) / options_.frame_count);
    if (!isRecording()) {
        return;
    }
    if (next_ < options_.frame_count) {
        drawNext();
    } else if (video_) {
        video_->closeWriteChannel(); // finishVideo() follows
    } else {
        const QString first = frameFile(file_, 1);
        end(true);
        Q_EMIT saved(first);
    }
}

void FlyThroughRecorder::finishVideo(int exit_code)
{
    const QString part = written_.front();
    if (exit_code != 0 || next_ < options_.frame_count) {
        const QByteArrayList lines = video_errors_.trimmed().split('\n');
        //: %1 is a file, %2 what ffmpeg says
        fail(tr("%1: the video cannot be written (%2); choose another folder, or save numbered "
                "pictures")
                 .arg(file_, QString::fromLocal8Bit(lines.constLast())));
        return;
    }
    QFile::remove(file_);
    if (!QFile::rename(part, file_)) {
        //: %1 is a file
        fail(tr("%1: the video cannot be written; choose another folder").arg(file_));
        return;
    }
    const QString file = file_;
    end(true);
    Q_EMIT saved(file);
}

void FlyThroughRecorder::fail(const QString& problem)
{
    if (isRecording()) {
        end(false);
        Q_EMIT failed(problem);
    }
}

void FlyThroughRecorder::cancel()
{
    if (isRecording()) {
        end(false);
        Q_EMIT canceled();
    }
}

void FlyThroughRecorder::end(bool is_complete)
{
    if (monitor_) {
        monitor_->cancel();
    }
    monitor_.reset();
    drawing_.reset();
    if (video_) {
        video_->disconnect(this);
        if (video_->state() != QProcess::NotRunning) {
            video_->kill();
            video_->waitForFinished(1000);
        }
        video_.release()->deleteLater(); // it may be the sender
    }
    if (!is_complete) {
        for (const QString& file : std::as_const(written_)) {
            QFile::remove(file);
        }
    }
    written_.clear();
    path_.reset();
}

} // namespace marsview
