// The text format of a recording's column "ground".
#pragma once

#include "haptics/terrain/ground_record.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

/// The column with the terrain changes before an update; an empty cell means no change.
inline constexpr std::string_view kGroundColumn = "ground";

/// One word: numbers separated by slashes, exact to the bit:
///
///     part/PART/COLUMNS/ROWS/EQUATORIAL_M/POLAR_M/COLUMN/ROW/E_COLUMN/E_ROW/N_COLUMN/N_ROW
///     below/ and the same
///     level/LEVEL/FIRST_COLUMN/FIRST_ROW/COLUMNS/ROWS/BITS     BITS in hexadecimal
///     level/LEVEL/FIRST_COLUMN/FIRST_ROW/COLUMNS/ROWS/BITS/MAP     of joined maps
///     tile/LEVEL/COLUMN/ROW/WEIGHT
///     tile/LEVEL/COLUMN/ROW/WEIGHT/MAP     of joined maps
///     felt/PART
///
/// as GroundPart (with SceneFrame's terms), GroundBelow, GroundLevel, GroundTile and GroundFelt.
std::string groundText(const GroundRecord& record);

/// Parses a cell: words separated by blanks. Empty if a word has none of the above forms.
std::optional<std::vector<GroundRecord>> parseGround(std::string_view cell);

} // namespace marsview
