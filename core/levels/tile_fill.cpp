#include "core/levels/tile_fill.h"

namespace marsview {

void TileFill::row(std::size_t first_column, std::size_t row, std::span<float> heights_m) const
{
    constexpr std::size_t kBlock = BlockMeans::kBlock;
    const BlockPlace y = placeOfSample(row, kBlock, level_rows);
    const float* above = means_m.data() + (y.before - window.first_row) * window.columns;
    const float* below = means_m.data() + (y.after - window.first_row) * window.columns;
    for (std::size_t i = 0; i < heights_m.size(); ++i) {
        const BlockPlace x = placeOfSample(first_column + i, kBlock, level_columns);
        const std::size_t before = x.before - window.first_column;
        const std::size_t after = x.after - window.first_column;
        heights_m[i] = interpolated(interpolated(above[before], above[after], x.share),
                                    interpolated(below[before], below[after], x.share), y.share);
    }
}

} // namespace marsview
