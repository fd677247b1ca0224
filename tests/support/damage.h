// Damage to files that nothing but their content tells of.
#pragma once

#include "tests/support/random.h"

#include <string>

namespace marsview::test {

/// Turns single bits around, away from the first and last 70 kB, and sets the time that the file
/// had. It has at least 150 kB.
void flipBits(const std::string& path, int count, Random& random);

} // namespace marsview::test
