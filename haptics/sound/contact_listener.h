// Derives audible properties of a contact from proxy and goal, about sixty times a second.
#pragma once

#include "core/geo/frames.h"
#include "haptics/device/workspace.h"
#include "haptics/interaction/workspace_frame.h"
#include "haptics/sound/contact_sound.h"

#include <cstdint>

namespace marsview {

/// A contact at one time.
struct ContactMoment {
    std::int64_t time_ns = 0; // of any clock
    ScenePoint proxy{};
    ScenePoint goal{};
    double height_m = 0.0;      // of the proxy
    bool is_in_contact = false; // and the surface force is on: not suppressed, map not held
    WorkspaceFrame frame;
    double stiffness_n_per_m = 0.0;
};

/// The reference ranges. Constant while a map is shown with one exaggeration.
struct ListenerOptions {
    double lowest_m = 0.0; // height of height_share 0; all shares are 0.5 unless highest_m > it
    double highest_m = 1.0;
    WorkspaceBox reach; // of the device: its ends along x are left and right
};

/// Remembers the last moment, to compute speed and roughness. A value type, for any one thread
/// except the servo thread.
class ContactListener {
public:
    explicit ContactListener(const ListenerOptions& options)
        : options_(options)
    {}

    /// Moments are passed in order; one with the same time as the last has no effect. After a
    /// position change that is too large for a slide, tracking restarts with speed 0.
    ContactFeel hear(const ContactMoment& moment) noexcept;

private:
    void follow(const ContactMoment& moment, const Vec3& spring_m) noexcept;

    ListenerOptions options_;
    bool has_last_ = false; // and it was in contact
    bool has_normal_ = false;
    std::int64_t last_ns_ = 0;
    ScenePoint last_proxy_{};
    Vec3 normal_{}; // of the surface, length 1, in the workspace
    double speed_m_per_s_ = 0.0;
    double roughness_rad_ = 0.0;
};

} // namespace marsview
