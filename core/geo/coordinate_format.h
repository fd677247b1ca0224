// Coordinate formats: the user's settings, and angles rounded for display.
#pragma once

#include "core/base/angle.h"
#include "core/geo/body.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace marsview {

enum class PositionSystem { Geographic, Map };

enum class AngleNotation {
    DecimalDegrees,       // 18.65°
    DegreesMinutesSeconds // 18° 39′ 00″
};

enum class LongitudeNotation {
    East360,     // 0° E to 360° E
    EastWest180, // 180° W to 180° E
    West360      // 0° W to 360° W, as on planetographic maps of many bodies
};

/// How the user reads and writes positions.
struct CoordinateFormat {
    PositionSystem system = PositionSystem::Geographic;
    AngleNotation angles = AngleNotation::DecimalDegrees;
    /// Empty: the usual notation for the body.
    std::optional<LongitudeNotation> longitudes{};
    /// By body name, if different from the body's usual kind: a choice on Mars must not change
    /// latitudes on Earth. The empty name is for unknown bodies.
    std::map<std::string, LatitudeKind, std::less<>> latitudes{};

    bool operator==(const CoordinateFormat&) const = default;

    /// `body` is null if unknown.
    LatitudeKind latitudesOn(const Body* body) const;
    LongitudeNotation longitudesOn(const Body* body) const;
    void setLatitudesOn(const Body* body, LatitudeKind kind);
};

/// An angle rounded as written. Rounding carries: 59.9996″ becomes the next minute.
struct AngleParts {
    AngleNotation notation = AngleNotation::DecimalDegrees;
    /// Decimals of a degree, from 0 to 8; or of a second, from 0 to 5, where -1 means whole minutes
    /// and -2 whole degrees.
    int digits = 0;
    double degrees = 0.0; // at least 0; a whole number unless decimal
    int minutes = 0;      // 0 to 59
    double seconds = 0.0; // in [0, 60)
    char direction = 'N'; // N, S, E or W

    bool operator==(const AngleParts&) const = default;
};

/// The fewest digits whose unit is not larger than `step`; the maximum if `step` is not positive.
int digitsFor(AngleNotation notation, Angle step);

/// `latitude` in [-90°, 90°]; values beyond are clamped to the pole. The equator counts as north.
AngleParts latitudeParts(Angle latitude, AngleNotation notation, int digits);

/// `longitude` is east-positive, in any turn.
AngleParts
longitudeParts(Angle longitude, LongitudeNotation range, AngleNotation notation, int digits);

/// The western and the eastern end of a span, `east` from 0 to 360° east of `west`. A full turn
/// covers the whole range of the notation, or 0° to 360° E where it begins at 0°. An end at the
/// seam is written as an end of the span: 350° E to 360° E.
std::pair<AngleParts, AngleParts> longitudeSpanParts(
    Angle west, Angle east, LongitudeNotation range, AngleNotation notation, int digits);

/// "18.65° N", "18° 39′ 00″ N", with a decimal point in every locale.
std::string angleText(const AngleParts& parts);

} // namespace marsview
