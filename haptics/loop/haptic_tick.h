// One tick of the servo loop: from the stylus position to the force, without clock or device.
#pragma once

#include "haptics/device/haptic_device.h"
#include "haptics/interaction/body_modes.h"
#include "haptics/interaction/hand_modes.h"
#include "haptics/interaction/hand_view.h"
#include "haptics/interaction/workspace_fit.h"
#include "haptics/interaction/workspace_walls.h"
#include "haptics/loop/passivity_observer.h"
#include "haptics/loop/safety_limiter.h"
#include "haptics/terrain/servo_map.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

namespace marsview {

/// Who has set a frame. View: the user or a flight has moved the camera; another place may now be
/// below the hand. Limit: the view has corrected the frame that the hand has moved; the surface
/// stays, and the map's momentum ends.
enum class FrameOrigin : std::uint8_t { View, Limit };

/// Settings for the loop: a tick sees all of them or none. Copies share the map.
struct LoopSettings {
    /// Null: nothing to touch. If the terrain and the workspace frame change together (another
    /// exaggeration), the new map and the new frame must be in the same set(): a tick with only one
    /// of them would misplace the hand.
    std::shared_ptr<ServoMap> map;
    /// Applied when `frame_number` changes. With body_axes if the map lies on its body.
    WorkspaceFrame frame;
    std::uint64_t frame_number = 0; // otherwise the loop keeps the frame as its hand has moved it
    FrameOrigin frame_origin = FrameOrigin::View;
    std::optional<ViewBounds> view_bounds{};
    /// In free space, while the map is at rest, the workspace slowly moves there; empty: it stays.
    std::optional<WorkspaceFit> fit{};
    double stiffness_n_per_m = 300.0; // of surface and walls; limited by the device
    double force_share = 1.0;         // of all forces, 0 to 1
    bool has_walls = true;
    bool is_grabbing = false; // with a key instead of the stylus button
    /// The first button of the stylus sets points for a tool instead of grabbing the map; the
    /// second one still grabs.
    bool is_placing = false;
    bool is_stopped = false; // emergency stop
    /// What is seen at the hand is not this map but another one that cannot be touched: the hand is
    /// in free space, and there is no edge.
    bool is_covered = false;
    ModeOptions modes{};
    /// The part of the workspace in which a simulated hand strokes; empty: all of it.
    std::optional<WorkspaceBox> strokes{};
};

/// The button that sets points, see LoopSettings::is_placing.
constexpr std::uint32_t kPlacingButton = 0b01;

/// How surface and wall forces are combined. NaiveSum exists only to measure the effect of Fade.
enum class ForceMixing : std::uint8_t { Fade, NaiveSum };

/// A third of the stable stiffness of the simulated hand at 3 ms of delay
/// (tests/bench/STABILITY.md).
inline constexpr double kStiffnessUnstatedNPerM = 300.0;

/// Constant while a device is open.
struct TickOptions {
    SafetyLimits limits;
    PassivityOptions passivity;
    bool is_passivity_kept = true;
    ForceMixing mixing = ForceMixing::Fade;
    double period_s = 1e-3; // nominal
    std::chrono::nanoseconds sample_age_max{15'000'000};
    std::chrono::nanoseconds terrain_age_max{500'000'000};
    /// Consecutive missed deadlines before the force is turned off. Each tick in time cancels a
    /// quarter of a miss, so a miss rate above one in five also turns the force off after a while.
    /// The force stays off until all misses are canceled.
    unsigned misses_max = 5;
};

/// Options for a device: its peak force is the short-term limit, and its continuous force, if
/// stated, the long-term limit.
TickOptions tickOptionsFor(const DeviceCapabilities& device);

struct TickInput {
    const LoopSettings* settings = nullptr;
    const DeviceCapabilities* device = nullptr;
    DeviceStatus status = DeviceStatus::Fine;
    DeviceSample sample;
    /// For a device that plays back a recording: replaces the sample's position. The map moves, and
    /// the mode changes, as recorded.
    const RecordedTick* recorded = nullptr;
    std::chrono::steady_clock::time_point now{};
    bool has_missed_deadline = false; // the last tick ended, or this one began, too late
    /// Seconds since the last force was written, for the limiter; empty: dt_s. A value above
    /// kSafetyStepMaxS is a pause and turns the force off.
    std::optional<double> since_write_s{};
};

/// The goals of one tick: one, or the sequence that moves the proxy to another place.
struct TickGoals {
    static constexpr std::size_t kMax = 4;
    std::array<TracePoint, kMax> goals{};
    std::array<TracePoint, kMax> proxies{}; // after each
    std::array<bool, kMax> are_in_contact{};
    std::size_t count = 0;
};

struct TickState {
    bool has_hand = false; // a position has been accepted
    WorkspacePoint hand{};
    double twist_rad = 0.0;
    std::uint32_t buttons = 0;
    bool is_placing = false; // the first button was pressed to set a point, and is still held
    bool has_frame = false;
    WorkspaceFrame frame;
    WorkspaceFrame seen_frame; // moves as the camera: also where the workspace alone has moved
    std::uint64_t frame_number = 0;
    std::uint64_t map_serial = 0; // 0: none
    std::uint64_t map_id = 0;
    double exaggeration = 0.0; // of the map
    bool has_touched = false;  // since this map was set
    bool is_on_map = false;    // the hand has been over the map, whose edge is a wall from inside
    bool is_lost = false;      // on a body, below the surface after its border let the proxy go
    ContactState contact;      // the last
    TracePoint proxy{};        // the same as in recordings
    ScenePoint goal{};
    /// Of the proxy, in the last tick, on each of ServoMap::tiles; empty away from it.
    std::array<std::optional<GridPoint>, LayeredMesh::kTiledMax> at{};
    ModeState modes;
    BodyModeState body_modes;   // of a map on its body
    Vec3 surface_force_n{};     // the last, on the hand
    Vec3 held_force_n{};        // the last, while the hand holds the map
    Vec3 release_n{};           // by which it differed from the surface force at the release
    double release_share = 0.0; // of this difference that is still applied
    PassivityState passivity;
    SafetyState safety;
    double period_s = 0.0; // smoothed
    unsigned misses = 0;   // in quarters
    bool is_late = false;  // force off until no misses are left
};

struct StepResult {
    Vec3 force_n{};                 // to be written
    bool is_force_recorded = false; // published in place of the written one
    ForceOffReason reason = ForceOffReason::None;
    StylusMode mode = StylusMode::Hover;
    bool has_changed_mode = false;
    bool has_changed_map = false; // another map, or the same map moved abruptly
    WorkspacePoint hand{};
    ScenePoint goal{};
    ContactState contact;
    std::optional<SceneMotion> motion{}; // of the map by the hand
    bool is_at_edge = false;             // beyond the edge of the map, which holds the hand back
    bool has_pressed_point = false;      // LoopSettings::is_placing: the button went down
    bool has_released_point = false;     // and up again
    TracePoint proxy{};
    TickGoals goals;                  // passed to the contact model, in order
    double ground_share = 1.0;        // fraction of the surface force that the walls let through
    double stiffness_n_per_m = 0;     // the stiffness used
    double damping_n_s_per_m = 0;     // added for passivity
    std::uint32_t missed_samples = 0; // terrain samples not available at full resolution
    bool has_ground_changed = false;  // the contact model was notified of a terrain change
    /// Of the surface straight below or above the hand, in the workspace; NaN outside the map. On a
    /// body, along the local vertical.
    double surface_z_m = std::numeric_limits<double>::quiet_NaN();
};

///     TickState state;
///     const TickOptions options = tickOptionsFor(device.capabilities());
///     const StepResult result = step(options, input, state, 0.001); // once per sample
///     device.write(result.force_n);
///
/// Computes one tick. `dt_s` is the time from the last sample to this one. The result depends only
/// on the arguments and on the contact model in the settings: the same inputs give the same
/// outputs. Does not allocate or wait.
StepResult
step(const TickOptions& options, const TickInput& input, TickState& state, double dt_s) noexcept;

/// The result that step() would have, without changing anything: loads code and data of the tick
/// into the processor's caches. Terrain that has newly arrived is left to the tick.
StepResult rehearse(const TickOptions& options,
                    const TickInput& input,
                    const TickState& state,
                    double dt_s) noexcept;

/// The stiffness that is used for the requested one: at most the device's stable stiffness, and
/// less if the loop runs slower than nominal, since the stable stiffness of a sampled spring falls
/// with its period (J. E. Colgate and G. Schenkel, Passivity of a class of sampled-data systems,
/// 1997). For a device that can push and states no stiffness, kStiffnessUnstatedNPerM is assumed.
double usedStiffness(double wanted_n_per_m,
                     const DeviceCapabilities& device,
                     double nominal_period_s,
                     double period_s) noexcept;

} // namespace marsview
