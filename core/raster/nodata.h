// The nodata value of a raster in its sample type.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

namespace marsview {

/// Nodata is declared as a double, but means the nearest value of the sample type: a float32 map
/// with nodata -3.4028234663852886e38 or 1e-34 compares in float. Empty if none is declared, if it
/// is NaN (always void), and if no sample can have it.
template <typename T>
struct Nodata {
    bool exists = false;
    T value{};

    explicit Nodata(const std::optional<double>& declared)
    {
        if (!declared || std::isnan(*declared)) {
            return;
        }
        if constexpr (std::is_floating_point_v<T>) {
            value = static_cast<T>(*declared);
            exists = true;
        } else {
            const double low = static_cast<double>(std::numeric_limits<T>::min());
            const double high = static_cast<double>(std::numeric_limits<T>::max());
            if (*declared >= low && *declared <= high && *declared == std::floor(*declared)) {
                exists = true;
                value =
                    *declared >= high ? std::numeric_limits<T>::max() : static_cast<T>(*declared);
            }
        }
    }
};

} // namespace marsview
