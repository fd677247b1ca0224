// Hears the contact out of where proxy and goal are, sixty times a second or so.
#pragma once

#include "core/geo/frames.h"
#include "haptics/device/workspace.h"
#include "haptics/interaction/workspace_frame.h"
#include "haptics/sound/contact_sound.h"

#include <cstdint>

namespace marsview {

/// One look at a contact.
struct ContactMoment {
    std::int64_t time_ns = 0; // of any clock
    ScenePoint proxy{};
    ScenePoint goal{};
    bool is_in_contact = false; // and the ground is felt: neither let go nor moved
    WorkspaceFrame frame;
    double stiffness_n_per_m = 0.0;
};

/// What is heard relative to. Constant while a map is shown with one exaggeration.
struct ListenerOptions {
    double lowest_m = 0.0; // of the scene: height_share 0; where highest_m is not above it, 0.5
    double highest_m = 1.0;
    WorkspaceBox reach; // of the device: its ends along x are left and right
};

/// Remembers the last look, to tell speed and roughness. A value, for any one thread but the
/// servo's.
class ContactListener {
public:
    explicit ContactListener(const ListenerOptions& options)
        : options_(options)
    {}

    /// Looks come in order; one of the same time as the last changes nothing. A place that is
    /// farther away than a hand slides in the time begins anew, without speed.
    ContactFeel hear(const ContactMoment& moment) noexcept;

private:
    void follow(const ContactMoment& moment, const Vec3& spring_m) noexcept;

    ListenerOptions options_;
    bool has_last_ = false; // and it was in contact
    bool has_normal_ = false;
    std::int64_t last_ns_ = 0;
    ScenePoint last_proxy_{};
    Vec3 normal_{}; // of the ground, length 1, in the workspace
    double speed_m_per_s_ = 0.0;
    double roughness_rad_ = 0.0;
};

} // namespace marsview
