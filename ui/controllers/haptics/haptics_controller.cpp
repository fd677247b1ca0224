#include "ui/controllers/haptics/haptics_controller.h"

#include "haptics/drivers/replay_driver.h"
#include "ui/controllers/haptics/flat_hand_scene.h"
#include "ui/text/haptics_text.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <QGuiApplication>
#include <QKeyEvent>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

bool isEmergencyKey(const QKeyEvent& event)
{
    return event.key() == Qt::Key_Pause ||
           (event.key() == Qt::Key_Period && (event.modifiers() & Qt::ControlModifier) != 0);
}

} // namespace

HapticsController::HapticsController(TerrainView& view, DriverMaker make_drivers, QObject* parent)
    : QObject(parent)
    , flat_scene_(new FlatHandScene(view, this))
    , scene_(flat_scene_)
    , device_(new DeviceSession(std::move(make_drivers), this))
    , recorder_(new TouchRecorder(
          *device_, [this] { return scene_->make(model_); }, this))
    , exaggeration_(scene_->exaggeration())
    , jobs_(*this)
{
    connect(device_, &DeviceSession::opened, this, &HapticsController::begin);
    connect(device_, &DeviceSession::ending, this, &HapticsController::end);
    connect(device_, &DeviceSession::ended, this, &HapticsController::releaseMap);
    connect(device_, &DeviceSession::forgotten, this, &HapticsController::forget);
    connect(device_, &DeviceSession::polled, this, &HapticsController::follow);
    connect(device_, &DeviceSession::pointPressed, this,
            [this](const ScenePoint& place) { scene_->pressStylus(place); });
    connect(device_, &DeviceSession::pointReleased, this, [this] { scene_->releaseStylus(); });
    connectScene();
    QCoreApplication::instance()->installEventFilter(this);
}

void HapticsController::connectScene()
{
    connect(scene_, &HandScene::mapsChanged, this, &HapticsController::takeGround);
    connect(scene_, &HandScene::exaggerationChanged, this, &HapticsController::takeExaggeration);
    connect(scene_, &HandScene::sightChanged, this, &HapticsController::followSight);
    // Terrain that arrived since then may be higher or lower.
    connect(scene_, &HandScene::pictureCompleted, this, [this] {
        if (device_->loop() != nullptr && device_->isSimulated() && scene_->touched()) {
            takeStrokes();
            device_->push();
        }
    });
    connect(scene_, &HandScene::grabbingChanged, this, [this](bool is_grabbing) {
        is_grabbing_ = is_grabbing;
        push();
    });
    // A tool that places points has the stylus as its pointer.
    connect(scene_, &HandScene::toolChanged, this, &HapticsController::push);
}

// Without a map the loop stops. It starts again with the map and the frame of the other scene.
void HapticsController::touchOn(HandScene* scene)
{
    HandScene* const next = scene != nullptr ? scene : flat_scene_;
    if (next == scene_) {
        return;
    }
    device_->stopReplay(tr("The replay has ended: another scene is shown"));
    excursion_.reset();
    recorder_->stop(RecordingEnd::WithItsMap);
    device_->settings().map = nullptr;
    is_grabbing_ = false;
    push();
    releaseMap();
    scene_->setInUse(false);
    scene_->disconnect(this);
    scene_ = next;
    connectScene();
    scene_->setInUse(device_->loop() != nullptr);
    takeGround();
    Q_EMIT sceneChanged();
}

void HapticsController::replay(const QString& file)
{
    const auto columns = goalColumnsOf(file.toStdString());
    if (columns && (*columns == GoalColumns::Geographic) != scene_->isOnBody()) {
        device_->setProblem(otherSceneText(file));
        return;
    }
    const QString uri = QStringLiteral("replay:") + file;
    device_->connectTo(scene_->isOnBody() ? QString::fromStdString(replayOnBody(uri.toStdString()))
                                          : uri);
}

QString HapticsController::otherSceneText(const QString& file) const
{
    const QString name = QFileInfo(file).fileName();
    return scene_->isOnBody()
               //: %1 is a file
               ? tr("%1 was recorded on the flat map. Choose View › Scene › Flat Map to replay it")
                     .arg(name)
               //: %1 is a file
               : tr("%1 was recorded on the globe. Choose View › Scene › Globe to replay it")
                     .arg(name);
}

QString HapticsController::whyNoTouch() const
{
    if (device_->loop() == nullptr) {
        return {};
    }
    return device_->settings().is_covered
               ? tr("Nothing to touch here: the layer is not held in memory")
               : scene_->whyNone();
}

QString HapticsController::whyApart() const
{
    const QString why = device_->loop() != nullptr ? scene_->whyApart() : QString();
    //: %1 is the reason
    return why.isEmpty() ? why : tr("Layers are touched one by one: %1").arg(why);
}

HapticsController::~HapticsController()
{
    blockSignals(true);
    device_->blockSignals(true);
    recorder_->blockSignals(true);
    excursion_.reset();
    end();
    device_->close();
    releaseMap();
}

bool HapticsController::eventFilter(QObject* watched, QEvent* event)
{
    if (device_->canBeStopped() &&
        (event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride) &&
        isEmergencyKey(static_cast<const QKeyEvent&>(*event))) {
        setStopped(true);
    }
    return QObject::eventFilter(watched, event);
}

void HapticsController::begin()
{
    push(); // before anything is touched
    scene_->setInUse(true);
    if (!device_->isReplaying()) {
        HapticsSettings settings = settings_;
        settings.device = device_->rememberedUri();
        setSettings(settings);
    }
    takeGround();
}

void HapticsController::end()
{
    replay_fit_.reset();
    returnCamera();
    recorder_->stop();
}

void HapticsController::releaseMap()
{
    scene_->release();
    scene_->show(std::nullopt);
    if (device_->loop() == nullptr) {
        scene_->setInUse(false);
    }
}

void HapticsController::forget()
{
    HapticsSettings settings = settings_;
    settings.device.clear();
    setSettings(settings);
    setStopped(false); // nothing is left that could push
}

void HapticsController::follow(const LoopState& state)
{
    if (state.tick > 0) {
        followHand(state);
        showHand(state);
        keepReplayInPicture(state);
        chooseMap(state);
    }
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
    const ServoLoop* loop = device().loop();
    const double most = loop != nullptr ? loop->device().stiffness_n_per_m_max : 0.0;
    return most > 0.0 ? std::clamp(most, kStiffnessMin, kStiffnessMax) : kStiffnessMax;
}

void HapticsController::setContactModel(ContactModelKind kind)
{
    if (kind != model_) {
        model_ = kind;
        makeMapAgain();
        push();
        reportReplay();
    }
}

void HapticsController::setStopped(bool is_stopped)
{
    if (is_stopped != is_stopped_) {
        is_stopped_ = is_stopped;
        if (device_->loop() != nullptr && scene_->touched()) {
            takeStrokes();
        }
        push();
        Q_EMIT stoppedChanged(is_stopped);
    }
}

// The hand stays on its map as long as that is shown, and begins on the uppermost. Where its map
// was joined with one that is not shown any more, it touches what is left below it.
void HapticsController::takeGround()
{
    if (device_->loop() == nullptr) {
        return;
    }
    const std::size_t count = scene_->maps().size();
    std::size_t first = 0;
    while (first < count && !scene_->canTouch(first)) {
        ++first;
    }
    if (first == count) {
        recorder_->stop(RecordingEnd::WithItsMap);
        device_->settings().map = nullptr;
        push();
        releaseMap();
        checkReplay();
        return;
    }
    const bool is_kept = scene_->touched().has_value();
    exaggeration_ = scene_->exaggeration();
    const auto& map = device_->settings().map;
    if (is_kept && map && map->frame.exaggeration() != exaggeration_) {
        makeMapAgain();
    }
    if (!is_kept) {
        takeMap(mapBelowHand().value_or(first)); // pushed together with the frame
    }
    takeSight();
    checkReplay();
}

// Whether the recording matches the current maps.
void HapticsController::checkReplay()
{
    replay_fit_.reset();
    if (!device_->isReplaying()) {
        return;
    }
    if (isReplayOnBody(device_->uri().toStdString()) != scene_->isOnBody()) {
        device_->stopReplay(otherSceneText(device_->replayedFile()));
        return;
    }
    reportReplay();
    std::vector<std::shared_ptr<const Georeference>> maps;
    for (const auto& map : scene_->maps()) {
        maps.emplace_back(map, &map->georeference());
    }
    if (maps.empty()) {
        return; // it waits for one
    }
    const GoalColumns columns = scene_->isOnBody() ? GoalColumns::Geographic : GoalColumns::Map;
    // Reading may take a while.
    jobs_.run([this, file = device_->replayedFile(), check = ++replay_check_, columns,
               maps = std::move(maps)](const auto& to) {
        Result<ReplayFit> fit = replayFit(file.toStdString(), maps, columns);
        if (!fit) {
            return; // it could be opened, and has gone since: there is nothing to compare
        }
        to->post([this, check, fit = std::move(fit).value()] {
            if (check == replay_check_ && device_->isReplaying()) {
                replay_fit_ = fit;
                reportReplay();
            }
        });
    });
}

// Again whenever the map is touched in another way.
void HapticsController::reportReplay()
{
    if (!device_->isReplaying()) {
        return;
    }
    const QString file = device_->replayedFile();
    const TouchedGround ground{
        .kind = model_,
        .radius_m = device_->settings().map ? device_->settings().map->radius_m : 1.0,
        .exaggeration = exaggeration_,
    };
    const std::size_t map_count =
        device_->settings().map ? 1 + device_->settings().map->below.size() : 1;
    const QString text =
        replay_fit_ ? replayText(file, *replay_fit_, ground, map_count) : QString();
    if (replay_fit_ && replay_fit_->isElsewhere()) {
        device_->stopReplay(text);
    } else if (text != device_->problem()) {
        device_->setProblem(text);
    }
}

void HapticsController::takeMap(std::size_t index)
{
    recorder_->stop(RecordingEnd::WithItsMap);
    scene_->touch(index);
    device_->settings().map = scene_->make(model_);
    device_->settings().is_covered = false;
}

// The map is the same; the HIP continues at its position.
void HapticsController::makeMapAgain()
{
    if (scene_->touched()) {
        device_->settings().map = scene_->make(model_); // recordings continue
    }
}

void HapticsController::takeExaggeration()
{
    if (scene_->exaggeration() != exaggeration_) {
        exaggeration_ = scene_->exaggeration();
        makeMapAgain(); // pushed together with the frame: no update sees one without the other
        takeSight();
        push();
        reportReplay();
    }
}

// Where several maps are shown, what lies uppermost below the hand is touched, together with the
// maps that it is joined with.
void HapticsController::chooseMap(const LoopState& state)
{
    const auto touched = scene_->touched();
    if (!touched) {
        setCovered(false);
        return;
    }
    // Where the hand is: the goal never leaves the map that it touches.
    const auto index =
        scene_->maps().size() > 1 ? scene_->mapAt(state.frame.toScene(state.hand)) : touched;
    setCovered(index && !scene_->canTouch(*index));
    const std::size_t next = index && scene_->canTouch(*index) ? *index : *touched;
    if (!scene_->isTouched(next) && !recorder_->isRecording()) {
        takeMap(next);
        push();
        reportReplay();
    }
}

// Of those that can be touched, for a hand that was touching a map until now.
std::optional<std::size_t> HapticsController::mapBelowHand() const
{
    const LoopState state = device_->loop()->state();
    if (!device_->settings().map || state.tick == 0 ||
        state.frame.body_axes.has_value() != scene_->isOnBody()) {
        return std::nullopt;
    }
    const auto index = scene_->mapAt(state.frame.toScene(state.hand));
    return index && scene_->canTouch(*index) ? index : std::nullopt;
}

void HapticsController::setCovered(bool is_covered)
{
    if (is_covered != device_->settings().is_covered) {
        device_->settings().is_covered = is_covered;
        push();
    }
}

// A camera that moved takes the workspace along at once.
void HapticsController::followSight()
{
    if (device_->loop() == nullptr || is_following_ || !scene_->touched()) {
        return;
    }
    if (!scene_->keepsWorkspace()) {
        takeSight();
        return;
    }
    takeStrokes();
    push();
}

// Maps the workspace to the visible area.
void HapticsController::takeSight()
{
    if (device_->loop() == nullptr || is_following_ || !scene_->touched()) {
        return;
    }
    scene_->fit(workspace(), device_->settings());
    takeStrokes();
    push();
}

// Keeps the strokes of a simulated hand within the picture; without terrain in sight they stay.
// After an emergency stop nothing holds the hand up: it lifts off, as people do, and does not sink
// into the terrain.
void HapticsController::takeStrokes()
{
    if (!device_->isSimulated()) {
        return;
    }
    constexpr double kHoverM = 0.004;
    if (auto strokes = scene_->strokes(workspace())) {
        strokes->low.z =
            is_stopped_ ? kHoverM + scene_->highestTerrainIn(*strokes) : workspace().low.z;
        device_->settings().strokes = strokes;
    }
}

// The device has moved the map: the camera follows within its limits, and beyond them the device's
// frame returns to the camera.
void HapticsController::followHand(const LoopState& state)
{
    if (!scene_->touched()) {
        return;
    }
    const SceneCamera before = scene_->cameraGoal();
    is_following_ = true;
    const LinkStep step =
        scene_->follow({.seen = state.seen_frame, .number = state.frame_number, .mode = state.mode},
                       workspace(), device_->settings());
    is_following_ = false;
    if (step.has_moved_camera && device_->isReplaying()) {
        if (!excursion_ || excursion_->sent_to != before) {
            excursion_ = Excursion{.before = before, .sent_to = {}};
        }
        excursion_->sent_to = scene_->cameraGoal();
    }
    if (step.has_moved_camera && step.has_changed_settings) {
        takeStrokes();
    }
    if (step.has_changed_settings) {
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
    scene_->show(StylusPose{.mode = state.mode,
                            .proxy = is_held_back ? contact.proxy : state.goal,
                            .goal = state.goal,
                            .is_in_contact = is_held_back,
                            .force_n = force_n,
                            .force_n_max = device_->loop()->device().force_n_peak});
}

// A recording contains the device's positions and what it did to the map, but not the camera.
void HapticsController::keepReplayInPicture(const LoopState& state)
{
    const bool is_user_moving =
        scene_->isMoving() || QGuiApplication::mouseButtons() != Qt::NoButton;
    if (device_->isReplaying() && !is_user_moving && state.contact.is_in_contact &&
        !scene_->isInPicture(state.contact.proxy)) {
        if (!excursion_ || excursion_->sent_to != scene_->cameraGoal()) {
            excursion_ = Excursion{.before = scene_->cameraGoal(), .sent_to = {}};
        }
        scene_->flyToPlace(state.contact.proxy);
        excursion_->sent_to = scene_->cameraGoal();
    }
}

// Unless the user has moved the camera since the replay did: then it stays.
void HapticsController::returnCamera()
{
    if (excursion_ && excursion_->sent_to == scene_->cameraGoal()) {
        scene_->flyTo(excursion_->before);
    }
    excursion_.reset();
}

void HapticsController::push()
{
    LoopSettings& loop = device_->settings();
    loop.stiffness_n_per_m = settings_.stiffness_n_per_m;
    loop.force_share = settings_.force_share;
    loop.has_walls = settings_.has_walls;
    loop.is_stopped = is_stopped_;
    loop.is_grabbing = is_grabbing_;
    loop.is_placing = scene_->isPlacing();
    device_->push();
}

} // namespace marsview
