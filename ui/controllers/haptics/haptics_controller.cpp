#include "ui/controllers/haptics/haptics_controller.h"

#include "haptics/interaction/workspace_walls.h"
#include "ui/canvas/terrain_view.h"
#include "ui/controllers/hand_sight.h"
#include "ui/text/haptics_text.h"

#include <QCoreApplication>
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
    , view_(view)
    , device_(new DeviceSession(std::move(make_drivers), this))
    , recorder_(new TouchRecorder(
          *device_, [this] { return hand_map_->make(model_, exaggeration_); }, this))
    , exaggeration_(view.exaggeration())
    , jobs_(*this)
{
    connect(device_, &DeviceSession::opened, this, &HapticsController::begin);
    connect(device_, &DeviceSession::ending, this, &HapticsController::end);
    connect(device_, &DeviceSession::ended, this, &HapticsController::releaseMap);
    connect(device_, &DeviceSession::forgotten, this, &HapticsController::forget);
    connect(device_, &DeviceSession::polled, this, &HapticsController::follow);
    connect(&view_, &TerrainView::layersChanged, this, &HapticsController::takeGround);
    connect(&view_, &TerrainView::exaggerationChanged, this, &HapticsController::takeExaggeration);
    connect(&view_, &TerrainView::sightChanged, this, &HapticsController::followSight);
    // Terrain that arrived since then may be higher or lower.
    connect(&view_, &TerrainView::pictureCompleted, this, [this] {
        if (device_->loop() != nullptr && device_->isSimulated() && !view_.ground().isEmpty()) {
            takeStrokes();
            device_->push();
        }
    });
    connect(&view_, &TerrainView::grabbingChanged, this, [this](bool is_grabbing) {
        is_grabbing_ = is_grabbing;
        push();
    });
    // A tool that places points has the stylus as its pointer.
    connect(&view_, &TerrainView::toolChanged, this, &HapticsController::push);
    connect(device_, &DeviceSession::pointPressed, &view_, &TerrainView::pressStylus);
    connect(device_, &DeviceSession::pointReleased, &view_, &TerrainView::releaseStylus);
    QCoreApplication::instance()->installEventFilter(this);
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
    hand_map_.reset();
    view_.showDevice(std::nullopt);
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
        if (device_->loop() != nullptr && !view_.ground().isEmpty()) {
            takeStrokes();
        }
        push();
        Q_EMIT stoppedChanged(is_stopped);
    }
}

// The hand stays on its map as long as that is shown, and begins on the uppermost.
void HapticsController::takeGround()
{
    if (device_->loop() == nullptr) {
        return;
    }
    const auto& maps = view_.ground().maps();
    if (maps.empty()) {
        recorder_->stop(RecordingEnd::WithItsMap);
        hand_map_.reset();
        device_->settings().map = nullptr;
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
    if (!device_->isReplaying()) {
        return;
    }
    reportReplay();
    std::vector<std::shared_ptr<const Georeference>> maps;
    for (const SceneMap& map : view_.ground().maps()) {
        maps.emplace_back(map.map, &map.map->georeference());
    }
    if (maps.empty()) {
        return; // it waits for one
    }
    // Reading may take a while.
    jobs_.run([this, file = device_->replayedFile(), check = ++replay_check_,
               maps = std::move(maps)](const auto& to) {
        Result<ReplayFit> fit = replayFit(file.toStdString(), maps);
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
    const QString text = replay_fit_ ? replayText(file, *replay_fit_, ground) : QString();
    if (replay_fit_ && replay_fit_->isElsewhere()) {
        device_->stopReplay(text);
    } else if (text != device_->problem()) {
        device_->setProblem(text);
    }
}

void HapticsController::setMap(std::size_t index)
{
    recorder_->stop(RecordingEnd::WithItsMap);
    hand_map_ = std::make_unique<TouchMap>(view_.ground().maps()[index]);
    device_->settings().map = hand_map_->make(model_, exaggeration_);
    push();
}

// The map is the same; the HIP continues at its position.
void HapticsController::makeMapAgain()
{
    if (hand_map_) {
        device_->settings().map = hand_map_->make(model_, exaggeration_); // recordings continue
    }
}

void HapticsController::takeExaggeration()
{
    if (view_.exaggeration() != exaggeration_) {
        exaggeration_ = view_.exaggeration();
        makeMapAgain(); // pushed together with the frame: no update sees one without the other
        takeSight();
        push();
        reportReplay();
    }
}

// Where several maps are shown, what lies uppermost below the hand is touched.
void HapticsController::chooseMap(const LoopState& state)
{
    const SceneSurface& ground = view_.ground();
    if (ground.maps().size() < 2 || !hand_map_ || recorder_->isRecording()) {
        return;
    }
    // Where the hand is: the goal never leaves the map that it touches.
    const ScenePoint hand = state.frame.toScene(state.hand);
    const auto index = ground.mapAt(hand.x, hand.y);
    if (index && !hand_map_->isOf(ground.maps()[*index])) {
        setMap(*index);
    }
}

// A camera that moved takes the workspace along at once. If it only tilted, or the picture got
// another size, the ground stays where the hand feels it until the tick can fit the workspace in
// free space.
void HapticsController::followSight()
{
    if (device_->loop() == nullptr || is_following_ || view_.ground().isEmpty()) {
        return;
    }
    const LimitedView seen = limitedView(hand_view_, view_.camera());
    if (seen.is_moved) {
        takeSight();
        return;
    }
    hand_view_ = seen.view;
    is_fitted_ = false;
    takeStrokes();
    push();
}

// Maps the workspace to the visible area.
void HapticsController::takeSight()
{
    if (device_->loop() == nullptr || is_following_ || view_.ground().isEmpty()) {
        return;
    }
    hand_view_ = {.camera = view_.camera(),
                  .frame =
                      frameForSight(view_.camera(), view_.viewport(), view_.ground(),
                                    view_.exaggeration(), device_->loop()->device().workspace)};
    device_->settings().frame = hand_view_.frame;
    device_->settings().frame_origin = FrameOrigin::View;
    device_->settings().fit.reset();
    is_fitted_ = true;
    ++device_->settings().frame_number;
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
    device_->settings().view_bounds = boundsFor(hand_view_, limits);
    boundZoom(hand_view_, limits, device_->settings().modes);
}

// The hand has moved the map and left it at rest: in free space, the tick fits the workspace to the
// view again.
void HapticsController::takeFit(const LoopState& state)
{
    if (is_fitted_ || isHolding(state.mode)) {
        return;
    }
    is_fitted_ = true;
    device_->settings().fit = WorkspaceFit{
        .seen = hand_view_.frame,
        .fitted = frameForSight(view_.camera(), view_.viewport(), view_.ground(),
                                view_.exaggeration(), device_->loop()->device().workspace)};
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
    const WorkspaceBox& workspace = device_->loop()->device().workspace;
    if (auto strokes =
            strokesInSight(view_.camera(), view_.viewport(), view_.ground(), view_.exaggeration(),
                           hand_view_.frame, reachWithin(workspace))) {
        strokes->low.z = is_stopped_
                             ? kHoverM + highestTerrainIn(*strokes, view_.ground(),
                                                          view_.exaggeration(), hand_view_.frame)
                             : workspace.low.z;
        device_->settings().strokes = strokes;
    }
}

// The device has moved the map: the camera follows within its limits, and beyond them the device's
// frame returns to the camera.
void HapticsController::followHand(const LoopState& state)
{
    if (state.frame_number != device_->settings().frame_number) {
        return;
    }
    if (state.seen_frame == hand_view_.frame) {
        takeFit(state);
        return;
    }
    is_fitted_ = false;
    const OrbitCamera wanted = cameraFollowing(hand_view_, state.seen_frame);
    const bool is_replay = device_->isReplaying();
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
        device_->settings().frame = hand_view_.frame;
        device_->settings().frame_origin = FrameOrigin::Limit;
        ++device_->settings().frame_number;
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
                                .force_n_max = device_->loop()->device().force_n_peak});
}

// A recording contains the device's positions and what it did to the map, but not the camera.
void HapticsController::keepReplayInPicture(const LoopState& state)
{
    const bool is_user_moving = view_.isMoving() || QGuiApplication::mouseButtons() != Qt::NoButton;
    if (device_->isReplaying() && !is_user_moving && state.contact.is_in_contact &&
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
    LoopSettings& loop = device_->settings();
    loop.stiffness_n_per_m = settings_.stiffness_n_per_m;
    loop.force_share = settings_.force_share;
    loop.has_walls = settings_.has_walls;
    loop.is_stopped = is_stopped_;
    loop.is_grabbing = is_grabbing_;
    loop.is_placing = view_.isPlacing();
    device_->push();
}

} // namespace marsview
