// The timeout for things that a window does by itself.
#pragma once

namespace marsview {

inline constexpr int kTimeout = 120000; // ms; far more than is ever needed on an idle machine

} // namespace marsview
