#include "core/globe/body_sight.h"

#include "core/base/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace marsview {
namespace {

struct Corner {
    double column = 0.0;
    double row = 0.0;
    double margin = 0.0;
};

// Where the margin is 0 on the way from one corner to another; nothing where it is not.
std::optional<GeographicPoint>
crossing(const BodySight& sight, const Corner& from, const Corner& to)
{
    if ((from.margin > 0.0) == (to.margin > 0.0)) {
        return std::nullopt;
    }
    const double share = from.margin / (from.margin - to.margin);
    return sight.placeAt(from.column + share * (to.column - from.column),
                         from.row + share * (to.row - from.row));
}

void addEdge(const BodySight& sight,
             const std::array<Corner, 3>& triangle,
             std::vector<std::array<GeographicPoint, 2>>& edges)
{
    std::array<GeographicPoint, 2> edge;
    std::size_t count = 0;
    for (std::size_t i = 0; i < triangle.size() && count < edge.size(); ++i) {
        if (const auto place = crossing(sight, triangle[i], triangle[(i + 1) % triangle.size()])) {
            edge[count++] = *place;
        }
    }
    if (count == edge.size()) {
        edges.push_back(edge);
    }
}

} // namespace

GeographicPoint BodySight::placeAt(double column, double row) const noexcept
{
    return {.longitude = Angle::degrees(-180.0 + 360.0 * column / static_cast<double>(columns - 1)),
            .latitude = Angle::degrees(90.0 - 180.0 * row / static_cast<double>(rows - 1))};
}

BodySight bodySight(const CameraPose& pose,
                    const Ellipsoid& ellipsoid,
                    const Viewport& viewport,
                    std::size_t columns,
                    std::size_t rows)
{
    MARSVIEW_CHECK(columns >= 2 && rows >= 2);
    BodySight sight{.columns = columns, .rows = rows, .margins = {}};
    sight.margins.reserve(columns * rows);
    const double up_slope = std::tan(0.5 * pose.field_of_view.radians());
    const double right_slope = up_slope * viewport.aspect();
    std::vector<std::array<double, 2>> meridians(columns); // cosine and sine of the longitude
    for (std::size_t column = 0; column < columns; ++column) {
        const double longitude =
            sight.placeAt(static_cast<double>(column), 0.0).longitude.radians();
        meridians[column] = {std::cos(longitude), std::sin(longitude)};
    }
    const double flat = ellipsoid.equatorial_m / ellipsoid.polar_m;
    for (std::size_t row = 0; row < rows; ++row) {
        const double latitude = sight.placeAt(0.0, static_cast<double>(row)).latitude.radians();
        const double cosine = std::cos(latitude);
        const double sine = std::sin(latitude);
        const double radius_m =
            ellipsoid.equatorial_m / std::hypot(cosine, sine * flat); // planetocentric
        for (const auto& [along, across] : meridians) {
            const ScenePoint place{radius_m * cosine * along, radius_m * cosine * across,
                                   radius_m * sine};
            // The normal, up to its length, which is that of the place.
            const Vec3 normal{place.x, place.y, place.z * flat * flat};
            const Vec3 to = place - pose.eye;
            const double depth_m = dot(to, pose.axes.forward);
            const double facing = -dot(to, normal) / (length(to) * length(normal));
            double margin = std::min(facing, depth_m / length(to));
            if (depth_m > 0.0) {
                margin = std::min(
                    {margin, 1.0 - std::abs(dot(to, pose.axes.right)) / (depth_m * right_slope),
                     1.0 - std::abs(dot(to, pose.axes.up)) / (depth_m * up_slope)});
            }
            sight.margins.push_back(static_cast<float>(margin));
        }
    }
    return sight;
}

std::vector<std::array<GeographicPoint, 2>> edgesOf(const BodySight& sight)
{
    std::vector<std::array<GeographicPoint, 2>> edges;
    const auto corner = [&sight](std::size_t column, std::size_t row) {
        return Corner{.column = static_cast<double>(column),
                      .row = static_cast<double>(row),
                      .margin = sight.margin(column, row)};
    };
    for (std::size_t row = 0; row + 1 < sight.rows; ++row) {
        for (std::size_t column = 0; column + 1 < sight.columns; ++column) {
            const Corner first = corner(column, row);
            const Corner last = corner(column + 1, row + 1);
            addEdge(sight, {first, corner(column + 1, row), last}, edges);
            addEdge(sight, {first, corner(column, row + 1), last}, edges);
        }
    }
    return edges;
}

double shareOfBody(const BodySight& sight)
{
    double seen = 0.0;
    double all = 0.0;
    for (std::size_t row = 0; row < sight.rows; ++row) {
        const double weight =
            std::cos(sight.placeAt(0.0, static_cast<double>(row)).latitude.radians());
        for (std::size_t column = 0; column + 1 < sight.columns;
             ++column) { // the last is the first
            all += weight;
            seen += sight.margin(column, row) > 0.0F ? weight : 0.0;
        }
    }
    return seen / all;
}

} // namespace marsview
