#include "app/bench/reference/color_error.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/terrain/ray_cast.h"
#include "core/view/terrain_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <vector>

namespace marsview {
namespace {

// Interpolates between the colors of a sampled ramp.
std::array<double, 3> colorAt(const std::array<Rgb8, 256>& colors, double share)
{
    const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(colors.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(place), colors.size() - 2);
    const double part = place - static_cast<double>(below);
    const Rgb8& a = colors[below];
    const Rgb8& b = colors[below + 1];
    return {a.red + part * (b.red - a.red), a.green + part * (b.green - a.green),
            a.blue + part * (b.blue - a.blue)};
}

} // namespace

ColorError measureColorError(const TintedScene& scene,
                             const OrbitCamera& camera,
                             const Viewport& viewport,
                             const ColorPictures& pictures,
                             std::size_t stride)
{
    const auto width = static_cast<std::size_t>(viewport.width);
    const auto height = static_cast<std::size_t>(viewport.height);
    MARSVIEW_CHECK(stride > 0 && pictures.tint.size() == 3 * width * height &&
                   pictures.light.size() == pictures.tint.size() &&
                   pictures.depths_m.size() == width * height);
    const auto colors = sampledRamp(scene.ramp);
    const double low_m = scene.range.minimum_m;
    const double span_m = scene.range.maximum_m - low_m;
    std::mutex mutex;
    std::vector<double> errors;
    const auto measure_row = [&](std::size_t row, std::vector<double>& found) {
        for (std::size_t column = 0; column < width; column += stride) {
            const std::size_t pixel = row * width + column;
            const std::uint8_t light = pictures.light[3 * pixel];
            if (!std::isfinite(pictures.depths_m[pixel]) || light == 255) {
                continue;
            }
            const Ray ray =
                pickRay(camera, viewport,
                        {static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5});
            const auto hit = castRay(
                scene.drawn.heightfield, scene.bounds,
                gridRay(ray.origin, ray.direction, scene.drawn.frame, scene.drawn.exaggeration));
            if (!hit) {
                continue;
            }
            const double shade = light / (255.0 * kHillshadeWhite);
            const auto color =
                colorAt(colors, span_m > 0.0 ? (hit->height_m - low_m) / span_m : 0.5);
            for (std::size_t k = 0; k < 3; ++k) {
                const double expected = std::min(color[k] * shade, 255.0);
                found.push_back(std::abs(expected - pictures.tint[3 * pixel + k]));
            }
        }
    };
    parallelRanges((height + stride - 1) / stride, 8, [&](std::size_t begin, std::size_t end) {
        std::vector<double> found;
        for (std::size_t i = begin; i < end; ++i) {
            measure_row(i * stride, found);
        }
        const std::lock_guard lock(mutex);
        errors.insert(errors.end(), found.begin(), found.end());
    });
    ColorError error{.pixel_count = errors.size() / 3};
    if (errors.empty()) {
        return error;
    }
    std::sort(errors.begin(), errors.end()); // also makes the sum independent of the thread order
    double sum = 0.0;
    for (const double e : errors) {
        sum += e;
    }
    error.mean_levels = sum / static_cast<double>(errors.size());
    error.p99_levels =
        errors[static_cast<std::size_t>(0.99 * static_cast<double>(errors.size() - 1))];
    error.max_levels = errors.back();
    return error;
}

} // namespace marsview
