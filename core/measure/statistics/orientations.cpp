#include "core/measure/statistics/orientations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace marsview {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kLineSteps = 90;
constexpr int kEllipseSteps = 120;

Vec3 direction(double trend_deg, double plunge_deg)
{
    const double trend = trend_deg * kDegree;
    const double plunge = plunge_deg * kDegree;
    return {std::cos(plunge) * std::sin(trend), std::cos(plunge) * std::cos(trend),
            -std::sin(plunge)};
}

double trendOf(const Vec3& v)
{
    const double trend = std::atan2(v.x, v.y) / kDegree;
    return trend < 0.0 ? trend + 360.0 : trend;
}

// The axis that all poles are nearest to: the largest eigenvector of their orientation tensor, by
// powers of it.
Vec3 commonAxis(std::span<const Vec3> poles)
{
    constexpr int kIterations = 200;
    Vec3 axis = poles.front();
    for (int i = 0; i < kIterations; ++i) {
        Vec3 sum{};
        for (const Vec3& pole : poles) {
            sum = sum + pole * dot(pole, axis);
        }
        axis = normalized(sum);
    }
    return axis;
}

} // namespace

PlaneOrientation orientationOf(const Attitude& attitude)
{
    return {.strike_deg = std::isnan(attitude.strike_deg) ? 0.0 : attitude.strike_deg,
            .dip_deg = attitude.dip_deg};
}

Vec3 poleOf(const PlaneOrientation& plane)
{
    return direction(plane.strike_deg - 90.0, 90.0 - plane.dip_deg);
}

OrientationStatistics orientationStatistics(std::span<const PlaneOrientation> planes)
{
    std::vector<Vec3> poles;
    poles.reserve(planes.size());
    for (const PlaneOrientation& plane : planes) {
        poles.push_back(poleOf(plane));
    }
    const Vec3 axis = commonAxis(poles);
    Vec3 sum{};
    for (const Vec3& pole : poles) {
        sum = sum + (dot(pole, axis) < 0.0 ? pole * -1.0 : pole);
    }
    const double resultant = length(sum);
    Vec3 mean = sum * (1.0 / resultant);
    if (mean.z > 0.0) {
        mean = mean * -1.0;
    }
    OrientationStatistics statistics;
    statistics.count = planes.size();
    statistics.trend_deg = trendOf(mean);
    statistics.plunge_deg = std::asin(std::clamp(-mean.z, 0.0, 1.0)) / kDegree;
    const double strike = statistics.trend_deg + 90.0;
    statistics.mean = {.strike_deg = strike >= 360.0 ? strike - 360.0 : strike,
                       .dip_deg = 90.0 - statistics.plunge_deg};
    const auto n = static_cast<double>(planes.size());
    if (planes.size() < 2) {
        statistics.kappa = std::numeric_limits<double>::quiet_NaN();
        statistics.confidence_deg = statistics.kappa;
        return statistics;
    }
    constexpr double kAllAgree = 1e-12; // of n
    const double missing = n - resultant;
    if (missing < kAllAgree * n) {
        statistics.kappa = std::numeric_limits<double>::infinity();
        return statistics;
    }
    statistics.kappa = (n - 1.0) / missing;
    const double cosine = 1.0 - missing / resultant * (std::pow(1.0 / 0.05, 1.0 / (n - 1.0)) - 1.0);
    statistics.confidence_deg = std::acos(std::max(-1.0, cosine)) / kDegree;
    return statistics;
}

// Lambert's azimuthal equal-area projection, with the horizon as the unit circle.
NetPoint netPoint(const Vec3& direction)
{
    const Vec3 down = direction.z > 0.0 ? direction * -1.0 : direction;
    const double scale = 1.0 / std::sqrt(1.0 - down.z);
    return {.right = down.x * scale, .up = down.y * scale};
}

std::vector<NetPoint> greatCircle(const PlaneOrientation& plane)
{
    const Vec3 along = direction(plane.strike_deg, 0.0);
    const Vec3 down = direction(plane.strike_deg + 90.0, plane.dip_deg);
    std::vector<NetPoint> line;
    for (int i = 0; i <= kLineSteps; ++i) {
        const double rake = std::numbers::pi * i / kLineSteps;
        Vec3 at = along * std::cos(rake) + down * std::sin(rake);
        at.z = std::min(at.z, 0.0); // rounding must not mirror an end
        line.push_back(netPoint(at));
    }
    return line;
}

std::vector<std::vector<NetPoint>> poleEllipse(const Attitude& attitude)
{
    if (!attitude.uncertainty.is_estimated) {
        return {};
    }
    const Vec3 pole = attitude.normal * -1.0;
    const auto axis = [&](std::size_t i) {
        const PoleAxis& known = attitude.uncertainty.axes[i];
        return direction(known.trend_deg, known.plunge_deg) *
               std::tan(known.half_angle_deg * kDegree);
    };
    const Vec3 longer = axis(0);
    const Vec3 shorter = axis(1);
    std::vector<std::vector<NetPoint>> pieces;
    bool was_above = false;
    for (int i = 0; i <= kEllipseSteps; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kEllipseSteps;
        const Vec3 at = normalized(pole + longer * std::cos(angle) + shorter * std::sin(angle));
        const bool is_above = at.z > 0.0;
        if (pieces.empty() || is_above != was_above) {
            pieces.emplace_back();
        }
        was_above = is_above;
        pieces.back().push_back(netPoint(at));
    }
    return pieces;
}

std::vector<double> strikeRose(std::span<const PlaneOrientation> planes, std::size_t sectors)
{
    std::vector<double> rose(sectors, 0.0);
    const std::size_t half = sectors / 2;
    const double width_deg = 180.0 / static_cast<double>(half);
    double count = 0.0;
    for (const PlaneOrientation& plane : planes) {
        if (plane.dip_deg <= 0.0) {
            continue;
        }
        const double turned = std::fmod(plane.strike_deg, 180.0);
        const double strike = turned < 0.0 ? turned + 180.0 : turned;
        const auto sector = std::min(half - 1, static_cast<std::size_t>(strike / width_deg));
        rose[sector] += 1.0;
        rose[sector + half] += 1.0;
        count += 1.0;
    }
    for (double& share : rose) {
        share /= std::max(1.0, count);
    }
    return rose;
}

} // namespace marsview
