#include "haptics/drivers/spacemouse/spacemouse_report.h"

#include <algorithm>
#include <cstddef>

namespace marsview {
namespace {

constexpr double kCountsMax = 350.0; // about the full range of all models
constexpr unsigned char kPush = 1;
constexpr unsigned char kTurn = 2;
constexpr unsigned char kButtons = 3;
constexpr std::size_t kThreeAxes = 7;
constexpr std::size_t kSixAxes = 13;

double rateAt(std::span<const unsigned char> report, std::size_t index)
{
    const std::size_t at = 1 + 2 * index;
    const auto counts =
        static_cast<std::int16_t>(static_cast<std::uint16_t>(report[at] | (report[at + 1] << 8)));
    return std::clamp(counts / kCountsMax, -1.0, 1.0);
}

// The device's axes are x right, y toward the user, z down: half a turn about x from ours.
Vec3 axesAt(std::span<const unsigned char> report, std::size_t first)
{
    return {rateAt(report, first), 0.0 - rateAt(report, first + 1),
            0.0 - rateAt(report, first + 2)};
}

} // namespace

bool takeSpaceMouseReport(std::span<const unsigned char> report, SpaceMouseRates& rates)
{
    if (report.empty()) {
        return false;
    }
    switch (report[0]) {
    case kPush:
        if (report.size() < kThreeAxes) {
            return false;
        }
        rates.push = axesAt(report, 0);
        if (report.size() >= kSixAxes) {
            rates.turn = axesAt(report, 3);
        }
        return true;
    case kTurn:
        if (report.size() < kThreeAxes) {
            return false;
        }
        rates.turn = axesAt(report, 0);
        return true;
    case kButtons: {
        if (report.size() < 2) {
            return false;
        }
        std::uint32_t buttons = 0;
        const std::size_t bytes = std::min<std::size_t>(report.size() - 1, sizeof buttons);
        for (std::size_t i = 0; i < bytes; ++i) {
            buttons |= static_cast<std::uint32_t>(report[1 + i]) << (8 * i);
        }
        rates.buttons = buttons;
        return true;
    }
    default:
        return false;
    }
}

} // namespace marsview
