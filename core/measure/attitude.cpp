#include "core/measure/attitude.h"

#include "core/measure/constants.h"
#include "core/measure/line_measures.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>
#include <numeric>
#include <type_traits>

namespace marsview {
namespace {

constexpr double kConfidence = 0.95;
constexpr double kCollinear = 1e-4;
constexpr double kPoleErrorDegMax = 45.0;

struct Axes {
    std::array<double, 3> variance{}; // descending
    std::array<Vec3, 3> direction{};
};

// Eigenvalues and eigenvectors of a symmetric matrix, by Jacobi's rotations.
Axes eigen(std::array<std::array<double, 3>, 3> a)
{
    std::array<std::array<double, 3>, 3> v{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (int sweep = 0; sweep < 64; ++sweep) {
        const double off = std::abs(a[0][1]) + std::abs(a[0][2]) + std::abs(a[1][2]);
        if (off == 0.0) {
            break;
        }
        for (std::size_t p = 0; p < 2; ++p) {
            for (std::size_t q = p + 1; q < 3; ++q) {
                if (a[p][q] == 0.0) {
                    continue;
                }
                const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
                const double t =
                    std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
                const double c = 1.0 / std::hypot(t, 1.0);
                const double s = t * c;
                for (std::size_t k = 0; k < 3; ++k) {
                    const double akp = a[k][p];
                    const double akq = a[k][q];
                    a[k][p] = c * akp - s * akq;
                    a[k][q] = s * akp + c * akq;
                }
                for (std::size_t k = 0; k < 3; ++k) {
                    const double apk = a[p][k];
                    const double aqk = a[q][k];
                    a[p][k] = c * apk - s * aqk;
                    a[q][k] = s * apk + c * aqk;
                    const double vkp = v[k][p];
                    const double vkq = v[k][q];
                    v[k][p] = c * vkp - s * vkq;
                    v[k][q] = s * vkp + c * vkq;
                }
                a[p][q] = 0.0;
                a[q][p] = 0.0;
            }
        }
    }
    std::array<std::size_t, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(),
              [&a](std::size_t i, std::size_t j) { return a[i][i] > a[j][j]; });
    Axes axes;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t k = order[i];
        axes.variance[i] = std::max(0.0, a[k][k]);
        axes.direction[i] = {v[0][k], v[1][k], v[2][k]};
    }
    return axes;
}

// Variances of the horizontal positions along their longest direction and across it.
struct PlanExtent {
    double along_m2 = 0.0;
    double across_m2 = 0.0;
};

PlanExtent planExtent(const std::array<std::array<double, 3>, 3>& scatter)
{
    const double mean = 0.5 * (scatter[0][0] + scatter[1][1]);
    const double half = std::hypot(0.5 * (scatter[0][0] - scatter[1][1]), scatter[0][1]);
    return {.along_m2 = mean + half, .across_m2 = std::max(0.0, mean - half)};
}

Vec3 sumOf(const std::vector<Vec3>& points)
{
    return std::accumulate(points.begin(), points.end(), Vec3{});
}

double azimuthOf(double east, double north)
{
    const double azimuth = std::atan2(east, north) * kDegreesPerRadian;
    return azimuth < 0.0 ? azimuth + 360.0 : azimuth;
}

double turned(double azimuth_deg, double by_deg)
{
    const double turned = std::fmod(azimuth_deg + by_deg + 720.0, 360.0);
    return turned < 360.0 ? turned : 0.0;
}

// The quantile of Fisher's F with 2 and m degrees of freedom, which has a closed form.
double quantileOfF(double probability, double m)
{
    return 0.5 * m * (std::pow(1.0 - probability, -2.0 / m) - 1.0);
}

// Of chi squared with 2 degrees of freedom.
double quantileOfChiSquared(double probability)
{
    return -2.0 * std::log(1.0 - probability);
}

PoleAxis poleAxis(Vec3 direction, double tangent)
{
    if (direction.z > 0.0) {
        direction = -direction;
    }
    return {.half_angle_deg = std::atan(tangent) * kDegreesPerRadian,
            .trend_deg = azimuthOf(direction.x, direction.y),
            .plunge_deg =
                std::atan2(-direction.z, std::hypot(direction.x, direction.y)) * kDegreesPerRadian};
}

// The errors of dip and strike on the ellipse normal + a·e1 + b·e2.
void setErrors(const Vec3& normal,
               const std::array<Vec3, 2>& axes,
               const std::array<double, 2>& tangents,
               AttitudeUncertainty& uncertainty)
{
    // The vertical, in coordinates of the ellipse.
    const auto share = [&](std::size_t i) { return axes[i].z / normal.z / tangents[i]; };
    const bool can_be_level = normal.z > 0.0 && tangents[0] > 0.0 && tangents[1] > 0.0 &&
                              share(0) * share(0) + share(1) * share(1) <= 1.0;
    const auto dip = [](const Vec3& n) { return std::atan2(std::hypot(n.x, n.y), n.z); };
    const double dip_rad = dip(normal);
    double dip_error_rad = 0.0;
    double strike_error_rad = 0.0;
    constexpr int kSteps = 1440;
    for (int i = 0; i < kSteps; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kSteps;
        const Vec3 n = normal + axes[0] * (tangents[0] * std::cos(angle)) +
                       axes[1] * (tangents[1] * std::sin(angle));
        dip_error_rad = std::max(dip_error_rad, std::abs(dip(n) - dip_rad));
        const double turn =
            std::atan2(n.x * normal.y - n.y * normal.x, n.x * normal.x + n.y * normal.y);
        strike_error_rad = std::max(strike_error_rad, std::abs(turn));
    }
    uncertainty.dip_error_deg =
        (can_be_level ? std::max(dip_error_rad, dip_rad) : dip_error_rad) * kDegreesPerRadian;
    uncertainty.strike_error_deg = can_be_level ? 180.0 : strike_error_rad * kDegreesPerRadian;
}

} // namespace

double Attitude::poleTrendDeg() const
{
    return turned(dip_direction_deg, 180.0);
}

Result<Attitude> fitAttitude(const Ground& ground,
                             std::span<const TerrainPoint> points,
                             const AttitudeOptions& options)
{
    const std::size_t n = points.size();
    if (n < 3) {
        return Error{ErrorCode::Invalid,
                     fmt::format("an attitude needs at least 3 positions, but there {} {}",
                                 n == 1 ? "is" : "are", n)};
    }
    std::vector<Vec3> places;
    for (const TerrainPoint& point : points) {
        places.push_back(ground.cartesian(point.position, point.elevation_m));
    }
    // Sums in an order that does not depend on that of the points.
    std::vector<Vec3> sorted = places;
    std::sort(sorted.begin(), sorted.end(), [](const Vec3& a, const Vec3& b) {
        return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
    });
    const auto count = static_cast<double>(n);
    const Vec3 first = sorted.front();
    for (Vec3& place : sorted) {
        place = place - first; // exact differences of close points
    }
    const Vec3 center = first + sumOf(sorted) * (1.0 / count);
    Attitude attitude;
    attitude.points = n;
    attitude.center = ground.positionOf(center);
    LocalFrame frame = ground.frameAt(attitude.center);
    attitude.center_elevation_m = frame.toLocal(center).z;
    frame.origin = center;
    std::array<std::array<double, 3>, 3> scatter{};
    for (const Vec3& place : sorted) {
        const Vec3 local = frame.toLocal(first + place);
        const std::array<double, 3> p{local.x, local.y, local.z};
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                scatter[i][k] += p[i] * p[k] / count;
            }
        }
    }
    const Axes axes = eigen(scatter);
    constexpr double kSameM = 1e-6;
    if (!(axes.variance[0] > kSameM * kSameM)) {
        return Error{ErrorCode::Invalid,
                     "the points coincide, so they have no plane; choose points apart from each "
                     "other"};
    }
    if (!(axes.variance[1] / axes.variance[0] >= kCollinear)) {
        return Error{ErrorCode::Invalid,
                     fmt::format("the points are nearly on a line ({:.3g} m long, {:.3g} m wide), "
                                 "so their plane is not determined; add points away from that line",
                                 std::sqrt(axes.variance[0]), std::sqrt(axes.variance[1]))};
    }
    // On a line in plan, the plane through them is vertical, whatever their elevations are.
    const PlanExtent plan = planExtent(scatter);
    if (!(plan.across_m2 / plan.along_m2 >= kCollinear)) {
        return Error{ErrorCode::Invalid,
                     fmt::format("the points are nearly on a line in plan ({:.3g} m long, {:.3g} m "
                                 "wide), so that any elevations give a vertical plane; add points "
                                 "away from that line",
                                 std::sqrt(plan.along_m2), std::sqrt(plan.across_m2))};
    }
    const Vec3 normal = axes.direction[2].z < 0.0 ? -axes.direction[2] : axes.direction[2];
    attitude.normal = normal;
    attitude.dip_deg = std::atan2(std::hypot(normal.x, normal.y), normal.z) * kDegreesPerRadian;
    const bool is_level = normal.x == 0.0 && normal.y == 0.0;
    attitude.dip_direction_deg = is_level ? kNoMeasure : azimuthOf(normal.x, normal.y);
    attitude.strike_deg = is_level ? kNoMeasure : turned(attitude.dip_direction_deg, -90.0);
    double squares = 0.0;
    for (const Vec3& place : places) {
        attitude.residuals_m.push_back(dot(frame.toLocal(place), normal));
    }
    for (const Vec3& place : sorted) {
        const double residual_m = dot(frame.toLocal(first + place), normal);
        squares += residual_m * residual_m;
    }
    attitude.rms_m = std::sqrt(squares / count);

    AttitudeUncertainty& uncertainty = attitude.uncertainty;
    uncertainty.confidence = kConfidence;
    double scaled_m = 0.0;
    uncertainty.is_estimated = n > kExactPoints || options.elevation_error_m.has_value();
    if (n > kExactPoints && !options.elevation_error_m) {
        const double freedom = count - 3.0;
        scaled_m = std::sqrt(squares / freedom * 2.0 * quantileOfF(kConfidence, freedom));
    } else {
        uncertainty.elevation_error_m =
            options.elevation_error_m.value_or(options.default_elevation_error_m);
        scaled_m = *uncertainty.elevation_error_m * normal.z *
                   std::sqrt(quantileOfChiSquared(kConfidence));
    }
    // The plane is least certain across the shorter extent of the points.
    const std::array<Vec3, 2> directions{axes.direction[1], axes.direction[0]};
    const std::array<double, 2> tangents{scaled_m / std::sqrt(count * axes.variance[1]),
                                         scaled_m / std::sqrt(count * axes.variance[0])};
    uncertainty.axes = {poleAxis(directions[0], tangents[0]), poleAxis(directions[1], tangents[1])};
    if (!(uncertainty.axes[0].half_angle_deg <= kPoleErrorDegMax)) {
        return Error{
            ErrorCode::Invalid,
            fmt::format("the plane is uncertain by {:.0f} degrees, more than {:.0f}; choose "
                        "points that are farther apart along azimuth {:.0f}°, or closer "
                        "to one plane",
                        uncertainty.axes[0].half_angle_deg, kPoleErrorDegMax,
                        std::fmod(uncertainty.axes[0].trend_deg, 180.0))};
    }
    setErrors(normal, directions, tangents, uncertainty);
    return attitude;
}

double elevationStepError(const RasterInfo& info, double elevation_m)
{
    const ElevationScale scale = info.elevationScale();
    const double raw = (elevation_m - scale.offset_m) / scale.gain;
    const double step = dispatchSampleType(info.type, [raw](auto zero) {
        using T = decltype(zero);
        if constexpr (std::is_floating_point_v<T>) {
            const auto magnitude = std::abs(static_cast<T>(raw));
            return static_cast<double>(
                std::nextafter(magnitude, std::numeric_limits<T>::infinity()) - magnitude);
        } else {
            return 1.0;
        }
    });
    return 0.5 * step * std::abs(scale.gain);
}

Result<std::vector<TerrainPoint>> pointsOnTerrain(MeasuredTerrain& terrain,
                                                  std::span<const GroundPosition> positions)
{
    std::vector<TerrainPoint> points;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const double elevation_m = terrain.elevation(positions[i]);
        if (terrain.failure()) {
            return *terrain.failure();
        }
        if (!std::isfinite(elevation_m)) {
            return Error{ErrorCode::OutOfRange,
                         fmt::format("position {} ({}, {}) is outside the map or on nodata; choose "
                                     "another position",
                                     i + 1, positions[i].x, positions[i].y)};
        }
        points.push_back({positions[i], elevation_m});
    }
    return points;
}

Result<Attitude> measureAttitude(MeasuredTerrain& terrain,
                                 std::span<const GroundPosition> positions,
                                 const AttitudeOptions& options)
{
    if (Status status = checkPositions(terrain.ground(), positions, 3, "an attitude"); !status) {
        return std::move(status).error();
    }
    const Result<std::vector<TerrainPoint>> points = pointsOnTerrain(terrain, positions);
    if (!points) {
        return points.error();
    }
    return fitAttitude(terrain.ground(), *points, options);
}

} // namespace marsview
