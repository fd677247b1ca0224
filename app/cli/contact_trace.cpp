#include "app/cli/contact_trace.h"

#include "app/console/quantile.h"
#include "core/base/plain_number.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string_view>

namespace marsview {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view kColumns =
    "contact,feature,vertices,faces,casts,cells,far_edges,far_loops";

const char* featureName(ContactFeature feature)
{
    switch (feature) {
    case ContactFeature::Free:
        return "free";
    case ContactFeature::Vertex:
        return "vertex";
    case ContactFeature::Edge:
        return "edge";
    case ContactFeature::Face:
        return "face";
    }
    MARSVIEW_CHECK(false);
}

struct CounterColumn {
    const char* name;
    std::uint32_t ContactCounters::*counter;
};

constexpr std::array kCounters{
    CounterColumn{"vertices", &ContactCounters::vertices},
    CounterColumn{"faces", &ContactCounters::faces},
    CounterColumn{"casts", &ContactCounters::casts},
    CounterColumn{"cells", &ContactCounters::cells},
    CounterColumn{"far_edges", &ContactCounters::far_edges},
    CounterColumn{"far_loops", &ContactCounters::far_loops},
};

} // namespace

Status trace(ContactModel& model,
             const TraceFrame& frame,
             std::span<const TracePoint> goals,
             const BeforeGoal& before_goal,
             std::vector<TraceUpdate>& updates)
{
    for (const TracePoint& goal : goals) {
        if (Status ready = before_goal(updates.size()); !ready) {
            return ready;
        }
        const ScenePoint aim = frame.to_scene(goal);
        TraceUpdate update;
        const Clock::time_point begin = Clock::now();
        update.state = model.update(aim);
        update.ns = std::chrono::duration<double, std::nano>(Clock::now() - begin).count();
        if (update.state.counters.refused != 0 && !updates.empty()) {
            update.proxy = updates.back().proxy;
        } else if (update.state.counters.refused == 0 && !update.state.is_in_contact &&
                   !frame.is_clamped(goal)) {
            update.proxy = goal;
        } else {
            update.proxy = frame.from_scene(update.state);
        }
        updates.push_back(update);
    }
    return Done{};
}

std::string asCsv(const std::vector<TraceUpdate>& updates, GoalColumns columns, TraceTiming timing)
{
    const bool has_ns = timing == TraceTiming::Yes;
    std::string text = columns == GoalColumns::Map ? "x,y,z," : "lon,lat,z,";
    text += kColumns;
    text += has_ns ? ",ns\n" : "\n";
    for (const TraceUpdate& update : updates) {
        text += fmt::format("{},{},{},{},{}", asText(update.proxy.x), asText(update.proxy.y),
                            asText(update.proxy.z), update.state.is_in_contact ? 1 : 0,
                            featureName(update.state.feature));
        for (const CounterColumn& column : kCounters) {
            text += fmt::format(",{}", update.state.counters.*column.counter);
        }
        if (has_ns) {
            text += fmt::format(",{:.0f}", update.ns);
        }
        text += '\n';
    }
    return text;
}

nlohmann::ordered_json traceSummary(const std::vector<TraceUpdate>& updates)
{
    std::size_t contacts = 0;
    std::size_t refused = 0;
    std::size_t cut_short = 0;
    double ns_sum = 0.0;
    std::vector<double> ns;
    for (const TraceUpdate& update : updates) {
        contacts += update.state.is_in_contact ? 1U : 0U;
        refused += update.state.counters.refused;
        cut_short += update.state.counters.cut_short;
        ns_sum += update.ns;
        ns.push_back(update.ns);
    }
    const double count = static_cast<double>(std::max<std::size_t>(updates.size(), 1));
    nlohmann::ordered_json totals;
    nlohmann::ordered_json means;
    for (const CounterColumn& column : kCounters) {
        std::uint64_t total = 0;
        for (const TraceUpdate& update : updates) {
            total += update.state.counters.*column.counter;
        }
        totals[column.name] = total;
        means[column.name] = static_cast<double>(total) / count;
    }
    return {{"updates", updates.size()},
            {"contact_updates", contacts},
            {"refused_updates", refused},
            {"cut_short_updates", cut_short},
            {"totals", totals},
            {"means", means},
            {"ns",
             {{"mean", ns_sum / count},
              {"p50", quantile(ns, 0.5)},
              {"p99", quantile(ns, 0.99)},
              {"p999", quantile(ns, 0.999)},
              {"max", quantile(ns, 1.0)}}}};
}

} // namespace marsview
