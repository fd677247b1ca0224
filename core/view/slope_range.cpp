#include "core/view/slope_range.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace marsview {
namespace {

// The texels of a whole map are several times as large as those of its first picture, and slopes
// over longer distances are smaller: nearly all of them must be in the range to include most of the
// finer ones.
constexpr double kSteepShare = 0.01;
constexpr double kLeastDegrees = 0.1;
constexpr double kMostDegrees = 90.0;

double roundDegreesAbove(double degrees)
{
    constexpr std::array kRound{1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0};
    for (double unit = kLeastDegrees; unit <= 10.0; unit *= 10.0) {
        for (const double round : kRound) {
            if (degrees <= round * unit * (1.0 + 1e-9)) {
                return round * unit;
            }
        }
    }
    return kMostDegrees;
}

// As rise over run, of the texels that are mostly not void.
std::vector<double>
slopesOf(const ReliefTile& whole, std::size_t columns, std::size_t rows, double slope_max)
{
    const ReliefTile::Level& finest = whole.levels.front();
    const double unit = slope_max / 32767.0;
    std::vector<double> slopes;
    constexpr std::size_t kBegin = ReliefTile::kBorder;
    for (std::size_t j = kBegin; j < kBegin + std::min(rows, ReliefTile::kTexels); ++j) {
        for (std::size_t i = kBegin; i < kBegin + std::min(columns, ReliefTile::kTexels); ++i) {
            const ReliefTexel& texel = finest.texels[j * finest.side + i];
            const double share = texel.share / 32767.0;
            if (share >= 0.5) {
                slopes.push_back(std::hypot(texel.east, texel.north) * unit / share);
            }
        }
    }
    return slopes;
}

} // namespace

SlopeRange
slopeRange(const ReliefTile& whole, std::size_t columns, std::size_t rows, double slope_max)
{
    std::vector<double> slopes = slopesOf(whole, columns, rows, slope_max);
    double steep_degrees = 0.0;
    if (!slopes.empty()) {
        const auto steep =
            slopes.end() - 1 -
            static_cast<std::ptrdiff_t>(kSteepShare * static_cast<double>(slopes.size() - 1));
        std::nth_element(slopes.begin(), steep, slopes.end());
        steep_degrees = Angle::radians(std::atan(*steep)).degrees();
    }
    return {.minimum = {}, .maximum = Angle::degrees(roundDegreesAbove(steep_degrees))};
}

SlopeHistogram slopeHistogram(const ReliefTile& whole,
                              std::size_t columns,
                              std::size_t rows,
                              double slope_max,
                              std::size_t bin_count)
{
    const std::vector<double> slopes = slopesOf(whole, columns, rows, slope_max);
    if (slopes.empty()) {
        return {};
    }
    const double steepest = std::atan(*std::max_element(slopes.begin(), slopes.end()));
    SlopeHistogram histogram{.maximum = Angle::radians(steepest),
                             .counts = std::vector<std::uint64_t>(bin_count, 0)};
    const double bins_per_radian = steepest > 0.0 ? static_cast<double>(bin_count) / steepest : 0.0;
    for (const double slope : slopes) {
        const auto bin = static_cast<std::size_t>(std::atan(slope) * bins_per_radian);
        ++histogram.counts[std::min(bin, bin_count - 1)];
    }
    return histogram;
}

} // namespace marsview
