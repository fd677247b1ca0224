// Zooming by lifting and lowering the hand, with detents at discrete zooms.
#pragma once

namespace marsview {

struct ZoomOptions {
    double metres_per_doubling = 0.03; // of the hand, upwards; > 0
    double detents_per_doubling = 2.0; // > 0
    double detent_n_per_m = 60.0;      // weak: at most a quarter of a newton
};

/// By how much larger the map is seen after the hand has risen by `rise_m`.
double zoomFactor(const ZoomOptions& options, double rise_m) noexcept;

/// How far above the nearest detent the hand is, in metres: half a step at most. The zooms
/// 2^(i / detents_per_doubling) of `scene_per_metre` are detents.
double aboveDetent(const ZoomOptions& options, double scene_per_metre) noexcept;

/// The vertical force on the hand there. Linear in the distance up to half way to the middle
/// between two detents, from there linearly back to zero: continuous everywhere.
double detentForce(const ZoomOptions& options, double above_m) noexcept;

} // namespace marsview
