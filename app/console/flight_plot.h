// A plot of a flight record: forces and heights over time.
#pragma once

#include "haptics/loop/loop_state.h"

#include <string>
#include <vector>

namespace marsview {

/// The text of an SVG file: the force on the hand, and below it the heights of the hand and of the
/// surface below it, over the seconds since the first record; bands mark panning and zooming. A map
/// that the hand has moved has a panel for its turn, size or place.
/// UTF-8; no fonts, scripts or links.
std::string flightPlot(const std::vector<TickRecord>& records, const std::string& title);

} // namespace marsview
