#include "ui/controllers/haptics/device_session.h"

#include "haptics/device/home_option.h"
#include "haptics/drivers/replay_driver.h"
#include "ui/text/haptics_text.h"
#include "ui/text/sentence.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace marsview {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kPollInterval{16};
constexpr milliseconds kLookInterval{3000};

// A window has no use for the placeholder of a missing device.
bool isForWindows(const FoundDevice& device)
{
    return !device.uri.starts_with("null:");
}

QString fileOf(const QString& replay_uri)
{
    return QString::fromStdString(replayedFile(replay_uri.toStdString()));
}

bool isPlayedBack(const QString& uri)
{
    return isReplay(uri.toStdString());
}

// Why a device cannot be used, for people: a recording is named by its file.
QString reasonText(const QString& problem)
{
    const qsizetype file = isPlayedBack(problem) ? problem.indexOf(QLatin1Char(':')) + 1 : 0;
    return translatedMessage(problem.sliced(file));
}

} // namespace

DeviceSession::DeviceSession(DriverMaker make_drivers, QObject* parent)
    : QObject(parent)
    , finder_(new DeviceFinder(std::move(make_drivers), this))
{
    connect(finder_, &DeviceFinder::found, this, &DeviceSession::takeDevices);
    connect(finder_, &DeviceFinder::opened, this, &DeviceSession::start);
    connect(finder_, &DeviceFinder::refused, this, &DeviceSession::refuse);
    look_timer_.setInterval(kLookInterval);
    connect(&look_timer_, &QTimer::timeout, this, &DeviceSession::findDevices);
    poll_timer_.setInterval(kPollInterval);
    poll_timer_.setTimerType(Qt::PreciseTimer);
    connect(&poll_timer_, &QTimer::timeout, this, &DeviceSession::poll);
}

HapticsConnection DeviceSession::connection() const noexcept
{
    return isConnected(state()) ? HapticsConnection::Connected
           : isOpening(state()) ? HapticsConnection::Opening
                                : HapticsConnection::None;
}

QString DeviceSession::rememberedUri() const
{
    return QString::fromStdString(lastingUri(uri_.toStdString()));
}

// Also where its readings are recorded ("record:FILE,sim:").
bool DeviceSession::isSimulated() const
{
    return uri_.startsWith(QStringLiteral("sim:")) || uri_.contains(QStringLiteral(",sim:"));
}

bool DeviceSession::canBeStopped() const noexcept
{
    return connection() != HapticsConnection::None || isAwaiting(state());
}

void DeviceSession::findDevices()
{
    finder_->find();
}

void DeviceSession::setLooking(bool is_looking)
{
    is_looking_ = is_looking;
    look();
}

// Also unseen, for a device that is awaited.
void DeviceSession::look()
{
    const bool is_to_run =
        (is_looking_ && connection() == HapticsConnection::None) || isAwaiting(state());
    if (is_to_run == look_timer_.isActive()) {
        return;
    }
    if (is_to_run) {
        look_timer_.start();
        findDevices();
    } else {
        look_timer_.stop();
    }
}

void DeviceSession::takeDevices(const std::vector<FoundDevice>& devices)
{
    std::vector<FoundDevice> kept;
    std::copy_if(devices.begin(), devices.end(), std::back_inserter(kept), isForWindows);
    // Reasons may be long: what can be used is seen first.
    std::stable_partition(kept.begin(), kept.end(),
                          [](const FoundDevice& device) { return device.isUsable(); });
    const auto is_same = [](const FoundDevice& a, const FoundDevice& b) {
        return a.uri == b.uri && a.name == b.name && a.reason == b.reason;
    };
    if (!std::equal(kept.begin(), kept.end(), devices_.begin(), devices_.end(), is_same)) {
        devices_ = std::move(kept);
        Q_EMIT devicesChanged();
    }
    if (!isAwaiting(state())) {
        return;
    }
    const bool is_there =
        std::any_of(devices_.begin(), devices_.end(), [this](const FoundDevice& device) {
            return device.isUsable() && device.isMeantBy(awaited_uri_.toStdString());
        });
    if (!is_there) {
        transitions_.take(DeviceEvent::Missed);
    } else if (state() != DeviceState::Lost) {
        connectTo(QString(awaited_uri_)); // which is cleared by it
    }
}

void DeviceSession::connectTo(const QString& uri)
{
    if (!isPlayedBack(uri)) {
        open(uri, uri == awaited_uri_ ? DeviceEvent::AwaitedChosen : DeviceEvent::DeviceChosen);
        return;
    }
    if (connection() != HapticsConnection::None && !isPlayedBack(uri_)) {
        awaited_uri_ = rememberedUri();
    }
    open(uri, DeviceEvent::RecordingChosen);
}

void DeviceSession::connectToRemembered(const QString& uri)
{
    if (!uri.isEmpty()) {
        open(uri, isPlayedBack(uri) ? DeviceEvent::RecordingChosen : DeviceEvent::RememberedChosen);
    }
}

void DeviceSession::holdBackRemembered(const QString& uri)
{
    if (!uri.isEmpty()) {
        uri_ = uri;
        setProblem(
            tr("The program ended unexpectedly while %1 was connected. Press Connect to use it "
               "again")
                .arg(uri));
    }
}

void DeviceSession::open(const QString& uri, DeviceEvent event)
{
    endLoop();
    transitions_.take(event);
    if (event != DeviceEvent::RecordingChosen) {
        awaited_uri_.clear(); // else it is waited for as soon as a recording has ended
    }
    replay_uri_.clear();
    uri_ = uri;
    setProblem({});
    look();
    finder_->open(uri);
}

void DeviceSession::start()
{
    loop_ = std::make_unique<ServoLoop>(finder_->takeOpened());
    transitions_.take(DeviceEvent::Opened);
    Q_EMIT opened();
    Q_EMIT connectionChanged();
}

void DeviceSession::refuse(const QString& problem, bool is_absent)
{
    const DeviceState before = state();
    // Of a device that is not plugged in OpenHaptics says no more than of one that is broken.
    const bool can_be_absent = is_absent || uri_.startsWith(QStringLiteral("openhaptics:"));
    transitions_.take(can_be_absent ? DeviceEvent::Absent : DeviceEvent::Refused);
    const bool is_awaited = isAwaiting(state()) && before != DeviceState::OpeningRecording;
    if (is_awaited) {
        awaited_uri_ = uri_;
    }
    const bool is_quiet = is_awaited && before == DeviceState::OpeningRemembered;
    const QString reason = reasonText(problem);
    resume(reason, is_quiet ? QString() : reason);
}

// After a recording, the device that it took the place of is connected again, if any.
void DeviceSession::resume(const QString& problem, const QString& notice)
{
    if (state() == DeviceState::Returning) {
        uri_ = std::exchange(awaited_uri_, {});
        finder_->open(uri_);
    }
    report(problem, notice);
    look();
}

void DeviceSession::setProblem(const QString& problem)
{
    report(problem, problem);
}

void DeviceSession::report(const QString& problem, const QString& notice)
{
    problem_ = problem;
    notice_ = notice;
    Q_EMIT connectionChanged();
}

QString DeviceSession::replayedFile() const
{
    return isReplaying() ? fileOf(uri_) : QString();
}

void DeviceSession::stopReplay(const QString& problem)
{
    if (isReplaying()) {
        endLoop();
        transitions_.take(DeviceEvent::RecordingOver);
        resume(problem, problem);
    }
}

QString DeviceSession::replayedToItsEnd() const
{
    return replay_uri_.isEmpty() ? QString() : fileOf(replay_uri_);
}

void DeviceSession::replayAgain()
{
    if (!replay_uri_.isEmpty()) {
        connectTo(QString(replay_uri_)); // which is cleared by it
    }
}

bool DeviceSession::canBeSetAtRest() const
{
    return loop_ != nullptr && loop_->device().can_set_home;
}

void DeviceSession::setAtRest()
{
    if (canBeSetAtRest()) {
        connectTo(rememberedUri() + QStringLiteral(",home"));
    }
}

void DeviceSession::disconnectDevice()
{
    const bool is_device = !isPlayedBack(uri_);
    replay_uri_.clear();
    awaited_uri_.clear();
    endLoop();
    transitions_.take(DeviceEvent::Disconnected);
    if (is_device) {
        Q_EMIT forgotten();
    }
    setProblem({});
    look();
}

void DeviceSession::close()
{
    endLoop();
    transitions_.take(DeviceEvent::Closed);
}

void DeviceSession::endLoop()
{
    finder_->cancelOpening();
    Q_EMIT ending();
    poll_timer_.stop();
    if (loop_) {
        loop_->stop(); // the ticks in which the force fades out are kept, too
        if (!loop_->flight().isEmpty()) {
            kept_ticks_ = loop_->flight().records();
        }
        loop_.reset();
    }
    settings_ = {};
    Q_EMIT ended();
}

void DeviceSession::push()
{
    if (!loop_) {
        return;
    }
    const bool was_running = loop_->isRunning();
    loop_->set(settings_);
    if (loop_->hasEnded()) {
        return; // which poll() reports
    }
    if (loop_->isRunning() != was_running) {
        loop_->isRunning() ? poll_timer_.start() : poll_timer_.stop();
        Q_EMIT runningChanged();
    }
}

void DeviceSession::poll()
{
    const LoopState state = loop_->state();
    LoopEvent event;
    // Of most kinds the state has the same information; reading empties the queue.
    std::vector<LoopEvent> points;
    while (loop_->nextEvent(event)) {
        if (event.kind == LoopEventKind::PointPressed ||
            event.kind == LoopEventKind::PointReleased) {
            points.push_back(event);
        }
    }
    for (const LoopEvent& point : points) {
        point.kind == LoopEventKind::PointPressed ? Q_EMIT pointPressed(point.place)
                                                  : Q_EMIT
                                                    pointReleased();
        if (!loop_) {
            return;
        }
    }
    if (loop_->hasEnded()) {
        finish(state);
    } else {
        Q_EMIT polled(state);
    }
}

void DeviceSession::finish(const LoopState& last)
{
    const QString name = deviceName(loop_->device().name);
    const std::string trouble = loop_->trouble();
    const QString uri = rememberedUri();
    const bool is_replay = isReplaying(); // may end while the force is off
    endLoop();
    if (last.reason == ForceOffReason::DeviceFinished || (is_replay && trouble.empty())) {
        transitions_.take(DeviceEvent::RecordingOver);
        replay_uri_ = uri;
        Q_EMIT replayEnded(fileOf(uri));
        resume({}, {});
        return;
    }
    const QString problem = trouble.empty() ? tr("%1 was lost; plug it in again").arg(name)
                                            //: %1 is a device, %2 a sentence about it
                                            : tr("%1 was lost: %2").arg(name, asSentence(trouble));
    if (is_replay) {
        transitions_.take(DeviceEvent::RecordingOver);
    } else {
        transitions_.take(DeviceEvent::Lost);
        awaited_uri_ = uri;
    }
    resume(problem, problem);
}

bool DeviceSession::hasTicks() const
{
    return !kept_ticks_.empty() || isRunning() || (loop_ && !loop_->flight().isEmpty());
}

std::vector<TickRecord> DeviceSession::lastTicks() const
{
    if (!loop_ || loop_->flight().isEmpty()) {
        return kept_ticks_;
    }
    std::vector<TickRecord> ticks = loop_->flight().records();
    if (isLost()) {
        ticks.insert(ticks.begin(), kept_ticks_.begin(), kept_ticks_.end());
    }
    return ticks;
}

} // namespace marsview
