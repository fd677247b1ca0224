#include "core/geo/coordinate_format.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>

namespace marsview {
namespace {

constexpr int kDecimalDigitsMax = 8;
constexpr int kSecondDigitsMax = 5;
constexpr int kMinutesOnly = -1;
constexpr int kDegreesOnly = -2;

std::int64_t powerOfTen(int exponent)
{
    std::int64_t power = 1;
    for (int i = 0; i < exponent; ++i) {
        power *= 10;
    }
    return power;
}

// Angles are counted in whole units, so that carries need no special case.
std::int64_t unitsInDegree(AngleNotation notation, int digits)
{
    if (notation == AngleNotation::DecimalDegrees) {
        return powerOfTen(digits);
    }
    return digits <= kDegreesOnly ? 1 : digits == kMinutesOnly ? 60 : 3600 * powerOfTen(digits);
}

int boundedDigits(AngleNotation notation, int digits)
{
    return notation == AngleNotation::DecimalDegrees
               ? std::clamp(digits, 0, kDecimalDigitsMax)
               : std::clamp(digits, kDegreesOnly, kSecondDigitsMax);
}

AngleParts partsOf(std::int64_t units, char direction, AngleNotation notation, int digits)
{
    AngleParts parts{.notation = notation, .digits = digits, .direction = direction};
    const std::int64_t per_degree = unitsInDegree(notation, digits);
    if (notation == AngleNotation::DecimalDegrees) {
        parts.degrees = static_cast<double>(units) / static_cast<double>(per_degree);
        return parts;
    }
    parts.degrees = static_cast<double>(units / per_degree);
    const std::int64_t rest = units % per_degree;
    if (digits == kMinutesOnly) {
        parts.minutes = static_cast<int>(rest);
    } else if (digits > kMinutesOnly) {
        const std::int64_t per_minute = per_degree / 60;
        parts.minutes = static_cast<int>(rest / per_minute);
        parts.seconds =
            static_cast<double>(rest % per_minute) / (static_cast<double>(per_minute) / 60.0);
    }
    return parts;
}

// Units east of the meridian, within one turn.
std::int64_t unitsEast(Angle longitude, std::int64_t per_degree)
{
    const double degrees = std::fmod(longitude.degrees(), 360.0);
    const std::int64_t turn = 360 * per_degree;
    const std::int64_t units = std::llround(degrees * static_cast<double>(per_degree)) % turn;
    return units < 0 ? units + turn : units;
}

AngleParts longitudePartsOf(std::int64_t units_east,
                            LongitudeNotation range,
                            AngleNotation notation,
                            int digits)
{
    const std::int64_t turn = 360 * unitsInDegree(notation, digits);
    switch (range) {
    case LongitudeNotation::East360:
        return partsOf(units_east, 'E', notation, digits);
    case LongitudeNotation::West360:
        return partsOf((turn - units_east) % turn, 'W', notation, digits);
    case LongitudeNotation::EastWest180:
        break;
    }
    return 2 * units_east > turn ? partsOf(turn - units_east, 'W', notation, digits)
                                 : partsOf(units_east, 'E', notation, digits);
}

std::string nameOf(const Body* body)
{
    return body != nullptr ? std::string(body->name) : std::string();
}

} // namespace

LatitudeKind CoordinateFormat::latitudesOn(const Body* body) const
{
    const auto chosen = latitudes.find(nameOf(body));
    if (chosen != latitudes.end()) {
        return chosen->second;
    }
    return body != nullptr ? body->latitude : LatitudeKind::Planetocentric;
}

LongitudeNotation CoordinateFormat::longitudesOn(const Body* body) const
{
    if (longitudes) {
        return *longitudes;
    }
    return body != nullptr && body->longitude == LongitudeRange::From0To360
               ? LongitudeNotation::East360
               : LongitudeNotation::EastWest180;
}

void CoordinateFormat::setLatitudesOn(const Body* body, LatitudeKind kind)
{
    latitudes.erase(nameOf(body));
    if (latitudesOn(body) != kind) {
        latitudes.emplace(nameOf(body), kind);
    }
}

int digitsFor(AngleNotation notation, Angle step)
{
    const int most =
        notation == AngleNotation::DecimalDegrees ? kDecimalDigitsMax : kSecondDigitsMax;
    int digits = notation == AngleNotation::DecimalDegrees ? 0 : kDegreesOnly;
    const double step_degrees = step.degrees() * (1.0 + 1e-9); // 0.1° resolves 0.1°
    while (digits < most &&
           !(1.0 / static_cast<double>(unitsInDegree(notation, digits)) <= step_degrees)) {
        ++digits;
    }
    return digits;
}

AngleParts latitudeParts(Angle latitude, AngleNotation notation, int digits)
{
    digits = boundedDigits(notation, digits);
    const double degrees = std::clamp(latitude.degrees(), -90.0, 90.0);
    const std::int64_t units =
        std::llround(degrees * static_cast<double>(unitsInDegree(notation, digits)));
    return partsOf(std::abs(units), units < 0 ? 'S' : 'N', notation, digits);
}

AngleParts
longitudeParts(Angle longitude, LongitudeNotation range, AngleNotation notation, int digits)
{
    digits = boundedDigits(notation, digits);
    return longitudePartsOf(unitsEast(longitude, unitsInDegree(notation, digits)), range, notation,
                            digits);
}

std::pair<AngleParts, AngleParts> longitudeSpanParts(
    Angle west, Angle east, LongitudeNotation range, AngleNotation notation, int digits)
{
    digits = boundedDigits(notation, digits);
    const std::int64_t per_degree = unitsInDegree(notation, digits);
    const std::int64_t turn = 360 * per_degree;
    const auto part = [&](std::int64_t units, char direction) {
        return partsOf(units, direction, notation, digits);
    };
    const std::int64_t from = unitsEast(west, per_degree);
    const std::int64_t to = unitsEast(east, per_degree);
    const bool is_turn =
        std::llround((east - west).degrees() * static_cast<double>(per_degree)) >= turn;
    switch (range) {
    case LongitudeNotation::East360:
        return {part(is_turn ? 0 : from, 'E'), part(is_turn || to == 0 ? turn : to, 'E')};
    case LongitudeNotation::West360:
        return {part(is_turn || from == 0 ? turn : turn - from, 'W'),
                part(is_turn ? 0 : (turn - to) % turn, 'W')};
    case LongitudeNotation::EastWest180:
        break;
    }
    if (is_turn) {
        // As the raster has it: many run from 0° to 360°.
        return from == 0 ? std::pair{part(0, 'E'), part(turn, 'E')}
                         : std::pair{part(turn / 2, 'W'), part(turn / 2, 'E')};
    }
    return {2 * from >= turn ? part(turn - from, 'W') : part(from, 'E'),
            longitudePartsOf(to, range, notation, digits)};
}

std::string angleText(const AngleParts& parts)
{
    if (parts.notation == AngleNotation::DecimalDegrees) {
        return fmt::format("{:.{}f}° {}", parts.degrees, parts.digits, parts.direction);
    }
    std::string text = fmt::format("{:.0f}°", parts.degrees);
    if (parts.digits >= kMinutesOnly) {
        text += fmt::format(" {:02}′", parts.minutes);
    }
    if (parts.digits > kMinutesOnly) {
        // Two digits before the point.
        const int width = parts.digits == 0 ? 2 : parts.digits + 3;
        text += fmt::format(" {:0{}.{}f}″", parts.seconds, width, parts.digits);
    }
    return text + ' ' + parts.direction;
}

} // namespace marsview
