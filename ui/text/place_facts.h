// The facts of a place on the terrain, as text.
#pragma once

#include "core/geo/frames.h"
#include "core/session/map.h"
#include "ui/text/coordinate_text.h"

#include <QString>

#include <vector>

namespace marsview {

/// Texts about one place; empty without one.
struct PlaceFacts {
    struct Fact {
        QString name;  // "Elevation"
        QString value; // "21,171 m (areoid)"
    };
    std::vector<Fact> facts;   // layer, coordinates, elevation, slope, aspect, sample
    QString coordinates;       // as on the status bar
    QString plain_coordinates; // the same for other programs
    QString elevation;         // in the preferred unit, for other programs: "21171.4"
    bool is_rough = false;     // finer samples are on their way; asking again requests them
};

struct PlaceTerms {
    CoordinateFormat format{};
    HeightUnit unit = HeightUnit::Meters;
};

/// Of a place on the grid of `map`, which is called `layer`. Elevation, slope and aspect are
/// those of the full-resolution surface, not exaggerated.
PlaceFacts
placeFacts(const Map& map, const QString& layer, GridPoint grid, const PlaceTerms& terms);

/// "225° (SW)": a direction on the compass.
QString aspectText(Angle aspect);

} // namespace marsview
