#include "core/view/tint_range.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

namespace marsview {
namespace {

constexpr double kRareShare = 0.005;
constexpr std::size_t kBlocksMax = 1'000'000;
constexpr std::size_t kBlocksMin = 400; // fewer tell nothing about half a percent

} // namespace

HeightRange tintRange(const BlockMeans& means, const HeightRange& all)
{
    std::size_t level = 0;
    while (means.means(level).columns() * means.means(level).rows() > kBlocksMax) {
        ++level;
    }
    const GridView<const float> blocks = means.means(level);
    std::vector<float> heights;
    for (std::size_t row = 0; row < blocks.rows(); ++row) {
        const auto line = blocks.row(row);
        std::copy_if(line.begin(), line.end(), std::back_inserter(heights),
                     [](float h) { return !std::isnan(h); });
    }
    if (heights.size() < kBlocksMin) {
        return all;
    }
    const auto rare = static_cast<std::ptrdiff_t>(kRareShare * static_cast<double>(heights.size()));
    std::nth_element(heights.begin(), heights.begin() + rare, heights.end());
    const float low = heights[static_cast<std::size_t>(rare)];
    std::nth_element(heights.begin(), heights.end() - 1 - rare, heights.end());
    const float high = *(heights.end() - 1 - rare);
    if (!(low < high)) {
        return all; // a hill in a plain is all that there is to see
    }
    return {.minimum_m = static_cast<double>(low), .maximum_m = static_cast<double>(high)};
}

} // namespace marsview
