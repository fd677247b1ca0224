#include "haptics/trace/goal_file.h"

#include "core/base/bounded_text.h"
#include "core/base/plain_number.h"
#include "haptics/trace/recording_reader.h"
#include "haptics/trace/table_words.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <ios>
#include <iostream>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace marsview {
namespace {

std::string_view headerOf(GoalColumns columns)
{
    return columns == GoalColumns::Map ? "x,y,z" : "lon,lat,z";
}

// Over an hour of a recording at 1 kHz; its longest lines list the tiles that arrived in an update.
constexpr TextBounds kGoalBounds{.bytes_max = std::size_t{1} << 30U,
                                 .line_bytes_max = std::size_t{1} << 20U};

bool isHeader(const TableWords& words, GoalColumns columns)
{
    return words.size() >= 3 &&
           fmt::format("{},{},{}", words[0], words[1], words[2]) == headerOf(columns);
}

// Lists of goals may have blanks in place of commas, and a comma at the end.
void splitAsGoals(std::string_view line, TableWords& words)
{
    constexpr std::size_t kColumns = 3;
    if (words.size() == 1) {
        splitAtBlanks(line, words);
    } else if (words.size() == kColumns + 1 && words.back().empty()) {
        words.pop_back();
    }
}

// Parses a line of three columns, or more if `has_more`.
std::optional<TracePoint> parseGoal(const TableWords& words, bool has_more)
{
    if (words.size() < 3 || (words.size() > 3) != has_more) {
        return std::nullopt;
    }
    const auto x = parseNumber(words[0]);
    const auto y = parseNumber(words[1]);
    const auto z = parseNumber(words[2]);
    return x && y && z ? std::optional<TracePoint>({*x, *y, *z}) : std::nullopt;
}

} // namespace

Result<std::vector<TracePoint>> readGoals(const std::string& text, const std::string& name)
{
    Result<GoalRecording> recording = readGoalRecording(text, name);
    if (!recording) {
        return std::move(recording).error();
    }
    return std::move(recording->goals);
}

Result<GoalRecording>
readGoalRecording(const std::string& text, const std::string& name, GoalColumns columns)
{
    std::string_view rest = text;
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (rest.starts_with(kByteOrderMark)) {
        rest.remove_prefix(kByteOrderMark.size());
    }
    GoalRecording recording;
    std::optional<RecordingReader> reader; // for the further columns of a recording
    TableWords words;
    bool has_header = false;
    bool has_more_columns = false;
    for (std::size_t number = 1; !rest.empty(); ++number) {
        const std::size_t end = rest.find('\n');
        if (end == std::string_view::npos && reader) {
            recording.is_cut_short = true; // a complete line of a recording ends with a line break
            break;
        }
        const std::string_view line = trimmed(rest.substr(0, end));
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
        if (line.empty()) {
            continue;
        }
        splitWords(line, words);
        if (!reader) {
            splitAsGoals(line, words);
        }
        const auto refused = [&](std::string_view why) {
            return Error{ErrorCode::Invalid, fmt::format("{}: line {} {}", name, number, why)};
        };
        if (!has_header) {
            if (!isHeader(words, columns)) {
                return Error{ErrorCode::Invalid,
                             fmt::format("{}: is neither a touch recording nor a list of goals "
                                         "(line {} is \"{}\", not the header \"{}\"); choose a "
                                         "file that this program recorded",
                                         name, number, quotedWord(line), headerOf(columns))};
            }
            has_header = true;
            has_more_columns = words.size() > 3;
            reader = RecordingReader::forHeader(words);
            continue;
        }
        const std::optional<TracePoint> goal = parseGoal(words, has_more_columns);
        if (!goal) {
            return refused(
                fmt::format("is \"{}\"; three numbers separated by commas or blanks are needed",
                            quotedWord(line)));
        }
        if (reader) {
            if (const std::string problem = reader->read(words, number, recording);
                !problem.empty()) {
                return refused(problem);
            }
        }
        recording.goals.push_back(*goal);
    }
    if (!has_header) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: is empty; the header \"{}\" and one goal per line are needed",
                                 name, headerOf(columns))};
    }
    return recording;
}

std::optional<GoalColumns> goalColumnsOf(const std::string& path)
{
    constexpr std::size_t kHeaderBytesMax = 4096;
    std::ifstream file(path, std::ios::binary);
    std::string begin(kHeaderBytesMax, '\0');
    file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
    begin.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
    for (const GoalColumns columns : {GoalColumns::Map, GoalColumns::Geographic}) {
        if (readGoalRecording(begin.substr(0, begin.find('\n')), path, columns)) {
            return columns;
        }
    }
    return std::nullopt;
}

Result<std::string> readGoalText(const std::string& path)
{
    if (path == "-") {
        return readBoundedText(std::cin, "--goals", kGoalBounds);
    }
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    int system_error = file ? 0 : errno;
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
        system_error = EISDIR;
    }
    if (!file || system_error != 0) {
        return Error{ErrorCode::NotFound,
                     fmt::format("{}: cannot be read ({}); give the path of a file of goals or of "
                                 "a recording",
                                 path, std::generic_category().message(system_error))};
    }
    return readBoundedText(file, path, kGoalBounds);
}

} // namespace marsview
