// The allowed range of fill heights.
#pragma once

#include "core/base/float_rounding.h"
#include "core/terrain/heightfield.h"

#include <optional>

namespace marsview {

/// Means are rounded, but fills must stay within the range of the map. Fills are floats, so that
/// tiles store them to the bit.
class FillRange {
public:
    explicit FillRange(const std::optional<HeightRange>& range)
        : low_m_(roundedUp(range.value_or(HeightRange{}).minimum_m))
        , high_m_(roundedDown(range.value_or(HeightRange{}).maximum_m))
    {
        if (low_m_ > high_m_) { // no float lies within
            high_m_ = low_m_;
        }
    }

    /// 0 if the map has no heights and hence no means.
    float clamped(float mean_m) const noexcept
    {
        return mean_m > low_m_ ? (mean_m < high_m_ ? mean_m : high_m_) : low_m_;
    }

private:
    float low_m_;
    float high_m_;
};

} // namespace marsview
