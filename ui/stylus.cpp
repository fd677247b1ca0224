#include "ui/stylus.h"

#include <algorithm>

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
    } else if (model_) {
        model_->setSurface(surfaceOf(index_));
    }
}

void Stylus::aim(const GroundPoint& at, const StylusButtons& buttons, double point_m)
{
    if (!model_ || at.index != index_) {
        index_ = at.index;
        model_.emplace(surfaceOf(index_));
        pose_.reset();
    }
    const StylusMode mode = pose_ ? nextMode(pose_->mode, buttons, pose_->is_in_contact)
                                  : nextMode(StylusMode::Hover, buttons, false);
    if (pose_ && (mode == StylusMode::Pan || mode == StylusMode::Zoom)) {
        pose_->mode = mode;
        return;
    }
    const ScenePoint ground =
        ground_.maps()[index_].frame.toScene(at.grid, at.height_m * exaggeration_);
    const ScenePoint goal = stylusGoal(ground, reach_, buttons.is_pressing, point_m);
    if (!pose_) {
        // From above, so that what is pressed into the ground first meets it from there.
        model_->place(stylusGoal(ground, reach_, false, point_m));
    }
    const ContactState contact = model_->update(goal);
    pose_ = StylusPose{.mode = mode,
                       .proxy = contact.proxy,
                       .goal = goal,
                       .is_in_contact = contact.is_in_contact,
                       .force_n = contact.is_in_contact ? stylusForce(contact.proxy, goal, point_m)
                                                        : Vec3{}};
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

} // namespace marsview
