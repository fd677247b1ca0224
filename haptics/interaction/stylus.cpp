#include "haptics/interaction/stylus.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace marsview {

void Stylus::setGround(const SceneSurface& ground, double exaggeration)
{
    const auto is_same = [](const SceneMap& a, const SceneMap& b) {
        return a.map == b.map && a.frame == b.frame;
    };
    const bool is_same_ground = std::equal(ground.maps().begin(), ground.maps().end(),
                                           ground_.maps().begin(), ground_.maps().end(), is_same);
    ground_ = ground;
    exaggeration_ = exaggeration;
    if (!is_same_ground) {
        lift();
        touch_.reset();
    }
    if (!pose_) {
        return;
    }
    if (model_) {
        model_->map_model->setExaggeration(exaggeration_);
    }
    updatePose(pose_->mode, stylusGoal(aimedGround(), reach_, model_ != nullptr, point_m_));
}

void Stylus::setModel(ContactModelKind kind)
{
    if (kind == kind_) {
        return;
    }
    kind_ = kind;
    if (!model_) {
        return;
    }
    // Slightly away from the proxy toward the goal, the proxy is the nearest point of the surface.
    // Off the surface, as for a sphere's center, the motion continues from there.
    constexpr double kHair = 1e-6;
    const auto [proxy, goal] = std::pair(pose_->proxy, pose_->goal);
    model_ = makeModel();
    const ContactState placed = model_->model->place(proxy + (goal - proxy) * kHair);
    if (!placed.is_in_contact || pose_->mode == StylusMode::Press) {
        model_->model->update(goal);
    }
    keepOnItsMap(goal);
    updatePose(pose_->mode, goal);
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
        releaseModel();
        touch_.reset();
    }
    at_ = at;
    point_m_ = point_m;
    const bool is_pressing = mode == StylusMode::Press;
    const ScenePoint goal = stylusGoal(aimedGround(), reach_, is_pressing, point_m_);
    if (is_pressing) {
        press(goal);
    } else {
        // A hovering mouse stylus has no height of its own, so ridges cannot obstruct it.
        releaseModel();
    }
    updatePose(mode, goal);
}

void Stylus::lift()
{
    releaseModel();
    pose_.reset();
}

void Stylus::releaseModel()
{
    model_.reset();
    if (touch_) {
        touch_->release();
    }
}

bool Stylus::refresh()
{
    if (!isWaiting() || !touch_->follow(*model_, pose_->proxy)) {
        return false;
    }
    model_->model->update(pose_->goal);
    keepOnItsMap(pose_->goal);
    updatePose(pose_->mode, pose_->goal);
    return true;
}

void Stylus::pressAnew()
{
    if (!model_ || pose_->mode != StylusMode::Press) {
        return;
    }
    model_->model->place(pose_->goal);
    model_->model->update(pose_->goal);
    keepOnItsMap(pose_->goal);
    updatePose(pose_->mode, pose_->goal);
}

void Stylus::deepen(double factor)
{
    reach_.depth_points =
        std::clamp(reach_.depth_points * factor, kStylusDepthMin, kStylusDepthMax);
}

std::shared_ptr<ServoMap> Stylus::makeModel()
{
    const SceneMap& map = ground_.maps()[at_.index];
    if (!touch_) {
        touch_ = std::make_unique<TouchMap>(map);
    }
    return touch_->make(kind_, exaggeration_);
}

ScenePoint Stylus::aimedGround() const
{
    return ground_.maps()[at_.index].frame.toScene(at_.grid, at_.height_m * exaggeration_);
}

void Stylus::press(const ScenePoint& goal)
{
    if (!model_) {
        model_ = makeModel();
        if (!model_) {
            return; // the map has no surface there
        }
        touch_->follow(*model_, goal);
        model_->model->place(goal); // from straight above: nothing next to it can obstruct it
    }
    touch_->follow(*model_, goal);
    model_->model->update(goal);
    keepOnItsMap(goal);
}

// A map's surface continues below the maps that cover it, and across its voids, through which lower
// maps are visible. The proxy must not slide there: it is pressed less deep.
void Stylus::keepOnItsMap(const ScenePoint& goal)
{
    constexpr int kHalvings = 10;
    const ScenePoint ground = aimedGround();
    Vec3 depth = goal - ground;
    for (int i = 0; i < kHalvings && !isOnItsMap(model_->model->state().proxy); ++i) {
        depth = depth * 0.5;
        model_->model->place(ground + depth);
    }
    if (!isOnItsMap(model_->model->state().proxy)) {
        holdAbove(ground);
    }
}

// A sphere placed on a slope rolls aside however lightly it is pressed. The closer the goal is to
// the point of first contact, straight above the aimed point, the less it rolls.
void Stylus::holdAbove(const ScenePoint& ground)
{
    constexpr int kDoublings = 60;
    constexpr int kHalvings = 40;
    const auto place = [&](double up_m) {
        return model_->model->place(ground + Vec3{0.0, 0.0, up_m});
    };
    double touching_m = 0.0;
    double free_m = ground_.maps()[at_.index].frame.meanCellSideM();
    for (int i = 0; i < kDoublings && place(free_m).is_in_contact; ++i) {
        touching_m = free_m;
        free_m *= 2.0;
    }
    for (int i = 0; i < kHalvings; ++i) {
        const double up_m = 0.5 * (touching_m + free_m);
        const ContactState state = place(up_m);
        if (state.is_in_contact && isOnItsMap(state.proxy)) {
            return;
        }
        (state.is_in_contact ? touching_m : free_m) = up_m;
    }
}

bool Stylus::isOnItsMap(const ScenePoint& proxy) const
{
    return ground_.mapAt(proxy.x, proxy.y).value_or(at_.index) == at_.index;
}

void Stylus::updatePose(StylusMode mode, const ScenePoint& goal)
{
    // A press that no contact can be kept for rests on the ground that it was aimed at.
    pose_ = stylusPose(mode, model_ ? model_->model->state() : ContactState{}, goal,
                       mode == StylusMode::Press ? aimedGround() : goal, point_m_);
}

} // namespace marsview
