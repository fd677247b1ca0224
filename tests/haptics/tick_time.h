// The time of a tick.
#pragma once

namespace marsview::test {

inline constexpr double kDt = 1e-3; // seconds

} // namespace marsview::test
