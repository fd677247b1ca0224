#include "ui/controllers/contact_sounds.h"

#include "haptics/sound/contact_sound.h"
#include "ui/canvas/terrain_view.h"
#include "ui/controllers/hand_sight.h"

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

ContactSounds::ContactSounds(TerrainView& view, OpenPlayer open, QObject* parent)
    : QObject(parent)
    , view_(view)
    , open_(std::move(open))
{
    timer_.setInterval(kPeriod);
    timer_.setTimerType(Qt::PreciseTimer);
    connect(&timer_, &QTimer::timeout, this, &ContactSounds::play);
    connect(&view_, &TerrainView::stylusMoved, this, [this] {
        const auto& pose = view_.shownStylus();
        if (player_ && pose && pose->is_in_contact && !timer_.isActive()) {
            timer_.start();
        }
    });
    connect(&view_, &TerrainView::sightChanged, this, &ContactSounds::takeSight);
    connect(&view_, &TerrainView::layersChanged, this, &ContactSounds::listenAnew);
    connect(&view_, &TerrainView::exaggerationChanged, this, &ContactSounds::listenAnew);
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
    if (!player_ || view_.ground().maps().empty()) {
        return;
    }
    const SceneBox box = view_.ground().box(view_.exaggeration());
    listener_.emplace(
        ListenerOptions{.lowest_m = box.minimum.z, .highest_m = box.maximum.z, .reach = kReach});
    takeSight();
    timer_.start();
}

void ContactSounds::takeSight()
{
    if (listener_) {
        frame_ = frameForSight(view_.camera(), view_.viewport(), view_.ground(),
                               view_.exaggeration(), kReach);
    }
}

ContactMoment ContactSounds::moment() const
{
    ContactMoment moment{.time_ns = nowNs(), .frame = frame_};
    const auto& pose = view_.shownStylus();
    if (!pose || !pose->is_in_contact ||
        (pose->mode != StylusMode::Hover && pose->mode != StylusMode::Press)) {
        return moment;
    }
    moment.proxy = pose->proxy;
    moment.goal = pose->goal;
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
