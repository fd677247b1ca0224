// The words of a line of a table, between its commas.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace marsview {

/// Views into the line.
using TableWords = std::vector<std::string_view>;

/// Without blanks and carriage returns around it.
inline std::string_view trimmed(std::string_view text)
{
    constexpr std::string_view kBlanks = " \t\r";
    const std::size_t begin = text.find_first_not_of(kBlanks);
    return begin == std::string_view::npos
               ? std::string_view()
               : text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

/// All of them, trimmed, in `words`, which is emptied first.
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

/// As a message shows it: not too long.
inline std::string quotedWord(std::string_view text)
{
    constexpr std::size_t kQuotedMax = 60;
    return text.size() <= kQuotedMax ? std::string(text)
                                     : std::string(text.substr(0, kQuotedMax)) + "…";
}

} // namespace marsview
