// The plane of an overview map around a pole.
#pragma once

#include "core/geo/frames.h"

namespace marsview {

/// What the overview map of a body shows.
enum class BodyOverview { Whole, NorthPole, SouthPole };

/// The overview for a view of that latitude, which is poleward of 70° for a pole. The one that is
/// shown around a pole stays down to 60°: a view that moves about 70° does not switch it back and
/// forth.
BodyOverview overviewFor(Angle latitude, BodyOverview shown) noexcept;

/// On the plane of an overview around a pole: x to the right, y up, the pole in the origin.
struct PolarPoint {
    double x = 0.0;
    double y = 0.0;
};

/// The polar stereographic projection of planetocentric places on a sphere, as on the USGS' polar
/// maps of planets: 0° is at the bottom around the north pole and at the top around the south pole,
/// 90° E to the right. Shapes are true, so that an outline of a polar stereographic raster is
/// straight. kEdge is at distance 1 from the pole. Errors: some ulp.
class PolarPlane {
public:
    /// The parallel around the disc that an overview shows.
    static constexpr Angle kEdge = Angle::degrees(50.0);

    /// `overview` is not Whole.
    explicit PolarPlane(BodyOverview overview) noexcept
        : is_north_(overview == BodyOverview::NorthPole)
    {}

    bool isNorth() const noexcept { return is_north_; }
    /// The opposite pole is at infinity.
    PolarPoint at(const GeographicPoint& place) const noexcept;
    /// Longitude in [-180°, 180°].
    GeographicPoint placeAt(const PolarPoint& point) const noexcept;
    /// On the plane, clockwise from up, of an azimuth at a place on that meridian.
    Angle heading(Angle azimuth, Angle longitude) const noexcept
    {
        return is_north_ ? azimuth - longitude : azimuth + longitude;
    }
    /// The azimuth on that meridian of a heading on the plane.
    Angle azimuth(Angle heading, Angle longitude) const noexcept
    {
        return is_north_ ? heading + longitude : heading - longitude;
    }
    /// The length on a sphere of radius 1 of a unit of the plane next to the pole.
    static double unitAtPole() noexcept;

private:
    bool is_north_;
};

} // namespace marsview
