#include "app/console/quantile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace marsview {

double quantile(std::vector<double> values, double share)
{
    if (values.empty()) {
        return 0.0;
    }
    const auto place =
        values.begin() +
        static_cast<std::ptrdiff_t>(std::lround(share * static_cast<double>(values.size() - 1)));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

} // namespace marsview
