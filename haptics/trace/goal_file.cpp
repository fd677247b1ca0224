#include "haptics/trace/goal_file.h"

#include "core/base/plain_number.h"

#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>

namespace marsview {
namespace {

constexpr std::string_view kHeader = "x,y,z";

std::string_view trimmed(std::string_view text)
{
    constexpr std::string_view kBlanks = " \t\r";
    const std::size_t begin = text.find_first_not_of(kBlanks);
    return begin == std::string_view::npos
               ? std::string_view()
               : text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

// The words between the commas of a line, at most the first four.
struct Words {
    std::array<std::string_view, 4> words;
    std::size_t count = 0;
};

Words wordsOf(std::string_view line)
{
    Words result;
    while (result.count < result.words.size()) {
        const std::size_t comma = line.find(',');
        result.words[result.count++] = trimmed(line.substr(0, comma));
        if (comma == std::string_view::npos) {
            break;
        }
        line.remove_prefix(comma + 1);
    }
    return result;
}

bool isHeader(std::string_view line)
{
    const Words words = wordsOf(line);
    return words.count >= 3 && words.words[0] == "x" && words.words[1] == "y" &&
           words.words[2] == "z";
}

// A line of a file whose header has three columns, or more.
std::optional<TracePoint> parseGoal(std::string_view line, std::size_t columns)
{
    const Words words = wordsOf(line);
    if (words.count != columns) {
        return std::nullopt;
    }
    const auto x = parseNumber(words.words[0]);
    const auto y = parseNumber(words.words[1]);
    const auto z = parseNumber(words.words[2]);
    return x && y && z ? std::optional<TracePoint>({*x, *y, *z}) : std::nullopt;
}

std::string quoted(std::string_view line)
{
    constexpr std::size_t kQuotedMax = 60;
    return line.size() <= kQuotedMax ? std::string(line)
                                     : std::string(line.substr(0, kQuotedMax)) + "…";
}

} // namespace

Result<std::vector<TracePoint>> readGoals(const std::string& text, const std::string& name)
{
    std::string_view rest = text;
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (rest.starts_with(kByteOrderMark)) {
        rest.remove_prefix(kByteOrderMark.size());
    }
    std::vector<TracePoint> goals;
    std::size_t columns = 0; // 0: no header yet; 4: or more
    for (std::size_t number = 1; !rest.empty(); ++number) {
        const std::size_t end = rest.find('\n');
        const std::string_view line = trimmed(rest.substr(0, end));
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
        if (line.empty()) {
            continue;
        }
        if (columns == 0) {
            if (!isHeader(line)) {
                return Error{ErrorCode::Invalid,
                             fmt::format("{}: line {} is \"{}\"; the first one has to be the "
                                         "header \"{}\"",
                                         name, number, quoted(line), kHeader)};
            }
            columns = wordsOf(line).count;
            continue;
        }
        const std::optional<TracePoint> goal = parseGoal(line, columns);
        if (!goal) {
            return Error{ErrorCode::Invalid,
                         fmt::format("{}: line {} is \"{}\"; three numbers with commas between "
                                     "them are needed",
                                     name, number, quoted(line))};
        }
        goals.push_back(*goal);
    }
    if (columns == 0) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: is empty; the header \"{}\" and a goal a line are needed",
                                 name, kHeader)};
    }
    return goals;
}

Result<std::string> readGoalText(const std::string& path)
{
    if (path == "-") {
        return std::string(std::istreambuf_iterator<char>(std::cin), {});
    }
    std::error_code ignored;
    std::ifstream file(path, std::ios::binary);
    if (!file || std::filesystem::is_directory(path, ignored)) {
        return Error{ErrorCode::NotFound, fmt::format("{}: cannot be read", path)};
    }
    return std::string(std::istreambuf_iterator<char>(file), {});
}

} // namespace marsview
