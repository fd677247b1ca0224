#include "core/measure/cap_plane.h"

#include <cmath>
#include <numbers>

namespace marsview {

CapPlane::CapPlane(const std::vector<double>& turns)
    : shape_(static_cast<std::uint32_t>(turns.size()))
{
    circle_.reserve(turns.size());
    for (const double turn : turns) {
        const double angle = 2.0 * std::numbers::pi * turn;
        circle_.push_back({std::cos(angle), std::sin(angle)});
    }
}

CapPlane::Point CapPlane::at(std::size_t sample, double u, double share) const noexcept
{
    const std::size_t next = sample + 1 < circle_.size() ? sample + 1 : 0;
    const Point edge = circle_[sample] * (1.0 - u) + circle_[next] * u;
    return edge * std::min(1.0, share / std::hypot(edge.x, edge.y));
}

std::array<CapPlane::Point, 3> CapPlane::corners(std::uint32_t face) const noexcept
{
    const std::array<std::uint32_t, 3> at = shape_.face(face);
    return {vertex(at[0]), vertex(at[1]), vertex(at[2])};
}

std::uint32_t CapPlane::faceAt(std::size_t sample, const Point& point) const noexcept
{
    const auto edge = static_cast<std::uint32_t>(sample);
    return walk(shape_.cornerAtCircle(edge) / 3, at(sample, 0.5, 1.0), point,
                [](std::uint32_t, double) {});
}

std::array<double, 3> CapPlane::weights(std::uint32_t face, const Point& point) const noexcept
{
    const std::array<Point, 3> at = corners(face);
    const double all = cross(at[1] - at[0], at[2] - at[0]);
    const double second = cross(point - at[0], at[2] - at[0]) / all;
    const double third = cross(at[1] - at[0], point - at[0]) / all;
    return {1.0 - second - third, second, third};
}

CapPlane::Exit
CapPlane::exitOf(std::uint32_t face, const Point& from, const Point& along) const noexcept
{
    const std::array<Point, 3> at = corners(face);
    Exit exit;
    for (std::uint32_t number = 0; number < 3; ++number) {
        const Point& begin = at[(number + 1) % 3];
        const Point edge = at[(number + 2) % 3] - begin;
        // The inside is on the left. Of the next face, both have exactly the other sign.
        const double outward = cross(along, edge);
        if (!(outward > 0.0)) {
            continue;
        }
        const double share = cross(edge, from - begin) / outward;
        if (share < exit.share) {
            const PoleCap::Beyond beyond = shape_.across(3 * face + number);
            if (!beyond.is_outside) {
                exit = {share, beyond.at / 3};
            }
        }
    }
    return exit;
}

} // namespace marsview
