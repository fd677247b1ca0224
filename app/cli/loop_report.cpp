#include "app/cli/loop_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>

namespace marsview {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kQuantiles{0.5, 0.99, 0.999};

double microseconds(TimeHistogram::Span span)
{
    return static_cast<double>(span.count()) * 1e-3;
}

Json timesOf(const TimeHistogram& times)
{
    return {{"count", times.count()},
            {"mean", times.meanNanoseconds()},
            {"p50", times.quantile(0.5).count()},
            {"p99", times.quantile(0.99).count()},
            {"p999", times.quantile(0.999).count()},
            {"max", times.maximum().count()}};
}

// Counts the durations in bins of powers of two.
std::map<int, std::uint64_t> doublings(const TimeHistogram& times)
{
    std::map<int, std::uint64_t> counts;
    times.visit([&counts](TimeHistogram::Span end, std::uint64_t count) {
        const double us = std::max(microseconds(end), 1e-3);
        counts[static_cast<int>(std::ceil(std::log2(us) - 1e-9))] += count;
    });
    return counts;
}

std::string bar(std::uint64_t count, std::uint64_t most)
{
    constexpr double kWidth = 40.0;
    const double share = static_cast<double>(count) / static_cast<double>(most);
    return std::string(static_cast<std::size_t>(std::ceil(kWidth * share)), '#');
}

std::string quantileLine(const char* name, const TimeHistogram& times)
{
    std::string line = fmt::format("{:<12}", name);
    for (const double q : kQuantiles) {
        line += fmt::format("  p{:<4g} {:>8.2f}", 100.0 * q, microseconds(times.quantile(q)));
    }
    return line + fmt::format("  max {:>9.2f} us\n", microseconds(times.maximum()));
}

std::string histogramOf(const TimeHistogram& times)
{
    const auto counts = doublings(times);
    std::uint64_t most = 1;
    for (const auto& [exponent, count] : counts) {
        most = std::max(most, count);
    }
    std::string text;
    for (const auto& [exponent, count] : counts) {
        text += fmt::format("  up to {:>9.3f} us {:>10}  {}\n", std::exp2(exponent), count,
                            bar(count, most));
    }
    return text;
}

// Why and for how long the force was off, with the last reason at the end.
std::string forceOffLine(const LoopReport& report)
{
    std::string text;
    for (std::size_t i = 0; i < report.force_off_ticks.size(); ++i) {
        if (report.force_off_ticks[i] > 0) {
            text += fmt::format("{}{} {:.3f} s", text.empty() ? "" : ", ",
                                forceOffReasonName(static_cast<ForceOffReason>(i)),
                                static_cast<double>(report.force_off_ticks[i]) / report.rate_hz);
        }
    }
    if (report.last_reason == ForceOffReason::None) {
        return fmt::format("force off: {}\n", text.empty() ? "never" : text);
    }
    return fmt::format("force off: {}; last reason: {}\n", text,
                       forceOffReasonName(report.last_reason));
}

Json reasonOrTrue(const std::string& refusal)
{
    return refusal.empty() ? Json(true) : Json(refusal);
}

} // namespace

Json asJson(const LoopReport& report)
{
    const LoopStatistics& s = report.statistics;
    const LoopCounts& c = report.state.counts;
    Json json = {{"file", report.file},
                 {"scene", report.scene},
                 {"device", report.device_uri},
                 {"device_name", report.device_name},
                 {"model", report.model},
                 {"exaggeration", report.exaggeration},
                 {"rate_hz", report.rate_hz},
                 {"ticks", c.ticks},
                 {"update_ns", timesOf(s.tick)},
                 {"lateness_ns", timesOf(s.lateness)},
                 {"missed_by_tick", s.missed_by_tick},
                 {"missed_by_waking", s.missed_by_waking},
                 {"skipped", s.skipped},
                 {"in_contact", c.in_contact},
                 {"cut_short", c.cut_short},
                 {"force_off", c.force_off},
                 {"damped", c.damped},
                 {"device_errors", c.read_errors},
                 {"ticks_with_tile_misses", c.ticks_with_misses},
                 {"samples_missed", c.samples_missed},
                 {"minor_faults", s.minor_faults},
                 {"major_faults", s.major_faults},
                 {"allocations", report.allocations ? Json(*report.allocations) : Json(nullptr)},
                 {"recorded", report.recorded},
                 {"not_recorded", c.not_recorded},
                 {"real_time_scheduling", reasonOrTrue(report.grants.scheduling_refusal)},
                 {"locked_memory", reasonOrTrue(report.grants.locking_refusal)},
                 {"last_reason", forceOffReasonName(report.last_reason)}};
    Json force_off_s = Json::object();
    for (std::size_t i = 0; i < report.force_off_ticks.size(); ++i) {
        if (report.force_off_ticks[i] > 0) {
            force_off_s[std::string(forceOffReasonName(static_cast<ForceOffReason>(i)))] =
                static_cast<double>(report.force_off_ticks[i]) / report.rate_hz;
        }
    }
    json["force_off_s"] = force_off_s;
    Json histogram = Json::array();
    s.tick.visit([&histogram](TimeHistogram::Span end, std::uint64_t count) {
        histogram.push_back({end.count(), count});
    });
    json["update_histogram_ns"] = histogram;
    if (report.streamer) {
        json["tiles"] = {{"windows_published", report.streamer->published},
                         {"tiles_put", report.streamer->tiles_put}};
    }
    return json;
}

std::string asText(const LoopReport& report)
{
    const LoopStatistics& s = report.statistics;
    const LoopCounts& c = report.state.counts;
    std::string text = fmt::format("{} on {}, {}: {} ticks at {:g} Hz\n", report.device_name,
                                   report.file, report.model, c.ticks, report.rate_hz);
    text += quantileLine("update time", s.tick) + histogramOf(s.tick);
    text += quantileLine("lateness", s.lateness);
    text += fmt::format("missed deadlines {} by the tick, {} by late wake-ups; {} turns skipped\n",
                        s.missed_by_tick, s.missed_by_waking, s.skipped);
    text += fmt::format("in contact {}, cut short {}, force off {}, damped {}\n", c.in_contact,
                        c.cut_short, c.force_off, c.damped);
    text += forceOffLine(report);
    text +=
        fmt::format("tile misses in {} ticks, {} samples\n", c.ticks_with_misses, c.samples_missed);
    text += fmt::format("page faults {} minor, {} major; allocations {}\n", s.minor_faults,
                        s.major_faults,
                        report.allocations ? std::to_string(*report.allocations) : "not counted");
    const auto granted = [](const std::string& refusal) {
        return refusal.empty() ? std::string("granted") : refusal;
    };
    text += fmt::format("real-time scheduling: {}\nlocked memory: {}\n",
                        granted(report.grants.scheduling_refusal),
                        granted(report.grants.locking_refusal));
    if (c.not_recorded > 0) {
        text += fmt::format("{} updates could not be recorded\n", c.not_recorded);
    }
    return text;
}

} // namespace marsview
