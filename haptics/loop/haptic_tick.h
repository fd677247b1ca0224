// One tick of the servo loop: from where the hand is to the force on it, without clock or device.
#pragma once

#include "haptics/device/haptic_device.h"
#include "haptics/interaction/hand_modes.h"
#include "haptics/interaction/workspace_walls.h"
#include "haptics/loop/passivity_observer.h"
#include "haptics/loop/safety_limiter.h"
#include "haptics/terrain/servo_map.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace marsview {

/// What the program tells the loop: a tick sees all of it or nothing. Copies share the map.
struct LoopSettings {
    /// Null: there is nothing to be felt. Where the ground changes and with it where the hand's
    /// workspace lies (another exaggeration), the new map and the new frame belong into one set():
    /// a tick that saw one without the other would put the hand elsewhere.
    std::shared_ptr<ServoMap> map;
    WorkspaceFrame frame;             // taken over when `frame_number` changes
    std::uint64_t frame_number = 0;   // otherwise the loop goes on with what its hand made of it
    double stiffness_n_per_m = 300.0; // of ground and walls; bounded by what the device stands
    double force_share = 1.0;         // of all forces, 0 to 1
    bool has_walls = true;
    bool is_grabbing = false; // with a key instead of the stylus' button
    bool is_stopped = false;  // emergency stop
    ModeOptions modes{};
    /// The part of the workspace in which a simulated hand strokes; nothing: all of it.
    std::optional<WorkspaceBox> strokes{};
};

/// How ground and walls are put together. All but Fade is there for measuring why it is there.
enum class ForceMixing : std::uint8_t { Fade, NaiveSum };

/// A third of what the simulated hand is stable with at 3 ms of delay (tests/bench/STABILITY.md).
inline constexpr double kStiffnessUnstatedNPerM = 300.0;

/// Constant while a device is open.
struct TickOptions {
    SafetyLimits limits;
    PassivityOptions passivity;
    bool is_passivity_kept = true;
    ForceMixing mixing = ForceMixing::Fade;
    double period_s = 1e-3; // as it should be
    std::chrono::nanoseconds sample_age_max{15'000'000};
    std::chrono::nanoseconds terrain_age_max{500'000'000};
    /// Deadlines missed one after the other before it lets go. Each tick in time makes up for a
    /// quarter of one: more than one in five, for long enough, lets go as well. It goes on letting
    /// go until all are made up for.
    unsigned misses_max = 5;
};

/// Those for a device, with its peak force as the limit for moments and its continuous force, where
/// it states one, as the limit for long.
TickOptions tickOptionsFor(const DeviceCapabilities& device);

struct TickInput {
    const LoopSettings* settings = nullptr;
    const DeviceCapabilities* device = nullptr;
    DeviceStatus status = DeviceStatus::Fine;
    DeviceSample sample;
    /// Of a device that plays back: takes the place of the sample's position.
    const TracePoint* recorded_goal = nullptr;
    std::chrono::steady_clock::time_point now{};
    bool has_missed_deadline = false; // the last tick ended, or this one began, too late
    /// Seconds since the last force was written, which is what the limiter counts; nothing: dt_s.
    /// More than kSafetyStepMaxS is a pause, and lets go.
    std::optional<double> since_write_s{};
};

/// Goals of one tick: one, or those by which the proxy is put elsewhere.
struct TickGoals {
    static constexpr std::size_t kMax = 4;
    std::array<TracePoint, kMax> goals{};
    std::array<TracePoint, kMax> proxies{}; // after each
    std::array<bool, kMax> are_in_contact{};
    std::size_t count = 0;
};

struct TickState {
    bool has_hand = false; // a position has been taken over
    WorkspacePoint hand{};
    double twist_rad = 0.0;
    bool has_frame = false;
    WorkspaceFrame frame;
    std::uint64_t frame_number = 0;
    std::uint64_t map_serial = 0; // 0: none
    std::uint64_t map_id = 0;
    double exaggeration = 0.0; // of the map
    bool has_touched = false;  // this map, since it came
    ContactState contact;      // the last
    TracePoint proxy{};        // the same on the map
    ScenePoint goal{};
    GridPoint at{}; // of the proxy, in the last tick
    ModeState modes;
    PassivityState passivity;
    SafetyState safety;
    double period_s = 0.0; // smoothed
    unsigned misses = 0;   // in quarters
    bool is_late = false;  // lets go until none is left
};

struct StepResult {
    Vec3 force_n{}; // to be written
    LetGoReason reason = LetGoReason::None;
    StylusMode mode = StylusMode::Hover;
    bool has_changed_mode = false;
    bool has_changed_map = false; // another map, or the same one jumped
    WorkspacePoint hand{};
    ScenePoint goal{};
    ContactState contact;
    TracePoint proxy{};
    TickGoals goals;                  // that the contact model was given, in order
    double ground_share = 1.0;        // of the ground's force that the walls let through
    double stiffness_n_per_m = 0;     // that was used
    double damping_n_s_per_m = 0;     // that was added to stay passive
    std::uint32_t missed_samples = 0; // of terrain that was not there at full resolution
    bool has_ground_changed = false;  // the contact model was told that its terrain has changed
};

/// The tick. `dt_s` is the time from the last sample to this one. Everything that it knows is in
/// its arguments, and in the contact model that the settings hold; the same again gives the same
/// again. Neither allocates nor waits.
StepResult
step(const TickOptions& options, const TickInput& input, TickState& state, double dt_s) noexcept;

/// The stiffness that is used where `wanted` is asked for: no more than the device is stable with,
/// and less where the loop runs slower than it should, as a sampled spring is stable only up to a
/// stiffness that falls with its period (J. E. Colgate and G. Schenkel, Passivity of a class of
/// sampled-data systems, 1997). A device that can push and states no stiffness is taken for one of
/// kStiffnessUnstatedNPerM.
double usedStiffness(double wanted_n_per_m,
                     const DeviceCapabilities& device,
                     double nominal_period_s,
                     double period_s) noexcept;

} // namespace marsview
