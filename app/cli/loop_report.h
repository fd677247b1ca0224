// The report of `marsview-cli loop` after a run.
#pragma once

#include "haptics/loop/servo_loop.h"
#include "haptics/terrain/clipmap_streamer.h"

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace marsview {

struct LoopReport {
    std::string file;
    std::string scene = "flat"; // or "body"
    std::string device_uri;
    std::string device_name;
    std::string model;
    double exaggeration = 1.0;
    double rate_hz = 1000.0;
    LoopStatistics statistics;
    RealTimeGrants grants;
    LoopState state;                                                   // the last
    std::array<std::uint64_t, kForceOffReasonCount> force_off_ticks{}; // LoopWatch's
    ForceOffReason last_reason = ForceOffReason::None;
    std::optional<ClipmapStreamerStatistics> streamer{};
    std::optional<std::uint64_t> allocations{}; // empty if allocations are not counted
    std::uint64_t recorded = 0;                 // updates
};

nlohmann::ordered_json asJson(const LoopReport& report);
std::string asText(const LoopReport& report);

} // namespace marsview
