// Chooses the finest frame that is ready in time.
//
// A governor that only reacts, coarser when late and finer when early, oscillates. This one
// predicts: it learns the current cost of triangles and pixels on this machine and chooses the
// finest picture whose predicted cost fits. Values and pure functions: no clock, no driver.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>

namespace marsview {

using Milliseconds = std::chrono::duration<double, std::milli>;

/// The amount to draw in a frame.
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

/// Initial costs, measured with Mesa's software driver on two cores, and on a small GPU.
FrameCost softwareFrameCost();
FrameCost gpuFrameCost();

/// The cost, updated with the measured time of a frame (normalized least mean squares). A
/// prediction error counts only as far as the previous frame agrees with it, so that a single slow
/// frame, for example when another program runs, changes nothing. Each term is corrected by its
/// share of the prediction plus a common share: otherwise, when few triangles are drawn because
/// they were slow, their cost would never recover. All terms stay positive.
FrameCost learned(const FrameCost& cost, const FrameLoad& load, Milliseconds taken);

/// The level of detail of a frame.
struct FramePlan {
    double error_px = 1.0; // 1 … kErrorPxMax, of the pixels that are drawn
    double scale = 1.0;    // of width and height, 0.5 … 1
    bool operator==(const FramePlan&) const = default;
};

/// Beyond this error the size of the picture is reduced.
inline constexpr double kErrorPxLarge = 8.0;
inline constexpr double kErrorPxMax = 64.0; // beyond 16 only for relief as steep as a wall
inline constexpr double kScaleMin = 0.5;

struct FrameRequest {
    Milliseconds target{33.0};
    double pixel_count = 0.0; // at scale 1
    /// The HIP is in contact: the picture must show the touched surface, so its size is reduced
    /// first.
    bool is_touching = false;
};

/// The finest plan whose predicted time is within the target: first the error grows, up to 8
/// pixels, then the picture shrinks, and finally the error grows again. A plan finer than the last
/// one must leave a margin, so that the picture does not flicker at the limit. `triangles(plan)`
/// returns the number of triangles of a plan; coarser plans have no more.
FramePlan planFrame(const FrameCost& cost,
                    const FrameRequest& request,
                    const FramePlan& last,
                    const std::function<std::size_t(const FramePlan&)>& triangles);

/// More triangles than samples of the smooth picture show nothing new.
inline constexpr double kTrianglesPerPixelMax = 4.0;

/// The plan of a picture at rest, at full size: an error of 1 pixel, or the least one whose number
/// of triangles is within kTrianglesPerPixelMax times `pixel_count`. Only a map with far more
/// samples than pixels and extreme relief needs more than 1.
FramePlan planAtRest(double pixel_count,
                     const std::function<std::size_t(const FramePlan&)>& triangles);

} // namespace marsview
