#include "haptics/device/orientation.h"

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

constexpr double kTolerance = 1e-6;
constexpr double kUnitTolerance = 0.01;

bool isRotation(const std::array<std::array<double, 3>, 3>& m) noexcept
{
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = i; j < 3; ++j) {
            const double product = m[i][0] * m[j][0] + m[i][1] * m[j][1] + m[i][2] * m[j][2];
            if (!(std::abs(product - (i == j ? 1.0 : 0.0)) <= kTolerance)) {
                return false;
            }
        }
    }
    const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    return determinant > 0.0;
}

} // namespace

// S. W. Shepperd, Quaternion from Rotation Matrix, J. Guidance and Control 1 (1978): divides by the
// largest component, so that none loses its digits.
Orientation orientationOf(const std::array<std::array<double, 3>, 3>& m) noexcept
{
    if (!isRotation(m)) {
        return {};
    }
    const double trace = m[0][0] + m[1][1] + m[2][2];
    std::array<double, 4> q{}; // w, x, y, z
    const double largest = std::max({trace, m[0][0], m[1][1], m[2][2]});
    if (largest == trace) {
        q = {1.0 + trace, m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]};
    } else {
        const std::size_t i = largest == m[0][0] ? 0 : largest == m[1][1] ? 1 : 2;
        const std::size_t j = (i + 1) % 3;
        const std::size_t k = (i + 2) % 3;
        q[0] = m[k][j] - m[j][k];
        q[i + 1] = 1.0 + m[i][i] - m[j][j] - m[k][k];
        q[j + 1] = m[j][i] + m[i][j];
        q[k + 1] = m[k][i] + m[i][k];
    }
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const double scale = (q[0] < 0.0 ? -1.0 : 1.0) / length;
    return {q[0] * scale, q[1] * scale, q[2] * scale, q[3] * scale};
}

bool isFinite(const Orientation& o) noexcept
{
    return std::isfinite(o.w) && std::isfinite(o.x) && std::isfinite(o.y) && std::isfinite(o.z);
}

bool isUnit(const Orientation& o) noexcept
{
    const double square = o.w * o.w + o.x * o.x + o.y * o.y + o.z * o.z;
    return std::isfinite(square) && std::abs(std::sqrt(square) - 1.0) <= kUnitTolerance;
}

// The swing-twist decomposition about the stylus's axis, which leads from the tip to the back end
// and in the reference orientation points along -y.
double twistOf(const Orientation& o) noexcept
{
    const double along = -o.y;
    if (o.w == 0.0 && along == 0.0) {
        return 0.0;
    }
    const double angle = 2.0 * std::atan2(along, o.w);
    constexpr double kTurn = 2.0 * 3.14159265358979323846;
    return std::remainder(angle, kTurn);
}

} // namespace marsview
