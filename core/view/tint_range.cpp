#include "core/view/tint_range.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

namespace marsview {
namespace {

constexpr double kRareShare = 0.005;
constexpr std::size_t kBlocksMax = 1'000'000;
constexpr std::size_t kBlocksMin = 400; // of fewer blocks, 0.5 % is less than two

} // namespace

std::vector<float> blockHeights(const BlockMeans& means)
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
    return heights;
}

std::optional<HeightRange> rangeWithoutRarest(std::vector<float> heights_m, double share)
{
    if (heights_m.empty()) {
        return std::nullopt;
    }
    const auto rare = static_cast<std::ptrdiff_t>(share * static_cast<double>(heights_m.size()));
    const auto low = heights_m.begin() + rare;
    std::nth_element(heights_m.begin(), low, heights_m.end());
    const float low_m = *low;
    const auto high = heights_m.end() - 1 - rare;
    std::nth_element(heights_m.begin(), high, heights_m.end());
    const float high_m = *high;
    if (!(low_m < high_m)) {
        return std::nullopt; // a hill in a plain would be cut off
    }
    return HeightRange{.minimum_m = static_cast<double>(low_m),
                       .maximum_m = static_cast<double>(high_m)};
}

HeightRange tintRange(const BlockMeans& means, const HeightRange& all)
{
    std::vector<float> heights = blockHeights(means);
    return heights.size() < kBlocksMin
               ? all
               : rangeWithoutRarest(std::move(heights), kRareShare).value_or(all);
}

} // namespace marsview
