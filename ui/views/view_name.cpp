#include "ui/views/view_name.h"

#include "ui/text/coordinate_text.h"

#include <QCoreApplication>

#include <algorithm>
#include <cmath>

namespace marsview {
namespace {

// Shares of the camera's distance, which a picture is three quarters of high.
constexpr double kMiddle = 0.2;  // what is this near is in the middle
constexpr double kLeast = 0.03;  // smaller places are not what is looked at
constexpr double kLargest = 1.2; // larger ones do not fit

double angleBetween(const GeographicPoint& a, const GeographicPoint& b)
{
    const double north = std::sin((a.latitude - b.latitude).radians() / 2.0);
    const double east = std::sin((a.longitude - b.longitude).radians() / 2.0);
    return 2.0 *
           std::asin(std::min(1.0, std::sqrt(north * north + std::cos(a.latitude.radians()) *
                                                                 std::cos(b.latitude.radians()) *
                                                                 east * east)));
}

} // namespace

QString viewNameFor(const Map& map,
                    const OrbitCamera& camera,
                    const NamesOnMap& names,
                    const CoordinateFormat& format)
{
    const Georeference& georeference = map.georeference();
    const GridPoint grid = georeference.sceneFrame().toGrid(camera.target);
    const auto middle = georeference.toGeographic(grid);
    if (names.names && middle && georeference.crs()->ellipsoid()) {
        const double radius_m = georeference.crs()->ellipsoid()->equatorial_m;
        const PlaceName* best = nullptr;   // the largest one that fits
        const PlaceName* around = nullptr; // the smallest one that contains the middle
        for (const PlaceName& place : names.names->names()) {
            const double away_m = radius_m * angleBetween(*middle, place.position);
            const double size = place.diameter_m / camera.distance_m;
            if (best == nullptr && size <= kLargest && (size >= kLeast || size == 0.0) &&
                away_m <= kMiddle * camera.distance_m) {
                best = &place; // the largest come first
            } else if (size > kLargest && away_m < place.diameter_m / 2.0) {
                around = &place;
            }
        }
        if (const PlaceName* place = best != nullptr ? best : around) {
            return QString::fromStdString(place->name);
        }
    }
    const QString position = positionText(format, map, grid, 0.01 * camera.distance_m);
    return position.isEmpty() ? QCoreApplication::translate("ViewName", "View") : position;
}

QString uniqueViewName(const Session& session, const QString& name)
{
    const auto is_taken = [&](const QString& candidate) {
        return std::any_of(session.views.begin(), session.views.end(), [&](const SavedView& view) {
            return QString::fromStdString(view.name) == candidate;
        });
    };
    QString unique = name;
    for (int number = 2; is_taken(unique); ++number) {
        //: A name that is taken, with a number after it
        unique = QCoreApplication::translate("ViewName", "%1 (%2)").arg(name).arg(number);
    }
    return unique;
}

} // namespace marsview
