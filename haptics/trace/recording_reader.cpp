#include "haptics/trace/recording_reader.h"

#include "core/base/plain_number.h"
#include "haptics/trace/ground_text.h"
#include "haptics/trace/motion_text.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <system_error>
#include <utility>
#include <variant>

namespace marsview {
namespace {

// The positions of the names; empty if one is missing.
template <std::size_t N>
std::optional<std::array<std::size_t, N>> placesOf(const std::array<std::string_view, N>& names,
                                                   const TableWords& header)
{
    std::array<std::size_t, N> places{};
    for (std::size_t i = 0; i < N; ++i) {
        const auto found = std::find(header.begin(), header.end(), names[i]);
        if (found == header.end()) {
            return std::nullopt;
        }
        places[i] = static_cast<std::size_t>(found - header.begin());
    }
    return places;
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

bool isSamePart(const GoalPart& a, const GoalPart& b)
{
    return a.map == b.map && a.part == b.part && a.kind == b.kind && a.radius_m == b.radius_m &&
           a.exaggeration == b.exaggeration;
}

} // namespace

std::optional<RecordingReader> RecordingReader::forHeader(const TableWords& header)
{
    const auto part_at = placesOf(kPartNames, header);
    if (!part_at) {
        return std::nullopt;
    }
    RecordingReader reader;
    reader.part_at_ = *part_at;
    reader.update_at_ = placesOf(kUpdateNames, header);
    reader.force_at_ = placesOf(kForceNames, header);
    if (const auto motion = placesOf(std::array{kMotionColumn}, header)) {
        reader.motion_at_ = motion->front();
    }
    if (const auto ground = placesOf(std::array{kGroundColumn}, header)) {
        reader.ground_at_ = ground->front();
    }
    reader.count_ = header.size();
    return reader;
}

std::string
RecordingReader::read(const TableWords& words, std::size_t number, GoalRecording& recording)
{
    std::optional<GoalPart> part = partIn(words);
    if (!part) {
        return "has no valid map, part, model, radius_m and exaggeration";
    }
    if (ground_at_) {
        const auto records = parseGround(words[*ground_at_]);
        if (!records) {
            return fmt::format("has the invalid ground \"{}\"", quotedWord(words[*ground_at_]));
        }
        addGround(*records, recording);
    }
    if (update_at_) {
        const auto update = updateIn(words);
        if (!update) {
            return "has no valid contact, proxy_x, proxy_y and proxy_z";
        }
        recording.updates.push_back(*update);
    }
    if (force_at_) {
        const auto force = forceIn(words);
        if (!force) {
            return "has no valid force_x_n, force_y_n, force_z_n and mode";
        }
        recording.forces.push_back(*force);
    }
    if (motion_at_ && !words[*motion_at_].empty()) {
        const auto motion = parseMotion(words[*motion_at_]);
        if (!motion) {
            return fmt::format("has the invalid motion \"{}\"", quotedWord(words[*motion_at_]));
        }
        recording.motions.push_back({.goal = recording.goals.size(), .motion = *motion});
    }
    if (recording.parts.empty() || !isSamePart(recording.parts.back(), *part)) {
        part->first = recording.goals.size();
        part->line = number;
        if (const auto maps = maps_.find(part->part); maps != maps_.end()) {
            part->ground = maps->second.uppermost;
            part->below = maps->second.below;
        }
        recording.parts.push_back(*part);
    }
    return {};
}

std::optional<GoalPart> RecordingReader::partIn(const TableWords& words) const
{
    if (words.size() != count_) {
        return std::nullopt;
    }
    const auto map = countOf(words[part_at_[0]]);
    const auto part = countOf(words[part_at_[1]]);
    const auto kind = contactModelKind(words[part_at_[2]]);
    const auto radius = parseNumber(words[part_at_[3]]);
    const auto exaggeration = parseNumber(words[part_at_[4]]);
    if (!map || !part || !kind || !isScale(radius) || !isScale(exaggeration)) {
        return std::nullopt;
    }
    return GoalPart{.map = *map,
                    .part = *part,
                    .kind = *kind,
                    .radius_m = *radius,
                    .exaggeration = *exaggeration};
}

std::optional<RecordedForce> RecordingReader::forceIn(const TableWords& words) const
{
    const auto x = parseNumber(words[(*force_at_)[0]]);
    const auto y = parseNumber(words[(*force_at_)[1]]);
    const auto z = parseNumber(words[(*force_at_)[2]]);
    const auto mode = stylusMode(words[(*force_at_)[3]]);
    if (!x || !y || !z || !isFinite(Vec3{*x, *y, *z}) || !mode) {
        return std::nullopt;
    }
    return RecordedForce{.force_n = {*x, *y, *z}, .mode = *mode};
}

std::optional<RecordedUpdate> RecordingReader::updateIn(const TableWords& words) const
{
    const auto contact = countOf(words[(*update_at_)[0]]);
    const auto x = parseNumber(words[(*update_at_)[1]]);
    const auto y = parseNumber(words[(*update_at_)[2]]);
    const auto z = parseNumber(words[(*update_at_)[3]]);
    if (!contact || !x || !y || !z) {
        return std::nullopt;
    }
    return RecordedUpdate{.is_in_contact = *contact != 0, .proxy = {*x, *y, *z}};
}

// Stores maps with their parts, and all other records with the next goal.
void RecordingReader::addGround(const std::vector<GroundRecord>& records, GoalRecording& recording)
{
    GoalGround ground{.goal = recording.goals.size(), .records = {}};
    for (const GroundRecord& record : records) {
        if (const auto* part = std::get_if<GroundPart>(&record)) {
            maps_[part->part] = {.uppermost = *part, .below = {}};
        } else if (const auto* below = std::get_if<GroundBelow>(&record)) {
            maps_[below->map.part].below.push_back(below->map);
        } else {
            ground.records.push_back(record);
        }
    }
    if (!ground.records.empty()) {
        recording.ground.push_back(std::move(ground));
    }
}

} // namespace marsview
