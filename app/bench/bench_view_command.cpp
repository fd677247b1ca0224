// marsview-cli bench view: speed and accuracy of the window's pictures.

#include "app/bench/bench_commands.h"
#include "app/bench/view_bench.h"
#include "app/console/machine.h"
#include "app/console/number_checks.h"
#include "app/console/quantile.h"
#include "app/console/scene_option.h"
#include "app/console/text_output.h"
#include "core/session/sample_map.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace marsview {
namespace {

using Json = nlohmann::ordered_json;

// Number of columns for the error threshold over time in the text table.
constexpr std::size_t kCourseColumns = 12;

struct BenchViewOptions {
    std::vector<std::string> paths;
    MapOptions map;
    std::string size = "1280x800";
    double target_ms = 33.0;
    ViewBenchOptions bench;
    bool is_json = false;

    bool isOnBody() const { return bench.scene == SceneKind::Body; }
};

double megabytes(std::size_t bytes)
{
    return static_cast<double>(bytes) / 1e6;
}

// Summary of the frames of a flight.
struct FrameSummary {
    double median_ms = 0.0;
    double p95_ms = 0.0;
    double max_ms = 0.0;
    double processor_mean_ms = 0.0;
    double triangles_median = 0.0;
    double error_median_px = 0.0;
    double error_max_px = 0.0;
    double scale_min = 1.0;
    std::size_t plan_changes = 0;
    std::size_t incomplete_count = 0;
};

FrameSummary summaryOf(const std::vector<FlownFrame>& frames)
{
    std::vector<double> wall_ms;
    std::vector<double> triangles;
    std::vector<double> errors_px;
    FrameSummary summary;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const FlownFrame& frame = frames[i];
        wall_ms.push_back(frame.wall.count());
        triangles.push_back(static_cast<double>(frame.triangle_count));
        errors_px.push_back(frame.plan.error_px);
        summary.processor_mean_ms += frame.processor.count() / static_cast<double>(frames.size());
        summary.scale_min = std::min(summary.scale_min, frame.plan.scale);
        summary.incomplete_count += frame.is_complete ? 0U : 1U;
        summary.plan_changes += i > 0 && frame.plan != frames[i - 1].plan ? 1U : 0U;
    }
    summary.median_ms = quantile(wall_ms, 0.5);
    summary.p95_ms = quantile(wall_ms, 0.95);
    summary.max_ms = quantile(wall_ms, 1.0);
    summary.triangles_median = quantile(triangles, 0.5);
    summary.error_median_px = quantile(errors_px, 0.5);
    summary.error_max_px = quantile(errors_px, 1.0);
    return summary;
}

// Over all frames of all flights.
double medianMilliseconds(const ViewBenchResult& result)
{
    std::vector<double> wall_ms;
    for (const FlightResult& flight : result.flights) {
        for (const FlownFrame& frame : flight.frames) {
            wall_ms.push_back(frame.wall.count());
        }
    }
    return quantile(wall_ms, 0.5);
}

double growth(const ViewBenchResult& result, const ViewBenchResult& first)
{
    return medianMilliseconds(result) / medianMilliseconds(first);
}

Json asJson(const OrbitCamera& camera)
{
    return {{"target_m", {camera.target.x, camera.target.y, camera.target.z}},
            {"distance_m", camera.distance_m},
            {"azimuth_deg", camera.azimuth.degrees()},
            {"tilt_deg", camera.tilt.degrees()}};
}

Json asJson(const RestingPose& pose)
{
    Json difference = nullptr;
    if (pose.difference) {
        difference = {{"full_triangle_count", pose.difference->full_triangle_count},
                      {"mean_color_difference_levels", pose.difference->mean_levels},
                      {"p99_color_difference_levels", pose.difference->p99_levels},
                      {"max_color_difference_levels", pose.difference->max_levels},
                      {"share_visibly_different", pose.difference->share_visible}};
    }
    Json json = {{"camera", asJson(pose.camera)},
                 {"triangle_count", pose.triangle_count},
                 {"error_bound_px", pose.error_bound_px},
                 {"pixel_count", nullptr},
                 {"share_within_threshold", nullptr},
                 {"error_mean_px", nullptr},
                 {"error_p99_px", nullptr},
                 {"error_max_px", nullptr},
                 {"against_every_sample", difference}};
    if (pose.error) {
        json["pixel_count"] = pose.error->pixel_count;
        json["share_within_threshold"] = pose.error->share_within;
        json["error_mean_px"] = pose.error->mean_px;
        json["error_p99_px"] = pose.error->p99_px;
        json["error_max_px"] = pose.error->max_px;
    }
    return json;
}

Json asJson(const FlightResult& flight)
{
    const FrameSummary summary = summaryOf(flight.frames);
    Json frames = Json::array();
    for (const FlownFrame& frame : flight.frames) {
        frames.push_back({{"frame_ms", frame.wall.count()},
                          {"processor_ms", frame.processor.count()},
                          {"triangle_count", frame.triangle_count},
                          {"error_threshold_px", frame.plan.error_px},
                          {"scale", frame.plan.scale},
                          {"is_complete", frame.is_complete}});
    }
    Json poses = Json::array();
    for (const RestingPose& pose : flight.poses) {
        poses.push_back(asJson(pose));
    }
    return {{"name", flightName(flight.flight)},
            {"frame_median_ms", summary.median_ms},
            {"frame_p95_ms", summary.p95_ms},
            {"frame_max_ms", summary.max_ms},
            {"processor_mean_ms", summary.processor_mean_ms},
            {"triangle_count_median", summary.triangles_median},
            {"error_threshold_median_px", summary.error_median_px},
            {"error_threshold_max_px", summary.error_max_px},
            {"scale_min", summary.scale_min},
            {"plan_change_count", summary.plan_changes},
            {"incomplete_frame_count", summary.incomplete_count},
            {"sharp_after_ms", flight.sharp_after.count()},
            {"smooth_after_ms", flight.smooth_after.count()},
            {"sharp_triangle_count", flight.sharp_triangle_count},
            {"frames", frames},
            {"resting_poses", poses}};
}

Json asJson(const ColorError& error)
{
    return {{"pixel_count", error.pixel_count},
            {"mean_levels", error.mean_levels},
            {"p99_levels", error.p99_levels},
            {"max_levels", error.max_levels}};
}

Json asJson(const std::vector<ColorResult>& results)
{
    Json colors = Json::array();
    for (const ColorResult& color : results) {
        Json poses = Json::array();
        for (const ColorPose& pose : color.poses) {
            Json means = asJson(pose.means);
            means["center_p99_levels"] = pose.means.center_p99_levels;
            Json& entry = poses.emplace_back(asJson(pose.centers));
            entry["against_means"] = std::move(means);
        }
        colors.push_back({{"exaggeration", color.exaggeration}, {"poses", poses}});
    }
    return colors;
}

Json asJson(const ViewBenchResult& result, const ViewBenchResult& first, bool is_on_body)
{
    Json flights = Json::array();
    for (const FlightResult& flight : result.flights) {
        flights.push_back(asJson(flight));
    }
    return {{"file", result.path},
            {"columns", result.columns},
            {"rows", result.rows},
            {"triangle_count", result.triangle_count},
            {"exaggeration", result.exaggeration},
            {"first_picture_ms", result.first_picture.count()},
            {"sharp_picture_ms", result.sharp_picture.count()},
            {"peak_memory_loaded_mb", megabytes(result.peak_memory_loaded_bytes)},
            {"peak_memory_flown_mb", megabytes(result.peak_memory_flown_bytes)},
            {"frame_median_ms", medianMilliseconds(result)},
            {"frame_median_against_first_map", growth(result, first)},
            {"colors_at_rest", is_on_body ? Json(nullptr) : asJson(result.colors)},
            {"flights", flights}};
}

void printFigures(const BenchViewOptions& options, const std::vector<ViewBenchResult>& results)
{
    const ViewBenchOptions& bench = options.bench;
    Json maps = Json::array();
    for (const ViewBenchResult& result : results) {
        maps.push_back(asJson(result, results.front(), options.isOnBody()));
    }
    Json json = {{"scene", sceneName(bench.scene)},
                 {"processor", processorName()},
                 {"core_count", std::thread::hardware_concurrency()},
                 {"graphics_driver", results.front().driver},
                 {"width_px", bench.viewport.width},
                 {"height_px", bench.viewport.height},
                 {"target_ms", options.target_ms},
                 {"frame_count", bench.frame_count},
                 {"error_threshold_at_rest_px", bench.error_px}};
    json["maps"] = std::move(maps);
    printJson(withSchema(json));
}

void printFlights(const ViewBenchResult& result)
{
    printLine(fmt::format("{:<7}{:>8}{:>8}{:>8}{:>8}{:>11}{:>8}{:>8}{:>8}{:>9}{:>10}", "flight",
                          "median", "p95", "max", "cpu", "triangles", "error", "worst", "scale",
                          "sharp", "smooth"));
    printLine(fmt::format("{:<7}{:>8}{:>8}{:>8}{:>8}{:>11}{:>8}{:>8}{:>8}{:>9}{:>10}", "", "ms",
                          "ms", "ms", "ms", "median", "px", "px", "least", "ms", "ms"));
    for (const FlightResult& flight : result.flights) {
        const FrameSummary summary = summaryOf(flight.frames);
        printLine(
            fmt::format("{:<7}{:>8.1f}{:>8.1f}{:>8.1f}{:>8.1f}{:>11.0f}{:>8.1f}{:>8.1f}{:>8.2f}{:>"
                        "9.0f}{:>10.0f}",
                        flightName(flight.flight), summary.median_ms, summary.p95_ms,
                        summary.max_ms, summary.processor_mean_ms, summary.triangles_median,
                        summary.error_median_px, summary.error_max_px, summary.scale_min,
                        flight.sharp_after.count(), flight.smooth_after.count()));
    }
}

// The error threshold over time for each flight.
void printCourses(const ViewBenchResult& result)
{
    printLine("\nerror threshold in px, from start to end of each flight");
    for (const FlightResult& flight : result.flights) {
        std::string line = fmt::format("{:<7}", flightName(flight.flight));
        const std::size_t columns = std::min(kCourseColumns, flight.frames.size());
        for (std::size_t i = 0; i < columns; ++i) {
            line += fmt::format("{:>6.1f}",
                                flight.frames[i * flight.frames.size() / columns].plan.error_px);
        }
        printLine(line);
    }
}

void printPoses(const ViewBenchResult& result, double error_px)
{
    printLine(fmt::format("\nat rest, threshold {} px", asText(error_px)));
    printLine(fmt::format("{:<7}{:>11}{:>11}{:>9}{:>9}{:>9}{:>9}  {}", "flight", "triangles",
                          "within", "mean px", "p99 px", "max px", "bound",
                          "color against every sample"));
    for (const FlightResult& flight : result.flights) {
        for (const RestingPose& pose : flight.poses) {
            const std::string difference =
                pose.difference
                    ? fmt::format("mean {:.2f}, p99 {}, max {} of 255; {:.2f} % visible",
                                  pose.difference->mean_levels, pose.difference->p99_levels,
                                  pose.difference->max_levels,
                                  100.0 * pose.difference->share_visible)
                    : std::string("left out");
            const std::string errors =
                pose.error ? fmt::format("{:>9.3f} %{:>9.3f}{:>9.3f}{:>9.3f}",
                                         100.0 * pose.error->share_within, pose.error->mean_px,
                                         pose.error->p99_px, pose.error->max_px)
                           : fmt::format("{:>11}{:>9}{:>9}{:>9}", "-", "-", "-", "-");
            printLine(fmt::format("{:<7}{:>11}{}{:>9.3f}  {}", flightName(flight.flight),
                                  pose.triangle_count, errors, pose.error_bound_px, difference));
        }
    }
}

// Median and maximum over all poses.
std::string spreadOf(const std::vector<ColorPose>& poses, double (*value)(const ColorPose&))
{
    std::vector<double> values;
    std::transform(poses.begin(), poses.end(), std::back_inserter(values), value);
    return fmt::format("{:>9.1f}{:>9.1f}", quantile(values, 0.5), quantile(values, 1.0));
}

// Over all poses at an exaggeration: medians and maxima.
void printColors(const ViewBenchResult& result)
{
    if (result.colors.empty()) {
        return;
    }
    printLine(
        "\ncolors at rest against those of the surface at full resolution: 99 % are within "
        "so many levels of 255");
    printLine(
        "sharp: against the color at the center of each pixel; smooth: against the mean over "
        "it; center: that color against that mean");
    printLine(fmt::format("{:<13}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}", "exaggeration", "sharp", "",
                          "smooth", "", "center", ""));
    printLine(fmt::format("{:<13}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}", "", "median", "largest", "median",
                          "largest", "median", "largest"));
    for (const ColorResult& colors : result.colors) {
        if (!colors.poses.empty()) {
            const auto spread = [&](double (*value)(const ColorPose&)) {
                return spreadOf(colors.poses, value);
            };
            printLine(fmt::format(
                "{:<13}{}{}{}", asText(colors.exaggeration),
                spread([](const ColorPose& pose) { return pose.centers.p99_levels; }),
                spread([](const ColorPose& pose) { return pose.means.p99_levels; }),
                spread([](const ColorPose& pose) { return pose.means.center_p99_levels; })));
        }
    }
}

void printForPeople(const BenchViewOptions& options, const std::vector<ViewBenchResult>& results)
{
    const ViewBenchOptions& bench = options.bench;
    printLine(fmt::format("{}, {} cores; {}", processorName(), std::thread::hardware_concurrency(),
                          results.front().driver));
    printLine(fmt::format("{} × {} pixels, {} ms/frame, {} frames/flight{}", bench.viewport.width,
                          bench.viewport.height, asText(options.target_ms), bench.frame_count,
                          options.isOnBody() ? ", on the body" : ""));
    for (const ViewBenchResult& result : results) {
        printLine(fmt::format("\n{}", result.path));
        printLine(fmt::format("{} × {} samples, {} triangles, exaggeration {}", result.columns,
                              result.rows, result.triangle_count, asText(result.exaggeration)));
        printLine(fmt::format(
            "first picture after {:.0f} ms, sharp after {:.0f} ms; peak memory {:.0f} MB, {:.0f} "
            "MB "
            "after the flights\n",
            result.first_picture.count(), result.sharp_picture.count(),
            megabytes(result.peak_memory_loaded_bytes), megabytes(result.peak_memory_flown_bytes)));
        printFlights(result);
        printCourses(result);
        printPoses(result, bench.error_px);
        if (options.isOnBody()) {
            printLine("\ncolors at rest against those of the surface at full resolution: -");
        } else {
            printColors(result);
        }
    }
    if (results.size() > 1) {
        printLine("\ngrowth of the median frame against the first map");
        for (const ViewBenchResult& result : results) {
            printLine(fmt::format("{:>12} triangles {:>8.1f} ms {:>6.2f}", result.triangle_count,
                                  medianMilliseconds(result), growth(result, results.front())));
        }
    }
}

Status runBenchView(const BenchViewOptions& given)
{
    BenchViewOptions options = given;
    const Result<Viewport> viewport = viewportFrom(options.size);
    if (!viewport) {
        return viewport.error();
    }
    options.bench.viewport = *viewport;
    options.bench.target = Milliseconds(options.target_ms);
    if (options.paths.empty()) {
        const std::filesystem::path sample = sampleMapFor(programFolder());
        if (sample.empty()) {
            return Error{ErrorCode::NotFound, "DEM: the bundled map is missing; name another"};
        }
        options.paths.push_back(sample.string());
    }
    std::vector<ViewBenchResult> results;
    for (const std::string& path : options.paths) {
        options.map.path = path;
        Result<ViewBenchResult> result = benchView(options.map, options.bench);
        if (!result) {
            return std::move(result).error();
        }
        results.push_back(std::move(result).value());
    }
    if (options.is_json) {
        printFigures(options, results);
    } else {
        printForPeople(options, results);
    }
    std::fflush(stdout); // before the messages about it
    for (const ViewBenchResult& result : results) {
        if (!options.bench.is_full && result.triangle_count > kFullTrianglesMax) {
            std::fprintf(stderr,
                         "marsview-cli: %s: pictures of every sample are skipped above %zu "
                         "triangles; --full draws them\n",
                         asOneLine(result.path).c_str(), kFullTrianglesMax);
        }
    }
    return Done{};
}

} // namespace

void addBenchViewCommand(CLI::App& bench, CommandAction& run)
{
    const auto options = std::make_shared<BenchViewOptions>();
    CLI::App* command = bench.add_subcommand(
        "view", "Fly over maps and measure the time and the error of the window's pictures");
    command
        ->add_option("DEM", options->paths,
                     "elevation maps, by default the bundled one; the times of several are "
                     "compared with the first's")
        ->type_name("FILE")
        ->transform(fileName());
    options->map.addOverridesTo(*command);
    command->add_option("--size", options->size, "width and height in pixels")
        ->type_name("WxH")
        ->capture_default_str()
        ->check(pictureSize());
    command->add_option("--target-ms", options->target_ms, "time for a frame while moving")
        ->capture_default_str()
        ->check(positiveNumber());
    command->add_option("--frames", options->bench.frame_count, "frames per flight")
        ->capture_default_str()
        ->check(wholeNumberFrom(1, 100'000));
    command
        ->add_option("--poses", options->bench.pose_count,
                     "poses per flight at which the error of the picture at rest is measured")
        ->capture_default_str()
        ->check(wholeNumberFrom(0, 1000));
    command
        ->add_option("--error-px", options->bench.error_px,
                     "largest error of the surface at rest, in pixels")
        ->capture_default_str()
        ->check(positiveNumber());
    command
        ->add_option("--exaggeration", options->bench.exaggeration,
                     "vertical exaggeration; default chosen for each map")
        ->check(positiveNumber());
    command
        ->add_option("--color-exaggerations", options->bench.color_exaggerations,
                     "exaggerations at which the colors of pictures at rest are measured")
        ->capture_default_str()
        ->delimiter(',')
        ->check(exaggerationFactor());
    command->add_flag("--full", options->bench.is_full,
                      "compare with pictures of every sample even of large maps");
    addSceneOption(*command, options->bench.scene,
                   "; the errors of pictures at rest and their colors are then left out (null in "
                   "JSON), since only the flat map has a reference for them");
    command->add_flag("--json", options->is_json, "print JSON, with every frame");
    command->callback([options, &run] { run = [options] { return runBenchView(*options); }; });
}

} // namespace marsview
