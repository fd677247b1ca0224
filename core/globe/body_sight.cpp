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

// How far inside the picture places are: positive where they are in it.
class PictureMargin {
public:
    PictureMargin(const CameraPose& pose, const Ellipsoid& ellipsoid, const Viewport& viewport)
        : pose_(pose)
        , equatorial_m_(ellipsoid.equatorial_m)
        , flat_(ellipsoid.equatorial_m / ellipsoid.polar_m)
        , up_slope_(std::tan(0.5 * pose.field_of_view.radians()))
        , right_slope_(up_slope_ * viewport.aspect())
    {}

    // `direction` is from the body's center, of length 1.
    float at(const Vec3& direction) const
    {
        const double radius_m =
            equatorial_m_ / std::hypot(direction.x, direction.y, direction.z * flat_);
        const ScenePoint place = direction * radius_m;
        // The normal, up to its length, which is that of the place.
        const Vec3 normal{place.x, place.y, place.z * flat_ * flat_};
        const Vec3 to = place - pose_.eye;
        const double depth_m = dot(to, pose_.axes.forward);
        const double facing = -dot(to, normal) / (length(to) * length(normal));
        double margin = std::min(facing, depth_m / length(to));
        if (depth_m > 0.0) {
            margin = std::min({margin,
                               1.0 - std::abs(dot(to, pose_.axes.right)) / (depth_m * right_slope_),
                               1.0 - std::abs(dot(to, pose_.axes.up)) / (depth_m * up_slope_)});
        }
        return static_cast<float>(margin);
    }

private:
    CameraPose pose_;
    double equatorial_m_;
    double flat_;
    double up_slope_;
    double right_slope_;
};

} // namespace

GeographicPoint BodySight::placeAt(double column, double row) const noexcept
{
    const double right = column / static_cast<double>(columns - 1);
    const double down = row / static_cast<double>(rows - 1);
    return plane ? plane->placeAt({2.0 * right - 1.0, 1.0 - 2.0 * down})
                 : GeographicPoint{.longitude = Angle::degrees(-180.0 + 360.0 * right),
                                   .latitude = Angle::degrees(90.0 - 180.0 * down)};
}

BodySight bodySight(const CameraPose& pose,
                    const Ellipsoid& ellipsoid,
                    const Viewport& viewport,
                    std::size_t columns,
                    std::size_t rows)
{
    MARSVIEW_CHECK(columns >= 2 && rows >= 2);
    BodySight sight{.columns = columns, .rows = rows, .plane = {}, .margins = {}};
    sight.margins.reserve(columns * rows);
    const PictureMargin margin(pose, ellipsoid, viewport);
    std::vector<std::array<double, 2>> meridians(columns); // cosine and sine of the longitude
    for (std::size_t column = 0; column < columns; ++column) {
        const double longitude =
            sight.placeAt(static_cast<double>(column), 0.0).longitude.radians();
        meridians[column] = {std::cos(longitude), std::sin(longitude)};
    }
    for (std::size_t row = 0; row < rows; ++row) {
        const double latitude = sight.placeAt(0.0, static_cast<double>(row)).latitude.radians();
        const double cosine = std::cos(latitude);
        const double sine = std::sin(latitude);
        for (const auto& [along, across] : meridians) {
            sight.margins.push_back(margin.at({cosine * along, cosine * across, sine}));
        }
    }
    return sight;
}

BodySight bodySight(const CameraPose& pose,
                    const Ellipsoid& ellipsoid,
                    const Viewport& viewport,
                    const PolarPlane& plane,
                    std::size_t side)
{
    MARSVIEW_CHECK(side >= 2);
    BodySight sight{.columns = side, .rows = side, .plane = plane, .margins = {}};
    sight.margins.reserve(side * side);
    const PictureMargin margin(pose, ellipsoid, viewport);
    for (std::size_t row = 0; row < side; ++row) {
        for (std::size_t column = 0; column < side; ++column) {
            const GeographicPoint place =
                sight.placeAt(static_cast<double>(column), static_cast<double>(row));
            const double cosine = std::cos(place.latitude.radians());
            sight.margins.push_back(margin.at({cosine * std::cos(place.longitude.radians()),
                                               cosine * std::sin(place.longitude.radians()),
                                               std::sin(place.latitude.radians())}));
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
    const auto add = [&](std::size_t column, std::size_t row, double weight) {
        all += weight;
        seen += sight.margin(column, row) > 0.0F ? weight : 0.0;
    };
    if (sight.plane) {
        for (std::size_t row = 0; row < sight.rows; ++row) {
            for (std::size_t column = 0; column < sight.columns; ++column) {
                const double poleward =
                    std::abs(sight.placeAt(static_cast<double>(column), static_cast<double>(row))
                                 .latitude.radians());
                if (poleward >= PolarPlane::kEdge.radians()) {
                    const double scale = 1.0 + std::sin(poleward); // that of the map is 2 / scale
                    add(column, row, scale * scale);
                }
            }
        }
        return seen / all;
    }
    for (std::size_t row = 0; row < sight.rows; ++row) {
        const double weight =
            std::cos(sight.placeAt(0.0, static_cast<double>(row)).latitude.radians());
        for (std::size_t column = 0; column + 1 < sight.columns;
             ++column) { // the last is the first
            add(column, row, weight);
        }
    }
    return seen / all;
}

} // namespace marsview
