#include "core/view/color_stretch.h"

#include "core/base/check.h"
#include "core/view/tint_range.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace marsview {
namespace {

constexpr std::size_t kSamplesMax = 1'000'000;
constexpr double kRelativeExtentMin = 1e-12;

std::vector<float> samplesOf(const Heightfield& heights)
{
    std::vector<float> values;
    values.reserve(heights.columns() * heights.rows());
    for (std::size_t row = 0; row < heights.rows(); ++row) {
        for (std::size_t column = 0; column < heights.columns(); ++column) {
            const double height_m = heights.sample(column, row);
            if (!std::isnan(height_m)) {
                values.push_back(static_cast<float>(height_m));
            }
        }
    }
    return values;
}

} // namespace

ColorStretch fixedStretch(double low, double high)
{
    MARSVIEW_CHECK(isStretchRange(low, high));
    return {.kind = StretchKind::Fixed, .low = low, .high = high};
}

bool isStretchRange(double low, double high)
{
    return std::isfinite(low) && std::isfinite(high) && std::isfinite(high - low) &&
           high - low > kRelativeExtentMin * std::max(std::abs(low), std::abs(high));
}

HeightRange stretchedRange(const ColorStretch& stretch, const StretchSource& source)
{
    const HeightRange all = source.heights.range().value_or(HeightRange{});
    switch (stretch.kind) {
    case StretchKind::Automatic:
        return source.automatic;
    case StretchKind::Full:
        return all;
    case StretchKind::Percentile: {
        const double share = std::clamp(stretch.cut_percent, 0.0, kStretchCutMax) / 100.0;
        const bool is_small = !source.heights.isTiled() &&
                              source.heights.columns() * source.heights.rows() <= kSamplesMax;
        const auto cut = rangeWithoutRarest(
            is_small ? samplesOf(source.heights) : blockHeights(source.means), share);
        return cut.value_or(all);
    }
    case StretchKind::Fixed:
        if (isStretchRange(stretch.low, stretch.high)) {
            return {.minimum_m = stretch.low, .maximum_m = stretch.high};
        }
        return all;
    }
    return all;
}

} // namespace marsview
