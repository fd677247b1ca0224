#include "haptics/drivers/polhem/polhem_report.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace marsview {
namespace {

constexpr std::size_t kLongBytes = 14;
constexpr std::size_t kOldestBytes = 8;
constexpr std::size_t kInformation = 6; // index of the int16
constexpr std::size_t kCommand = 3;
constexpr std::size_t kAttributes = 4;
constexpr std::int16_t kSetEncoders = 1;

std::int16_t int16At(std::span<const unsigned char> bytes, std::size_t index)
{
    return static_cast<std::int16_t>(
        static_cast<std::uint16_t>(bytes[2 * index] | (bytes[2 * index + 1] << 8)));
}

void put(PolhemCommand& command, std::size_t index, std::int16_t value)
{
    const auto bits = static_cast<std::uint16_t>(value);
    command.bytes[1 + 2 * index] = static_cast<unsigned char>(bits & 0xFF);
    command.bytes[2 + 2 * index] = static_cast<unsigned char>(bits >> 8);
}

std::size_t commandBytes(PolhemLayout layout)
{
    switch (layout) {
    case PolhemLayout::RawHid:
        return 65;
    case PolhemLayout::Short:
        return 1 + kLongBytes;
    case PolhemLayout::Oldest:
        return 1 + kOldestBytes;
    }
    return 0;
}

} // namespace

std::optional<PolhemReport> parsePolhemReport(std::span<const unsigned char> report)
{
    PolhemReport parsed;
    if (report.size() >= kLongBytes) {
        for (std::size_t i = 0; i < parsed.encoders.size(); ++i) {
            parsed.encoders[i] = int16At(report, i);
        }
        parsed.wants_calibration = int16At(report, kInformation) == 1;
        return parsed;
    }
    if (report.size() == kOldestBytes) {
        for (std::size_t i = 0; i < 3; ++i) {
            parsed.encoders[i] = int16At(report, i);
        }
        return parsed;
    }
    return std::nullopt;
}

PolhemCommand polhemCurrentCommand(PolhemLayout layout, const std::array<double, 3>& currents_a)
{
    PolhemCommand command;
    command.size = commandBytes(layout);
    for (std::size_t i = 0; i < currents_a.size(); ++i) {
        using Limits = std::numeric_limits<std::int16_t>;
        const double ma =
            std::clamp(std::round(currents_a[i] * 1000.0), static_cast<double>(Limits::min()),
                       static_cast<double>(Limits::max()));
        put(command, i, static_cast<std::int16_t>(ma));
    }
    return command;
}

PolhemCommand polhemHomeCommand(PolhemLayout layout, const PolhemEncoders& encoders)
{
    PolhemCommand command;
    command.size = commandBytes(layout);
    if (layout == PolhemLayout::Oldest) {
        return command;
    }
    put(command, kCommand, kSetEncoders);
    for (std::size_t i = 0; i < 3; ++i) {
        put(command, kAttributes + i, encoders[i]);
        put(command, i, encoders[3 + i]); // in place of the currents
    }
    return command;
}

} // namespace marsview
