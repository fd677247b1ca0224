// Reports of WoodenHaptics and Polhem boards: encoding and decoding.
#pragma once

#include "haptics/drivers/polhem/polhem_kinematics.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace marsview {

/// Boards differ in the length of their input and output reports; numbers are little-endian int16.
enum class PolhemLayout : std::uint8_t {
    RawHid, // a Teensy: 64 bytes both ways, the first 14 of them used
    Short,  // 14 bytes: six encoders, status
    Oldest, // 8 bytes: three encoders, data for the makers
};

struct PolhemReport {
    PolhemEncoders encoders{};
    /// The board's button has been pressed to confirm that the device is in its home position;
    /// stays true until the encoders are set.
    bool wants_calibration = false;
};

/// Empty if the report is too short for any layout of six or three encoders.
std::optional<PolhemReport> parsePolhemReport(std::span<const unsigned char> report);

/// Begins with hidapi's report number 0; its length depends on the layout.
struct PolhemCommand {
    std::array<unsigned char, 65> bytes{};
    std::size_t size = 0;
};
/// Currents beyond the int16 range in milliamperes are clamped.
PolhemCommand polhemCurrentCommand(PolhemLayout layout, const std::array<double, 3>& currents_a);
/// Sets the encoders. The oldest boards do not support this; they get currents of zero.
PolhemCommand polhemHomeCommand(PolhemLayout layout, const PolhemEncoders& encoders);

} // namespace marsview
