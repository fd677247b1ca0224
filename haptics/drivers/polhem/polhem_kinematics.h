// Kinematics of WoodenHaptics and Polhem devices: pure functions.
//
// Notation. A base turns about the vertical by a. On it, two bodies of lengths B and C move in one
// plane; their angles b and c are both measured from the vertical. The end effector's distance from
// the axis is r = B sin b + C sin c and its height is z = A + B cos b - C cos c. With a = 0 the
// device points toward the user. The motors turn the bodies through capstans: body angle = sign ·
// motor angle · capstan / body diameter. (M. Forsslund, M. Yip, E.-L. Sallnäs, WoodenHaptics, TEI
// 2015.)
#pragma once

#include "haptics/device/workspace.h"

#include <array>
#include <cstdint>
#include <string>

namespace marsview {

/// Arrays of three hold values for the base, the lower and the upper body.
struct PolhemParameters {
    std::string name;
    std::array<double, 3> capstan_diameter_m{};
    std::array<double, 3> body_diameter_m{};
    std::array<double, 3> body_length_m{};
    std::array<double, 3> encoder_counts_per_turn{};
    std::array<double, 3> angle_sign{}; // 1 or -1
    std::array<double, 3> torque_constant_nm_per_a{};
    double current_a_max = 0.0; // of each motor
    /// Origin of the workspace frame in the device's own axes: toward the user, right, up.
    std::array<double, 3> origin_m{};
    double workspace_radius_m = 0.0; // radius of the reachable ball around the origin
    double force_n_peak = 0.0;
    double force_n_continuous = 0.0;
    double stiffness_n_per_m_max = 0.0;
    /// Encoder counts in the home position.
    std::array<std::int16_t, 6> home_encoders{};
    double twist_counts_per_turn = 0.0; // of the sixth encoder, with its sign; 0: none
};

using PolhemEncoders = std::array<std::int16_t, 6>;

/// Angles of the three bodies, rad.
struct PolhemPose {
    double a = 0.0;
    double b = 0.0;
    double c = 0.0;
};

PolhemPose polhemPose(const PolhemParameters& p, const PolhemEncoders& encoders) noexcept;

/// Position of the end effector in the workspace frame.
WorkspacePoint polhemPosition(const PolhemParameters& p, const PolhemPose& pose) noexcept;

/// Derivative of the end effector's position by the angle of each body: the columns of the
/// Jacobian, meters per radian.
std::array<Vec3, 3> polhemJacobian(const PolhemParameters& p, const PolhemPose& pose) noexcept;

/// The body torques for a force at the end effector: the transposed Jacobian times the force, N·m.
std::array<double, 3>
polhemTorques(const PolhemParameters& p, const PolhemPose& pose, const Vec3& force_n) noexcept;

/// The motor currents for a force, in amperes. If one would exceed its maximum, all are scaled by
/// the same factor, which keeps the force's direction. Zero if a number is not finite.
std::array<double, 3>
polhemCurrents(const PolhemParameters& p, const PolhemPose& pose, const Vec3& force_n) noexcept;

/// Radians.
double polhemTwist(const PolhemParameters& p, const PolhemEncoders& encoders) noexcept;

/// The largest cube within the reachable ball.
WorkspaceBox polhemWorkspace(const PolhemParameters& p);

} // namespace marsview
