// marsview-cli loop: runs the real servo thread on a device and reports its timing.

#include "app/bench/followed_body_view.h"
#include "app/bench/followed_view.h"
#include "app/cli/commands.h"
#include "app/cli/loop_map.h"
#include "app/cli/loop_outcome.h"
#include "app/cli/loop_report.h"
#include "app/cli/replay_notice.h"
#include "app/console/flight_plot.h"
#include "app/console/long_job.h"
#include "app/console/number_checks.h"
#include "app/console/output_file.h"
#include "app/console/scene_option.h"
#include "app/console/text_output.h"
#include "core/base/nearest_word.h"
#include "core/files/file_address.h"
#include "core/sources/output_check.h"
#include "haptics/device/device_registry.h"
#include "haptics/drivers/built_in_drivers.h"
#include "haptics/drivers/record_driver.h"
#include "haptics/drivers/replay_driver.h"
#include "haptics/interaction/body_frame.h"
#include "haptics/loop/rt_scope.h"
#include "haptics/trace/session_recorder.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace marsview {
namespace {

struct LoopOptions {
    MapOptions map;
    std::string device;
    LoopMapOptions loop;
    std::string model{contactModelName(kContactModelDefault)};
    double seconds = 10.0;
    std::optional<double> across_cells;
    double stiffness_n_per_m = 300.0;
    double lead_us = 100.0;
    std::string record;
    std::string flight;
    std::string plot;
    bool is_json = false;
};

// If the program is killed while it uses a plugin's device, the next start blames the plugin. So
// from before the device is opened until it is closed, termination signals only end the loop.
// Ignored signals, as under nohup, stay ignored.
class OrderlyEnd {
public:
    OrderlyEnd()
    {
        is_asked_ = 0;
        takeSignals();
    }
    ~OrderlyEnd()
    {
        setAll(SIG_DFL);
        std::signal(SIGPIPE, broken_pipe_);
    }
    OrderlyEnd(const OrderlyEnd&) = delete;
    OrderlyEnd& operator=(const OrderlyEnd&) = delete;

    /// Call it again after other code may have replaced some of the handlers.
    void takeSignals()
    {
        setAll([](int) { is_asked_ = 1; });
    }
    bool isAskedFor() const { return is_asked_ != 0; }

private:
    static void setAll(void (*handler)(int))
    {
        for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
            if (std::signal(number, handler) == SIG_IGN) {
                std::signal(number, SIG_IGN);
            }
        }
    }

    // When a recording goes to a pipe, a closed pipe is an error like a full disk.
    void (*broken_pipe_)(int) = std::signal(SIGPIPE, SIG_IGN);
    static inline volatile std::sig_atomic_t is_asked_ = 0;
};

// The frame in which the workspace covers the whole map, or the middle of it.
WorkspaceFrame
frameFor(const LoopOptions& options, const LoopMap& map, const DeviceCapabilities& device)
{
    const WorkspaceBox reach = reachWithin(device.workspace);
    if (map.mesh) {
        std::optional<double> width_m;
        if (options.across_cells) {
            width_m = *options.across_cells * map.cell_m;
        }
        return frameForBodyMap(map.mesh, map.opened->georeference(), reach, width_m);
    }
    WorkspaceFrame frame = frameForMap(map.box, reach);
    if (options.across_cells) {
        frame.scene_per_meter = *options.across_cells * map.cell_m / (reach.high.x - reach.low.x);
    }
    return frame;
}

// The map as a camera of the view shows it.
FollowedMap followedMap(const LoopMap& map, double exaggeration)
{
    const Georeference& georeference = map.opened->georeference();
    return {.frame = georeference.sceneFrame(),
            .columns = georeference.columns(),
            .rows = georeference.rows(),
            .limits = navigationLimits(map.box, map.cell_m),
            .height_m = [opened = map.opened, exaggeration](double east_m, double north_m) {
                const SceneFrame& frame = opened->georeference().sceneFrame();
                return exaggeration *
                       opened->heightfield().heightNow(frame.toGrid({east_m, north_m, 0.0}));
            }};
}

// The same of a map on its body.
BodyLimits bodyLimitsOf(const LoopMap& map, double exaggeration)
{
    const HeightRange range = map.on_body.range();
    return bodyLimits(*map.grid, range.minimum_m * exaggeration, range.maximum_m * exaggeration);
}

BodyGround bodyGround(const LoopMap& map, double exaggeration)
{
    return [terrain = map.on_body, exaggeration](const GeographicPoint& place) {
        return exaggeration * terrain.height(place);
    };
}

// "replay:file:///a.csv" and "record:file:///a.csv,DEVICE" with the paths of their files.
Result<std::string> withLocalPath(const std::string& uri)
{
    constexpr std::string_view kLoop = "#loop";
    const std::size_t begin = uri.find(':') + 1;
    const std::size_t end = isReplay(uri) ? uri.size() - (uri.ends_with(kLoop) ? kLoop.size() : 0)
                                          : begin + recordedFile(uri).size();
    const Result<std::string> path = localPathOf(uri.substr(begin, end - begin));
    return path ? Result<std::string>(uri.substr(0, begin) + *path + uri.substr(end))
                : Result<std::string>(path.error());
}

// The URI of an available driver, of the form that the driver accepts. Whether the device is there
// is only known once it is opened.
CLI::Validator knownDevice()
{
    return {[](std::string& uri) {
                const DeviceRegistry registry(builtInDrivers());
                const std::vector<std::string> schemes = registry.schemes();
                const std::size_t colon = uri.find(':');
                const std::string scheme = uri.substr(0, colon);
                const bool is_known =
                    std::find(schemes.begin(), schemes.end(), scheme) != schemes.end();
                if (is_known && colon != std::string::npos) {
                    if (const Status checked = registry.check(uri); !checked) {
                        return checked.error().message;
                    }
                    Result<std::string> local = withLocalPath(uri);
                    if (!local) {
                        return local.error().message;
                    }
                    uri = std::move(local).value();
                    return std::string();
                }
                return is_known ? fmt::format("\"{}\" has no colon; write \"{}:\"", uri, uri)
                                : fmt::format(
                                      "unknown device \"{}\"; a device is written "
                                      "SCHEME:ADDRESS, where SCHEME is one of {}{}",
                                      uri, fmt::join(schemes, ", "), didYouMean(scheme, schemes));
            },
            ""};
}

// A simulated hand that swipes counts in cells; their width in its workspace follows from the
// frame.
Result<std::unique_ptr<HapticDevice>>
openDevice(DeviceRegistry& registry, const LoopOptions& options, const LoopMap& map)
{
    const std::string uri =
        map.mesh && isReplay(options.device) ? replayOnBody(options.device) : options.device;
    const bool is_swipe = uri.starts_with("sim:") && uri.find("swipe=") != std::string::npos &&
                          uri.find("cell_m=") == std::string::npos;
    if (!is_swipe) {
        return registry.open(uri);
    }
    const Result<std::unique_ptr<HapticDevice>> plain = registry.open("sim:");
    if (!plain) {
        return plain.error();
    }
    const WorkspaceFrame frame = frameFor(options, map, (*plain)->capabilities());
    return registry.open(fmt::format("{},cell_m={}", uri, map.cell_m / frame.scene_per_meter));
}

// Saturates: a very long time gives the largest number of ticks that can be counted.
std::uint64_t ticksWithin(double seconds, double rate_hz)
{
    constexpr double kTicksMax = 9e15; // whole numbers, also in doubles
    return static_cast<std::uint64_t>(std::min(std::ceil(seconds * rate_hz), kTicksMax));
}

// A device that is too slow for its rate does not make the loop last much longer.
LoopWatch::Clock::time_point watchedUntil(double seconds)
{
    constexpr double kSecondsMax = 1e9;
    const double patient_s = std::min(seconds + std::max(1.0, 0.02 * seconds), kSecondsMax);
    return LoopWatch::Clock::now() + std::chrono::duration_cast<LoopWatch::Clock::duration>(
                                         std::chrono::duration<double>(patient_s));
}

Status runLoop(const LoopOptions& options)
{
    FilesInUse files{
        .maps = options.loop.pile.withPath(options.map.path),
        .read = {},
        .written = {options.record, options.flight, options.plot, recordedFile(options.device)}};
    if (isReplay(options.device)) {
        files.read.push_back(replayedFile(options.device));
    }
    const Result<OpenFiles> inputs = checkOutputs(files);
    if (!inputs) {
        return inputs.error();
    }
    std::optional<LoopMap> map;
    {
        LongJob job("reading");
        Result<LoopMap> opened = openLoopMap(options.map, options.loop, job.monitor());
        if (!opened) {
            return std::move(opened).error();
        }
        map = std::move(opened).value();
    }
    OrderlyEnd end;
    DeviceRegistry registry(builtInDrivers());
    Result<std::unique_ptr<HapticDevice>> device = openDevice(registry, options, *map);
    if (!device) {
        return std::move(device).error();
    }

    const Result<std::string> replay_notice = replayNotice(options.device, *map);
    if (!replay_notice) {
        return replay_notice.error();
    }

    const double rate_hz = (*device)->capabilities().rate_hz;
    ServoLoopOptions loop_options;
    loop_options.ticks_max =
        loop_options.thread.uncounted_turns + ticksWithin(options.seconds, rate_hz);
    loop_options.thread.lead =
        std::chrono::nanoseconds(static_cast<std::int64_t>(options.lead_us * 1e3));
    ServoLoop loop(std::move(device).value(), loop_options);
    const GoalColumns goals = map->mesh ? GoalColumns::Geographic : GoalColumns::Map;
    std::unique_ptr<SessionRecorder> recorder;
    if (!options.record.empty()) {
        Result<std::unique_ptr<SessionRecorder>> begun =
            SessionRecorder::begin(loop, options.record, 0, goals);
        if (!begun) {
            return std::move(begun).error();
        }
        recorder = std::move(begun).value();
    }
    const std::uint64_t allocations_before = RtScope::allocationCount();
    LoopWatch watch(loop_options.ticks_max, LoopWatch::Clock::now());
    {
        LongJob job("running");
        end.takeSignals();
        LoopSettings settings;
        settings.map = map->map;
        settings.stiffness_n_per_m = options.stiffness_n_per_m;
        const WorkspaceBox reach = reachWithin(loop.device().workspace);
        const WorkspaceFrame frame = frameFor(options, *map, loop.device());
        std::optional<FollowedView> view; // in the plane, or else:
        std::optional<FollowedBodyView> body_view;
        if (map->grid) {
            body_view.emplace(reach, bodyLimitsOf(*map, options.loop.exaggeration),
                              bodyGround(*map, options.loop.exaggeration));
            body_view->beginAt(frame, settings);
        } else {
            view.emplace(reach);
            view->setMap(followedMap(*map, options.loop.exaggeration));
            view->beginAt(frame, settings);
        }
        loop.set(settings);
        const auto follow = [&](const LoopState& state) {
            return view ? view->follow(state.seen_frame, state.frame_number, state.mode, settings)
                        : body_view->follow(state.seen_frame, state.frame_number, state.mode,
                                            settings);
        };
        constexpr std::chrono::milliseconds kLook{16};
        const LoopWatch::Clock::time_point give_up = watchedUntil(options.seconds);
        while (!loop.hasEnded() && !end.isAskedFor() && !watch.isSilent() &&
               LoopWatch::Clock::now() < give_up) {
            std::this_thread::sleep_for(kLook);
            const LoopState state = loop.state();
            if (!isReplay(options.device) && follow(state)) {
                loop.set(settings);
            }
            watch.look(loop, LoopWatch::Clock::now());
            job.monitor().report(std::min(1.0, static_cast<double>(loop.state().tick) /
                                                   static_cast<double>(loop_options.ticks_max)));
        }
        watch.look(loop, LoopWatch::Clock::now());
        loop.stop();
    }
    end.takeSignals();
    if (end.isAskedFor() && loop.state().tick == 0) {
        return Error{ErrorCode::Canceled, options.device + ": interrupted before the loop began"};
    }
    const Status verdict = watch.verdict(options.device);
    LoopReport report{.file = options.map.path,
                      .scene = sceneName(options.loop.scene),
                      .device_uri = options.device,
                      .device_name = loop.device().name,
                      .model = options.model,
                      .exaggeration = options.loop.exaggeration,
                      .rate_hz = rate_hz,
                      .statistics = loop.statistics(),
                      .grants = loop.grants(),
                      .state = loop.state(),
                      .force_off_ticks = watch.forceOffTicks(),
                      .last_reason = watch.lastReason()};
#ifdef MARSVIEW_COUNTS_ALLOCATIONS
    report.allocations = RtScope::allocationCount() - allocations_before;
#else
    (void)allocations_before;
#endif
    if (map->touch) {
        report.streamer = map->touch->statistics();
    }
    const Status recorded = recorder ? recorder->finish() : Done{};
    if (recorder) {
        report.recorded = recorder->updates();
    }
    if (!options.flight.empty()) {
        if (Status written = saveFlight(loop.flight(), options.flight); !written) {
            return written;
        }
    }
    if (!options.plot.empty()) {
        const std::string title =
            fmt::format("{} on {}, {}", options.device, options.map.path, options.model);
        const Status written =
            writeOutputFile(options.plot, flightPlot(loop.flight().records(), title));
        if (!written) {
            return written;
        }
    }
    if (options.is_json) {
        printJson(withSchema(asJson(report)));
    } else {
        const std::string text = asText(report);
        std::fwrite(text.data(), 1, text.size(), stdout);
    }
    printNotices(map->opened->info());
    if (!replay_notice->empty()) {
        std::fprintf(stderr, "marsview-cli: %s\n", asOneLine(*replay_notice).c_str());
    }
    return verdict ? recorded : verdict;
}

} // namespace

void addLoopCommand(CLI::App& app, CommandAction& run)
{
    const auto options = std::make_shared<LoopOptions>();
    CLI::App* command = app.add_subcommand(
        "loop", "Run the servo loop on a device and print how long its updates took");
    options->map.addTo(*command);
    command
        ->add_option("--device", options->device,
                     "its URI: null:, sim:swipe=10,delay_ms=1, replay:GOALS.csv, …")
        ->type_name("URI")
        ->required()
        ->transform(knownDevice());
    command->add_option("--seconds", options->seconds, "how long, unless the device ends first")
        ->capture_default_str()
        ->check(positiveNumber());
    std::vector<std::string> names;
    for (const ContactModelKind kind : kContactModelKinds) {
        names.emplace_back(contactModelName(kind));
    }
    addSceneOption(*command, options->loop.scene,
                   ", which is touched as a ball; recordings are then in longitude, latitude and "
                   "elevation");
    options->loop.pile.addTo(*command);
    command->add_option("--model", options->model, "contact model")
        ->capture_default_str()
        ->check(oneOf(names));
    command
        ->add_option("--radius", options->loop.radius_m,
                     "radius of the virtual-proxy sphere, scene meters; default half a cell")
        ->check(positiveNumber());
    command->add_option("--exaggeration", options->loop.exaggeration, "vertical exaggeration")
        ->capture_default_str()
        ->check(exaggerationFactor());
    command
        ->add_option("--across", options->across_cells,
                     "width of the workspace in cells, around the map's center; default the whole "
                     "map")
        ->check(positiveNumber());
    command
        ->add_option("--stiffness", options->stiffness_n_per_m,
                     "surface stiffness in N/m; limited to the device's stable stiffness")
        ->capture_default_str()
        ->check(positiveNumber());
    command
        ->add_option("--lead", options->lead_us,
                     "microseconds before each update at which the loop loads what it needs into "
                     "the processor's caches; 0: not at all")
        ->capture_default_str()
        ->check(numberFrom(0.0, 900.0));
    command
        ->add_option("--record", options->record,
                     "CSV file for the recording; trace --goals and replay: read it")
        ->type_name("FILE")
        ->transform(fileName());
    command
        ->add_option("--flight", options->flight,
                     "CSV file for the last ten seconds of the flight recorder")
        ->type_name("FILE")
        ->transform(fileName());
    command
        ->add_option("--plot", options->plot,
                     "SVG file for a plot of the same seconds: force, height of the hand and of "
                     "the surface below it")
        ->type_name("FILE")
        ->transform(fileName());
    command->add_flag("--json", options->is_json, "print JSON");
    command->callback([options, &run] {
        options->loop.pile.check(options->loop.scene);
        options->loop.kind = contactModelKind(options->model).value_or(kContactModelDefault);
        run = [options] { return runLoop(*options); };
    });
}

} // namespace marsview
