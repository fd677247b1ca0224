// What WoodenHaptics and Polhem boards say and hear: bytes to numbers and back.
#pragma once

#include "haptics/drivers/polhem_kinematics.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace marsview {

/// Boards differ in the length of their reports, in and out; the numbers are little-endian int16.
enum class PolhemLayout : std::uint8_t {
    RawHid, // a Teensy: 64 bytes both ways, the first 14 of them used
    Short,  // 14 bytes: six encoders, information
    Oldest, // 8 bytes: three encoders, something for its makers
};

struct PolhemReport {
    PolhemEncoders encoders{};
    /// Somebody has pressed the board's button, which says that the arm is in its position for
    /// calibration; stays so until the encoders are set.
    bool wants_calibration = false;
};

/// Nothing where the report is too short for any layout of six or three encoders.
std::optional<PolhemReport> parsePolhemReport(std::span<const unsigned char> report);

/// With hidapi's report number 0 in front; as many bytes as the layout sends.
struct PolhemCommand {
    std::array<unsigned char, 65> bytes{};
    std::size_t size = 0;
};
/// Currents beyond int16 milliampere are cut off there.
PolhemCommand polhemCurrentCommand(PolhemLayout layout, const std::array<double, 3>& currents_a);
/// Sets the encoders; not understood by the oldest boards, which get currents of zero.
PolhemCommand polhemHomeCommand(PolhemLayout layout, const PolhemEncoders& encoders);

} // namespace marsview
