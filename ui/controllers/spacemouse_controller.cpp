#include "ui/controllers/spacemouse_controller.h"

#include "ui/canvas/steered_view.h"

#include <QApplication>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

namespace marsview {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kFrame{16};
// How often it is looked whether the window is in front again while the cap is pushed.
constexpr milliseconds kUnheardInterval{100};
// Below ten frames a second the map is slower than the hand, lest it leap.
constexpr std::chrono::duration<double> kStepMax{0.1};

constexpr std::uint32_t kHomeButton = 1U << 0;

CapRates capOf(const SpaceMouseRates& rates)
{
    return {.push = rates.push, .turn = rates.turn};
}

// The first device that can be opened; null if there is none.
std::unique_ptr<SpaceMouse> openFirst(const HidApi& api, const std::function<void()>& notify)
{
    for (const FoundDevice& found : SpaceMouse::find(api)) {
        if (found.isUsable()) {
            const std::string address = found.uri.substr(found.uri.find(':') + 1);
            if (auto mouse = SpaceMouse::open(address, api, notify)) {
                return std::move(mouse).value();
            }
        }
    }
    return nullptr;
}

} // namespace

SpaceMouseController::SpaceMouseController(std::vector<SteeredWidget> views,
                                           const SpaceMouseOptions& options,
                                           QObject* parent)
    : QObject(parent)
    , views_(std::move(views))
    , options_(options)
    , jobs_(*this)
{
    look_timer_.setInterval(options_.look_interval);
    connect(&look_timer_, &QTimer::timeout, this, [this] {
        if (isInFront()) {
            look();
        }
    });
    frame_timer_.setTimerType(Qt::PreciseTimer);
    connect(&frame_timer_, &QTimer::timeout, this, &SpaceMouseController::advance);
    look_timer_.start();
    look();
}

SpaceMouseController::~SpaceMouseController() = default;

void SpaceMouseController::look()
{
    if (std::exchange(is_looking_, true)) {
        return;
    }
    const HidApi& api = options_.api != nullptr ? *options_.api : systemHidApi();
    jobs_.run([this, &api](const auto& outlet) {
        const auto notify = [this, outlet] { outlet->post([this] { wake(); }); };
        // Shared because posted functors are copied; a mouse that is not taken is closed with it.
        const auto mouse = std::make_shared<std::unique_ptr<SpaceMouse>>(openFirst(api, notify));
        outlet->post([this, mouse] {
            is_looking_ = false;
            if (*mouse) {
                take(std::move(*mouse));
            }
        });
    });
}

void SpaceMouseController::take(std::unique_ptr<SpaceMouse> mouse)
{
    look_timer_.stop();
    mouse_ = std::move(mouse);
    Q_EMIT connected(QString::fromStdString(mouse_->name()));
    wake(); // it may have been pushed, or lost, before it came here
}

void SpaceMouseController::wake()
{
    if (!mouse_) {
        return;
    }
    if (mouse_->isLost()) {
        lose();
    } else if (!frame_timer_.isActive()) {
        advanced_ = options_.now();
        frame_timer_.start(kFrame);
    }
}

void SpaceMouseController::advance()
{
    if (mouse_->isLost()) {
        lose();
        return;
    }
    const auto now = options_.now();
    const double seconds =
        std::clamp<std::chrono::duration<double>>(now - std::exchange(advanced_, now),
                                                  std::chrono::duration<double>(0.0), kStepMax)
            .count();
    const SpaceMouseRates rates = mouse_->rates();
    const std::uint32_t pressed = mouse_->takePressed();
    const bool is_heard = isHeard();
    SteeredView& view = shown().view;
    const CapRates cap = is_heard ? capOf(rates) : CapRates{};
    if (is_heard && (pressed & kHomeButton) != 0) {
        view.goHome();
        is_flying_home_ = true;
    }
    // Pressing the button may move the cap: it must come to rest before it moves the camera again.
    is_flying_home_ = is_flying_home_ && view.isMoving() && doesSteer(cap);
    view.steer(is_flying_home_ ? CapRates{} : cap, seconds);
    if (rates.isAtRest()) {
        frame_timer_.stop();
    } else if (const milliseconds wanted = is_heard ? kFrame : kUnheardInterval;
               wanted != frame_timer_.intervalAsDuration()) {
        frame_timer_.setInterval(wanted); // restarts it
    }
}

const SteeredWidget& SpaceMouseController::shown() const
{
    const auto found = std::find_if(views_.begin(), views_.end(), [](const SteeredWidget& view) {
        return !view.widget.isHidden();
    });
    return found != views_.end() ? *found : views_.front();
}

// The window itself, or a panel that was taken out of it.
bool SpaceMouseController::isInFront() const
{
    const QWidget* active = QApplication::activeWindow();
    while (active != nullptr && active->windowType() == Qt::Tool &&
           active->parentWidget() != nullptr) {
        active = active->parentWidget()->window();
    }
    return active == shown().widget.window();
}

bool SpaceMouseController::isHeard() const
{
    return shown().widget.isVisible() && isInFront() &&
           QApplication::activeModalWidget() == nullptr;
}

void SpaceMouseController::lose()
{
    const QString name = QString::fromStdString(mouse_->name());
    frame_timer_.stop();
    mouse_.reset(); // its thread has ended
    shown().view.steer({}, 0.0);
    look_timer_.start();
    Q_EMIT disconnected(name);
}

} // namespace marsview
