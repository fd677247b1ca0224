#include "haptics/interaction/body_stylus.h"

#include <algorithm>
#include <utility>

namespace marsview {

void BodyStylus::setGround(std::vector<Surface> surfaces, SurfaceAt surface_at)
{
    lift();
    surfaces_ = std::move(surfaces);
    surface_at_ = std::move(surface_at);
}

void BodyStylus::setModel(ContactModelKind kind)
{
    if (kind == std::exchange(kind_, kind) || !model_) {
        return;
    }
    // Slightly away from the proxy toward the goal, the proxy is the nearest point of the surface.
    constexpr double kHair = 1e-6;
    const auto [proxy, goal] = std::pair(pose_->proxy, pose_->goal);
    model_.reset();
    model_ = makeModel();
    model_->place(proxy + (goal - proxy) * kHair);
    model_->update(goal);
    keepOnItsSurface(goal);
    updatePose(pose_->mode, goal);
}

void BodyStylus::aim(const BodyAim& at, const StylusButtons& buttons, double point_m)
{
    const StylusMode mode = pose_ ? nextMode(pose_->mode, buttons, pose_->is_in_contact)
                                  : nextMode(StylusMode::Hover, buttons, false);
    if (pose_ && (mode == StylusMode::Pan || mode == StylusMode::Zoom)) {
        pose_->mode = mode;
        return;
    }
    const bool is_pressing = mode == StylusMode::Press;
    if (at.index != at_.index) {
        model_.reset(); // no wall between two maps holds a pointer, which feels none
    }
    at_ = at;
    point_m_ = point_m;
    const double up_points = is_pressing ? -reach_.depth_points : reach_.hover_points;
    const ScenePoint goal = at_.point + at_.up * (up_points * point_m_);
    if (is_pressing) {
        press(goal);
    } else {
        model_.reset(); // a hovering stylus has no height of its own, so ridges cannot obstruct it
    }
    updatePose(mode, goal);
}

void BodyStylus::lift()
{
    model_.reset();
    pose_.reset();
}

void BodyStylus::deepen(double factor)
{
    reach_.depth_points =
        std::clamp(reach_.depth_points * factor, kStylusDepthMin, kStylusDepthMax);
}

std::unique_ptr<ContactModel> BodyStylus::makeModel() const
{
    const Surface& surface = surfaces_[at_.index];
    const ContactModelOptions options{.radius_m = surface.radius_m};
    return surface.joined ? makeContactModel(kind_, LayeredSurface(surface.joined), options)
                          : makeContactModel(kind_, BodySurface(surface.mesh), options);
}

void BodyStylus::press(const ScenePoint& goal)
{
    if (at_.index >= surfaces_.size() || !surfaces_[at_.index].mesh) {
        return;
    }
    if (!model_) {
        model_ = makeModel();
        model_->place(goal); // from straight above: nothing next to it can obstruct it
    }
    model_->update(goal);
    keepOnItsSurface(goal);
}

// A surface continues below those that cover it, and across its voids. The proxy must not slide
// there: it is pressed less deep.
void BodyStylus::keepOnItsSurface(const ScenePoint& goal)
{
    constexpr int kHalvings = 10;
    Vec3 depth = goal - at_.point;
    for (int i = 0; i < kHalvings && !isOnItsSurface(model_->state().proxy); ++i) {
        depth = depth * 0.5;
        model_->place(at_.point + depth);
    }
}

bool BodyStylus::isOnItsSurface(const ScenePoint& proxy) const
{
    if (!surface_at_) {
        return true;
    }
    const auto found = surface_at_(proxy);
    const auto& joined = surfaces_[at_.index].joined;
    return found && (*found == at_.index || (joined && surfaces_[*found].joined == joined));
}

void BodyStylus::updatePose(StylusMode mode, const ScenePoint& goal)
{
    // A press that no contact can be kept for rests on the ground that it was aimed at.
    pose_ = stylusPose(mode, model_ ? model_->state() : ContactState{}, goal,
                       mode == StylusMode::Press ? at_.point : goal, point_m_);
}

} // namespace marsview
