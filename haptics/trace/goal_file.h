// Files of goals: what a hand aimed at, one update a line.
#pragma once

#include "core/base/result.h"
#include "core/contact/contact_model.h"
#include "core/contact/goal_frame.h"
#include "haptics/terrain/ground_record.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// The goals in `text`: a line "x,y,z", then a goal a line. Further columns, as a recording has
/// them, are passed over. Blanks, empty lines, CR before LF and a byte order mark do no harm; "nan"
/// and "inf" are numbers. `name` is whose text it is, for the message that tells the line that
/// cannot be read.
Result<std::vector<TracePoint>> readGoals(const std::string& text, const std::string& name);

/// What goals were aimed at with, from `first` on.
struct GoalPart {
    std::size_t first = 0;  // of the goals
    std::size_t line = 0;   // of the file, from 1
    std::uint64_t map = 0;  // another number is another map
    std::uint64_t part = 0; // another number is another contact model; one may come back
    ContactModelKind kind = kContactModelDefault;
    double radius_m = 1.0;
    double exaggeration = 1.0;
    std::optional<GroundPart> ground{}; // where the file tells it
};

/// What has changed of the ground before a goal.
struct GoalGround {
    std::size_t goal = 0;
    std::vector<GroundRecord> records; // in order, without GroundParts
};

/// What came of a goal when it was recorded.
struct RecordedUpdate {
    bool is_in_contact = false;
    TracePoint proxy{};

    bool operator==(const RecordedUpdate&) const = default;
};

/// Goals, and what a recording tells of them.
struct GoalRecording {
    std::vector<TracePoint> goals;
    std::vector<GoalPart> parts;         // in order; none where the file is but goals
    std::vector<GoalGround> ground;      // in order; none where all of it was there
    std::vector<RecordedUpdate> updates; // of each goal; none where the file does not tell
    /// The last line of a recording had no end, as when the program was killed or the disk was
    /// full, and is left out.
    bool is_cut_short = false;
};

/// The same as readGoals(), with the columns "map,part,model,radius_m,exaggeration", and with them
/// "ground" and "contact,proxy_x,proxy_y,proxy_z", where the header has them.
Result<GoalRecording> readGoalRecording(const std::string& text, const std::string& name);

/// The text of a file, or of standard input where `path` is "-". TooLarge above 1 GiB, or with a
/// line above 1 MiB.
Result<std::string> readGoalText(const std::string& path);

} // namespace marsview
