// Checks of what only a bug could break. They stay on in release builds.
#pragma once

namespace marsview {

/// Prints the condition and its place to stderr and aborts. Any thread.
[[noreturn]] void checkFailed(const char* condition, const char* file, int line) noexcept;

} // namespace marsview

/// Aborts with the place when `condition` is false. For programmer errors only; what the world can
/// get wrong is a Result (result.h).
#define MARSVIEW_CHECK(condition)                                                                  \
    (static_cast<bool>(condition) ? void(0)                                                        \
                                  : ::marsview::checkFailed(#condition, __FILE__, __LINE__))
