// Lengths, headings and forces as people read them.
#pragma once

#include "core/base/angle.h"

#include <QString>

namespace marsview {

/// "500 km", "20 m", "0.5 m": a round length with the digits that it has, thousands separated.
QString lengthText(double round_length_m);

/// A number with enough decimals to distinguish multiples of `step`; with a true minus sign, never
/// "−0".
QString numberText(double value, double step);

/// "332° (north-north-west)": the heading as a whole number of degrees from 0 to 359 and in words
/// of sixteen winds.
QString headingText(Angle heading);

} // namespace marsview
