#include "app/bench/touch_sessions.h"

#include "app/bench/closed_loop.h"
#include "app/bench/computed_terrain.h"
#include "core/base/split_mix.h"
#include "core/terrain/filled_heightfield.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <utility>
#include <vector>

namespace marsview {
namespace {

constexpr std::size_t kSessionSide = 201; // samples
constexpr double kHalfM = 100.0;
constexpr double kTickS = 1e-3;
constexpr double kJitter = 0.2; // share of a tick
constexpr double kFitM = 1e-3;  // of the hand from where a fitted workspace has it

double terrainHeight(std::size_t kind, double x, double y)
{
    switch (kind) {
    case 0:
        return 5.0;
    case 1:
        return 3.0 * std::sin(0.2 * x) + 2.0 * std::cos(0.13 * y);
    default:
        return 0.4 * std::abs(x) + 0.1 * y; // a valley
    }
}

constexpr std::size_t kTerrainCount = 3;

std::shared_ptr<const FilledHeightfield> filledTerrain(std::size_t kind)
{
    return computedTerrain(kSessionSide, [kind](std::size_t column, std::size_t row) {
        return terrainHeight(kind, static_cast<double>(column) - kHalfM,
                             kHalfM - static_cast<double>(row));
    });
}

std::shared_ptr<ServoMap> mapOf(std::size_t kind, std::uint64_t id)
{
    static const auto terrains = [] {
        std::vector<std::shared_ptr<const FilledHeightfield>> made;
        for (std::size_t i = 0; i < kTerrainCount; ++i) {
            made.push_back(filledTerrain(i));
        }
        return made;
    }();
    const auto transform = GeoTransform::fromTerms({-0.5, 1.0, 0.0, 0.5, 0.0, -1.0});
    const auto georeference =
        std::make_shared<const Georeference>(kSessionSide, kSessionSide, *transform, std::nullopt);
    return makeServoMap(GoalFrame(georeference, 1.0), terrains[kind], {.map_id = id});
}

ClosedLoop::HeightOf heightOf(std::size_t kind)
{
    return [kind](double x, double y) {
        return std::max(std::abs(x), std::abs(y)) <= kHalfM ? terrainHeight(kind, x, y)
                                                            : std::nan("");
    };
}

DeviceCapabilities sessionDevice()
{
    DeviceCapabilities device;
    device.workspace = {{-0.08, -0.06, -0.06}, {0.08, 0.06, 0.06}};
    device.force_n_peak = 3.3;
    device.stiffness_n_per_m_max = 600.0;
    return device;
}

class Session {
public:
    explicit Session(const TouchSessionOptions& options)
        : random_(options.seed * kSplitMixStep)
        , grip_n_per_m_(uniform(30.0, 200.0))
        , loop_({.device = sessionDevice(),
                 .hand = {.mass_kg = uniform(0.05, 0.2),
                          .damping_n_s_per_m = 2.0,
                          .grip_n_per_m = grip_n_per_m_,
                          .grip_n_s_per_m = 2.0,
                          .encoder_m = 2e-5,
                          .delay_s = 0.0},
                 .hand_begin = {0.0, 0.0, 0.05},
                 .stiffness_n_per_m = uniform(150.0, 450.0)},
                mapOf(0, 1),
                heightOf(0))
        , last_force_n_{}
    {
        changeMap();
        OrbitCamera camera = loop_.camera();
        camera.distance_m = uniform(20.0, 250.0);
        camera.tilt = Angle::degrees(uniform(0.0, 70.0));
        camera.azimuth = Angle::degrees(uniform(-180.0, 180.0));
        loop_.moveCamera(camera);
        seconds_ = options.seconds;
    }

    TouchSessionResult run()
    {
        const auto ticks = static_cast<std::uint64_t>(seconds_ / kTickS);
        while (loop_.ticks() < ticks) {
            act();
        }
        rest();
        result_.ticks = loop_.ticks();
        return result_;
    }

private:
    double unit() { return nextRandom(random_); }
    double uniform(double low, double high) { return low + (high - low) * unit(); }

    void note(TouchInvariant invariant, const std::string& detail)
    {
        ++result_.violations[static_cast<std::size_t>(invariant)];
        if (result_.first.empty()) {
            result_.first = fmt::format("tick {}: {}: {}", loop_.ticks(),
                                        touchInvariantName(invariant), detail);
        }
    }

    // The surface may be elsewhere from now on.
    void noteEvent()
    {
        event_tick_ = loop_.ticks();
        has_event_ = true;
        energy_j_ = std::min(energy_j_, 0.0);
    }

    void changeMap()
    {
        noteEvent();
        const auto kind = static_cast<std::size_t>(unit() * kTerrainCount) % kTerrainCount;
        loop_.setMap(mapOf(kind, ++map_id_), heightOf(kind));
        kind_ = kind;
    }

    // Something for a tenth of a second up to one.
    void act()
    {
        if (unit() < 0.4) {
            loop_.settings.is_grabbing = !loop_.settings.is_grabbing;
        }
        if (unit() < 0.05) {
            changeMap();
        } else if (unit() < 0.03) {
            loop_.setMap(nullptr, {});
        } else if (unit() < 0.05) {
            noteEvent();
            OrbitCamera camera = loop_.camera();
            camera.target = {uniform(-120.0, 120.0), uniform(-120.0, 120.0), 0.0};
            camera.distance_m = uniform(5.0, 400.0);
            loop_.moveCamera(camera);
        }
        const WorkspacePoint aim{uniform(-0.085, 0.085), uniform(-0.065, 0.065),
                                 uniform(-0.04, 0.05)};
        const bool is_fling = unit() < 0.2;
        const double speed = is_fling ? 0.8 : uniform(0.02, 0.2);
        const double spin = unit() < 0.3 ? uniform(-3.0, 3.0) : 0.0;
        const int ticks = static_cast<int>(uniform(100.0, 900.0));
        for (int i = 0; i < ticks; ++i) {
            const Vec3 way = aim - aim_;
            const double step = speed * kTickS;
            aim_ = length(way) > step ? aim_ + way * (step / length(way)) : aim;
            twist_rad_ += spin * kTickS;
            tick();
        }
    }

    void tick()
    {
        loop_.hand().aimAt(aim_);
        loop_.twist(twist_rad_);
        const Vec3 force_before_n = loop_.last().force_n;
        const Vec3 velocity = loop_.hand().velocity();
        const double dt_s = kTickS * uniform(1.0 - kJitter, 1.0 + kJitter);
        const StepResult& felt = loop_.tick(dt_s);
        // The force of the last tick has acted since.
        energy_j_ += dot(force_before_n, (velocity + loop_.hand().velocity()) * 0.5) * dt_s;
        check(felt, dt_s);
        last_force_n_ = felt.force_n;
    }

    void check(const StepResult& felt, double dt_s)
    {
        const SafetyLimits& limits = loop_.options().limits;
        const double force_n = length(felt.force_n);
        if (!(force_n <= limits.force_n_max * (1.0 + 1e-9))) {
            note(TouchInvariant::ForceIsFiniteAndWithinLimits, fmt::format("{} N", force_n));
        }
        const double rate = felt.reason == ForceOffReason::None ? limits.rate_n_per_s_max
                                                                : limits.release_n_per_s_max;
        const double change_n = length(felt.force_n - last_force_n_);
        if (!(change_n <= rate * dt_s * (1.0 + 1e-9))) {
            note(TouchInvariant::ForceChangesNoFasterThanTheLimiter, fmt::format("{} N", change_n));
        }
        result_.force_n_max = std::max(result_.force_n_max, force_n);
        result_.energy_j_max = std::max(result_.energy_j_max, energy_j_);
        result_.contact_ticks += felt.contact.is_in_contact ? 1U : 0U;
        result_.pan_ticks += felt.mode == StylusMode::Pan ? 1U : 0U;
        result_.zoom_ticks += felt.mode == StylusMode::Zoom ? 1U : 0U;
        result_.gliding_ticks +=
            !isHolding(felt.mode) && length(loop_.state().modes.pan.velocity_m_per_s) > 0.0 ? 1U
                                                                                            : 0U;
        if (!loop_.settings.map) {
            return;
        }
        const OrbitCamera& camera = loop_.camera();
        const OrbitCamera limited = loop_.limited(camera);
        const double off_m = length(limited.target - camera.target) +
                             std::abs(limited.distance_m - camera.distance_m);
        if (!(off_m <= 1e-2 * camera.distance_m)) {
            note(TouchInvariant::CameraIsWithinItsLimits, fmt::format("{} m", off_m));
        }
        const ScenePoint at = loop_.frame().toScene(felt.hand);
        if (!(length(felt.goal - at) <= 1e-6 * loop_.frame().scene_per_meter)) {
            note(TouchInvariant::StateIsWhatIsFelt, fmt::format("{} m", length(felt.goal - at)));
        }
        // A slope that glides below the hand, or terrain that appears above it, lifts the hand by
        // the height of the workspace at most.
        constexpr double kLiftM = 0.12;
        if (has_event_ && loop_.ticks() > event_tick_ + 2000) {
            has_event_ = false;
            energy_j_ = std::min(energy_j_, 0.0);
        }
        const int lift_count = has_event_ ? 2 : 1;
        if (!(energy_j_ <= lift_count * kLiftM * limits.force_n_max) && !is_energy_noted_) {
            is_energy_noted_ = true;
            note(TouchInvariant::EnergyGivenToTheHandIsBounded, fmt::format("{} J", energy_j_));
        }
    }

    void hold(const WorkspacePoint& aim, int ticks)
    {
        for (int i = 0; i < ticks; ++i) {
            const Vec3 way = aim - aim_;
            constexpr double kStepM = 1e-4;
            aim_ = length(way) > kStepM ? aim_ + way * (kStepM / length(way)) : aim;
            tick();
        }
    }

    // From the hand to where a workspace that fits the view has it.
    double offFit() const
    {
        const WorkspaceFrame fit =
            loop_.settings.fit ? loop_.settings.fit->fitted : loop_.fittedFrame();
        const WorkspacePoint hand = loop_.hand().measured();
        return length(fit.toWorkspace(loop_.frame().toScene(hand)) - hand);
    }
    bool isSettled() const
    {
        return loop_.state().modes.pan.velocity_m_per_s == Vec3{} && offFit() <= kFitM;
    }

    // Of the hand over the surface below it; at the map's edge, which holds the hand back, over the
    // nearest point of the map.
    double clearance() const
    {
        const WorkspacePoint hand = loop_.hand().measured();
        ScenePoint at = loop_.frame().toScene(hand);
        at.z = terrainHeight(kind_, std::clamp(at.x, -kHalfM, kHalfM),
                             std::clamp(at.y, -kHalfM, kHalfM));
        return hand.z - loop_.frame().toWorkspace(at).z;
    }

    // Free space, then a press in the middle of the workspace.
    void rest()
    {
        loop_.settings.is_grabbing = false;
        if (!loop_.settings.map) {
            changeMap();
        }
        constexpr int kRestTicks = 30000; // a map glides for up to 12 s
        constexpr int kPart = 500;
        for (int i = 0; i < kRestTicks && (i < 2 * kPart || !isSettled()); i += kPart) {
            hold({0.0, 0.0, 0.055}, kPart);
        }
        const double off_m = offFit();
        const bool is_free = !loop_.last().contact.is_in_contact;
        // Near the surface the workspace rests: that is within reach.
        const FitOptions fit;
        const bool is_near = clearance() <= fit.clearance_min_m + fit.clearance_fade_m;
        if (is_free && !is_near && !(off_m <= kFitM)) {
            note(TouchInvariant::ViewIsReachable, fmt::format("{} mm off", off_m * 1e3));
        }
        const double z_m = loop_.surfaceZ();
        if (!std::isfinite(z_m)) {
            return; // the edge of the map is here
        }
        const double press_n = 0.5;
        for (int i = 0; i < 3000; ++i) {
            const WorkspacePoint& at = loop_.hand().position();
            aim_ = {0.0, 0.0, std::max(at.z - press_n / grip_n_per_m_, -0.2)};
            tick();
        }
        if (!loop_.last().contact.is_in_contact || loop_.last().ground_share < 1.0) {
            return;
        }
        // What the hand presses with, by its own spring, and how deep the surface lets it.
        const StepResult& felt = loop_.last();
        const double hand_n = length(aim_ - loop_.hand().position()) * grip_n_per_m_;
        const double depth_m =
            length(loop_.frame().differenceToWorkspace(felt.contact.proxy - felt.goal));
        const double sink_m = depth_m - hand_n / felt.stiffness_n_per_m;
        result_.sink_m_max = std::max(result_.sink_m_max, sink_m);
        // The hand still moves a little.
        if (!(sink_m <= 2e-4) || !(length(felt.force_n) >= 0.9 * press_n)) {
            note(TouchInvariant::RestingSurfaceDoesNotGiveWay,
                 fmt::format("{} mm, {} N", sink_m * 1e3, length(felt.force_n)));
        }
    }

    std::uint64_t random_;
    double grip_n_per_m_;
    ClosedLoop loop_;
    Vec3 last_force_n_;
    WorkspacePoint aim_{0.0, 0.0, 0.05};
    double twist_rad_ = 0.0;
    double energy_j_ = 0.0;
    bool is_energy_noted_ = false;
    bool has_event_ = true; // an event that moves the surface, less than two seconds ago
    std::uint64_t event_tick_ = 0;
    std::uint64_t map_id_ = 1;
    std::size_t kind_ = 0; // of the terrain
    double seconds_ = 0.0;
    TouchSessionResult result_;
};

} // namespace

std::string_view touchInvariantName(TouchInvariant invariant) noexcept
{
    constexpr std::array<std::string_view, kTouchInvariantCount> kNames{
        "force finite and within limits",
        "force changes no faster than the limiter",
        "camera within its limits",
        "state is what is felt",
        "energy given to the hand",
        "resting surface does not give way",
        "view reachable"};
    return kNames[static_cast<std::size_t>(invariant)];
}

void TouchSessionResult::add(const TouchSessionResult& other)
{
    for (std::size_t i = 0; i < kTouchInvariantCount; ++i) {
        violations[i] += other.violations[i];
    }
    if (first.empty()) {
        first = other.first;
    }
    ticks += other.ticks;
    contact_ticks += other.contact_ticks;
    pan_ticks += other.pan_ticks;
    zoom_ticks += other.zoom_ticks;
    gliding_ticks += other.gliding_ticks;
    force_n_max = std::max(force_n_max, other.force_n_max);
    energy_j_max = std::max(energy_j_max, other.energy_j_max);
    sink_m_max = std::max(sink_m_max, other.sink_m_max);
}

std::uint64_t TouchSessionResult::violationCount() const noexcept
{
    std::uint64_t sum = 0;
    for (const std::uint64_t count : violations) {
        sum += count;
    }
    return sum;
}

TouchSessionResult runTouchSession(const TouchSessionOptions& options)
{
    return Session(options).run();
}

} // namespace marsview
