// Checks for programming errors. They stay enabled in release builds.
#pragma once

namespace marsview {

/// Prints the condition and its source location to stderr and aborts. Any thread.
[[noreturn]] void checkFailed(const char* condition, const char* file, int line) noexcept;

} // namespace marsview

/// Aborts with the source location if `condition` is false. For programmer errors only; bad files
/// and lost devices are Results (result.h).
#define MARSVIEW_CHECK(condition)                                                                  \
    (static_cast<bool>(condition) ? void(0)                                                        \
                                  : ::marsview::checkFailed(#condition, __FILE__, __LINE__))
