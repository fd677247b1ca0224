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

} // namespace

SlopeRange
slopeRange(const ReliefTile& whole, std::size_t columns, std::size_t rows, double slope_max)
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

} // namespace marsview
