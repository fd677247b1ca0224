#include "app/bench/reference/picture_error.h"

#include "core/base/check.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace marsview {

PictureError measurePictureError(const DrawnScene& scene,
                                 const OrbitCamera& camera,
                                 const Viewport& viewport,
                                 std::span<const double> depths_m,
                                 double threshold_px)
{
    const auto width = static_cast<std::size_t>(viewport.width);
    MARSVIEW_CHECK(depths_m.size() == width * static_cast<std::size_t>(viewport.height));
    const Vec3 forward = axesOf(camera).forward;
    std::vector<double> errors_px;
    errors_px.reserve(depths_m.size());
    for (std::size_t i = 0; i < depths_m.size(); ++i) {
        if (!std::isfinite(depths_m[i])) {
            continue;
        }
        const std::size_t row = i / width;
        const PixelPoint pixel{static_cast<double>(i % width) + 0.5,
                               static_cast<double>(row) + 0.5};
        const Ray ray = pickRay(camera, viewport, pixel);
        ScenePoint point = ray.at(depths_m[i] / dot(ray.direction, forward));
        const double height_m = scene.heightfield.height(scene.frame.toGrid(point));
        if (std::isnan(height_m)) {
            continue;
        }
        point.z = height_m * scene.exaggeration;
        if (const auto there = project(camera, viewport, point)) {
            errors_px.push_back(std::hypot(there->x - pixel.x, there->y - pixel.y));
        }
    }
    PictureError error{.pixel_count = errors_px.size()};
    if (errors_px.empty()) {
        return error;
    }
    double sum = 0.0;
    std::size_t within = 0;
    for (const double e : errors_px) {
        sum += e;
        within += e <= threshold_px ? 1 : 0;
    }
    const auto count = static_cast<double>(errors_px.size());
    error.mean_px = sum / count;
    error.share_within = static_cast<double>(within) / count;
    const auto p99 = errors_px.begin() + static_cast<std::ptrdiff_t>(0.99 * (count - 1.0));
    std::nth_element(errors_px.begin(), p99, errors_px.end());
    error.p99_px = *p99;
    error.max_px = *std::max_element(p99, errors_px.end());
    return error;
}

} // namespace marsview
