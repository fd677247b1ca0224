#include "ui/text/place_facts.h"

#include "core/measure/closed_surface.h"
#include "core/terrain/surface_slope.h"
#include "ui/text/number_text.h"

#include <QCoreApplication>

#include <algorithm>
#include <array>
#include <cmath>

namespace marsview {
namespace {

QString placeTr(const char* text)
{
    return QCoreApplication::translate("PlaceFacts", text);
}

// The number of the nearest sample.
QString nearest(double place, std::size_t count)
{
    return numberText(std::clamp(std::round(place), 0.0, static_cast<double>(count - 1)), 0);
}

} // namespace

QString aspectText(Angle aspect)
{
    //: The eight points of the compass
    static constexpr std::array kPoints{
        QT_TRANSLATE_NOOP("PlaceFacts", "N"), QT_TRANSLATE_NOOP("PlaceFacts", "NE"),
        QT_TRANSLATE_NOOP("PlaceFacts", "E"), QT_TRANSLATE_NOOP("PlaceFacts", "SE"),
        QT_TRANSLATE_NOOP("PlaceFacts", "S"), QT_TRANSLATE_NOOP("PlaceFacts", "SW"),
        QT_TRANSLATE_NOOP("PlaceFacts", "W"), QT_TRANSLATE_NOOP("PlaceFacts", "NW")};
    const double degrees = aspect.degrees();
    const auto point = static_cast<std::size_t>(std::lround(degrees / 45.0)) % kPoints.size();
    const int rounded = static_cast<int>(std::lround(degrees)) % 360;
    //: A direction: %1 is degrees clockwise from north, %2 a point of the compass
    return placeTr(QT_TRANSLATE_NOOP("PlaceFacts", "%1° (%2)"))
        .arg(numberText(rounded, 0), placeTr(kPoints[point]));
}

PlaceFacts placeFacts(const Map& map, const QString& layer, GridPoint grid, const PlaceTerms& terms)
{
    const Heightfield& heightfield = map.heightfield();
    const Georeference& georeference = map.georeference();
    const ClosedSurface surface(georeference, heightfield);
    const double height_m = surface.height(grid, ClosedSurface::Tiles::Requested);
    PlaceFacts place;
    place.is_rough = !surface.isExact(grid);
    const auto add = [&place](const char* name, const QString& value) {
        place.facts.push_back({placeTr(name), value});
    };
    const auto read = [&place](const QString& value) {
        //: A value that is not yet exact
        return place.is_rough ? placeTr(QT_TRANSLATE_NOOP("PlaceFacts", "≈ %1")).arg(value) : value;
    };
    add(QT_TRANSLATE_NOOP("PlaceFacts", "Layer"), layer);
    place.coordinates = positionText(terms.format, map, grid);
    place.plain_coordinates = plainPositionText(terms.format, map, grid);
    if (!place.coordinates.isEmpty()) {
        add(QT_TRANSLATE_NOOP("PlaceFacts", "Coordinates"), place.coordinates);
    }
    if (std::isfinite(height_m)) {
        const HeightRange range = heightfield.range().value_or(HeightRange{});
        add(QT_TRANSLATE_NOOP("PlaceFacts", "Elevation"),
            read(heightText(map.info(), range, height_m, terms.unit)));
        const double relief =
            inUnit(range.maximum_m, terms.unit) - inUnit(range.minimum_m, terms.unit);
        place.elevation =
            QString::number(inUnit(height_m, terms.unit), 'f', decimalsFor(relief / 100.0, 3));
    } else {
        add(QT_TRANSLATE_NOOP("PlaceFacts", "Elevation"),
            placeTr(QT_TRANSLATE_NOOP("PlaceFacts", "none (nodata)")));
    }
    if (const auto slope = slopeAt(heightfield, georeference, grid)) {
        add(QT_TRANSLATE_NOOP("PlaceFacts", "Slope"),
            //: A slope in degrees
            read(placeTr(QT_TRANSLATE_NOOP("PlaceFacts", "%1°"))
                     .arg(numberText(slope->slope.degrees(), 1))));
        add(QT_TRANSLATE_NOOP("PlaceFacts", "Aspect"),
            slope->aspect ? read(aspectText(*slope->aspect))
                          //: Of ground that slopes to no side
                          : placeTr(QT_TRANSLATE_NOOP("PlaceFacts", "none (level)")));
    }
    add(QT_TRANSLATE_NOOP("PlaceFacts", "Sample"),
        //: The nearest sample of the raster, counted from 0
        placeTr(QT_TRANSLATE_NOOP("PlaceFacts", "column %1, row %2"))
            .arg(nearest(grid.column, heightfield.columns()),
                 nearest(grid.row, heightfield.rows())));
    return place;
}

} // namespace marsview
