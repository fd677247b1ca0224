// The ground of a recording, as its column "ground" has it.
#pragma once

#include "haptics/terrain/ground_record.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

/// What has changed of the ground before an update; empty where nothing has.
inline constexpr std::string_view kGroundColumn = "ground";

/// A word of numbers with slashes between them, exact to the bit:
///
///     part/PART/COLUMNS/ROWS/EQUATORIAL_M/POLAR_M/COLUMN/ROW/E_COLUMN/E_ROW/N_COLUMN/N_ROW
///     level/LEVEL/FIRST_COLUMN/FIRST_ROW/COLUMNS/ROWS/BITS     BITS in hexadecimal
///     tile/LEVEL/COLUMN/ROW/WEIGHT
///     felt/PART
///
/// as GroundPart (with SceneFrame's terms), GroundLevel, GroundTile and GroundFelt.
std::string groundText(const GroundRecord& record);

/// The words of a cell, which have blanks between them. Nothing where one is none of the above.
std::optional<std::vector<GroundRecord>> parseGround(std::string_view cell);

} // namespace marsview
