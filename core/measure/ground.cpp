#include "core/measure/ground.h"

#include "core/base/check.h"

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/GeodesicExact.hpp>
#include <GeographicLib/GeodesicLine.hpp>
#include <GeographicLib/GeodesicLineExact.hpp>
#include <GeographicLib/PolygonArea.hpp>

#include <cmath>
#include <numbers>
#include <variant>

namespace marsview {
namespace {

// The series of Geodesic are accurate to 15 nm on bodies as round as the Earth and Mars; their
// error grows as the sixth power of the flattening.
constexpr double kFlatteningOfSeriesMax = 0.01;

using Geodesics = std::variant<GeographicLib::Geodesic, GeographicLib::GeodesicExact>;

Geodesics geodesicsOn(const Ellipsoid& ellipsoid)
{
    const double f = ellipsoid.flattening();
    if (std::abs(f) <= kFlatteningOfSeriesMax) {
        return GeographicLib::Geodesic(ellipsoid.equatorial_m, f);
    }
    return GeographicLib::GeodesicExact(ellipsoid.equatorial_m, f);
}

double azimuthFrom0(double degrees)
{
    const double azimuth = degrees < 0.0 ? degrees + 360.0 : degrees;
    return azimuth < 360.0 ? azimuth : 0.0;
}

struct PlaneLine {
    GroundPosition from;
    double east = 0.0; // of the unit direction
    double north = 1.0;
};

template <typename Area, typename Geodesic>
GroundPolygon polygonOn(const Geodesic& geodesic, std::span<const GroundPosition> vertices)
{
    Area sum(geodesic);
    for (const GroundPosition& vertex : vertices) {
        sum.AddPoint(vertex.y, vertex.x);
    }
    GroundPolygon polygon;
    sum.Compute(false, true, polygon.perimeter_m, polygon.area_m2);
    return polygon;
}

GroundPolygon planePolygon(std::span<const GroundPosition> vertices)
{
    GroundPolygon polygon;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        // Relative to the first vertex: map coordinates may be large.
        const GroundPosition& o = vertices.front();
        const GroundPosition& a = vertices[i];
        const GroundPosition& b = vertices[(i + 1) % vertices.size()];
        polygon.area_m2 += 0.5 * ((a.x - o.x) * (b.y - o.y) - (b.x - o.x) * (a.y - o.y));
        polygon.perimeter_m += std::hypot(b.x - a.x, b.y - a.y);
    }
    return polygon;
}

} // namespace

struct Ground::Impl {
    Geodesics geodesics;
    GeographicLib::Geocentric geocentric;
};

struct GroundLine::Impl {
    std::variant<PlaneLine, GeographicLib::GeodesicLine, GeographicLib::GeodesicLineExact> line;
};

GroundPosition GroundLine::at(double distance_m) const
{
    MARSVIEW_CHECK(impl_ != nullptr);
    if (const auto* plane = std::get_if<PlaneLine>(&impl_->line)) {
        return {plane->from.x + distance_m * plane->east,
                plane->from.y + distance_m * plane->north};
    }
    GroundPosition position;
    double azimuth = 0.0;
    double unused = 0.0;
    if (const auto* series = std::get_if<GeographicLib::GeodesicLine>(&impl_->line)) {
        using Line = GeographicLib::GeodesicLine;
        series->GenPosition(false, distance_m, Line::LATITUDE | Line::LONGITUDE | Line::LONG_UNROLL,
                            position.y, position.x, azimuth, unused, unused, unused, unused,
                            unused);
    } else {
        using Line = GeographicLib::GeodesicLineExact;
        std::get<Line>(impl_->line)
            .GenPosition(false, distance_m, Line::LATITUDE | Line::LONGITUDE | Line::LONG_UNROLL,
                         position.y, position.x, azimuth, unused, unused, unused, unused, unused);
    }
    return position;
}

Ground Ground::onEllipsoid(const Ellipsoid& ellipsoid)
{
    Ground ground;
    ground.ellipsoid_ = ellipsoid;
    ground.impl_ = std::make_shared<const Impl>(
        Impl{.geodesics = geodesicsOn(ellipsoid),
             .geocentric = {ellipsoid.equatorial_m, ellipsoid.flattening()}});
    return ground;
}

Ground Ground::onPlane()
{
    return {};
}

GroundPosition Ground::position(GeographicPoint geographic) const
{
    MARSVIEW_CHECK(ellipsoid_.has_value());
    return {geographic.longitude.degrees(),
            ellipsoid_->planetographic(geographic.latitude).degrees()};
}

GeographicPoint Ground::geographic(GroundPosition position) const
{
    MARSVIEW_CHECK(ellipsoid_.has_value());
    return {Angle::degrees(position.x), ellipsoid_->planetocentric(Angle::degrees(position.y))};
}

GroundLine Ground::line(GroundPosition from, GroundPosition to) const
{
    GroundLine line;
    if (impl_ == nullptr) {
        const double east = to.x - from.x;
        const double north = to.y - from.y;
        line.length_m_ = std::hypot(east, north);
        line.azimuth_deg_ = azimuthFrom0(std::atan2(east, north) * 180.0 / std::numbers::pi);
        PlaneLine plane{.from = from};
        if (line.length_m_ > 0.0) {
            plane.east = east / line.length_m_;
            plane.north = north / line.length_m_;
        }
        line.impl_ = std::make_shared<const GroundLine::Impl>(GroundLine::Impl{plane});
        return line;
    }
    double azimuth_there = 0.0;
    double azimuth = 0.0;
    std::visit(
        [&](const auto& geodesics) {
            geodesics.Inverse(from.y, from.x, to.y, to.x, line.length_m_, azimuth, azimuth_there);
            line.impl_ = std::make_shared<const GroundLine::Impl>(
                GroundLine::Impl{geodesics.Line(from.y, from.x, azimuth)});
        },
        impl_->geodesics);
    line.azimuth_deg_ = azimuthFrom0(azimuth);
    return line;
}

GroundLine Ground::ray(GroundPosition from, double azimuth_deg) const
{
    GroundLine line;
    line.length_m_ = 1.0;
    line.azimuth_deg_ = azimuthFrom0(std::remainder(azimuth_deg, 360.0));
    if (impl_ == nullptr) {
        const double azimuth = azimuth_deg * std::numbers::pi / 180.0;
        line.impl_ = std::make_shared<const GroundLine::Impl>(
            GroundLine::Impl{PlaneLine{from, std::sin(azimuth), std::cos(azimuth)}});
        return line;
    }
    std::visit(
        [&](const auto& geodesics) {
            line.impl_ = std::make_shared<const GroundLine::Impl>(
                GroundLine::Impl{geodesics.Line(from.y, from.x, azimuth_deg)});
        },
        impl_->geodesics);
    return line;
}

double Ground::distanceM(GroundPosition a, GroundPosition b) const
{
    if (impl_ == nullptr) {
        return std::hypot(b.x - a.x, b.y - a.y);
    }
    double distance_m = 0.0;
    std::visit([&](const auto& geodesics) { geodesics.Inverse(a.y, a.x, b.y, b.x, distance_m); },
               impl_->geodesics);
    return distance_m;
}

GroundPolygon Ground::polygon(std::span<const GroundPosition> vertices) const
{
    if (vertices.empty()) {
        return {};
    }
    if (impl_ == nullptr) {
        return planePolygon(vertices);
    }
    if (const auto* series = std::get_if<GeographicLib::Geodesic>(&impl_->geodesics)) {
        return polygonOn<GeographicLib::PolygonArea>(*series, vertices);
    }
    return polygonOn<GeographicLib::PolygonAreaExact>(
        std::get<GeographicLib::GeodesicExact>(impl_->geodesics), vertices);
}

Vec3 Ground::cartesian(GroundPosition position, double elevation_m) const
{
    if (impl_ == nullptr) {
        return {position.x, position.y, elevation_m};
    }
    Vec3 point;
    impl_->geocentric.Forward(position.y, position.x, elevation_m, point.x, point.y, point.z);
    return point;
}

GroundPosition Ground::positionOf(const Vec3& cartesian) const
{
    if (impl_ == nullptr) {
        return {cartesian.x, cartesian.y};
    }
    GroundPosition position;
    double elevation_m = 0.0;
    impl_->geocentric.Reverse(cartesian.x, cartesian.y, cartesian.z, position.y, position.x,
                              elevation_m);
    return position;
}

LocalFrame Ground::frameAt(GroundPosition position) const
{
    if (impl_ == nullptr) {
        return {{position.x, position.y, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    }
    // Columns: east, north, up.
    std::vector<double> axes(9);
    LocalFrame frame;
    impl_->geocentric.Forward(position.y, position.x, 0.0, frame.origin.x, frame.origin.y,
                              frame.origin.z, axes);
    frame.east = {axes[0], axes[3], axes[6]};
    frame.north = {axes[1], axes[4], axes[7]};
    frame.up = {axes[2], axes[5], axes[8]};
    return frame;
}

} // namespace marsview
