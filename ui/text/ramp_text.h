// Color ramps as people see and read them.
#pragma once

#include "core/view/color_ramp.h"

#include <QIcon>
#include <QString>

namespace marsview {

/// The ramp's name in the user's language.
QString rampName(const ColorRamp& ramp);

/// The ramp from left to right.
QIcon rampIcon(const ColorRamp& ramp);

QColor colorFrom(Rgb8 color);

} // namespace marsview
