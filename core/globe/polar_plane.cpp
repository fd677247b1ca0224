#include "core/globe/polar_plane.h"

#include <cmath>
#include <numbers>

namespace marsview {
namespace {

constexpr Angle kPoleBeyond = Angle::degrees(70.0);
constexpr Angle kWholeWithin = Angle::degrees(60.0);

} // namespace

BodyOverview overviewFor(Angle latitude, BodyOverview shown) noexcept
{
    const BodyOverview there =
        latitude > Angle() ? BodyOverview::NorthPole : BodyOverview::SouthPole;
    const double off_equator = std::abs(latitude.radians());
    const bool is_near = off_equator > (shown == there ? kWholeWithin : kPoleBeyond).radians();
    return is_near ? there : BodyOverview::Whole;
}

double PolarPlane::unitAtPole() noexcept
{
    return 2.0 * std::tan(0.25 * std::numbers::pi - 0.5 * kEdge.radians());
}

PolarPoint PolarPlane::at(const GeographicPoint& place) const noexcept
{
    const double poleward = is_north_ ? place.latitude.radians() : -place.latitude.radians();
    const double distance = 2.0 * std::tan(0.25 * std::numbers::pi - 0.5 * poleward) / unitAtPole();
    const double longitude = place.longitude.radians();
    const double y = distance * std::cos(longitude);
    return {distance * std::sin(longitude), is_north_ ? -y : y};
}

GeographicPoint PolarPlane::placeAt(const PolarPoint& point) const noexcept
{
    const double distance = std::hypot(point.x, point.y) * unitAtPole();
    const double poleward = 0.5 * std::numbers::pi - 2.0 * std::atan(0.5 * distance);
    return {.longitude = Angle::radians(std::atan2(point.x, is_north_ ? -point.y : point.y)),
            .latitude = Angle::radians(is_north_ ? poleward : -poleward)};
}

} // namespace marsview
