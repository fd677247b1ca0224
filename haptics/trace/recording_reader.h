// The columns of a recording other than its goals.
#pragma once

#include "haptics/terrain/ground_record.h"
#include "haptics/trace/goal_file.h"
#include "haptics/trace/table_words.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

/// Parses them line by line into a GoalRecording.
class RecordingReader {
public:
    /// Empty if the header does not have the columns "map,part,model,radius_m,exaggeration".
    static std::optional<RecordingReader> forHeader(const TableWords& header);

    /// Parses the file's line `number` (from 1), whose goal is the next of `recording`. Returns the
    /// error, phrased to follow the line number; empty if the line is valid.
    std::string read(const TableWords& words, std::size_t number, GoalRecording& recording);

private:
    static constexpr std::array<std::string_view, 5> kPartNames{"map", "part", "model", "radius_m",
                                                                "exaggeration"};
    static constexpr std::array<std::string_view, 4> kUpdateNames{"contact", "proxy_x", "proxy_y",
                                                                  "proxy_z"};
    static constexpr std::array<std::string_view, 4> kForceNames{"force_x_n", "force_y_n",
                                                                 "force_z_n", "mode"};

    std::optional<GoalPart> partIn(const TableWords& words) const;
    std::optional<RecordedForce> forceIn(const TableWords& words) const;
    std::optional<RecordedUpdate> updateIn(const TableWords& words) const;
    void addGround(const std::vector<GroundRecord>& records, GoalRecording& recording);

    // Column positions; older recordings do not have all of these columns.
    std::array<std::size_t, kPartNames.size()> part_at_{};
    std::optional<std::array<std::size_t, kUpdateNames.size()>> update_at_;
    std::optional<std::array<std::size_t, kForceNames.size()>> force_at_;
    std::optional<std::size_t> ground_at_;
    std::optional<std::size_t> motion_at_;
    std::size_t count_ = 0; // of all columns
    struct Maps {
        GroundPart uppermost;
        std::vector<GroundPart> below;
    };
    std::map<std::uint64_t, Maps> maps_; // by part
};

} // namespace marsview
