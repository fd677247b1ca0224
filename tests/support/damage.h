// Damage to files that only their content reveals.
#pragma once

#include "tests/support/random.h"

#include <string>

namespace marsview::test {

/// Flips single bits, except in the first and last 70 kB, and restores the file's time. The file
/// has at least 150 kB.
void flipBits(const std::string& path, int count, Random& random);

} // namespace marsview::test
