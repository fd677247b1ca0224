// Terrain made of noise for tests.
#pragma once

#include "app/bench/reference/fractal_heights.h"

namespace marsview::test {

using marsview::fractalHeights;

} // namespace marsview::test
