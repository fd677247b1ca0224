#include "ui/controllers/haptics/touch_recorder.h"

#include "core/sources/output_check.h"
#include "haptics/terrain/servo_map.h"

#include <utility>

namespace marsview {

TouchRecorder::TouchRecorder(DeviceSession& device,
                             std::function<std::shared_ptr<ServoMap>()> make_map,
                             QObject* parent)
    : QObject(parent)
    , device_(device)
    , make_map_(std::move(make_map))
    , jobs_(*this)
{
    connect(&device_, &DeviceSession::runningChanged, this, &TouchRecorder::changed);
}

Status TouchRecorder::start(const QString& file)
{
    stop();
    const auto refused = [this](Error error) {
        Q_EMIT failed(QString::fromStdString(error.message));
        return error;
    };
    if (!device_.isRunning()) {
        return refused(
            {ErrorCode::Invalid,
             tr("%1: nothing to record; connect a device and open a map").arg(file).toStdString()});
    }
    if (Status writable = checkWritable(file); !writable) {
        return refused(std::move(writable).error());
    }
    // From a model that nothing has touched yet, so that a replay has all that it needs. It begins
    // at the old one's proxy: the hand feels nothing of that.
    const std::shared_ptr<ServoMap> fresh = make_map_();
    Result<std::unique_ptr<SessionRecorder>> recorder = SessionRecorder::begin(
        *device_.loop(), file.toStdString(), fresh->serial,
        fresh->surface->body() != nullptr ? GoalColumns::Geographic : GoalColumns::Map);
    if (!recorder) {
        return refused(std::move(recorder).error());
    }
    device_.settings().map = fresh;
    device_.push();
    recorder_ = std::move(recorder).value();
    file_ = file;
    Q_EMIT changed();
    return Done{};
}

// A recording must not overwrite the open maps or the recording that is replayed.
Status TouchRecorder::checkWritable(const QString& file) const
{
    FilesInUse files{.maps = {}, .read = {}, .written = {file.toStdString()}};
    if (maps_in_use_) {
        files.maps = maps_in_use_();
    }
    if (device_.isReplaying()) {
        files.read.push_back(device_.replayedFile().toStdString());
    }
    const Result<OpenFiles> inputs = checkOutputs(files);
    return inputs ? Status(Done{}) : Status(inputs.error());
}

void TouchRecorder::stop(RecordingEnd end)
{
    if (!recorder_) {
        return;
    }
    const Status written = recorder_->finish();
    const qulonglong updates = recorder_->updates();
    recorder_.reset();
    Q_EMIT changed();
    if (written) {
        Q_EMIT recorded(file_, updates, end);
    } else {
        Q_EMIT failed(QString::fromStdString(written.error().message));
    }
}

void TouchRecorder::saveTicks(std::vector<TickRecord> ticks, const QString& file)
{
    if (const Status writable = checkWritable(file); !writable) {
        Q_EMIT savingFailed(QString::fromStdString(writable.error().message));
        return;
    }
    ticks = ofLastScene(std::move(ticks));
    SavedTicks saved{.file = file, .count = ticks.size()};
    for (std::size_t i = 1; i < ticks.size(); ++i) {
        const bool is_same_run = ticks[i].tick > ticks[i - 1].tick;
        const std::int64_t ns = ticks[i].time_ns - ticks[i - 1].time_ns;
        saved.seconds += is_same_run ? 1e-9 * static_cast<double>(ns) : 0.0;
    }
    jobs_.run([this, ticks = std::move(ticks), saved](const auto& outlet) {
        const Status written = saveFlight(ticks, saved.file.toStdString());
        const QString problem =
            written ? QString() : QString::fromStdString(written.error().message);
        outlet->post([this, saved, problem] {
            if (problem.isEmpty()) {
                Q_EMIT ticksSaved(saved);
            } else {
                Q_EMIT savingFailed(problem);
            }
        });
    });
}

} // namespace marsview
