// Numbers as people read them.
#pragma once

#include "core/terrain/heightfield.h"

#include <QString>

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace marsview {

/// In which unit heights are told. Distances on the ground stay metric.
enum class HeightUnit { Metres, Feet };

double inUnit(double height_m, HeightUnit unit);
/// "m" or "ft".
QString unitSymbol(HeightUnit unit);

/// `decimals` digits after the point, in groups as the locale has them, with a true minus sign, and
/// never "−0".
QString numberText(double value, int decimals);

/// As many digits as `digits` significant ones need at most, otherwise as numberText.
QString shortNumberText(double value, int digits);

/// A count, in groups.
QString countText(std::size_t count);

/// "−8,201 … 21,241 m". Resolves about a hundredth of the range.
QString heightRangeText(const HeightRange& range, HeightUnit unit);

/// "3.2 GB". Two significant digits, powers of ten.
QString bytesText(std::uint64_t bytes);

/// "4 min left", no finer than anybody can tell.
QString timeLeftText(std::chrono::seconds left);

/// Decimals that show a tenth of `resolution`, at most `most`.
int decimalsFor(double resolution, int most);

/// The text with true minus signs for the hyphens before digits. Leaves other hyphens alone.
QString withMinusSigns(QString text);

} // namespace marsview
