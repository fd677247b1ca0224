// Zooming by raising and lowering the hand, with detents at discrete zoom levels.
#pragma once

namespace marsview {

struct ZoomOptions {
    double meters_per_doubling = 0.03; // of the hand, upward; > 0
    double detents_per_doubling = 2.0; // > 0
    double detent_n_per_m = 60.0;      // weak: at most a quarter of a newton
};

/// The magnification after the hand has risen by `rise_m`.
double zoomFactor(const ZoomOptions& options, double rise_m) noexcept;

/// The rise from one detent to the next, in meters.
double detentStep(const ZoomOptions& options) noexcept;

/// Height of the hand above the nearest detent, in meters: at most half a step. The detents are the
/// zooms 2^(i / detents_per_doubling) of `scene_per_meter`.
double aboveDetent(const ZoomOptions& options, double scene_per_meter) noexcept;

/// The vertical force on the hand there. Linear in the distance up to half way to the midpoint of
/// two detents, from there linearly back to zero: continuous everywhere.
double detentForce(const ZoomOptions& options, double above_m) noexcept;

} // namespace marsview
