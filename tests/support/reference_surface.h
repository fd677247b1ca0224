// The surface between samples, computed independently of the program.
#pragma once

#include <array>

namespace marsview::test {

/// Heights of the corners (0,0), (1,0), (0,1), (1,1) of a cell; x to the right, y downward.
using CornerHeights = std::array<long double, 4>;

/// Height at (x, y) in [0, 1]² of the plane through the three corners of the triangle that contains
/// it, with the cell cut from (0,0) to (1,1). From the plane's normal, in long double. NaN if one
/// of the three is NaN.
long double planeHeight(const CornerHeights& z, long double x, long double y);

} // namespace marsview::test
