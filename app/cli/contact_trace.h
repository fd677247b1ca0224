// A contact model run over a list of goals, one update a line.
#pragma once

#include "core/base/result.h"
#include "core/contact/contact_model.h"
#include "core/contact/goal_frame.h"

#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

namespace marsview {

/// Between the points of the file and those that the model moves among.
struct TraceFrame {
    std::function<ScenePoint(const TracePoint& goal)> to_scene;
    std::function<TracePoint(const ContactState& state)> from_scene;
    /// Whether the model aims at another point instead, on the border of the map.
    std::function<bool(const TracePoint& goal)> is_clamped;
};

/// Of one of all goals, counted from 0, before the model is given it.
using BeforeGoal = std::function<Status(std::size_t goal)>;

struct TraceUpdate {
    TracePoint proxy; // to the digit the goal, where free
    ContactState state;
    double ns = 0.0;
};

/// Runs the model over some of the goals; the first of its first ones places it. Adds to `updates`,
/// which has one for each goal before. What `before_goal` says.
Status trace(ContactModel& model,
             const TraceFrame& frame,
             std::span<const TracePoint> goals,
             const BeforeGoal& before_goal,
             std::vector<TraceUpdate>& updates);

/// The trace as CSV, with a column `ns` if asked for.
enum class TraceTiming { No, Yes };
std::string asCsv(const std::vector<TraceUpdate>& updates, TraceTiming timing);

/// Counts, totals and means of the counters, and times.
nlohmann::ordered_json traceSummary(const std::vector<TraceUpdate>& updates);

} // namespace marsview
