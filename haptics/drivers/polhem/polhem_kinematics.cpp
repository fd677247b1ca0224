#include "haptics/drivers/polhem/polhem_kinematics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace marsview {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// The device's axes are toward the user, right, up; the workspace's are right, away, up.
WorkspacePoint fromArm(double toward, double right, double up)
{
    return {right, -toward, up};
}

} // namespace

PolhemPose polhemPose(const PolhemParameters& p, const PolhemEncoders& encoders) noexcept
{
    std::array<double, 3> angles{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double motor_rad = kTurn * encoders[i] / p.encoder_counts_per_turn[i];
        angles[i] = p.angle_sign[i] * motor_rad * p.capstan_diameter_m[i] / p.body_diameter_m[i];
    }
    return {angles[0], angles[1], angles[2]};
}

WorkspacePoint polhemPosition(const PolhemParameters& p, const PolhemPose& pose) noexcept
{
    const auto& [length_a, length_b, length_c] = p.body_length_m;
    const double r = length_b * std::sin(pose.b) + length_c * std::sin(pose.c);
    const double z = length_a + length_b * std::cos(pose.b) - length_c * std::cos(pose.c);
    return fromArm(std::cos(pose.a) * r - p.origin_m[0], std::sin(pose.a) * r - p.origin_m[1],
                   z - p.origin_m[2]);
}

std::array<Vec3, 3> polhemJacobian(const PolhemParameters& p, const PolhemPose& pose) noexcept
{
    const double length_b = p.body_length_m[1];
    const double length_c = p.body_length_m[2];
    const double sin_a = std::sin(pose.a);
    const double cos_a = std::cos(pose.a);
    const double sin_b = std::sin(pose.b);
    const double cos_b = std::cos(pose.b);
    const double sin_c = std::sin(pose.c);
    const double cos_c = std::cos(pose.c);
    const double r = length_b * sin_b + length_c * sin_c;
    const WorkspacePoint zero;
    return {fromArm(-sin_a * r, cos_a * r, 0.0) - zero,
            fromArm(cos_a * length_b * cos_b, sin_a * length_b * cos_b, -length_b * sin_b) - zero,
            fromArm(cos_a * length_c * cos_c, sin_a * length_c * cos_c, length_c * sin_c) - zero};
}

std::array<double, 3>
polhemTorques(const PolhemParameters& p, const PolhemPose& pose, const Vec3& force_n) noexcept
{
    const std::array<Vec3, 3> jacobian = polhemJacobian(p, pose);
    return {dot(jacobian[0], force_n), dot(jacobian[1], force_n), dot(jacobian[2], force_n)};
}

std::array<double, 3>
polhemCurrents(const PolhemParameters& p, const PolhemPose& pose, const Vec3& force_n) noexcept
{
    const std::array<double, 3> torques = polhemTorques(p, pose, force_n);
    std::array<double, 3> currents{};
    double excess = 1.0;
    for (std::size_t i = 0; i < 3; ++i) {
        // The motor turns faster than the body by the capstan ratio, with less torque.
        const double motor_nm =
            p.angle_sign[i] * torques[i] * p.capstan_diameter_m[i] / p.body_diameter_m[i];
        currents[i] = motor_nm / p.torque_constant_nm_per_a[i];
        if (!std::isfinite(currents[i])) {
            return {};
        }
        excess = std::max(excess, std::abs(currents[i]) / p.current_a_max);
    }
    for (double& current : currents) {
        current /= excess;
    }
    return currents;
}

double polhemTwist(const PolhemParameters& p, const PolhemEncoders& encoders) noexcept
{
    return p.twist_counts_per_turn == 0.0 ? 0.0 : kTurn * encoders[5] / p.twist_counts_per_turn;
}

WorkspaceBox polhemWorkspace(const PolhemParameters& p)
{
    const double half = p.workspace_radius_m / std::numbers::sqrt3;
    return {{-half, -half, -half}, {half, half, half}};
}

} // namespace marsview
