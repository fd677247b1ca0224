#include "core/view/frame_governor.h"

#include <algorithm>
#include <array>
#include <span>

namespace marsview {
namespace {

constexpr std::array kErrorsPx{1.0, 1.4, 2.0, 2.8, 4.0, 5.6, kErrorPxLarge};
constexpr std::array kLastErrorsPx{11.0, 16.0, 23.0, 32.0, 45.0, kErrorPxMax};
constexpr std::array kScales{1.0, 0.85, 0.7, 0.6, kScaleMin};

constexpr double kLearningRate = 0.25;
constexpr double kSurpriseMax = 3.0;  // times the prediction
constexpr double kCommonShare = 0.2;  // of a prediction error that every term takes, in addition to
                                      // its own share
constexpr double kFinerMargin = 0.85; // of the target, for a plan finer than the last

} // namespace

Milliseconds FrameCost::predicted(const FrameLoad& load) const
{
    return base + per_triangle * static_cast<double>(load.triangle_count) +
           per_pixel * load.pixel_count;
}

FrameCost softwareFrameCost()
{
    return {.base = Milliseconds(3.0),
            .per_triangle = Milliseconds(1.6e-4),
            .per_pixel = Milliseconds(1.6e-5)};
}

FrameCost gpuFrameCost()
{
    return {.base = Milliseconds(1.5),
            .per_triangle = Milliseconds(3e-6),
            .per_pixel = Milliseconds(1e-6)};
}

FrameCost learned(const FrameCost& cost, const FrameLoad& load, Milliseconds taken)
{
    const Milliseconds expected = cost.predicted(load);
    const double ratio = std::clamp(taken / expected, 1.0 / kSurpriseMax, kSurpriseMax);
    const double believed = ratio > 1.0 ? std::max(1.0, std::min(ratio, cost.last_ratio))
                                        : std::min(1.0, std::max(ratio, cost.last_ratio));
    const std::array shares{cost.base / expected,
                            cost.per_triangle * static_cast<double>(load.triangle_count) / expected,
                            cost.per_pixel * load.pixel_count / expected};
    double norm = 0.0;
    for (const double share : shares) {
        norm += share * (share + kCommonShare);
    }
    // Normalized, so that the prediction for this load changes by the learning rate.
    const auto moved = [&](Milliseconds term, double share) {
        return term * (1.0 + kLearningRate * (share + kCommonShare) / norm * (believed - 1.0));
    };
    return {.base = moved(cost.base, shares[0]),
            .per_triangle = moved(cost.per_triangle, shares[1]),
            .per_pixel = moved(cost.per_pixel, shares[2]),
            .last_ratio = ratio};
}

FramePlan planFrame(const FrameCost& cost,
                    const FrameRequest& request,
                    const FramePlan& last,
                    const std::function<std::size_t(const FramePlan&)>& triangles)
{
    const auto fits = [&](const FramePlan& plan) {
        const Milliseconds time =
            cost.predicted({.triangle_count = triangles(plan),
                            .pixel_count = request.pixel_count * plan.scale * plan.scale});
        const bool is_finer = plan.error_px < last.error_px || plan.scale > last.scale;
        return time <= request.target * (is_finer ? kFinerMargin : 1.0);
    };
    if (request.is_touching) {
        for (const double scale : kScales) {
            const FramePlan plan{.error_px = kErrorsPx.front(), .scale = scale};
            if (fits(plan)) {
                return plan;
            }
        }
    }
    for (const double error_px : kErrorsPx) {
        const FramePlan plan{.error_px = error_px, .scale = request.is_touching ? kScaleMin : 1.0};
        if (fits(plan)) {
            return plan;
        }
    }
    for (const double scale : kScales) {
        const FramePlan plan{.error_px = kErrorPxLarge, .scale = scale};
        if (fits(plan)) {
            return plan;
        }
    }
    for (const double error_px : kLastErrorsPx) {
        const FramePlan plan{.error_px = error_px, .scale = kScaleMin};
        if (fits(plan)) {
            return plan;
        }
    }
    return {.error_px = kErrorPxMax, .scale = kScaleMin};
}

FramePlan planAtRest(double pixel_count,
                     const std::function<std::size_t(const FramePlan&)>& triangles)
{
    for (const std::span<const double> errors_px :
         {std::span<const double>(kErrorsPx), std::span<const double>(kLastErrorsPx)}) {
        for (const double error_px : errors_px) {
            const FramePlan plan{.error_px = error_px};
            if (static_cast<double>(triangles(plan)) <= kTrianglesPerPixelMax * pixel_count) {
                return plan;
            }
        }
    }
    return {.error_px = kErrorPxMax};
}

} // namespace marsview
