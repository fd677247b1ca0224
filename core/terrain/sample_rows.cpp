#include "core/terrain/sample_rows.h"

#include <limits>

namespace marsview {

void readHeights(const Heightfield& heightfield,
                 std::size_t first_column,
                 std::size_t row,
                 double base_m,
                 std::span<float> heights)
{
    readHeights(heightfield.samples(), heightfield.scale(), first_column, row, base_m, heights);
}

void readHeights(const SampleGrid& samples,
                 const ElevationScale& scale,
                 std::size_t first_column,
                 std::size_t row,
                 double base_m,
                 std::span<float> heights)
{
    samples.visit([&](auto view) {
        const auto* raw = view.row(row).data() + first_column;
        using Raw = std::remove_cvref_t<decltype(*raw)>;
        if constexpr (sizeof(Raw) <= 2) {
            // Two-byte samples are exact in float, and float arithmetic vectorizes in fours.
            const auto gain = static_cast<float>(scale.gain);
            const auto offset = static_cast<float>(scale.offset_m - base_m);
            for (std::size_t i = 0; i < heights.size(); ++i) {
                heights[i] = static_cast<float>(raw[i]) * gain + offset;
            }
        } else {
            for (std::size_t i = 0; i < heights.size(); ++i) {
                heights[i] = static_cast<float>(scale.height(static_cast<double>(raw[i])) - base_m);
            }
        }
    });
    if (samples.hasVoids()) {
        for (std::size_t i = 0; i < heights.size(); ++i) {
            if (samples.isVoid(first_column + i, row)) {
                heights[i] = std::numeric_limits<float>::quiet_NaN();
            }
        }
    }
}

} // namespace marsview
