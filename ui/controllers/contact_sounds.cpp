#include "ui/controllers/contact_sounds.h"

#include "haptics/sound/contact_sound.h"
#include "ui/controllers/hand_scene.h"

#include <chrono>
#include <mutex>
#include <thread>
#include <utility>

namespace marsview {
namespace {

constexpr std::chrono::milliseconds kPeriod{16};

// Where the sound is laid out: what a desktop stylus reaches.
constexpr WorkspaceBox kReach{{-0.08, -0.06, -0.06}, {0.08, 0.06, 0.06}};

std::int64_t nowNs()
{
    return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
}

} // namespace

struct ContactSounds::Opening {
    std::mutex mutex;
    ContactSounds* owner = nullptr; // null once the owner is destroyed
};

ContactSounds::ContactSounds(HandScene& scene, OpenPlayer open, QObject* parent)
    : QObject(parent)
    , scene_(&scene)
    , open_(std::move(open))
{
    timer_.setInterval(kPeriod);
    timer_.setTimerType(Qt::PreciseTimer);
    connect(&timer_, &QTimer::timeout, this, &ContactSounds::play);
    connectScene();
}

void ContactSounds::connectScene()
{
    connect(scene_, &HandScene::stylusMoved, this, [this] {
        const auto& pose = scene_->shownStylus();
        if (player_ && pose && pose->is_in_contact && !timer_.isActive()) {
            timer_.start();
        }
    });
    connect(scene_, &HandScene::sightChanged, this, &ContactSounds::takeSight);
    connect(scene_, &HandScene::mapsChanged, this, &ContactSounds::listenAnew);
    connect(scene_, &HandScene::exaggerationChanged, this, &ContactSounds::listenAnew);
}

void ContactSounds::setScene(HandScene& scene)
{
    scene_->disconnect(this);
    scene_ = &scene;
    connectScene();
    listenAnew();
}

ContactSounds::~ContactSounds()
{
    if (opening_) {
        const std::lock_guard lock(opening_->mutex);
        opening_->owner = nullptr;
    }
}

void ContactSounds::setOn(bool is_on)
{
    if (is_on == is_on_) {
        return;
    }
    is_on_ = is_on;
    if (is_on) {
        open();
    } else {
        timer_.stop();
        player_.reset();
        sound_ = {};
    }
    Q_EMIT onChanged(is_on);
}

// Detecting that no output exists may take a second.
void ContactSounds::open()
{
    if (opening_) {
        return; // it is being opened
    }
    opening_ = std::make_shared<Opening>();
    opening_->owner = this;
    std::thread([opening = opening_, open = open_] {
        auto player = std::make_shared<Result<SoundPlayer>>(open());
        const std::lock_guard lock(opening->mutex);
        if (opening->owner != nullptr) {
            QMetaObject::invokeMethod(
                opening->owner,
                [owner = opening->owner, player] { owner->take(std::move(*player)); },
                Qt::QueuedConnection);
        }
    }).detach();
}

void ContactSounds::take(Result<SoundPlayer> player)
{
    opening_.reset();
    if (!is_on_) {
        return; // switched off in the meantime
    }
    if (!player) {
        setOn(false);
        Q_EMIT failed(QString::fromStdString(player.error().message));
        return;
    }
    player_ = std::move(player).value();
    listenAnew();
    Q_EMIT opened();
}

void ContactSounds::listenAnew()
{
    listener_.reset();
    if (!player_ || scene_->isEmpty()) {
        return;
    }
    const HeightRange heights = scene_->heightRange();
    listener_.emplace(ListenerOptions{
        .lowest_m = heights.minimum_m, .highest_m = heights.maximum_m, .reach = kReach});
    takeSight();
    timer_.start();
}

void ContactSounds::takeSight()
{
    if (listener_ && !scene_->isEmpty()) {
        frame_ = scene_->fittedFrame(kReach);
    }
}

ContactMoment ContactSounds::moment() const
{
    ContactMoment moment{.time_ns = nowNs(), .frame = frame_};
    const auto& pose = scene_->shownStylus();
    if (!pose || !pose->is_in_contact ||
        (pose->mode != StylusMode::Hover && pose->mode != StylusMode::Press)) {
        return moment;
    }
    moment.proxy = pose->proxy;
    moment.goal = pose->goal;
    moment.height_m = scene_->heightOf(pose->proxy);
    moment.is_in_contact = true;
    const double spring_m = length(frame_.differenceToWorkspace(pose->proxy - pose->goal));
    moment.stiffness_n_per_m = spring_m > 0.0 ? length(pose->force_n) / spring_m : 0.0;
    return moment;
}

void ContactSounds::play()
{
    if (!player_ || !listener_) {
        timer_.stop();
        return;
    }
    if (!player_->isConnected()) {
        player_.reset();
        timer_.stop();
        open(); // another output may be there
        return;
    }
    const ContactMoment now = moment();
    sound_ = contactSound(listener_->hear(now));
    player_->set(sound_);
    if (!now.is_in_contact) {
        timer_.stop(); // it fades out by itself
    }
}

} // namespace marsview
