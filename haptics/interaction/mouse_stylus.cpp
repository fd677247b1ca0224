#include "haptics/interaction/mouse_stylus.h"

namespace marsview {

StylusMode nextMode(StylusMode mode, const StylusButtons& buttons, bool is_in_contact) noexcept
{
    if (buttons.is_grabbing) {
        const bool is_grabbed = mode == StylusMode::Pan || mode == StylusMode::Zoom;
        return is_grabbed ? mode : is_in_contact ? StylusMode::Pan : StylusMode::Zoom;
    }
    return buttons.is_pressing ? StylusMode::Press : StylusMode::Hover;
}

ScenePoint stylusGoal(const ScenePoint& ground,
                      const StylusReach& reach,
                      bool is_pressing,
                      double point_m) noexcept
{
    const double up_points = is_pressing ? -reach.depth_points : reach.hover_points;
    return {ground.x, ground.y, ground.z + up_points * point_m};
}

Vec3 stylusForce(const ScenePoint& proxy, const ScenePoint& goal, double point_m) noexcept
{
    const Vec3 force_n = (proxy - goal) * (kHandMetersPerPoint / point_m * kStiffnessNPerM);
    const double magnitude_n = length(force_n);
    return magnitude_n > kForceNMax ? force_n * (kForceNMax / magnitude_n) : force_n;
}

StylusPose stylusPose(StylusMode mode,
                      const ContactState& contact,
                      const ScenePoint& goal,
                      const ScenePoint& free,
                      double point_m) noexcept
{
    StylusPose pose{.mode = mode, .proxy = free, .goal = goal};
    if (contact.is_in_contact) {
        pose.proxy = contact.proxy;
        pose.is_in_contact = true;
        pose.force_n = stylusForce(contact.proxy, goal, point_m);
    }
    return pose;
}

} // namespace marsview
