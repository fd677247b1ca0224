// Maps without relief, to lie on top of each other.
#pragma once

#include "tests/support/temp_folder.h"

#include <array>
#include <cstddef>
#include <string>

namespace marsview::test {

/// A square map of Mars in longitude and latitude, by the degrees of its western and northern
/// border and of its cells. Returns its path.
std::string writeLevelMars(const TempFolder& folder,
                           const std::string& name,
                           std::size_t side,
                           const std::array<double, 3>& west_north_cell,
                           float height_m);

} // namespace marsview::test
