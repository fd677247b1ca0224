#include "haptics/interaction/stylus.h"

#include <algorithm>
#include <optional>

namespace marsview {

void Stylus::setGround(const SceneSurface& ground, double exaggeration)
{
    const auto is_same = [](const SceneMap& a, const SceneMap& b) {
        return a.map.dataset == b.map.dataset && a.frame == b.frame;
    };
    const bool is_same_ground = std::equal(ground.maps().begin(), ground.maps().end(),
                                           ground_.maps().begin(), ground_.maps().end(), is_same);
    ground_ = ground;
    exaggeration_ = exaggeration;
    if (!is_same_ground) {
        lift();
    }
    if (!pose_) {
        return;
    }
    if (model_) {
        model_->setSurface(surfaceOf(at_.index));
    }
    updatePose(pose_->mode, stylusGoal(aimedGround(), reach_, model_.has_value(), point_m_));
}

void Stylus::aim(const GroundPoint& at, const StylusButtons& buttons, double point_m)
{
    const StylusMode mode = pose_ ? nextMode(pose_->mode, buttons, pose_->is_in_contact)
                                  : nextMode(StylusMode::Hover, buttons, false);
    if (pose_ && (mode == StylusMode::Pan || mode == StylusMode::Zoom)) {
        pose_->mode = mode;
        return;
    }
    if (at.index != at_.index) {
        model_.reset();
    }
    at_ = at;
    point_m_ = point_m;
    const bool is_pressing = mode == StylusMode::Press;
    const ScenePoint goal = stylusGoal(aimedGround(), reach_, is_pressing, point_m_);
    if (is_pressing) {
        press(goal);
    } else {
        // Hovering, a mouse has no height of its own that could get in the way of a ridge.
        model_.reset();
    }
    updatePose(mode, goal);
}

void Stylus::lift()
{
    model_.reset();
    pose_.reset();
}

void Stylus::deepen(double factor)
{
    reach_.depth_points =
        std::clamp(reach_.depth_points * factor, kStylusDepthMin, kStylusDepthMax);
}

HeightfieldSurface Stylus::surfaceOf(std::size_t index) const
{
    const SceneMap& map = ground_.maps()[index];
    return {map.map.filled, map.frame, exaggeration_};
}

ScenePoint Stylus::aimedGround() const
{
    return ground_.maps()[at_.index].frame.toScene(at_.grid, at_.height_m * exaggeration_);
}

void Stylus::press(const ScenePoint& goal)
{
    constexpr int kHalvings = 10;
    const ScenePoint ground = aimedGround();
    if (!model_) {
        model_.emplace(surfaceOf(at_.index));
        model_->place(goal); // from straight above: nothing beside the place is in the way
    }
    ScenePoint proxy = model_->update(goal).proxy;
    // A map's surface goes on below the maps that cover it, and across its voids, through which
    // lower ones are seen. The proxy must not slide there: it is pressed less deep.
    Vec3 depth = goal - ground;
    for (int i = 0; i < kHalvings && !isOnItsMap(proxy); ++i) {
        depth = depth * 0.5;
        proxy = model_->place(ground + depth).proxy;
    }
}

bool Stylus::isOnItsMap(const ScenePoint& proxy) const
{
    return ground_.mapAt(proxy.x, proxy.y).value_or(at_.index) == at_.index;
}

void Stylus::updatePose(StylusMode mode, const ScenePoint& goal)
{
    const auto contact = model_ ? model_->contact() : std::nullopt;
    const ScenePoint proxy = contact ? model_->surface().point(*contact) : goal;
    pose_ = StylusPose{.mode = mode,
                       .proxy = proxy,
                       .goal = goal,
                       .is_in_contact = contact.has_value(),
                       .force_n = contact ? stylusForce(proxy, goal, point_m_) : Vec3{}};
}

} // namespace marsview
