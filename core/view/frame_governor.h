// How fine a frame may be so that it is ready in time.
//
// A governor that only reacts, coarser when late and finer when early, swings for ever. This one
// predicts: it learns what triangles and pixels cost on this machine at this moment, and takes the
// finest picture whose predicted cost fits. Values and pure functions: no clock, no driver.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>

namespace marsview {

using Milliseconds = std::chrono::duration<double, std::milli>;

/// What there is to draw in a frame.
struct FrameLoad {
    std::size_t triangle_count = 0;
    double pixel_count = 0.0;
};

/// The cost of a frame: time = base + per_triangle · triangles + per_pixel · pixels.
struct FrameCost {
    Milliseconds base{2.0};
    Milliseconds per_triangle{1e-4};
    Milliseconds per_pixel{1e-5};
    double last_ratio = 1.0; // time over prediction of the last frame, 1/3 … 3

    Milliseconds predicted(const FrameLoad& load) const;
};

/// Where learning begins, measured with Mesa's software driver on two cores, and on a small GPU.
FrameCost softwareFrameCost();
FrameCost gpuFrameCost();

/// The cost after a frame of that load took that long (normalised least mean squares). A surprise
/// counts as far as the frame before agrees with it, so that a single slow frame, as when another
/// program gets the processor, changes nothing. Each term takes the share of it that it has in the
/// prediction, and all take some: where few triangles are drawn because they were slow, they would
/// otherwise be believed to be slow for ever. All terms stay positive.
FrameCost learned(const FrameCost& cost, const FrameLoad& load, Milliseconds taken);

/// How fine a frame is drawn.
struct FramePlan {
    double error_px = 1.0; // 1 … kErrorPxMax, of the pixels that are drawn
    double scale = 1.0;    // of width and height, 0.5 … 1
    bool operator==(const FramePlan&) const = default;
};

/// From here on the size of the picture gives way.
inline constexpr double kErrorPxLarge = 8.0;
inline constexpr double kErrorPxMax = 16.0;
inline constexpr double kScaleMin = 0.5;

struct FrameWish {
    Milliseconds target{33.0};
    double pixel_count = 0.0; // at scale 1
    /// The hand is on the ground: what it feels is what is to be seen, so that the size of the
    /// picture gives way first.
    bool is_touching = false;
};

/// The finest plan that is predicted to take at most the target: the error gives way first, up to 8
/// pixels, then the size of the picture, and at last the error again. A plan finer than the last
/// one is taken only where it leaves a margin, so that nothing flickers at the limit.
/// `triangles(plan)` counts what would be drawn; coarser plans have no more.
FramePlan planFrame(const FrameCost& cost,
                    const FrameWish& wish,
                    const FramePlan& last,
                    const std::function<std::size_t(const FramePlan&)>& triangles);

} // namespace marsview
