#include "app/bench/stability_case.h"

#include "app/bench/computed_terrain.h"
#include "core/base/split_mix.h"
#include "core/terrain/filled_heightfield.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace marsview {
namespace {

// A scene meter is a workspace millimeter, and one sample.
constexpr std::size_t kSide = 241;
constexpr double kScale = 1000.0;
constexpr double kSeconds = 6.0;
constexpr double kEventsEndS = 2.5;
constexpr double kRestBeginS = 5.5; // slow damped motion has decayed by then
constexpr double kPeriodS = 1e-3;
constexpr WorkspaceBox kWorkspace{{-0.08, -0.06, -0.06}, {0.08, 0.06, 0.06}};

double heightAt(StabilityScene scene, std::size_t column, std::size_t row)
{
    const double x = static_cast<double>(column) - 120.0;
    const double y = 120.0 - static_cast<double>(row);
    switch (scene) {
    case StabilityScene::Ridge:
        return -std::abs(x);
    case StabilityScene::Canyon:
        return std::abs(x);
    case StabilityScene::Checkerboard:
        return (column + row) % 2 == 0 ? 2.0 : 0.0;
    case StabilityScene::WallCorner: // down toward the corner of the walls, 2 : 1
        return -1.4 * ((x - 80.0) + (y - 60.0));
    default:
        return 0.0;
    }
}

std::shared_ptr<const FilledHeightfield> terrainOf(StabilityScene scene)
{
    return computedTerrain(kSide, [scene](std::size_t column, std::size_t row) {
        return heightAt(scene, column, row);
    });
}

// Created once: they are the same in every run.
const std::shared_ptr<const FilledHeightfield>& terrainFor(StabilityScene scene)
{
    static const auto terrains = [] {
        std::vector<std::shared_ptr<const FilledHeightfield>> made;
        for (const StabilityScene each : kStabilityScenes) {
            made.push_back(terrainOf(each));
        }
        return made;
    }();
    return terrains[static_cast<std::size_t>(scene)];
}

std::shared_ptr<ServoMap>
mapFor(StabilityScene scene, const StabilityOptions& options, std::uint64_t id)
{
    const auto transform = GeoTransform::fromTerms({-0.5, 1.0, 0.0, 0.5, 0.0, -1.0});
    const auto georeference =
        std::make_shared<const Georeference>(kSide, kSide, *transform, std::nullopt);
    return makeServoMap(GoalFrame(georeference, 1.0), terrainFor(scene),
                        {.kind = options.model, .contact = {.radius_m = 0.5}, .map_id = id});
}

// The hand's intention at a time.
struct Intent {
    WorkspacePoint aim{};
    bool is_grabbing = false;
    int change = 0; // number of the map
};

Intent intentAt(StabilityScene scene, double seconds, double press_m)
{
    const double t = std::min(seconds, kEventsEndS);
    switch (scene) {
    case StabilityScene::Ridge:
        return {.aim = {0.0003, 0.0, -press_m}};
    case StabilityScene::Canyon:
        return {.aim = {0.001, 0.0, -press_m}};
    case StabilityScene::Checkerboard:
        return {.aim = {0.008 * t, 0.003 * t, -press_m}};
    case StabilityScene::WallCorner: // beyond the walls, below the slope
        return {.aim = {0.083, 0.063, -0.012}};
    case StabilityScene::ModeSwitches:
        return {.aim = {0.01 * std::sin(9.0 * t), 0.008 * std::cos(7.0 * t), -press_m},
                .is_grabbing = seconds < kEventsEndS && std::fmod(seconds, 0.25) > 0.125};
    case StabilityScene::PanHold:
        return {.aim = {0.01 * std::sin(9.0 * t), 0.008 * std::cos(7.0 * t), -press_m},
                .is_grabbing = seconds > 0.5};
    case StabilityScene::ZoomHold:
        return {.aim = {0.004 * std::sin(9.0 * t), 0.0, 0.02 + 0.006 * std::sin(5.0 * t)},
                .is_grabbing = seconds > 0.5};
    case StabilityScene::MapChange:
        return {.aim = {0.0, 0.0, -press_m}, .change = static_cast<int>(t / 0.3)};
    default:
        return {.aim = {0.0, 0.0, -press_m}};
    }
}

// The range of equidistant values about a straight line through them.
double rippleOf(const std::vector<double>& values)
{
    const auto n = static_cast<double>(values.size());
    double sum = 0.0;
    double sum_i = 0.0;
    double sum_ii = 0.0;
    double sum_iv = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto x = static_cast<double>(i);
        sum += values[i];
        sum_i += x;
        sum_ii += x * x;
        sum_iv += x * values[i];
    }
    const double slope = (n * sum_iv - sum_i * sum) / (n * sum_ii - sum_i * sum_i);
    const double start = (sum - slope * sum_i) / n;
    double low = 0.0;
    double high = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double off = values[i] - start - slope * static_cast<double>(i);
        low = std::min(low, off);
        high = std::max(high, off);
    }
    return high - low;
}

double varianceOf(const std::vector<double>& values)
{
    double sum = 0.0;
    double squares = 0.0;
    for (const double v : values) {
        sum += v;
        squares += v * v;
    }
    const auto n = static_cast<double>(values.size());
    return std::max(0.0, squares / n - sum * sum / (n * n));
}

} // namespace

std::string_view stabilitySceneName(StabilityScene scene) noexcept
{
    constexpr std::array<std::string_view, kStabilityScenes.size()> kNames{
        "plane",         "ridge",    "canyon",    "checkerboard", "wall corner",
        "mode switches", "pan hold", "zoom hold", "map change"};
    return kNames[static_cast<std::size_t>(scene)];
}

HandOptions stabilityHand(double delay_s)
{
    return {.mass_kg = 0.1,
            .damping_n_s_per_m = 1.0,
            .grip_n_per_m = 150.0,
            .grip_n_s_per_m = 2.5,
            .tremor_m = 0.0,
            .encoder_m = 2e-5,
            .delay_s = delay_s,
            .seed = 1};
}

StabilityResult runStability(StabilityScene scene, const StabilityOptions& options)
{
    constexpr double kPressM = 0.006; // the grip's spring then presses with at most 0.9 N
    DeviceCapabilities device;
    device.workspace = kWorkspace;
    device.force_n_peak = 8.0;
    device.stiffness_n_per_m_max = options.stiffness_n_per_m;
    TickOptions tick_options = tickOptionsFor(device);
    tick_options.mixing = options.mixing;
    tick_options.is_passivity_kept = options.is_passivity_kept;

    LoopSettings settings;
    const std::array maps{mapFor(scene, options, 1), mapFor(scene, options, 2)};
    settings.map = maps[0];
    settings.frame = {.place = {}, .scene_per_meter = kScale};
    settings.frame_number = 1;
    settings.stiffness_n_per_m = options.stiffness_n_per_m;
    settings.modes.scene_per_meter_min = 0.1 * kScale;
    settings.modes.scene_per_meter_max = 10.0 * kScale;

    TickState state;
    TickInput input;
    std::uint64_t random_state = options.seed;
    const Intent first = intentAt(scene, 0.0, kPressM);
    SimulatedHand hand(stabilityHand(options.delay_s),
                       {std::min(first.aim.x, kWorkspace.high.x - 0.001),
                        std::min(first.aim.y, kWorkspace.high.y - 0.001), 0.015});
    StabilityResult result;
    std::array<std::vector<double>, 3> places;
    std::array<std::vector<double>, 3> speeds;
    std::size_t ticks = 0;
    std::size_t touching = 0;
    int change = 0;
    while (hand.seconds() < kSeconds) {
        const Intent intent = intentAt(scene, hand.seconds(), kPressM);
        const double dt_s = kPeriodS + options.jitter_s * (2.0 * nextRandom(random_state) - 1.0);
        hand.aimAt(intent.aim);
        hand.advance(dt_s);
        if (intent.change != change) {
            change = intent.change;
            settings.map = maps[static_cast<std::size_t>(change) % 2];
            settings.frame = state.frame.panned({0.004, -0.003, 0.0});
            ++settings.frame_number;
        }
        settings.is_grabbing = intent.is_grabbing;
        input.settings = &settings;
        input.device = &device;
        input.now += std::chrono::nanoseconds(static_cast<std::int64_t>(dt_s * 1e9));
        input.sample.position = hand.measured();
        input.sample.time = input.now;
        const StepResult step_result = step(tick_options, input, state, dt_s);
        hand.push(step_result.force_n);

        ++ticks;
        touching += step_result.contact.is_in_contact ? 1U : 0U;
        const double kinetic_j = hand.energyJ();
        result.energy_j_max =
            std::isfinite(kinetic_j) ? std::max(result.energy_j_max, kinetic_j) : 1e9;
        if (hand.seconds() >= kRestBeginS) {
            const WorkspacePoint& at = hand.position();
            const Vec3& v = hand.velocity();
            for (std::size_t axis = 0; axis < 3; ++axis) {
                places[axis].push_back(axis == 0 ? at.x : axis == 1 ? at.y : at.z);
                speeds[axis].push_back(axis == 0 ? v.x : axis == 1 ? v.y : v.z);
            }
        }
    }
    double variance = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        result.ripple_m = std::max(result.ripple_m, rippleOf(places[axis]));
        variance += varianceOf(speeds[axis]);
    }
    result.speed_m_per_s = std::sqrt(variance);
    result.contact_share = static_cast<double>(touching) / static_cast<double>(ticks);
    return result;
}

double largestStable(StabilityScene scene, StabilityOptions options, double most)
{
    constexpr double kFirst = 50.0;
    constexpr double kStep = 1.1;
    double stable = 0.0;
    for (double k = kFirst; k <= most; k *= kStep) {
        options.stiffness_n_per_m = k;
        if (!runStability(scene, options).isStable()) {
            return stable;
        }
        stable = k;
    }
    return stable;
}

} // namespace marsview
