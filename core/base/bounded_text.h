// Reading a whole text up to a maximum length.
#pragma once

#include "core/base/result.h"

#include <cstddef>
#include <iosfwd>
#include <string>

namespace marsview {

struct TextBounds {
    std::size_t bytes_max;      // of the whole text
    std::size_t line_bytes_max; // of each line, without its end
};

/// All of `in`; messages call it `name`. TooLarge as soon as a limit is exceeded, so that an
/// endless stream ("/dev/zero", a pipe) is refused. Unreadable if reading fails.
Result<std::string>
readBoundedText(std::istream& in, const std::string& name, const TextBounds& bounds);

enum class LineOutcome { Line, End, TooLong };

/// Reads the next line without its line ending, like std::getline, but at most `bytes_max` bytes.
/// After TooLong, `line` holds the beginning of the line.
LineOutcome readBoundedLine(std::istream& in, std::string& line, std::size_t bytes_max);

} // namespace marsview
