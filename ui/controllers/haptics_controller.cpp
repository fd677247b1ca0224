#include "ui/controllers/haptics_controller.h"

#include "core/raster/output_check.h"
#include "haptics/device/home_option.h"
#include "haptics/drivers/replay_driver.h"
#include "haptics/interaction/workspace_walls.h"
#include "ui/canvas/terrain_view.h"
#include "ui/controllers/hand_sight.h"
#include "ui/text/haptics_text.h"
#include "ui/text/sentence.h"

#include <QCoreApplication>
#include <QGuiApplication>
#include <QKeyEvent>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

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

QString lastingUri(const QString& uri)
{
    return QString::fromStdString(marsview::lastingUri(uri.toStdString()));
}

bool isEmergencyKey(const QKeyEvent& event)
{
    return event.key() == Qt::Key_Pause ||
           (event.key() == Qt::Key_Period && (event.modifiers() & Qt::ControlModifier) != 0);
}

bool isPlayedBack(const QString& uri)
{
    return isReplay(uri.toStdString());
}

// Also where its readings are recorded ("record:FILE,sim:").
bool isSimulated(const QString& uri)
{
    return uri.startsWith(QStringLiteral("sim:")) || uri.contains(QStringLiteral(",sim:"));
}

} // namespace

HapticsController::HapticsController(TerrainView& view, DriverMaker make_drivers, QObject* parent)
    : QObject(parent)
    , view_(view)
    , finder_(new DeviceFinder(std::move(make_drivers), this))
    , exaggeration_(view.exaggeration())
    , jobs_(*this)
{
    connect(finder_, &DeviceFinder::found, this, &HapticsController::takeDevices);
    connect(finder_, &DeviceFinder::opened, this, [this] { start(finder_->takeOpened()); });
    connect(finder_, &DeviceFinder::refused, this, [this](const QString& problem, bool is_absent) {
        connection_ = HapticsConnection::None;
        // Of a device that is not plugged in OpenHaptics says no more than of one that is broken.
        is_quiet_ = is_quiet_ && (is_absent || uri_.startsWith(QStringLiteral("openhaptics:")));
        if (is_quiet_ || is_coming_back_) {
            wanted_uri_ = uri_;
            was_wanted_gone_ = true;
        }
        resumeInterrupted(problem);
    });
    look_timer_.setInterval(kLookInterval);
    connect(&look_timer_, &QTimer::timeout, this, &HapticsController::findDevices);
    poll_timer_.setInterval(kPollInterval);
    poll_timer_.setTimerType(Qt::PreciseTimer);
    connect(&poll_timer_, &QTimer::timeout, this, &HapticsController::poll);
    connect(&view_, &TerrainView::layersChanged, this, &HapticsController::takeGround);
    connect(&view_, &TerrainView::exaggerationChanged, this, &HapticsController::takeExaggeration);
    connect(&view_, &TerrainView::sightChanged, this, &HapticsController::takeSight);
    // Terrain that arrived since then may be higher or lower.
    connect(&view_, &TerrainView::pictureCompleted, this, [this] {
        if (loop_ && isSimulated(uri_) && !view_.ground().isEmpty()) {
            takeStrokes();
            push();
        }
    });
    connect(&view_, &TerrainView::grabbingChanged, this, [this](bool is_grabbing) {
        is_grabbing_ = is_grabbing;
        push();
    });
    QCoreApplication::instance()->installEventFilter(this);
}

HapticsController::~HapticsController()
{
    blockSignals(true);
    excursion_.reset();
    close();
}

bool HapticsController::eventFilter(QObject* watched, QEvent* event)
{
    if (canBeStopped() &&
        (event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride) &&
        isEmergencyKey(static_cast<const QKeyEvent&>(*event))) {
        setStopped(true);
    }
    return QObject::eventFilter(watched, event);
}

void HapticsController::findDevices()
{
    finder_->find();
}

void HapticsController::setLooking(bool is_looking)
{
    is_looking_ = is_looking;
    // Also unseen, for one that was lost or is remembered.
    const bool is_to_run =
        (is_looking || !wanted_uri_.isEmpty()) && connection_ == HapticsConnection::None;
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

void HapticsController::takeDevices(const std::vector<FoundDevice>& devices)
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
    if (wanted_uri_.isEmpty() || connection_ != HapticsConnection::None) {
        return;
    }
    const bool is_there =
        std::any_of(devices_.begin(), devices_.end(), [this](const FoundDevice& device) {
            return device.isUsable() && device.isMeantBy(wanted_uri_.toStdString());
        });
    if (is_there && was_wanted_gone_) {
        connectTo(QString(wanted_uri_)); // which is cleared by it
    }
    was_wanted_gone_ = was_wanted_gone_ || !is_there;
}

void HapticsController::connectTo(const QString& uri)
{
    const bool is_back = is_lost_ && uri == wanted_uri_; // what happened to it is still of use
    if (!isPlayedBack(uri)) {
        interrupted_uri_.clear();
        wanted_uri_.clear(); // else it is waited for as soon as the recording has ended
    } else if (connection_ != HapticsConnection::None && !isPlayedBack(uri_)) {
        interrupted_uri_ = lastingUri(uri_);
    }
    close();
    if (!is_back) {
        is_lost_ = false;
    }
    is_quiet_ = false;
    is_coming_back_ = false;
    replay_uri_.clear();
    uri_ = uri;
    connection_ = HapticsConnection::Opening;
    setProblem({});
    setLooking(is_looking_);
    finder_->open(uri);
}

void HapticsController::connectToRemembered()
{
    if (!settings_.device.isEmpty()) {
        connectTo(QString(settings_.device));
        is_quiet_ = true;
    }
}

void HapticsController::holdBackRemembered()
{
    if (!settings_.device.isEmpty()) {
        uri_ = settings_.device;
        setProblem(
            tr("The program ended unexpectedly while %1 was connected. Press Connect to use it "
               "again")
                .arg(settings_.device));
    }
}

bool HapticsController::isReplaying() const
{
    return connection_ == HapticsConnection::Connected && isPlayedBack(uri_);
}

bool HapticsController::canBeSetAtRest() const
{
    return connection_ == HapticsConnection::Connected && loop_ != nullptr &&
           loop_->device().can_set_home;
}

void HapticsController::stopReplay()
{
    if (isReplaying()) {
        close();
        resumeInterrupted({});
    }
}

QString HapticsController::replayedToItsEnd() const
{
    return replay_uri_.isEmpty() ? QString()
                                 : QString::fromStdString(replayedFile(replay_uri_.toStdString()));
}

void HapticsController::replayAgain()
{
    if (!replay_uri_.isEmpty()) {
        connectTo(QString(replay_uri_));
    }
}

void HapticsController::setAtRest()
{
    if (canBeSetAtRest()) {
        connectTo(lastingUri(uri_) + QStringLiteral(",home"));
    }
}

void HapticsController::disconnectDevice()
{
    replay_uri_.clear();
    wanted_uri_.clear();
    interrupted_uri_.clear();
    const bool is_device = !isPlayedBack(uri_);
    close();
    is_lost_ = false;
    if (is_device) {
        HapticsSettings settings = settings_;
        settings.device.clear();
        setSettings(settings);
        setStopped(false); // nothing is left that could push
    }
    setProblem({});
    setLooking(is_looking_);
}

void HapticsController::start(std::unique_ptr<HapticDevice> device)
{
    loop_ = std::make_unique<ServoLoop>(std::move(device));
    connection_ = HapticsConnection::Connected;
    is_quiet_ = false;
    if (!isPlayedBack(uri_)) {
        HapticsSettings settings = settings_;
        settings.device = lastingUri(uri_);
        setSettings(settings);
    }
    loop_settings_ = {};
    hand_map_.reset();
    takeGround();
    Q_EMIT connectionChanged();
}

// Whatever the connection is, there is none after this.
void HapticsController::close()
{
    finder_->cancelOpening();
    replay_fit_.reset();
    returnCamera();
    stopRecording();
    poll_timer_.stop();
    keepTicks();
    loop_.reset();
    hand_map_.reset();
    loop_settings_ = {};
    view_.showDevice(std::nullopt);
    connection_ = HapticsConnection::None;
}

void HapticsController::setProblem(const QString& problem)
{
    problem_ = problem;
    Q_EMIT connectionChanged();
}

void HapticsController::poll()
{
    const LoopState state = loop_->state();
    LoopEvent event;
    while (loop_->nextEvent(event)) {
        // The state has the same information; reading empties the queue.
    }
    if (loop_->hasEnded()) {
        finishLost(state);
        return;
    }
    if (state.tick > 0) {
        followHand(state);
        showHand(state);
        keepReplayInPicture(state);
        chooseMap(state);
    }
    Q_EMIT polled(state);
}

void HapticsController::finishLost(const LoopState& state)
{
    const QString name = QString::fromStdString(loop_->device().name);
    const std::string trouble = loop_->trouble();
    const QString uri = lastingUri(uri_);
    close();
    const bool is_replay = isPlayedBack(uri); // may end while the force is off
    if (state.reason == ForceOffReason::DeviceFinished || (is_replay && trouble.empty())) {
        replay_uri_ = uri;
        Q_EMIT replayEnded(QString::fromStdString(replayedFile(uri.toStdString())));
        resumeInterrupted({});
        return;
    }
    const QString problem = trouble.empty() ? tr("%1 was lost; plug it in again").arg(name)
                                            //: %1 is a device, %2 a sentence about it
                                            : tr("%1 was lost: %2").arg(name, asSentence(trouble));
    if (is_replay) {
        resumeInterrupted(problem);
        return;
    }
    wanted_uri_ = uri; // once it is there again
    was_wanted_gone_ = false;
    is_lost_ = true;
    setProblem(problem);
    setLooking(is_looking_);
}

// A recording has ended: the device that it replaced, if any, is connected again.
void HapticsController::resumeInterrupted(const QString& problem)
{
    if (!interrupted_uri_.isEmpty()) {
        const QString replayed = replay_uri_;
        connectTo(QString(interrupted_uri_)); // which is cleared by it
        replay_uri_ = replayed;
        is_coming_back_ = true;
    }
    was_wanted_gone_ = true; // for all that was seen meanwhile
    setProblem(problem);
    setLooking(is_looking_);
}

// With the ticks in which the force faded out.
void HapticsController::keepTicks()
{
    if (loop_) {
        loop_->stop();
        if (!loop_->flight().isEmpty()) {
            kept_ticks_ = loop_->flight().records();
        }
    }
}

bool HapticsController::hasTicks() const
{
    return !kept_ticks_.empty() || canRecord() || (loop_ && !loop_->flight().isEmpty());
}

std::vector<TickRecord> HapticsController::lastTicks() const
{
    if (!loop_ || loop_->flight().isEmpty()) {
        return kept_ticks_;
    }
    std::vector<TickRecord> ticks = loop_->flight().records();
    if (is_lost_) {
        ticks.insert(ticks.begin(), kept_ticks_.begin(), kept_ticks_.end());
    }
    return ticks;
}

void HapticsController::saveTicks(std::vector<TickRecord> ticks, const QString& file)
{
    if (const Status writable = checkWritable(file); !writable) {
        Q_EMIT savingFailed(QString::fromStdString(writable.error().message));
        return;
    }
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

void HapticsController::setSettings(const HapticsSettings& settings)
{
    if (settings != settings_) {
        settings_ = settings;
        push();
        Q_EMIT settingsChanged();
    }
}

double HapticsController::stiffnessMax() const
{
    return loop_ && loop_->device().stiffness_n_per_m_max > 0.0
               ? std::clamp(loop_->device().stiffness_n_per_m_max, kStiffnessMin, kStiffnessMax)
               : kStiffnessMax;
}

void HapticsController::setContactModel(ContactModelKind kind)
{
    if (kind != model_) {
        model_ = kind;
        makeMapAgain();
        push();
        tellReplay();
    }
}

void HapticsController::setStopped(bool is_stopped)
{
    if (is_stopped != is_stopped_) {
        is_stopped_ = is_stopped;
        push();
        Q_EMIT stoppedChanged(is_stopped);
    }
}

Status HapticsController::startRecording(const QString& file)
{
    stopRecording();
    const auto refused = [this](Error error) {
        Q_EMIT recordingFailed(QString::fromStdString(error.message));
        return error;
    };
    if (!canRecord()) {
        return refused(
            {ErrorCode::Invalid,
             tr("%1: nothing to record; connect a device and open a map").arg(file).toStdString()});
    }
    if (Status writable = checkWritable(file); !writable) {
        return refused(std::move(writable).error());
    }
    // From a model that nothing has touched yet, so that a replay has all that it needs. It begins
    // at the old one's proxy: the hand feels nothing of that.
    const std::shared_ptr<ServoMap> fresh = hand_map_->make(model_, exaggeration_);
    Result<std::unique_ptr<SessionRecorder>> recorder =
        SessionRecorder::begin(*loop_, file.toStdString(), fresh->serial);
    if (!recorder) {
        return refused(std::move(recorder).error());
    }
    loop_settings_.map = fresh;
    push();
    recorder_ = std::move(recorder).value();
    recording_file_ = file;
    Q_EMIT recordingChanged();
    return Done{};
}

// A recording must not overwrite the open maps or the recording that is replayed.
Status HapticsController::checkWritable(const QString& file) const
{
    FilesInUse files{.maps = {}, .read = {}, .written = {file.toStdString()}};
    if (maps_in_use_) {
        files.maps = maps_in_use_();
    }
    if (isReplaying()) {
        files.read.push_back(replayedFile(uri_.toStdString()));
    }
    return checkOutputs(files);
}

void HapticsController::stopRecording(RecordingEnd end)
{
    if (!recorder_) {
        return;
    }
    const Status written = recorder_->finish();
    const qulonglong updates = recorder_->updates();
    recorder_.reset();
    Q_EMIT recordingChanged();
    if (written) {
        Q_EMIT recorded(recording_file_, updates, end);
    } else {
        Q_EMIT recordingFailed(QString::fromStdString(written.error().message));
    }
}

// The hand stays on its map as long as that is shown, and begins on the uppermost.
void HapticsController::takeGround()
{
    if (!loop_) {
        return;
    }
    const auto& maps = view_.ground().maps();
    if (maps.empty()) {
        stopRecording(RecordingEnd::WithItsMap);
        hand_map_.reset();
        loop_settings_.map = nullptr;
        push();
        view_.showDevice(std::nullopt);
        checkReplay();
        return;
    }
    const bool is_kept =
        hand_map_ && std::any_of(maps.begin(), maps.end(),
                                 [this](const SceneMap& map) { return hand_map_->isOf(map); });
    exaggeration_ = view_.exaggeration();
    takeSight();
    if (!is_kept) {
        setMap(0);
    }
    checkReplay();
}

// Whether the recording matches the current maps.
void HapticsController::checkReplay()
{
    replay_fit_.reset();
    if (!isReplaying()) {
        return;
    }
    tellReplay();
    std::vector<std::shared_ptr<const Georeference>> maps;
    for (const SceneMap& map : view_.ground().maps()) {
        maps.emplace_back(map.map, &map.map->georeference());
    }
    if (maps.empty()) {
        return; // it waits for one
    }
    // Reading may take a while.
    jobs_.run([this, uri = uri_, check = ++replay_check_, maps = std::move(maps)](const auto& to) {
        Result<ReplayFit> fit = replayFit(replayedFile(uri.toStdString()), maps);
        if (!fit) {
            return; // it could be opened, and has gone since: there is nothing to compare
        }
        to->post([this, check, fit = std::move(fit).value()] {
            if (check == replay_check_ && isReplaying()) {
                replay_fit_ = fit;
                tellReplay();
            }
        });
    });
}

// Again whenever the map is touched in another way.
void HapticsController::tellReplay()
{
    if (!isReplaying()) {
        return;
    }
    const QString file = QString::fromStdString(replayedFile(uri_.toStdString()));
    const TouchedGround ground{
        .kind = model_,
        .radius_m = loop_settings_.map ? loop_settings_.map->radius_m : 1.0,
        .exaggeration = exaggeration_,
    };
    const QString text = replay_fit_ ? replayText(file, *replay_fit_, ground) : QString();
    if (replay_fit_ && replay_fit_->isElsewhere()) {
        close();
        resumeInterrupted(text);
    } else if (text != problem_) {
        setProblem(text);
    }
}

void HapticsController::setMap(std::size_t index)
{
    stopRecording(RecordingEnd::WithItsMap);
    hand_map_ = std::make_unique<TouchMap>(view_.ground().maps()[index]);
    loop_settings_.map = hand_map_->make(model_, exaggeration_);
    push();
}

// The map is the same; the HIP continues at its position.
void HapticsController::makeMapAgain()
{
    if (hand_map_) {
        loop_settings_.map = hand_map_->make(model_, exaggeration_); // recordings continue
    }
}

void HapticsController::takeExaggeration()
{
    if (view_.exaggeration() != exaggeration_) {
        exaggeration_ = view_.exaggeration();
        makeMapAgain(); // pushed together with the frame: no update sees one without the other
        takeSight();
        push();
        tellReplay();
    }
}

// Where several maps are shown, what lies uppermost below the hand is touched.
void HapticsController::chooseMap(const LoopState& state)
{
    const SceneSurface& ground = view_.ground();
    if (ground.maps().size() < 2 || !hand_map_ || recorder_) {
        return;
    }
    // Where the hand is: the goal never leaves the map that it touches.
    const ScenePoint hand = state.frame.toScene(state.hand);
    const auto index = ground.mapAt(hand.x, hand.y);
    if (index && !hand_map_->isOf(ground.maps()[*index])) {
        setMap(*index);
    }
}

// The user or a flight moved the camera: the workspace is mapped to the visible area again.
void HapticsController::takeSight()
{
    if (!loop_ || is_following_ || view_.ground().isEmpty()) {
        return;
    }
    hand_view_ = {.camera = view_.camera(),
                  .frame = frameForSight(view_.camera(), view_.viewport(), view_.ground(),
                                         view_.exaggeration(), loop_->device().workspace)};
    loop_settings_.frame = hand_view_.frame;
    loop_settings_.frame_origin = FrameOrigin::View;
    loop_settings_.fit.reset();
    is_fitted_ = true;
    ++loop_settings_.frame_number;
    takeBounds();
    takeStrokes();
    push();
}

// The hand moves the map within the limits of the camera.
void HapticsController::takeBounds()
{
    const SceneSurface& ground = view_.ground();
    const NavigationLimits limits =
        navigationLimits(ground.box(view_.exaggeration()), ground.pixelMeters());
    loop_settings_.view_bounds = boundsFor(hand_view_, limits);
    boundZoom(hand_view_, limits, loop_settings_.modes);
}

// The hand has moved the map and left it at rest: in free space, the tick fits the workspace to the
// view again.
void HapticsController::takeFit(const LoopState& state)
{
    if (is_fitted_ || isHolding(state.mode)) {
        return;
    }
    is_fitted_ = true;
    loop_settings_.fit =
        WorkspaceFit{.seen = hand_view_.frame,
                     .fitted = frameForSight(view_.camera(), view_.viewport(), view_.ground(),
                                             view_.exaggeration(), loop_->device().workspace)};
    push();
}

// Keeps the strokes of a simulated hand within the picture; without terrain in sight they stay.
void HapticsController::takeStrokes()
{
    if (!isSimulated(uri_)) {
        return;
    }
    if (const auto strokes =
            strokesInSight(view_.camera(), view_.viewport(), view_.ground(), view_.exaggeration(),
                           hand_view_.frame, reachWithin(loop_->device().workspace))) {
        loop_settings_.strokes = strokes;
    }
}

// The device has moved the map: the camera follows within its limits, and beyond them the device's
// frame returns to the camera.
void HapticsController::followHand(const LoopState& state)
{
    if (state.frame_number != loop_settings_.frame_number) {
        return;
    }
    if (state.seen_frame == hand_view_.frame) {
        takeFit(state);
        return;
    }
    is_fitted_ = false;
    const OrbitCamera wanted = cameraFollowing(hand_view_, state.seen_frame);
    const bool is_replay = isReplaying();
    if (is_replay && (!excursion_ || excursion_->sent_to != view_.cameraGoal())) {
        excursion_ = Excursion{.before = view_.cameraGoal(), .sent_to = {}};
    }
    is_following_ = true;
    view_.setCamera(wanted);
    is_following_ = false;
    if (is_replay) {
        excursion_->sent_to = view_.cameraGoal();
    }
    const LimitedView limited =
        limitedView({.camera = wanted, .frame = state.seen_frame}, view_.camera());
    hand_view_ = limited.view;
    if (limited.is_moved) {
        loop_settings_.frame = hand_view_.frame;
        loop_settings_.frame_origin = FrameOrigin::Limit;
        ++loop_settings_.frame_number;
        takeBounds();
        takeStrokes();
        push();
    }
}

void HapticsController::showHand(const LoopState& state)
{
    const ContactState& contact = state.contact;
    const Vec3 force_n =
        state.frame.differenceToScene(state.force_n) * (1.0 / state.frame.scene_per_meter);
    // At the edge of the map, too, the cursor stays behind and its spring leads to the hand.
    const bool is_held_back = contact.is_in_contact || state.is_at_edge;
    view_.showDevice(StylusPose{.mode = state.mode,
                                .proxy = is_held_back ? contact.proxy : state.goal,
                                .goal = state.goal,
                                .is_in_contact = is_held_back,
                                .force_n = force_n,
                                .force_n_max = loop_->device().force_n_peak});
}

// A recording contains the device's positions and what it did to the map, but not the camera.
void HapticsController::keepReplayInPicture(const LoopState& state)
{
    const bool is_user_moving = view_.isMoving() || QGuiApplication::mouseButtons() != Qt::NoButton;
    if (isReplaying() && !is_user_moving && state.contact.is_in_contact &&
        !view_.isInPicture(state.contact.proxy)) {
        if (!excursion_ || excursion_->sent_to != view_.cameraGoal()) {
            excursion_ = Excursion{.before = view_.cameraGoal(), .sent_to = {}};
        }
        view_.flyToPlace(state.contact.proxy);
        excursion_->sent_to = view_.cameraGoal();
    }
}

// Unless the user has moved the camera since the replay did: then it stays.
void HapticsController::returnCamera()
{
    if (excursion_ && excursion_->sent_to == view_.cameraGoal()) {
        view_.flyTo(excursion_->before);
    }
    excursion_.reset();
}

void HapticsController::push()
{
    if (!loop_) {
        return;
    }
    loop_settings_.stiffness_n_per_m = settings_.stiffness_n_per_m;
    loop_settings_.force_share = settings_.force_share;
    loop_settings_.has_walls = settings_.has_walls;
    loop_settings_.is_stopped = is_stopped_;
    loop_settings_.is_grabbing = is_grabbing_;
    const bool was_running = loop_->isRunning();
    loop_->set(loop_settings_);
    if (loop_->hasEnded()) {
        return; // which poll() reports
    }
    if (loop_->isRunning() != was_running) {
        loop_->isRunning() ? poll_timer_.start() : poll_timer_.stop();
        Q_EMIT recordingChanged();
    }
}

} // namespace marsview
