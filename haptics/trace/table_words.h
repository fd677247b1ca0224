// Splits a line of a table at its commas or blanks.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

/// Views into the line.
using TableWords = std::vector<std::string_view>;

/// Without leading and trailing blanks and carriage returns.
inline std::string_view trimmed(std::string_view text)
{
    constexpr std::string_view kBlanks = " \t\r";
    const std::size_t begin = text.find_first_not_of(kBlanks);
    return begin == std::string_view::npos
               ? std::string_view()
               : text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

/// Splits the line into trimmed words; replaces the content of `words`.
inline void splitWords(std::string_view line, TableWords& words)
{
    words.clear();
    while (true) {
        const std::size_t comma = line.find(',');
        words.push_back(trimmed(line.substr(0, comma)));
        if (comma == std::string_view::npos) {
            return;
        }
        line.remove_prefix(comma + 1);
    }
}

/// As splitWords, for lines without commas: splits at blanks.
inline void splitAtBlanks(std::string_view line, TableWords& words)
{
    words.clear();
    for (line = trimmed(line); !line.empty(); line = trimmed(line)) {
        const std::size_t blank = std::min(line.find_first_of(" \t"), line.size());
        words.push_back(line.substr(0, blank));
        line.remove_prefix(blank);
    }
}

/// For messages: quoted and truncated.
inline std::string quotedWord(std::string_view text)
{
    constexpr std::size_t kQuotedMax = 60;
    return text.size() <= kQuotedMax ? std::string(text)
                                     : std::string(text.substr(0, kQuotedMax)) + "…";
}

} // namespace marsview
