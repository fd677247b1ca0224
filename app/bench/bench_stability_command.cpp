// marsview-cli bench stability: the largest stiffness at which a simulated hand comes to rest.

#include "app/bench/bench_commands.h"
#include "app/bench/stability_case.h"
#include "app/bench/touch_gestures.h"
#include "app/bench/touch_sessions.h"
#include "app/console/flight_plot.h"
#include "app/console/long_job.h"
#include "app/console/number_checks.h"
#include "app/console/output_file.h"
#include "app/console/text_output.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kDelaysS{0.0, 1e-3, 2e-3, 3e-3};

struct BenchStabilityOptions {
    double most_n_per_m = 4000.0;
    double jitter_ms = 0.2;
    std::uint64_t seed = 1;
    std::uint64_t sessions = 0;
    std::string plots; // a folder
    bool is_json = false;
};

// A way of combining forces; each gets a table.
struct Variant {
    const char* name;
    ForceMixing mixing;
    bool is_passivity_kept;
};

constexpr std::array kVariants{
    Variant{"fade", ForceMixing::Fade, true},
    Variant{"fade, without passivity control", ForceMixing::Fade, false},
    Variant{"naive sum", ForceMixing::NaiveSum, true},
    Variant{"naive sum, without passivity control", ForceMixing::NaiveSum, false},
};

struct Row {
    const Variant* variant;
    ContactModelKind model;
    StabilityScene scene;
    std::array<double, kDelaysS.size()> largest_n_per_m{};
};

std::string cell(double n_per_m, double most)
{
    return n_per_m * 1.1 > most ? fmt::format("≥ {:.0f}", n_per_m) : fmt::format("{:.0f}", n_per_m);
}

// A model's minimum over all measured scenes of a variant.
std::vector<Row> worstOf(const std::vector<Row>& rows, const Variant& variant)
{
    std::vector<Row> worst;
    for (const Row& row : rows) {
        if (row.variant != &variant) {
            continue;
        }
        if (worst.empty() || worst.back().model != row.model) {
            worst.push_back(row);
            continue;
        }
        for (std::size_t d = 0; d < kDelaysS.size(); ++d) {
            worst.back().largest_n_per_m[d] =
                std::min(worst.back().largest_n_per_m[d], row.largest_n_per_m[d]);
        }
    }
    return worst;
}

std::string line(std::string_view name, const Row& row, const BenchStabilityOptions& options)
{
    std::string text = fmt::format("| {} |", name);
    for (const double largest : row.largest_n_per_m) {
        text += fmt::format(" {} |", cell(largest, options.most_n_per_m));
    }
    return text + '\n';
}

constexpr const char* kDelayColumns = " | 0 ms | 1 ms | 2 ms | 3 ms |\n|---|---|---|---|---|\n";

std::string tableOf(const std::vector<Row>& rows, const BenchStabilityOptions& options)
{
    std::string text;
    for (const Variant& variant : kVariants) {
        const bool is_fade = variant.mixing == ForceMixing::Fade;
        text +=
            fmt::format("\n{}{}, the largest stable stiffness in N/m:\n\n| model{}", variant.name,
                        is_fade ? ", the worst of all scenes" : ", wall corner", kDelayColumns);
        for (const Row& row : worstOf(rows, variant)) {
            text += line(contactModelName(row.model), row, options);
        }
        if (!is_fade) {
            continue;
        }
        text += fmt::format("\n| {}, {}{}", contactModelName(kContactModelDefault), variant.name,
                            kDelayColumns);
        for (const Row& row : rows) {
            if (row.variant == &variant && row.model == kContactModelDefault) {
                text += line(stabilitySceneName(row.scene), row, options);
            }
        }
    }
    return text;
}

// Random sessions of a hand, the loop and a camera.
struct Sessions {
    std::uint64_t count = 0;
    std::uint64_t seed = 0;
    std::uint64_t failed = 0;
    std::uint64_t first_failed = 0; // its seed
    TouchSessionResult sum{};

    Status verdict() const
    {
        if (failed == 0) {
            return Done{};
        }
        return Error{ErrorCode::Invalid,
                     fmt::format("{} of {} sessions failed; the first has the seed {}: {}", failed,
                                 count, first_failed, sum.first)};
    }
};

Result<Sessions> measureSessions(std::uint64_t count, std::uint64_t seed)
{
    Sessions sessions{.count = count, .seed = seed};
    LongJob job("touching");
    for (std::uint64_t i = 0; i < count; ++i) {
        job.monitor().report(static_cast<double>(i) / static_cast<double>(count));
        if (job.monitor().isCanceled()) {
            return Error{ErrorCode::Canceled, "measuring was canceled"};
        }
        const TouchSessionResult result = runTouchSession({.seed = seed + i});
        if (result.violationCount() > 0 && ++sessions.failed == 1) {
            sessions.first_failed = seed + i;
        }
        sessions.sum.add(result);
    }
    return sessions;
}

Json asJson(const Sessions& sessions)
{
    const TouchSessionResult& sum = sessions.sum;
    Json json = {{"sessions", sessions.count},
                 {"seed", sessions.seed},
                 {"ticks", sum.ticks},
                 {"contact_ticks", sum.contact_ticks},
                 {"pan_ticks", sum.pan_ticks},
                 {"zoom_ticks", sum.zoom_ticks},
                 {"gliding_ticks", sum.gliding_ticks},
                 {"force_n_max", sum.force_n_max},
                 {"energy_j_max", sum.energy_j_max},
                 {"sink_m_max", sum.sink_m_max},
                 {"failed_sessions", sessions.failed},
                 {"violations", Json::object()}};
    for (std::size_t i = 0; i < kTouchInvariantCount; ++i) {
        json["violations"][touchInvariantName(static_cast<TouchInvariant>(i))] = sum.violations[i];
    }
    return json;
}

std::string asText(const Sessions& sessions)
{
    std::string text;
    const Json json = asJson(sessions);
    for (const auto& [name, value] : json.items()) {
        text += fmt::format("{}: {}\n", name, value.dump());
    }
    return text;
}

Status runSessions(const BenchStabilityOptions& options)
{
    const Result<Sessions> sessions = measureSessions(options.sessions, options.seed);
    if (!sessions) {
        return sessions.error();
    }
    if (options.is_json) {
        printJson(withSchema(asJson(*sessions)));
    } else {
        printLine(asText(*sessions));
    }
    return sessions->verdict();
}

Result<std::vector<Row>> measureScenes(const BenchStabilityOptions& options)
{
    std::vector<Row> rows;
    for (const Variant& variant : kVariants) {
        for (const ContactModelKind model : kContactModelKinds) {
            for (const StabilityScene scene : kStabilityScenes) {
                // The mixing only has an effect at walls.
                if (variant.mixing == ForceMixing::Fade || scene == StabilityScene::WallCorner) {
                    rows.push_back({.variant = &variant, .model = model, .scene = scene});
                }
            }
        }
    }
    LongJob job("measuring");
    for (std::size_t i = 0; i < rows.size(); ++i) {
        job.monitor().report(static_cast<double>(i) / static_cast<double>(rows.size()));
        if (job.monitor().isCanceled()) {
            return Error{ErrorCode::Canceled, "measuring was canceled"};
        }
        Row& row = rows[i];
        for (std::size_t d = 0; d < kDelaysS.size(); ++d) {
            row.largest_n_per_m[d] =
                largestStable(row.scene,
                              {.model = row.model,
                               .delay_s = kDelaysS[d],
                               .jitter_s = options.jitter_ms * 1e-3,
                               .mixing = row.variant->mixing,
                               .is_passivity_kept = row.variant->is_passivity_kept,
                               .seed = options.seed},
                              options.most_n_per_m);
        }
    }
    return rows;
}

Status writeGesturePlots(const std::string& folder)
{
    for (const TouchGesture gesture : kTouchGestures) {
        const std::string path = fmt::format("{}/{}.svg", folder, touchGestureName(gesture));
        Status written = writeOutputFile(
            path, flightPlot(makeGesture(gesture), std::string(touchGestureTitle(gesture))));
        if (!written) {
            return written;
        }
        printLine(path);
    }
    return Done{};
}

Status runBench(const BenchStabilityOptions& options)
{
    if (!options.plots.empty()) {
        return writeGesturePlots(options.plots);
    }
    if (options.sessions > 0) {
        return runSessions(options);
    }
    const Result<std::vector<Row>> rows = measureScenes(options);
    if (!rows) {
        return rows.error();
    }
    constexpr std::uint64_t kSessions = 200;
    const Result<Sessions> sessions = measureSessions(kSessions, options.seed);
    if (!sessions) {
        return sessions.error();
    }
    if (!options.is_json) {
        printLine(tableOf(*rows, options));
        printLine("random sessions with a camera:\n\n" + asText(*sessions));
        return sessions->verdict();
    }
    Json json = {{"stated_n_per_m", kStatedStiffnessNPerM},
                 {"most_n_per_m", options.most_n_per_m},
                 {"jitter_ms", options.jitter_ms},
                 {"seed", options.seed},
                 {"delays_s", kDelaysS}};
    for (const Row& row : *rows) {
        json["rows"].push_back({{"mixing", row.variant->name},
                                {"model", contactModelName(row.model)},
                                {"scene", stabilitySceneName(row.scene)},
                                {"largest_n_per_m", row.largest_n_per_m}});
    }
    json["random_sessions"] = asJson(*sessions);
    printJson(withSchema(json));
    return sessions->verdict();
}

} // namespace

void addBenchStabilityCommand(CLI::App& bench, CommandAction& run)
{
    const auto options = std::make_shared<BenchStabilityOptions>();
    CLI::App* command = bench.add_subcommand(
        "stability", "Press a simulated hand on difficult surfaces at increasing stiffness");
    command->add_option("--most", options->most_n_per_m, "largest stiffness to test, N/m")
        ->capture_default_str()
        ->check(positiveNumber());
    command->add_option("--jitter-ms", options->jitter_ms, "of the loop's period")
        ->capture_default_str()
        ->check(numberFrom(0.0, 0.9));
    command->add_option("--seed", options->seed, "of the jitter")
        ->capture_default_str()
        ->check(wholeNumberFrom(0, std::numeric_limits<std::uint64_t>::max()));
    command
        ->add_option(
            "--sessions", options->sessions,
            "run only so many random sessions with a camera; without it, all scenes and 200")
        ->check(wholeNumberFrom(1, 100'000'000));
    command
        ->add_option("--plots", options->plots,
                     "only make the paper's gestures and plot what the hand feels, as SVG files in "
                     "this folder")
        ->type_name("FOLDER");
    command->add_flag("--json", options->is_json, "print JSON");
    command->callback([options, &run] { run = [options] { return runBench(*options); }; });
}

} // namespace marsview
