// Order statistics of measurements.
#pragma once

#include <vector>

namespace marsview {

/// The value below which `share` of the values lies; 0 if `values` is empty.
double quantile(std::vector<double> values, double share);

} // namespace marsview
