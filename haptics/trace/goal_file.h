// Files of goals: what a hand aimed at, one update a line.
#pragma once

#include "core/base/result.h"
#include "core/contact/goal_frame.h"

#include <string>
#include <vector>

namespace marsview {

/// The goals in `text`: a line "x,y,z", then a goal a line. Further columns, as a recording has
/// them, are passed over. Blanks, empty lines, CR before LF and a byte order mark do no harm; "nan"
/// and "inf" are numbers. `name` is whose text it is, for the message that tells the line that
/// cannot be read.
Result<std::vector<TracePoint>> readGoals(const std::string& text, const std::string& name);

/// The same of a file, or of standard input where `path` is "-".
Result<std::string> readGoalText(const std::string& path);

} // namespace marsview
