#include "haptics/sound/contact_listener.h"

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

// Strokes change within about 100 ms; moments are 16 ms apart with jitter.
constexpr double kSpeedSmoothingS = 0.04;
// Texture is perceived over a finger's width or less.
constexpr double kRoughnessWayM = 5e-3;
// Faster than any slide of a hand: the position was set elsewhere.
constexpr double kSpeedMaxMPerS = 5.0;
// A moment later than this is unrelated to the last one.
constexpr double kPauseMaxS = 0.25;
// The direction of a shorter spring is dominated by rounding.
constexpr double kSpringMinM = 1e-6;

double angleBetween(const Vec3& a, const Vec3& b) noexcept
{
    return std::atan2(length(cross(a, b)), dot(a, b));
}

} // namespace

ContactFeel ContactListener::hear(const ContactMoment& moment) noexcept
{
    if (!moment.is_in_contact) {
        has_last_ = false;
        has_normal_ = false;
        last_ns_ = moment.time_ns;
        return {};
    }
    // From the hand to the proxy: along the surface normal.
    const Vec3 spring_m = moment.frame.differenceToWorkspace(moment.proxy - moment.goal);
    follow(moment, spring_m);
    const double span_m = options_.highest_m - options_.lowest_m;
    const double middle = 0.5 * (options_.reach.low.x + options_.reach.high.x);
    const double half_m = 0.5 * (options_.reach.high.x - options_.reach.low.x);
    return {.is_in_contact = true,
            .force_n = moment.stiffness_n_per_m * length(spring_m),
            .speed_m_per_s = speed_m_per_s_,
            .roughness_rad = roughness_rad_,
            .height_share = span_m > 0.0 ? (moment.height_m - options_.lowest_m) / span_m : 0.5,
            .across =
                half_m > 0.0 ? (moment.frame.toWorkspace(moment.proxy).x - middle) / half_m : 0.0};
}

void ContactListener::follow(const ContactMoment& moment, const Vec3& spring_m) noexcept
{
    const double dt_s = static_cast<double>(moment.time_ns - last_ns_) * 1e-9;
    if (has_last_ && !(dt_s > 0.0)) {
        return;
    }
    // Along the surface, independent of map motion under the hand.
    const double way_m =
        has_last_ ? length(moment.frame.differenceToWorkspace(moment.proxy - last_proxy_)) : 0.0;
    const bool goes_on = has_last_ && dt_s <= kPauseMaxS && way_m <= kSpeedMaxMPerS * dt_s;
    if (goes_on) {
        speed_m_per_s_ += -std::expm1(-dt_s / kSpeedSmoothingS) * (way_m / dt_s - speed_m_per_s_);
    } else {
        speed_m_per_s_ = 0.0;
        roughness_rad_ = 0.0;
        has_normal_ = false;
    }
    if (length(spring_m) > kSpringMinM) {
        const Vec3 normal = normalized(spring_m);
        if (has_normal_) {
            // Unchanged at rest.
            roughness_rad_ += -std::expm1(-way_m / kRoughnessWayM) *
                              (angleBetween(normal_, normal) - roughness_rad_);
        }
        normal_ = normal;
        has_normal_ = true;
    }
    has_last_ = true;
    last_ns_ = moment.time_ns;
    last_proxy_ = moment.proxy;
}

} // namespace marsview
