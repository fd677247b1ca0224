// Statistics of attitudes in words.
#pragma once

#include "core/measure/statistics/orientations.h"

#include <QStringList>

namespace marsview {

/// Number, mean plane and pole, Fisher's κ and the 95 % cone where they are known: a line each. For
/// two planes or more.
QStringList orientationLines(const OrientationStatistics& statistics);

} // namespace marsview
