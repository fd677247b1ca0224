// Text that a plugin provides.
#pragma once

#include <cstddef>
#include <string>

namespace marsview {

/// The text up to its terminating 0 or `bytes_max`, on one line: control characters become spaces.
/// Empty if null. Never cut within a UTF-8 character. It may still not be valid UTF-8.
std::string shownPluginText(const char* text, std::size_t bytes_max);

} // namespace marsview
