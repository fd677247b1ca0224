#include "app/bench/touch_gestures.h"

#include "app/bench/closed_loop.h"
#include "app/bench/computed_terrain.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace marsview {
namespace {

constexpr std::size_t kSide = 201; // samples, 1 m apart
constexpr double kHalfM = 100.0;
constexpr double kGripNPerM = 1.0; // soft: what the hand presses with hardly depends on its place
constexpr double kPressN = 0.4;

double hills(double x, double y)
{
    return 2.0 * std::sin(0.15 * x) + std::cos(0.11 * y);
}

double hillsOnTheMap(double x, double y)
{
    return std::max(std::abs(x), std::abs(y)) <= kHalfM ? hills(x, y) : std::nan("");
}

std::shared_ptr<ServoMap> hillMap()
{
    const auto terrain = computedTerrain(kSide, [](std::size_t column, std::size_t row) {
        return hills(static_cast<double>(column) - kHalfM, kHalfM - static_cast<double>(row));
    });
    const auto transform = GeoTransform::fromTerms({-0.5, 1.0, 0.0, 0.5, 0.0, -1.0});
    const auto georeference =
        std::make_shared<const Georeference>(kSide, kSide, *transform, std::nullopt);
    return makeServoMap(GoalFrame(georeference, 1.0), terrain, {.map_id = 1});
}

ClosedLoopOptions loopOptions()
{
    ClosedLoopOptions options;
    options.device.workspace = {{-0.08, -0.06, -0.06}, {0.08, 0.06, 0.06}};
    options.device.force_n_peak = 3.3;
    options.device.stiffness_n_per_m_max = 600.0;
    options.hand = {.mass_kg = 0.1,
                    .damping_n_s_per_m = 2.0,
                    .grip_n_per_m = kGripNPerM,
                    .grip_n_s_per_m = 0.0};
    options.hand_begin = {-0.03, 0.0, 0.02};
    return options;
}

class Gesture {
public:
    Gesture()
        : loop_(loopOptions(), hillMap(), hillsOnTheMap)
    {}

    std::vector<TickRecord> take() { return std::move(records_); }

    void pan()
    {
        press();
        grab(true);
        run(700, {0.1, 0.0, -kPressN});
        grab(false);
        stopHand();
    }

    void flingIntoALimit()
    {
        press();
        grab(true);
        run(200, {0.6, 0.0, -kPressN});
        grab(false);
        stopHand();
    }

    void zoom(double way_m)
    {
        run(300, {});
        grab(true);
        move(way_m);
        grab(false);
        run(2000, {});
    }

    // "ratcheting up": the hand grabs, lifts, releases, returns and grabs again.
    void ratchets()
    {
        for (int stroke = 0; stroke < 4; ++stroke) {
            run(300, {});
            grab(true);
            move(0.025);
            grab(false);
            run(3000, {});
            move(loop_.surfaceZ() + 0.01 - at().z);
        }
        press();
    }

    void twist()
    {
        run(300, {});
        grab(true);
        run(200, {});
        constexpr int kTicks = 2000;
        for (int i = 1; i <= kTicks; ++i) {
            loop_.twist(0.5 * std::numbers::pi * i / kTicks);
            tick({});
        }
        run(500, {});
        grab(false);
        run(500, {});
        press();
    }

private:
    WorkspacePoint at() const { return loop_.hand().position(); }
    void grab(bool is_grabbing) { loop_.settings.is_grabbing = is_grabbing; }
    // While the map glides on below it.
    void stopHand()
    {
        for (int i = 0; i < 1000 && loop_.hand().velocity().x > 0.0; ++i) {
            tick({-0.3, 0.0, -kPressN});
        }
        press();
    }
    // The arm keeps its place on a slope.
    void press()
    {
        constexpr double kArmNPerM = 60.0;
        const WorkspacePoint place = at();
        for (int i = 0; i < 2000; ++i) {
            const Vec3 pull_n = (place - at()) * kArmNPerM;
            tick({pull_n.x, pull_n.y, -kPressN});
        }
    }
    void run(int ticks, const Vec3& force_n)
    {
        for (int i = 0; i < ticks; ++i) {
            tick(force_n);
        }
    }
    // By about `way_m` vertically, at some 0.15 m/s, and to rest.
    void move(double way_m)
    {
        const double end_m = at().z + way_m;
        const double side = way_m > 0.0 ? 1.0 : -1.0;
        for (int i = 0; i < 4000 && (end_m - at().z) * side > 0.0; ++i) {
            tick({0.0, 0.0, side * 0.3});
        }
        run(500, {});
    }

    void tick(const Vec3& force_n)
    {
        loop_.hand().aimAt(at() + force_n * (1.0 / kGripNPerM));
        const StepResult& felt = loop_.tick();
        records_.push_back({.tick = loop_.ticks(),
                            .time_ns = static_cast<std::int64_t>(loop_.ticks()) * 1'000'000,
                            .proxy = felt.proxy,
                            .force_n = felt.force_n,
                            .hand = felt.hand,
                            .mode = felt.mode,
                            .reason = felt.reason,
                            .is_in_contact = felt.contact.is_in_contact,
                            .has_motion = felt.motion.has_value(),
                            .motion = felt.motion.value_or(SceneMotion{}),
                            .surface_z_m = felt.surface_z_m});
    }

    ClosedLoop loop_;
    std::vector<TickRecord> records_;
};

} // namespace

std::string_view touchGestureName(TouchGesture gesture) noexcept
{
    constexpr std::array<std::string_view, kTouchGestures.size()> kNames{
        "pan", "fling-into-a-limit", "zoom-in", "zoom-out", "ratchets", "twist"};
    return kNames[static_cast<std::size_t>(gesture)];
}

std::string_view touchGestureTitle(TouchGesture gesture) noexcept
{
    constexpr std::array<std::string_view, kTouchGestures.size()> kTitles{
        "Pan: press, grab, pull, release the moving map",
        "Fling: release a fast map, which stops at its limit",
        "Zoom in: grab space, lift, release",
        "Zoom out: grab space, lower, release",
        "Ratchets: grab space and lift, four times, then press",
        "Twist: grab space, turn the stylus by 90°, release, press"};
    return kTitles[static_cast<std::size_t>(gesture)];
}

std::vector<TickRecord> makeGesture(TouchGesture gesture)
{
    Gesture made;
    switch (gesture) {
    case TouchGesture::Pan:
        made.pan();
        break;
    case TouchGesture::FlingIntoALimit:
        made.flingIntoALimit();
        break;
    case TouchGesture::ZoomIn:
        made.zoom(0.03);
        break;
    case TouchGesture::ZoomOut:
        made.zoom(-0.012);
        break;
    case TouchGesture::Ratchets:
        made.ratchets();
        break;
    case TouchGesture::Twist:
        made.twist();
        break;
    }
    return made.take();
}

} // namespace marsview
