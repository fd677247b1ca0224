// Order statistics of measurements.
#pragma once

#include <vector>

namespace marsview {

/// The value below which a share of the values lies; 0 of none.
double quantile(std::vector<double> values, double share);

} // namespace marsview
