#include "app/bench/reference/color_error.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/terrain/ray_cast.h"
#include "core/view/terrain_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace marsview {
namespace {

using Color = std::array<double, 3>;

// Rays along a side of a pixel.
constexpr std::size_t kMeanRays = 4;

// Interpolates between the colors of a sampled ramp.
Color colorAt(const std::array<Rgb8, 256>& colors, double share)
{
    const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(colors.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(place), colors.size() - 2);
    const double part = place - static_cast<double>(below);
    const Rgb8& a = colors[below];
    const Rgb8& b = colors[below + 1];
    return {a.red + part * (b.red - a.red), a.green + part * (b.green - a.green),
            a.blue + part * (b.blue - a.blue)};
}

// The colors of the surface at full resolution, without light.
class SurfaceColors {
public:
    SurfaceColors(const TintedScene& scene, const OrbitCamera& camera, const Viewport& viewport)
        : scene_(scene)
        , camera_(camera)
        , viewport_(viewport)
        , ramp_(sampledRamp(scene.ramp))
    {}

    std::optional<Color> at(const PixelPoint& pixel) const
    {
        const Ray ray = pickRay(camera_, viewport_, pixel);
        const DrawnScene& drawn = scene_.drawn;
        const auto hit =
            castRay(drawn.heightfield, scene_.bounds,
                    gridRay(ray.origin, ray.direction, drawn.frame, drawn.exaggeration));
        if (!hit) {
            return std::nullopt;
        }
        const double span_m = scene_.range.maximum_m - scene_.range.minimum_m;
        return colorAt(ramp_,
                       span_m > 0.0 ? (hit->height_m - scene_.range.minimum_m) / span_m : 0.5);
    }

    // Over the pixel whose upper left corner this is; nothing where any ray shows sky.
    std::optional<Color> meanOver(const PixelPoint& corner) const
    {
        Color sum{};
        for (std::size_t i = 0; i < kMeanRays * kMeanRays; ++i) {
            const auto inside = [](std::size_t ray) {
                return (static_cast<double>(ray) + 0.5) / kMeanRays;
            };
            const auto color =
                at({corner.x + inside(i % kMeanRays), corner.y + inside(i / kMeanRays)});
            if (!color) {
                return std::nullopt;
            }
            for (std::size_t k = 0; k < sum.size(); ++k) {
                sum[k] += (*color)[k] / static_cast<double>(kMeanRays * kMeanRays);
            }
        }
        return sum;
    }

private:
    const TintedScene& scene_;
    const OrbitCamera& camera_;
    const Viewport& viewport_;
    std::array<Rgb8, 256> ramp_;
};

// Differences of channels, in levels.
struct Differences {
    std::vector<double> of_picture;
    std::vector<double> of_centers; // from means

    void append(const Differences& more)
    {
        of_picture.insert(of_picture.end(), more.of_picture.begin(), more.of_picture.end());
        of_centers.insert(of_centers.end(), more.of_centers.begin(), more.of_centers.end());
    }
};

double p99(const std::vector<double>& sorted)
{
    return sorted.empty()
               ? 0.0
               : sorted[static_cast<std::size_t>(0.99 * static_cast<double>(sorted.size() - 1))];
}

// Sorts, which also makes the sum independent of the threads.
ColorError summaryOf(Differences differences)
{
    std::vector<double>& errors = differences.of_picture;
    std::sort(errors.begin(), errors.end());
    std::sort(differences.of_centers.begin(), differences.of_centers.end());
    ColorError error{.pixel_count = errors.size() / 3,
                     .p99_levels = p99(errors),
                     .center_p99_levels = p99(differences.of_centers)};
    if (!errors.empty()) {
        error.mean_levels =
            std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
        error.max_levels = errors.back();
    }
    return error;
}

} // namespace

ColorError measureColorError(const TintedScene& scene,
                             const OrbitCamera& camera,
                             const Viewport& viewport,
                             const ColorPictures& pictures,
                             const ColorSampling& sampling)
{
    const auto width = static_cast<std::size_t>(viewport.width);
    const auto height = static_cast<std::size_t>(viewport.height);
    const std::size_t stride = sampling.stride;
    MARSVIEW_CHECK(stride > 0 && pictures.tint.size() == 3 * width * height &&
                   pictures.light.size() == pictures.tint.size() &&
                   pictures.depths_m.size() == width * height);
    const SurfaceColors surface(scene, camera, viewport);
    const bool is_of_means = sampling.reference == ColorReference::Mean;
    const auto measure_pixel = [&](std::size_t column, std::size_t row, Differences& found) {
        const std::size_t pixel = row * width + column;
        const std::uint8_t light = pictures.light[3 * pixel];
        if (!std::isfinite(pictures.depths_m[pixel]) || light == 255) {
            return;
        }
        const PixelPoint corner{static_cast<double>(column), static_cast<double>(row)};
        const auto center = surface.at({corner.x + 0.5, corner.y + 0.5});
        const auto expected = is_of_means ? surface.meanOver(corner) : center;
        if (!center || !expected) {
            return;
        }
        const double shade = light / (255.0 * kHillshadeWhite);
        const auto lit = [shade](double level) { return std::min(level * shade, 255.0); };
        for (std::size_t k = 0; k < expected->size(); ++k) {
            const double level = lit((*expected)[k]);
            found.of_picture.push_back(std::abs(level - pictures.tint[3 * pixel + k]));
            if (is_of_means) {
                found.of_centers.push_back(std::abs(level - lit((*center)[k])));
            }
        }
    };
    std::mutex mutex;
    Differences differences;
    parallelRanges((height + stride - 1) / stride, 8, [&](std::size_t begin, std::size_t end) {
        Differences found;
        for (std::size_t row = begin * stride; row < end * stride && row < height; row += stride) {
            for (std::size_t column = 0; column < width; column += stride) {
                measure_pixel(column, row, found);
            }
        }
        const std::lock_guard lock(mutex);
        differences.append(found);
    });
    return summaryOf(std::move(differences));
}

} // namespace marsview
