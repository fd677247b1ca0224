// Runs a contact model over a list of goals, one update per line.
#pragma once

#include "core/base/result.h"
#include "core/contact/contact_model.h"
#include "core/contact/goal_frame.h"
#include "haptics/trace/goal_file.h"

#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

namespace marsview {

/// Converts between the points of the file and the coordinates of the model.
struct TraceFrame {
    std::function<ScenePoint(const TracePoint& goal)> to_scene;
    std::function<TracePoint(const ContactState& state)> from_scene;
    /// Whether the model clamps the goal to the border of the map.
    std::function<bool(const TracePoint& goal)> is_clamped;
};

/// Called with a goal's index, counted from 0 over all goals, before the model gets the goal.
using BeforeGoal = std::function<Status(std::size_t goal)>;

struct TraceUpdate {
    TracePoint proxy; // in free space exactly the goal
    ContactState state;
    double ns = 0.0;
};

/// Runs the model over some of the goals; a new model's first goal places its proxy. Appends to
/// `updates`, which has one entry for each earlier goal. Returns the error of `before_goal`.
Status trace(ContactModel& model,
             const TraceFrame& frame,
             std::span<const TracePoint> goals,
             const BeforeGoal& before_goal,
             std::vector<TraceUpdate>& updates);

/// The trace as CSV, optionally with a column `ns`.
enum class TraceTiming { No, Yes };
std::string asCsv(const std::vector<TraceUpdate>& updates, GoalColumns columns, TraceTiming timing);

/// Counts, totals and means of the counters, and times.
nlohmann::ordered_json traceSummary(const std::vector<TraceUpdate>& updates);

} // namespace marsview
