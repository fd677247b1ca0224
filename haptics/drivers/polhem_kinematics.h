// The arm of WoodenHaptics and Polhem devices: pure functions.
//
// Notation. A base that turns about the vertical by a, on it two parallel bodies of lengths B and C
// whose angles b and c are both counted from the vertical: r = B sin b + C sin c is how far the tip
// is from the axis, z = A + B cos b - C cos c how high. With a = 0 the arm points to the user. The
// motors turn the bodies through capstans: body angle = sign · motor angle · capstan / body
// diameter. (M. Forsslund, M. Yip, E.-L. Sallnäs, WoodenHaptics, TEI 2015.)
#pragma once

#include "haptics/device/workspace.h"

#include <array>
#include <cstdint>
#include <string>

namespace marsview {

/// Arrays of three are of the base, the lower and the upper body.
struct PolhemParameters {
    std::string name;
    std::array<double, 3> capstan_diameter_m{};
    std::array<double, 3> body_diameter_m{};
    std::array<double, 3> body_length_m{};
    std::array<double, 3> encoder_counts_per_turn{};
    std::array<double, 3> angle_sign{}; // 1 or -1
    std::array<double, 3> torque_constant_nm_per_a{};
    double current_a_max = 0.0; // of each motor
    /// What the workspace is counted from, in the arm's own axes: towards the user, right, up.
    std::array<double, 3> origin_m{};
    double workspace_radius_m = 0.0; // of the ball about it that the hand reaches
    double force_n_peak = 0.0;
    double force_n_continuous = 0.0;
    double stiffness_n_per_m_max = 0.0;
    /// What the encoders count in the position that the arm is calibrated in.
    std::array<std::int16_t, 6> home_encoders{};
    double twist_counts_per_turn = 0.0; // of the sixth encoder, with its sign; 0: there is none
};

using PolhemEncoders = std::array<std::int16_t, 6>;

/// Angles of the three bodies, rad.
struct PolhemPose {
    double a = 0.0;
    double b = 0.0;
    double c = 0.0;
};

PolhemPose polhemPose(const PolhemParameters& p, const PolhemEncoders& encoders) noexcept;

/// The tip, in the workspace frame.
WorkspacePoint polhemPosition(const PolhemParameters& p, const PolhemPose& pose) noexcept;

/// How the tip moves per radian of each body: the columns of the Jacobian, metres.
std::array<Vec3, 3> polhemJacobian(const PolhemParameters& p, const PolhemPose& pose) noexcept;

/// The torques on the bodies that hold a force at the tip: the Jacobian's transpose times it, N·m.
std::array<double, 3>
polhemTorques(const PolhemParameters& p, const PolhemPose& pose, const Vec3& force_n) noexcept;

/// The motors' currents for it in ampere, all smaller by the same factor where one would be more
/// than its maximum: the force keeps its direction. Zero where a number is not finite.
std::array<double, 3>
polhemCurrents(const PolhemParameters& p, const PolhemPose& pose, const Vec3& force_n) noexcept;

/// Radians.
double polhemTwist(const PolhemParameters& p, const PolhemEncoders& encoders) noexcept;

/// The cube within the ball that the hand reaches.
WorkspaceBox polhemWorkspace(const PolhemParameters& p);

} // namespace marsview
