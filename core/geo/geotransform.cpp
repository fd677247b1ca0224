#include "core/geo/geotransform.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace marsview {
namespace {

// The grid counts from pixel centers, the terms from pixel corners.
constexpr double kCenterOfPixel = 0.5;

// The smallest sine of the angle between the two pixel axes that counts as independent axes.
constexpr double kSineOfAxesMin = 1e-9;

} // namespace

Result<GeoTransform> GeoTransform::fromTerms(const Terms& t)
{
    const bool is_finite =
        std::all_of(t.begin(), t.end(), [](double v) { return std::isfinite(v); });
    const double determinant = t[1] * t[5] - t[2] * t[4];
    const double area = std::hypot(t[1], t[4]) * std::hypot(t[2], t[5]);
    if (!is_finite || area == 0.0 || !(std::abs(determinant) > kSineOfAxesMin * area)) {
        return Error{ErrorCode::Invalid,
                     fmt::format("geotransform [{}, {}, {}, {}, {}, {}] cannot be inverted", t[0],
                                 t[1], t[2], t[3], t[4], t[5])};
    }
    GeoTransform transform;
    transform.terms_ = t;
    return transform;
}

MapPoint GeoTransform::toMap(GridPoint grid) const noexcept
{
    const double pixel = grid.column + kCenterOfPixel;
    const double line = grid.row + kCenterOfPixel;
    const Terms& t = terms_;
    return {t[0] + (pixel * t[1] + line * t[2]), t[3] + (pixel * t[4] + line * t[5])};
}

GridPoint GeoTransform::toGrid(MapPoint map) const noexcept
{
    const Terms& t = terms_;
    const double dx = map.x - t[0];
    const double dy = map.y - t[3];
    if (t[2] == 0.0 && t[4] == 0.0) {
        return {dx / t[1] - kCenterOfPixel, dy / t[5] - kCenterOfPixel};
    }
    const double determinant = t[1] * t[5] - t[2] * t[4];
    return {(dx * t[5] - dy * t[2]) / determinant - kCenterOfPixel,
            (dy * t[1] - dx * t[4]) / determinant - kCenterOfPixel};
}

double GeoTransform::pixelWidth() const noexcept
{
    return std::hypot(terms_[1], terms_[4]);
}

double GeoTransform::pixelHeight() const noexcept
{
    return std::hypot(terms_[2], terms_[5]);
}

} // namespace marsview
