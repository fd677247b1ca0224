// Numbers as people read them.
#pragma once

#include "core/terrain/heightfield.h"

#include <QString>

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace marsview {

/// The unit of elevations. Distances on the ground stay metric.
enum class HeightUnit { Meters, Feet };

double inUnit(double height_m, HeightUnit unit);
/// "m" or "ft".
QString unitSymbol(HeightUnit unit);

/// `decimals` digits after the point, in groups as the locale has them, with a true minus sign, and
/// never "−0".
QString numberText(double value, int decimals);

/// As many digits as `digits` significant ones need at most, otherwise as numberText.
QString shortNumberText(double value, int digits);
/// Rounded to `digits` significant ones, never with an exponent: "343,000". Below 1 as
/// shortNumberText().
QString significantNumberText(double value, int digits);

/// A raw value of samples, in full if it is an integer, otherwise with the fewest digits that mean
/// it in its type: "−3.4028235E38".
QString sampleText(double raw);

/// A count, in groups.
QString countText(std::size_t count);

/// "−8,201 … 21,241 m". Resolves about a hundredth of the range.
QString heightRangeText(const HeightRange& range, HeightUnit unit);

/// "3.2 GB". Two significant digits, powers of ten.
QString bytesText(std::uint64_t bytes);

/// "4 min left", rounded to the accuracy of the estimate.
QString timeLeftText(std::chrono::seconds left);

/// Decimals that show a tenth of `resolution`, at most `most`.
int decimalsFor(double resolution, int most);

/// Keeps `text`, a number, range or coordinate, in its order from left to right where the layout
/// runs from right to left. Unchanged in other layouts.
QString leftToRight(const QString& text);

/// Keeps a name, as of a file or layer, apart from the direction of the sentence around it.
/// Unchanged where both run from left to right.
QString isolated(const QString& name);

/// "21,171 m": a number that is text already, and a unit.
QString withUnit(const QString& number, const QString& unit);

/// The text with true minus signs for the hyphens before digits. Leaves other hyphens alone.
QString withMinusSigns(QString text);

} // namespace marsview
