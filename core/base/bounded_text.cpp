#include "core/base/bounded_text.h"

#include <algorithm>
#include <fmt/format.h>
#include <istream>
#include <vector>

namespace marsview {
namespace {

std::string asSize(std::size_t bytes)
{
    constexpr std::size_t kMega = 1U << 20U;
    return bytes >= kMega ? fmt::format("{} MiB", bytes / kMega)
                          : fmt::format("{} KiB", bytes / 1024);
}

} // namespace

Result<std::string>
readBoundedText(std::istream& in, const std::string& name, const TextBounds& bounds)
{
    constexpr std::size_t kChunkBytes = 1U << 16U;
    std::vector<char> chunk(kChunkBytes);
    std::string text;
    std::size_t line = 1;
    std::size_t line_bytes = 0;
    while (in) {
        in.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
        const auto count = static_cast<std::size_t>(in.gcount());
        for (std::size_t i = 0; i < count; ++i) {
            if (chunk[i] == '\n') {
                ++line;
                line_bytes = 0;
            } else if (++line_bytes > bounds.line_bytes_max) {
                return Error{ErrorCode::TooLarge,
                             fmt::format("{}: line {} is longer than {}; this is not a text file "
                                         "of the expected kind",
                                         name, line, asSize(bounds.line_bytes_max))};
            }
        }
        if (text.size() + count > bounds.bytes_max) {
            return Error{ErrorCode::TooLarge,
                         fmt::format("{}: longer than {}, the maximum; split it into several files",
                                     name, asSize(bounds.bytes_max))};
        }
        text.append(chunk.data(), count);
    }
    if (in.bad()) {
        return Error{ErrorCode::Unreadable, fmt::format("{}: reading failed", name)};
    }
    return text;
}

LineOutcome readBoundedLine(std::istream& in, std::string& line, std::size_t bytes_max)
{
    line.clear();
    std::streambuf* const buffer = in.rdbuf();
    constexpr int kEnd = std::char_traits<char>::eof();
    for (int c = buffer->sbumpc(); c != kEnd; c = buffer->sbumpc()) {
        if (c == '\n') {
            return LineOutcome::Line;
        }
        if (line.size() == bytes_max) {
            return LineOutcome::TooLong;
        }
        line.push_back(static_cast<char>(c));
    }
    return line.empty() ? LineOutcome::End : LineOutcome::Line;
}

} // namespace marsview
