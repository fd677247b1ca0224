#include "core/contact/body_goal_frame.h"

#include "core/body/body_positions.h"

#include <GeographicLib/Geocentric.hpp>

#include <cmath>
#include <limits>

namespace marsview {

BodyGoalFrame::BodyGoalFrame(const Ellipsoid& ellipsoid,
                             double exaggeration,
                             Angle middle_longitude)
    : ellipsoid_(ellipsoid)
    , exaggeration_(exaggeration)
    , middle_deg_(middle_longitude.degrees())
{}

ScenePoint BodyGoalFrame::toScene(const TracePoint& goal) const noexcept
{
    if (!(std::abs(goal.y) <= 90.0)) {
        constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
        return {kNone, kNone, kNone};
    }
    const BodyPositions::Foot foot = footOf(
        ellipsoid_, {.longitude = Angle::degrees(goal.x), .latitude = Angle::degrees(goal.y)});
    return foot.surface_m + foot.normal * (goal.z * exaggeration_);
}

TracePoint BodyGoalFrame::fromScene(const ScenePoint& point) const noexcept
{
    const GeographicLib::Geocentric frame(ellipsoid_.equatorial_m, ellipsoid_.flattening());
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    double height_m = 0.0;
    frame.Reverse(point.x, point.y, point.z, latitude_deg, longitude_deg, height_m);
    return {middle_deg_ + std::remainder(longitude_deg - middle_deg_, 360.0),
            ellipsoid_.planetocentric(Angle::degrees(latitude_deg)).degrees(),
            height_m / exaggeration_};
}

BodyGoalFrame
bodyGoalFrame(const Georeference& map, const Ellipsoid& ellipsoid, double exaggeration)
{
    const auto place = map.toGeographic(
        {0.5 * static_cast<double>(map.columns() - 1), 0.5 * static_cast<double>(map.rows() - 1)});
    return {ellipsoid, exaggeration, place ? place->longitude : Angle::degrees(0.0)};
}

} // namespace marsview
