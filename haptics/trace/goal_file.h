// Files of goals: the positions a hand aimed at, one update per line.
#pragma once

#include "core/base/result.h"
#include "core/contact/contact_model.h"
#include "core/contact/goal_frame.h"
#include "haptics/device/recorded_tick.h"
#include "haptics/terrain/ground_record.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// The first three columns of a file of goals.
enum class GoalColumns : std::uint8_t {
    Map,        // "x,y,z": map coordinates (GoalFrame)
    Geographic, // "lon,lat,z": of the body scene (BodyGoalFrame)
};

/// Parses `text`: the header "x,y,z", then one goal per line. Further columns, as in a recording,
/// are ignored. Blanks, empty lines, CR before LF and a byte order mark are permitted; "nan" and
/// "inf" are numbers. `name` is the source of the text, for the message that names the invalid
/// line.
Result<std::vector<TracePoint>> readGoals(const std::string& text, const std::string& name);

/// The map and contact model of the goals from `first` on.
struct GoalPart {
    std::size_t first = 0;  // index of the goal
    std::size_t line = 0;   // line in the file, from 1
    std::uint64_t map = 0;  // different for another map
    std::uint64_t part = 0; // different for another contact model; a model may occur again
    ContactModelKind kind = kContactModelDefault;
    double radius_m = 1.0;
    double exaggeration = 1.0;
    std::optional<GroundPart> ground{}; // if stored in the file; the uppermost of several maps
    std::vector<GroundPart> below{};    // the maps joined with it, from above
};

/// Changes of the terrain before a goal.
struct GoalGround {
    std::size_t goal = 0;
    std::vector<GroundRecord> records; // in order, without maps
};

/// The recorded result of a goal.
struct RecordedUpdate {
    bool is_in_contact = false;
    TracePoint proxy{};

    bool operator==(const RecordedUpdate&) const = default;
};

/// The recorded force on the hand, in the workspace, and the mode.
struct RecordedForce {
    Vec3 force_n{};
    StylusMode mode = StylusMode::Hover;
};

/// The hand has moved the map in the tick of a goal.
struct GoalMotion {
    std::size_t goal = 0;
    SceneMotion motion;
};

/// Goals and the other data of a recording.
struct GoalRecording {
    std::vector<TracePoint> goals;
    std::vector<GoalPart> parts;         // in order; none if the file contains only goals
    std::vector<GoalGround> ground;      // in order; none if all terrain was resident
    std::vector<RecordedUpdate> updates; // one per goal; none if not stored in the file
    std::vector<RecordedForce> forces;   // the same
    std::vector<GoalMotion> motions;     // in order
    /// The last line of a recording was incomplete, for example because the program was killed or
    /// the disk was full, and is skipped.
    bool is_cut_short = false;
};

/// As readGoals(), and also reads the columns "map,part,model,radius_m,exaggeration", and with them
/// "ground", "contact,proxy_x,proxy_y,proxy_z", "force_x_n,force_y_n,force_z_n,mode" and "motion",
/// if the header has them.
Result<GoalRecording> readGoalRecording(const std::string& text,
                                        const std::string& name,
                                        GoalColumns columns = GoalColumns::Map);

/// The kind of goals that a file has by its header; empty if it cannot be read or is another file.
std::optional<GoalColumns> goalColumnsOf(const std::string& path);

/// The text of a file, or of standard input if `path` is "-". TooLarge above 1 GiB, or with a line
/// above 1 MiB.
Result<std::string> readGoalText(const std::string& path);

} // namespace marsview
