#include "haptics/loop/haptic_tick.h"

#include "core/base/rotation.h"
#include "core/body/body_positions.h"
#include "haptics/device/time_between.h"

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

using std::chrono::nanoseconds;

constexpr double kStepMaxS = 0.01; // longer steps are clamped to this for the dynamics

Vec3 asVector(const WorkspacePoint& p) noexcept
{
    return {p.x, p.y, p.z};
}

// A position that the device cannot have: wrong units, or a broken encoder.
bool isBeyond(const WorkspaceBox& box, const WorkspacePoint& p) noexcept
{
    const auto isOut = [](double at, double low, double high) {
        constexpr double kMarginM = 0.25;
        const double margin = std::max(kMarginM, high - low);
        return !(at >= low - margin && at <= high + margin); // also true for NaN
    };
    return isOut(p.x, box.low.x, box.high.x) || isOut(p.y, box.low.y, box.high.y) ||
           isOut(p.z, box.low.z, box.high.z);
}

// A hand moves its stylus at less than 5 m/s. `dt_s` is at most kStepMaxS.
bool isJump(const Vec3& shift_m, double dt_s) noexcept
{
    constexpr double kSpeedMaxMPerS = 5.0;
    constexpr double kSlackM = 0.01;
    return !(length(shift_m) <= kSlackM + kSpeedMaxMPerS * dt_s);
}

ForceOffReason reasonOf(DeviceStatus status) noexcept
{
    switch (status) {
    case DeviceStatus::Fine:
        return ForceOffReason::None;
    case DeviceStatus::Unready:
        return ForceOffReason::DeviceUnready;
    case DeviceStatus::Lost:
        return ForceOffReason::DeviceLost;
    case DeviceStatus::Finished:
        return ForceOffReason::DeviceFinished;
    }
    return ForceOffReason::Fault;
}

enum class Purpose : std::uint8_t { Tick, Rehearsal };

// One tick, with the data passed between its steps.
class Tick {
public:
    Tick(Purpose purpose,
         const TickOptions& options,
         const TickInput& input,
         TickState& state,
         double dt_s) noexcept
        : is_rehearsal_(purpose == Purpose::Rehearsal)
        , options_(options)
        , input_(input)
        , settings_(*input.settings)
        , state_(state)
        , since_write_s_(input.since_write_s.value_or(dt_s))
        , dt_s_(std::isfinite(dt_s) ? std::clamp(dt_s, 0.0, kStepMaxS) : 0.0)
        , map_(settings_.map.get())
    {}

    StepResult run() noexcept
    {
        learnPeriod();
        takeFrame();
        takeMap();
        const bool is_known = takeHand();
        Forces forces;
        if (is_known && map_ != nullptr) {
            forces = interact();
        }
        limit(forces);
        publish();
        return result_;
    }

private:
    // A hand may press walls and the map's edge with any force. If the sum of all forces exceeds
    // the limit, theirs are reduced, not that of the surface.
    struct Forces {
        Vec3 force_n{};
        Vec3 yielding_n{};
    };

    void learnPeriod() noexcept
    {
        if (!(dt_s_ > 0.0)) {
            return;
        }
        constexpr double kShare = 0.02; // about 50 ticks
        state_.period_s = state_.period_s > 0.0
                              ? state_.period_s + kShare * (dt_s_ - state_.period_s)
                              : std::max(dt_s_, options_.period_s);
    }

    void takeFrame() noexcept
    {
        if (state_.has_frame && state_.frame_number == settings_.frame_number) {
            return;
        }
        if (!settings_.frame.isSound()) {
            return;
        }
        // A camera that moves smoothly carries the map along; after a jump another place is below
        // the hand.
        constexpr double kJumpM = 2e-3;
        const Vec3 moved_m =
            state_.has_frame
                ? settings_.frame.toWorkspace(state_.frame.toScene(state_.hand)) - state_.hand
                : Vec3{};
        const bool is_limit = state_.has_frame && settings_.frame_origin == FrameOrigin::Limit;
        if (is_limit) {
            state_.modes.pan.velocity_m_per_s = {};
            state_.body_modes.spin_rad_per_s = {};
        }
        if (input_.recorded != nullptr) {
            state_.has_hand = false; // the recorded goal does not depend on the view
        } else if (state_.has_frame && !is_limit && !(length(moved_m) < kJumpM)) {
            has_jumped_ = true;
        }
        // At another scale the touched point moves although the hand does not.
        if (state_.has_frame && !is_limit && state_.contact.is_in_contact) {
            const ScenePoint& at = state_.contact.proxy;
            is_stretched_ =
                !(length(settings_.frame.toWorkspace(at) - state_.frame.toWorkspace(at)) < kJumpM);
        }
        state_.frame =
            is_limit ? state_.frame.moved(state_.seen_frame, settings_.frame) : settings_.frame;
        state_.seen_frame = settings_.frame;
        state_.frame_number = settings_.frame_number;
        state_.has_frame = true;
    }

    void takeMap() noexcept
    {
        if (map_ != nullptr && isOnBody() != state_.frame.body_axes.has_value()) {
            map_ = nullptr; // until its frame comes
        }
        const std::uint64_t serial = map_ != nullptr ? map_->serial : 0;
        if (serial == state_.map_serial) {
            return;
        }
        if (map_ != nullptr && map_->map_id == state_.map_id && state_.has_touched) {
            is_other_model_ = true; // of the same map: it continues at the last model's proxy
        } else {
            is_fresh_ = true;
        }
        // The same terrain at another exaggeration: the penetration depth has jumped.
        const double exaggeration = map_ != nullptr ? map_->frame.exaggeration() : 0.0;
        is_stretched_ = is_stretched_ || (is_other_model_ && exaggeration != state_.exaggeration);
        state_.exaggeration = exaggeration;
        state_.map_serial = serial;
        state_.map_id = map_ != nullptr ? map_->map_id : 0;
        state_.has_touched = false;
    }

    // Whether there is a hand to interact with.
    bool takeHand() noexcept
    {
        result_.reason =
            settings_.is_stopped ? ForceOffReason::EmergencyStop : reasonOf(input_.status);
        if (input_.status != DeviceStatus::Fine) {
            return false;
        }
        WorkspacePoint at = input_.sample.position;
        if (input_.recorded != nullptr && map_ != nullptr) {
            at = state_.frame.toWorkspace(map_->surface->toScene(input_.recorded->goal));
        } else {
            note(ageReason());
            if (!isFinite(asVector(at)) || isBeyond(input_.device->workspace, at) ||
                !std::isfinite(input_.sample.twist_rad)) {
                note(ForceOffReason::DeviceImplausible);
                return false;
            }
            if (state_.has_hand && isJump(at - state_.hand, dt_s_)) {
                note(ForceOffReason::DeviceImplausible); // and continues from there
                has_jumped_ = true;
                state_.has_hand = false;
            }
            if (!input_.sample.is_held) {
                note(ForceOffReason::NotHeld);
            }
        }
        shift_m_ = state_.has_hand ? at - state_.hand : Vec3{};
        twist_change_rad_ = state_.has_hand
                                ? std::remainder(input_.sample.twist_rad - state_.twist_rad,
                                                 2.0 * 3.14159265358979323846)
                                : 0.0;
        state_.hand = at;
        state_.twist_rad = input_.sample.twist_rad;
        state_.has_hand = true;
        takeButtons();
        return true;
    }

    // A button that was pressed for a point does not grab until it is released, whatever the tool
    // is then; one that grabbed sets no point.
    void takeButtons() noexcept
    {
        const std::uint32_t now = input_.recorded == nullptr ? input_.sample.buttons : 0;
        const bool is_down = (now & kPlacingButton) != 0;
        const bool was_down = (state_.buttons & kPlacingButton) != 0;
        result_.has_pressed_point = is_down && !was_down && settings_.is_placing;
        result_.has_released_point = !is_down && state_.is_placing;
        state_.is_placing = is_down && (state_.is_placing || result_.has_pressed_point);
        state_.buttons = now;
    }

    ForceOffReason ageReason() const noexcept
    {
        const nanoseconds age = timeBetween(input_.sample.time, input_.now);
        const bool is_stale = age > options_.sample_age_max || age < -options_.sample_age_max;
        return is_stale ? ForceOffReason::DeviceStale : ForceOffReason::None;
    }

    void note(ForceOffReason reason) noexcept
    {
        if (result_.reason == ForceOffReason::None) {
            result_.reason = reason;
        }
    }

    Forces interact() noexcept
    {
        const double stiffness = usedStiffness(settings_.stiffness_n_per_m, *input_.device,
                                               options_.period_s, state_.period_s);
        result_.stiffness_n_per_m = stiffness;
        WallContact walls;
        if (settings_.has_walls && input_.recorded == nullptr) {
            walls = wallsAt(input_.device->workspace, state_.hand, stiffness);
        }
        const double share = options_.mixing == ForceMixing::Fade ? walls.ground_share : 1.0;
        result_.ground_share = share;

        const std::uint32_t grabbing_buttons =
            kGrabbingButtons & ~(state_.is_placing ? kPlacingButton : 0U);
        const bool is_grabbing =
            (input_.sample.buttons & grabbing_buttons) != 0 || settings_.is_grabbing;
        const WorkspaceFrame seen = state_.seen_frame;
        moveAsRecorded();
        const double clearance_m = clearance();
        const ModeStep mode = stepMode({.hand = state_.hand,
                                        .hand_shift = shift_m_,
                                        .twist_change_rad = twist_change_rad_,
                                        .is_grabbing = is_grabbing,
                                        .is_in_contact = state_.contact.is_in_contact,
                                        .free_share = share,
                                        .stiffness_n_per_m = stiffness,
                                        .surface_force_n = state_.surface_force_n,
                                        .clearance_m = clearance_m,
                                        .frame = state_.frame});
        result_.has_changed_mode = mode.has_changed_mode;
        bool has_moved = true;
        if (mode.has_moved_map && mode.frame.isSound()) {
            const WorkspaceFrame before = state_.frame;
            state_.frame = mode.frame;
            state_.seen_frame = state_.seen_frame.moved(mode.seen_from, mode.frame);
            keepWithinView(share);
            keepHandOnMap(before);
        } else if (settings_.fit && !isHolding(state_.modes.mode) &&
                   !state_.contact.is_in_contact && input_.recorded == nullptr) {
            fitWorkspace();
        } else {
            has_moved = false;
        }
        if (!isHolding(state_.modes.mode) && input_.recorded == nullptr) {
            lowerIntoReach(has_moved ? clearance() : clearance_m);
        }
        if (!(state_.seen_frame == seen)) {
            result_.motion = state_.seen_frame.motionFrom(seen);
        }
        refreshTerrain(stiffness);
        Forces forces{.force_n = mode.force_n, .yielding_n = walls.force_n};
        const Vec3 surface_n = touch() * (stiffness * share);
        const Vec3 edge_n = edge_m_ * (stiffness * share);
        if (isHolding(state_.modes.mode)) {
            state_.held_force_n = mode.force_n;
            state_.release_share = 0.0;
        } else {
            forces.force_n = forces.force_n + surface_n + release(surface_n + edge_n);
            forces.yielding_n = forces.yielding_n + edge_n;
        }
        state_.surface_force_n = surface_n + edge_n;
        const double force_share = std::clamp(settings_.force_share, 0.0, 1.0);
        forces = {forces.force_n * force_share, forces.yielding_n * force_share};
        if (!options_.is_passivity_kept) {
            return forces;
        }
        const Vec3 force_n = forces.force_n + forces.yielding_n;
        const PassivityStep passive = keepPassive(
            options_.passivity,
            {.force_n = force_n, .shift_m = shift_m_, .stored_j = storedEnergy(force_n, stiffness)},
            state_.passivity, dt_s_);
        result_.damping_n_s_per_m = passive.damping_n_s_per_m;
        forces.force_n = forces.force_n + (passive.force_n - force_n);
        return forces;
    }

    bool isOnBody() const noexcept { return map_->surface->body() != nullptr; }

    ModeStep stepMode(const ModeInput& input) noexcept
    {
        return isOnBody() ? stepBodyModes(modeOptions(), input, *map_->surface->body(),
                                          state_.modes, state_.body_modes, dt_s_)
                          : stepModes(modeOptions(), input, state_.modes, dt_s_);
    }

    // In a spring that exerts the force, and in a map that the hand has set in motion.
    double storedEnergy(const Vec3& force_n, double stiffness) const noexcept
    {
        const double spring_j = 0.5 * dot(force_n, force_n) / std::max(stiffness, 1.0);
        const Vec3& map_m_per_s = state_.modes.pan.velocity_m_per_s;
        return isHolding(state_.modes.mode)
                   ? spring_j + 0.5 * settings_.modes.pan.mass_kg * dot(map_m_per_s, map_m_per_s)
                   : spring_j;
    }

    // Slowly where that brings the surface closer to the hand.
    void fitWorkspace() noexcept
    {
        const FitOptions options;
        const WorkspaceFrame before = state_.frame;
        const double clearance_m = clearance();
        const double near = fitShare(options, clearance_m);
        const auto move = [&](double share) {
            state_.frame = fitted(options, *settings_.fit, before, state_.seen_frame, state_.hand,
                                  {.share = share, .haste = near}, dt_s_);
        };
        move(1.0);
        if (!(clearance() >= clearance_m)) {
            move(near);
        }
    }

    // A surface above the top of the workspace, where a flight or a glide has put it, cannot be
    // touched, and the hand below it never gets into free space: it sinks to the top. A surface
    // within the workspace rests in contact.
    void lowerIntoReach(double clearance_m) noexcept
    {
        const WorkspaceBox& reach = input_.device->workspace;
        const double above_m = surfaceZ(clearance_m) - reach.high.z;
        if (!(reach.low.z < reach.high.z) || !(above_m > 0.0)) { // also for NaN
            return;
        }
        const FitOptions options;
        const double speed = std::max(options.speed_m_per_s, above_m / options.settle_s);
        state_.frame = state_.frame.panned({0.0, 0.0, -std::min(above_m, speed * dt_s_)});
    }

    void moveAsRecorded() noexcept
    {
        if (input_.recorded == nullptr || !input_.recorded->motion) {
            return;
        }
        const WorkspaceFrame moved = state_.seen_frame.after(*input_.recorded->motion);
        if (moved.isSound()) {
            state_.frame = state_.frame.moved(state_.seen_frame, moved);
            state_.seen_frame = moved;
        }
    }

    // The limits of the zoom are those of the frame that the camera follows.
    ModeOptions modeOptions() const noexcept
    {
        ModeOptions modes = settings_.modes;
        const double share = state_.frame.scene_per_meter / state_.seen_frame.scene_per_meter;
        modes.scene_per_meter_min *= share;
        modes.scene_per_meter_max *= share;
        return modes;
    }

    // Of the hand over the terrain below it, in the workspace.
    double clearance() const noexcept
    {
        return map_->surface->clearance(state_.frame.toScene(state_.hand)) /
               state_.frame.scene_per_meter;
    }

    // Of the surface straight below the hand, in the workspace.
    double surfaceZ(double clearance_m) const noexcept
    {
        if (!isOnBody()) {
            return state_.hand.z - clearance_m;
        }
        const Vec3 up = verticalAt(*map_->surface->body(), state_.frame.toScene(state_.hand)).up;
        return state_.hand.z - clearance_m * dot(state_.frame.body_axes->z, up);
    }

    // Moves the map by `shift_m`, in the scene, back from where the hand has moved it.
    void moveBack(const Vec3& shift_m, double hold_share) noexcept
    {
        state_.frame.place = state_.frame.place + shift_m;
        state_.seen_frame.place = state_.seen_frame.place + shift_m;
        if (isOnBody()) {
            state_.body_modes.spin_rad_per_s = {};
            return;
        }
        stopMap(state_.modes.pan, -state_.frame.differenceToWorkspace(shift_m),
                state_.modes.mode == StylusMode::Pan ? hold_share : 0.0);
    }

    // The same by a turn of the body about its center.
    void rollBack(const Rotation& turn, double hold_share) noexcept
    {
        const ScenePoint at = state_.frame.toScene(state_.hand);
        for (WorkspaceFrame* frame : {&state_.frame, &state_.seen_frame}) {
            frame->place = turn * frame->place;
            frame->body_axes = (turn * *frame->body_axes).orthonormal();
        }
        const Vec3 shift_m = state_.frame.differenceToWorkspace(at - turn * at);
        state_.body_modes.spin_rad_per_s = {};
        stopMap(state_.modes.pan, state_.body_modes.level * shift_m,
                state_.modes.mode == StylusMode::Pan ? hold_share : 0.0);
    }

    // The map's motion ends where the camera's target reaches its bounds: a hand that goes on
    // pulling feels the hold's spring, which relaxes at a wall.
    void keepWithinView(double share) noexcept
    {
        if (!settings_.view_bounds) {
            return;
        }
        const ViewBounds& bounds = *settings_.view_bounds;
        const ScenePoint target = state_.seen_frame.toScene(bounds.target);
        if (isOnBody()) {
            const Vec3 axis = cross(bounds.middle, target);
            const double over_rad =
                std::atan2(length(axis), dot(bounds.middle, target)) - bounds.reach_rad;
            if (over_rad > 0.0) {
                rollBack(Rotation::by(normalized(axis) * -over_rad), share);
            }
            return;
        }
        ScenePoint kept = target;
        kept.x = std::clamp(target.x, bounds.low.x, std::max(bounds.low.x, bounds.high.x));
        kept.y = std::clamp(target.y, bounds.low.y, std::max(bounds.low.y, bounds.high.y));
        if (!(kept == target)) {
            moveBack(kept - target, share);
        }
    }

    // A gliding map stops where its edge reaches the hand.
    void keepHandOnMap(const WorkspaceFrame& before) noexcept
    {
        if (!state_.is_on_map || isHolding(state_.modes.mode)) {
            return;
        }
        const Vec3 was_m = map_->surface->beyondMap(before.toScene(state_.hand));
        const Vec3 is_m = map_->surface->beyondMap(state_.frame.toScene(state_.hand));
        if (length(is_m) > length(was_m)) {
            moveBack(was_m - is_m, 0.0);
        }
    }

    // After a release the force of the hold passes over to that of the surface.
    Vec3 release(const Vec3& surface_n) noexcept
    {
        if (has_jumped_ || is_fresh_ || is_entering_) {
            state_.release_share = 0.0;
        } else if (result_.has_changed_mode) {
            state_.release_n = state_.held_force_n - surface_n;
            state_.release_share = 1.0;
        }
        const Vec3 rest_n = state_.release_n * state_.release_share;
        state_.release_share = std::max(
            0.0, state_.release_share - dt_s_ / std::max(options_.limits.change_ramp_s, 1e-3));
        return rest_n;
    }

    void refreshTerrain(double stiffness) noexcept
    {
        if (is_rehearsal_) {
            return;
        }
        // Newly arrived terrain may change the force at most at this rate.
        constexpr double kForceRateNPerS = 20.0;
        const double rate_m_per_s =
            std::max(1e-3, kForceRateNPerS * state_.frame.scene_per_meter /
                               (std::max(stiffness, 1.0) * map_->frame.exaggeration()));
        for (std::size_t i = 0; i < map_->tiles.size(); ++i) {
            ServoTerrain& terrain = *map_->tiles[i].terrain;
            terrain.resident().setRate(rate_m_per_s);
            terrain.resident().resetMisses();
            result_.has_ground_changed =
                terrain.refresh(motionOver(i), dt_s_) || result_.has_ground_changed;
            if (terrain.silence(input_.now) > options_.terrain_age_max) {
                note(ForceOffReason::TerrainStale);
            }
        }
        if (result_.has_ground_changed) {
            map_->model->terrainChanged();
        }
    }

    // Of the proxy over a map in tiles.
    HandMotion motionOver(std::size_t tiles) noexcept
    {
        const auto [at, column_share, is_near] = map_->surface->onGrid(
            state_.has_touched ? state_.contact.proxy : state_.frame.toScene(state_.hand), tiles);
        std::optional<GridPoint>& last = state_.at[tiles];
        const double per_s = dt_s_ > 0.0 && state_.has_touched && last ? 1.0 / dt_s_ : 0.0;
        const double turn = map_->surface->columnsPerTurn(tiles);
        const GridPoint before = last.value_or(at);
        const double columns = at.column - before.column;
        last = is_near ? std::optional(at) : std::nullopt;
        return {.at = at,
                .columns_per_s = (turn > 0.0 ? std::remainder(columns, turn) : columns) * per_s,
                .rows_per_s = (at.row - before.row) * per_s,
                .column_share = column_share,
                .time_ns = input_.now.time_since_epoch() / nanoseconds(1),
                .is_active = is_near};
    }

    // Whether there is terrain below the hand. From inside, the edge of the map is a wall; beside
    // the map there is nothing to touch until the hand comes over it.
    bool isOverMap() noexcept
    {
        if (input_.recorded != nullptr) {
            return true;
        }
        const ScenePoint at = state_.frame.toScene(state_.hand);
        beyond_m_ = map_->surface->beyondMap(at);
        result_.is_at_edge = !(beyond_m_ == Vec3{});
        if (!result_.is_at_edge) {
            is_entering_ = !state_.is_on_map && state_.has_touched;
            state_.is_on_map = true;
        } else if (has_jumped_ || is_fresh_) {
            state_.is_on_map = false;
        }
        if (settings_.is_covered) {
            state_.is_on_map = false;
            is_entering_ = false;
        }
        if (!state_.is_on_map) { // coming back, the proxy is put straight above the hand
            state_.goal = at;
            state_.contact = {};
            state_.contact.proxy = at;
            state_.proxy = map_->surface->fromScene(at);
        }
        result_.is_at_edge = result_.is_at_edge && state_.is_on_map;
        return state_.is_on_map;
    }

    // From the stylus to the proxy, in workspace meters; from beyond the map, from its edge on.
    Vec3 touch() noexcept
    {
        if (!isOverMap()) {
            return {};
        }
        is_entering_ = is_entering_ || (state_.is_lost && input_.recorded == nullptr);
        const TracePoint aimed = input_.recorded != nullptr ? input_.recorded->goal : aim();
        if (is_other_model_ && !has_jumped_ && !is_entering_) {
            goOnAtProxy();
        } else if (map_->is_touched && (has_jumped_ || is_entering_ || !state_.has_touched)) {
            putStraightAbove(aimed);
        } else if (isHeldByWall(aimed)) {
            putStraightAbove(aimed);
        }
        update(aimed);
        state_.has_touched = true;
        if (!is_rehearsal_) {
            map_->is_touched = true;
        }
        std::uint64_t missed = 0;
        for (const ServoTiles& tiles : map_->tiles) {
            missed += tiles.terrain->resident().misses().count;
        }
        result_.missed_samples =
            static_cast<std::uint32_t>(std::min<std::uint64_t>(missed, UINT32_MAX));
        constexpr double kBelowM = 1e-5;
        state_.is_lost = isOnBody() && !state_.contact.is_in_contact && clearance() < -kBelowM;
        if (state_.contact.counters.refused != 0) {
            return {};
        }
        const ScenePoint over = isOnBody() ? state_.goal : map_->surface->overMap(state_.goal);
        edge_m_ = state_.frame.differenceToWorkspace(-beyond_m_);
        return state_.contact.is_in_contact
                   ? state_.frame.differenceToWorkspace(state_.contact.proxy - over)
                   : Vec3{};
    }

    TracePoint aim() const noexcept
    {
        return map_->surface->fromScene(map_->surface->overMap(state_.frame.toScene(state_.hand)));
    }

    // Recomputes the goal from what a recording stores, so that a replay gives the same result.
    void update(const TracePoint& goal) noexcept
    {
        state_.goal = map_->surface->toScene(goal);
        state_.contact =
            is_rehearsal_ ? map_->model->rehearse(state_.goal) : map_->model->update(state_.goal);
        if (state_.contact.counters.refused == 0) {
            // In free space exactly the goal, as in `trace`.
            state_.proxy = state_.contact.is_in_contact || map_->surface->isClamped(goal)
                               ? map_->surface->fromScene(state_.contact.proxy)
                               : goal;
        }
        TickGoals& goals = result_.goals;
        if (goals.count < TickGoals::kMax) {
            goals.goals[goals.count] = goal;
            goals.proxies[goals.count] = state_.proxy;
            goals.are_in_contact[goals.count] = state_.contact.is_in_contact;
            ++goals.count;
        }
    }

    // A recording has the goals over the wall.
    bool isHeldByWall(const TracePoint& goal) const noexcept
    {
        return input_.recorded == nullptr && !is_fresh_ && state_.contact.is_in_contact &&
               map_->surface->isHeldByWall(state_.contact.proxy, goal);
    }

    // Moves above all terrain and over to the new place: the result depends only on the goals.
    void putStraightAbove(const TracePoint& goal) noexcept
    {
        const HighWay way = map_->surface->highWay(map_->model->state().proxy, goal);
        for (std::size_t i = 0; i < way.count; ++i) {
            update(way.goals[i]);
        }
    }

    // Slightly below the last model's proxy, the new proxy is the nearest point of the surface.
    void goOnAtProxy() noexcept
    {
        if (!state_.contact.is_in_contact) {
            return;
        }
        constexpr double kHairM = 1e-6;
        const double depth = kHairM * state_.frame.scene_per_meter / map_->frame.exaggeration();
        update({state_.proxy.x, state_.proxy.y, state_.proxy.z - depth});
    }

    void limit(const Forces& forces) noexcept
    {
        if (map_ == nullptr) {
            note(ForceOffReason::NoTouch);
        }
        if (isTooLate()) {
            note(ForceOffReason::MissedDeadline);
        }
        result_.has_changed_map = has_jumped_ || is_fresh_ || is_stretched_ ||
                                  (is_entering_ && state_.contact.is_in_contact);
        const SafetyOutput safe = limitForce(options_.limits,
                                             {.force_n = forces.force_n,
                                              .yielding_n = forces.yielding_n,
                                              .reason = result_.reason,
                                              .has_changed = result_.has_changed_map},
                                             state_.safety, since_write_s_);
        result_.reason = safe.reason;
        result_.force_n = safe.force_n;
        noteWritten(state_.passivity, safe.force_n);
    }

    // Whether deadlines are missed too often, or nothing was written for so long that the hand may
    // have moved anywhere.
    bool isTooLate() noexcept
    {
        constexpr unsigned kQuarters = 4;
        const unsigned most = kQuarters * (options_.misses_max + 1);
        if (input_.has_missed_deadline) {
            state_.misses += kQuarters;
        } else if (state_.misses > 0) {
            --state_.misses;
        }
        const bool is_pause = since_write_s_ > kSafetyStepMaxS;
        if (is_pause || state_.misses >= most) {
            state_.misses = most;
            state_.is_late = true;
        }
        state_.is_late = state_.is_late && state_.misses > 0;
        return state_.is_late;
    }

    void publish() noexcept
    {
        result_.mode = state_.modes.mode;
        if (input_.recorded != nullptr) {
            result_.mode = input_.recorded->mode.value_or(result_.mode);
            if (result_.motion) {
                result_.motion = input_.recorded->motion; // to the bit
            }
        }
        result_.hand = state_.hand;
        result_.goal = state_.goal + (state_.is_on_map ? beyond_m_ : Vec3{}); // where the hand is
        result_.contact = state_.contact;
        result_.proxy = state_.proxy;
        if (map_ != nullptr && state_.has_hand &&
            map_->surface->beyondMap(state_.frame.toScene(state_.hand)) == Vec3{}) {
            result_.surface_z_m = surfaceZ(clearance());
        }
    }

    bool is_rehearsal_;
    const TickOptions& options_;
    const TickInput& input_;
    const LoopSettings& settings_;
    TickState& state_;
    double since_write_s_;
    double dt_s_;
    ServoMap* map_;
    StepResult result_;
    Vec3 shift_m_{};
    double twist_change_rad_ = 0.0;
    Vec3 beyond_m_{}; // from the map's edge to the hand, in the scene
    Vec3 edge_m_{};   // back to the edge that holds the hand, in the workspace
    bool is_entering_ = false;
    bool has_jumped_ = false;
    bool is_fresh_ = false;
    bool is_other_model_ = false;
    bool is_stretched_ = false;
};

} // namespace

TickOptions tickOptionsFor(const DeviceCapabilities& device)
{
    TickOptions options;
    options.limits.force_n_max = device.force_n_peak;
    options.limits.force_n_continuous =
        device.force_n_continuous > 0.0 ? device.force_n_continuous : device.force_n_peak;
    options.period_s = device.rate_hz > 0.0 ? 1.0 / device.rate_hz : 1e-3;
    return options;
}

double usedStiffness(double wanted_n_per_m,
                     const DeviceCapabilities& device,
                     double nominal_period_s,
                     double period_s) noexcept
{
    // A device without force output has no limit; the computed force is still displayed.
    const double unstated = device.force_n_peak > 0.0 ? kStiffnessUnstatedNPerM : wanted_n_per_m;
    const double stable =
        device.stiffness_n_per_m_max > 0.0 ? device.stiffness_n_per_m_max : unstated;
    const double rate = period_s > nominal_period_s ? nominal_period_s / period_s : 1.0;
    const double used = std::min(wanted_n_per_m, stable * rate);
    return used > 0.0 ? used : 0.0; // also for NaN
}

StepResult
step(const TickOptions& options, const TickInput& input, TickState& state, double dt_s) noexcept
{
    return Tick(Purpose::Tick, options, input, state, dt_s).run();
}

StepResult rehearse(const TickOptions& options,
                    const TickInput& input,
                    const TickState& state,
                    double dt_s) noexcept
{
    TickState copy = state;
    return Tick(Purpose::Rehearsal, options, input, copy, dt_s).run();
}

} // namespace marsview
