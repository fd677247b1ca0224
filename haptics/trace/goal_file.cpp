#include "haptics/trace/goal_file.h"

#include "core/base/plain_number.h"
#include "haptics/trace/ground_text.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

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

// Where a recording's columns are, those that tell what goals were aimed at with.
struct PartColumns {
    static constexpr std::array<std::string_view, 5> kNames{"map", "part", "model", "radius_m",
                                                            "exaggeration"};
    std::array<std::size_t, kNames.size()> at{};
    static constexpr std::array<std::string_view, 4> kUpdateNames{"contact", "proxy_x", "proxy_y",
                                                                  "proxy_z"};
    std::optional<std::size_t> ground{}; // older recordings have none
    std::optional<std::array<std::size_t, kUpdateNames.size()>> update{};
    std::size_t count = 0; // of all columns
};

std::vector<std::string_view> allWordsOf(std::string_view line)
{
    std::vector<std::string_view> words;
    while (true) {
        const std::size_t comma = line.find(',');
        words.push_back(trimmed(line.substr(0, comma)));
        if (comma == std::string_view::npos) {
            return words;
        }
        line.remove_prefix(comma + 1);
    }
}

// Where each of the names is; nothing where one is missing.
template <std::size_t N>
std::optional<std::array<std::size_t, N>> placesOf(const std::array<std::string_view, N>& names,
                                                   const std::vector<std::string_view>& words)
{
    std::array<std::size_t, N> places{};
    for (std::size_t i = 0; i < N; ++i) {
        const auto found = std::find(words.begin(), words.end(), names[i]);
        if (found == words.end()) {
            return std::nullopt;
        }
        places[i] = static_cast<std::size_t>(found - words.begin());
    }
    return places;
}

std::optional<PartColumns> partColumnsOf(std::string_view header)
{
    const std::vector<std::string_view> words = allWordsOf(header);
    const auto places = placesOf(PartColumns::kNames, words);
    if (!places) {
        return std::nullopt;
    }
    PartColumns columns{.at = *places, .count = words.size()};
    if (const auto ground = placesOf(std::array{kGroundColumn}, words)) {
        columns.ground = ground->front();
    }
    columns.update = placesOf(PartColumns::kUpdateNames, words);
    return columns;
}

std::optional<std::uint64_t> countOf(std::string_view word)
{
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool is_whole = error == std::errc() && end == word.data() + word.size();
    return is_whole ? std::optional(value) : std::nullopt;
}

bool isScale(const std::optional<double>& value)
{
    constexpr double kMax = 1e12;
    return value && *value > 0.0 && *value < kMax;
}

std::optional<GoalPart> parsePart(const std::vector<std::string_view>& words,
                                  const PartColumns& columns)
{
    if (words.size() != columns.count) {
        return std::nullopt;
    }
    const auto word = [&](std::size_t i) { return words[columns.at[i]]; };
    const auto map = countOf(word(0));
    const auto part = countOf(word(1));
    const auto kind = contactModelKind(word(2));
    const auto radius = parseNumber(word(3));
    const auto exaggeration = parseNumber(word(4));
    if (!map || !part || !kind || !isScale(radius) || !isScale(exaggeration)) {
        return std::nullopt;
    }
    return GoalPart{.map = *map,
                    .part = *part,
                    .kind = *kind,
                    .radius_m = *radius,
                    .exaggeration = *exaggeration};
}

std::optional<RecordedUpdate> parseUpdate(const std::vector<std::string_view>& words,
                                          const std::array<std::size_t, 4>& places)
{
    const auto contact = countOf(words[places[0]]);
    const auto x = parseNumber(words[places[1]]);
    const auto y = parseNumber(words[places[2]]);
    const auto z = parseNumber(words[places[3]]);
    return contact && x && y && z ? std::optional(RecordedUpdate{.is_in_contact = *contact != 0,
                                                                 .proxy = {*x, *y, *z}})
                                  : std::nullopt;
}

bool isSamePart(const GoalPart& a, const GoalPart& b)
{
    return a.map == b.map && a.part == b.part && a.kind == b.kind && a.radius_m == b.radius_m &&
           a.exaggeration == b.exaggeration;
}

// Keeps what is said of parts with the parts, the rest with the goal that comes next.
void addGround(GoalRecording& recording,
               std::map<std::uint64_t, GroundPart>& parts,
               const std::vector<GroundRecord>& records)
{
    GoalGround ground{.goal = recording.goals.size(), .records = {}};
    for (const GroundRecord& record : records) {
        if (const auto* part = std::get_if<GroundPart>(&record)) {
            parts[part->part] = *part;
        } else {
            ground.records.push_back(record);
        }
    }
    if (!ground.records.empty()) {
        recording.ground.push_back(std::move(ground));
    }
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
    Result<GoalRecording> recording = readGoalRecording(text, name);
    if (!recording) {
        return std::move(recording).error();
    }
    return std::move(recording->goals);
}

Result<GoalRecording> readGoalRecording(const std::string& text, const std::string& name)
{
    std::string_view rest = text;
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (rest.starts_with(kByteOrderMark)) {
        rest.remove_prefix(kByteOrderMark.size());
    }
    GoalRecording recording;
    std::optional<PartColumns> part_columns;
    std::map<std::uint64_t, GroundPart> ground_parts;
    std::size_t columns = 0; // 0: no header yet; 4: or more
    for (std::size_t number = 1; !rest.empty(); ++number) {
        const std::size_t end = rest.find('\n');
        if (end == std::string_view::npos && part_columns) {
            recording.is_cut_short = true; // recordings end their lines
            break;
        }
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
            part_columns = partColumnsOf(line);
            continue;
        }
        const std::optional<TracePoint> goal = parseGoal(line, columns);
        if (!goal) {
            return Error{ErrorCode::Invalid,
                         fmt::format("{}: line {} is \"{}\"; three numbers with commas between "
                                     "them are needed",
                                     name, number, quoted(line))};
        }
        if (part_columns) {
            const std::vector<std::string_view> words = allWordsOf(line);
            std::optional<GoalPart> part = parsePart(words, *part_columns);
            if (!part) {
                return Error{ErrorCode::Invalid,
                             fmt::format("{}: line {} does not tell map, part, model, radius_m "
                                         "and exaggeration as a recording does",
                                         name, number)};
            }
            if (part_columns->ground) {
                const std::string_view cell = words[*part_columns->ground];
                const auto records = parseGround(cell);
                if (!records) {
                    return Error{
                        ErrorCode::Invalid,
                        fmt::format("{}: line {} has the ground \"{}\", which is none that "
                                    "a recording tells of",
                                    name, number, quoted(cell))};
                }
                addGround(recording, ground_parts, *records);
            }
            if (part_columns->update) {
                const auto update = parseUpdate(words, *part_columns->update);
                if (!update) {
                    return Error{ErrorCode::Invalid,
                                 fmt::format("{}: line {} does not tell contact, proxy_x, proxy_y "
                                             "and proxy_z as a recording does",
                                             name, number)};
                }
                recording.updates.push_back(*update);
            }
            if (recording.parts.empty() || !isSamePart(recording.parts.back(), *part)) {
                part->first = recording.goals.size();
                part->line = number;
                const auto ground = ground_parts.find(part->part);
                if (ground != ground_parts.end()) {
                    part->ground = ground->second;
                }
                recording.parts.push_back(*part);
            }
        }
        recording.goals.push_back(*goal);
    }
    if (columns == 0) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: is empty; the header \"{}\" and a goal a line are needed",
                                 name, kHeader)};
    }
    return recording;
}

Result<std::string> readGoalText(const std::string& path)
{
    if (path == "-") {
        return std::string(std::istreambuf_iterator<char>(std::cin), {});
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
    return std::string(std::istreambuf_iterator<char>(file), {});
}

} // namespace marsview
