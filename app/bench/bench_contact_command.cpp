// marsview-cli bench contact: run time against error for every contact model.

#include "app/bench/bench_commands.h"
#include "app/bench/contact_bench.h"
#include "app/bench/reference/fractal_heights.h"
#include "app/bench/svg_plot.h"
#include "app/console/long_job.h"
#include "app/console/machine.h"
#include "app/console/map_options.h"
#include "app/console/number_checks.h"
#include "app/console/output_file.h"
#include "app/console/scene_option.h"
#include "app/console/text_output.h"
#include "core/base/parallel.h"
#include "core/session/open_map.h"
#include "core/terrain/surface_analysis.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace marsview {
namespace {

using Json = nlohmann::ordered_json;

// The step of an int16 fractal, as a fraction of a cell.
constexpr double kFractalStep = 1.0 / 64.0;

// Mean errors below this, in cells, are plotted in the floor band.
constexpr double kPlotFloor = 1e-6;

struct BenchContactOptions {
    MapOptions map;
    std::size_t size = 4096;
    std::uint64_t seed = 20031;
    std::string sample_type = "float32";
    std::vector<std::string> models;
    std::string goals = "both";
    SceneKind scene = SceneKind::Flat;
    ContactBenchOptions bench;
    std::string plot;
    bool is_json = false;

    bool isOnBody() const { return scene == SceneKind::Body; }
};

// The terrain under the hand.
struct Ground {
    std::string name;
    std::shared_ptr<const Map> map; // null: the fractal
    std::shared_ptr<const FilledHeightfield> filled;
    SceneFrame frame;
    std::size_t hierarchy_bytes = 0;

    const SampleGrid& samples() const { return filled->heightfield().samples(); }
    std::size_t triangleCount() const { return 2 * (filled->columns() - 1) * (filled->rows() - 1); }
    double perTriangle(std::size_t bytes) const
    {
        return static_cast<double>(bytes) / static_cast<double>(triangleCount());
    }
};

// The size of the bounds for ray casts: one per block and per node above, one more with voids.
std::size_t hierarchyBytes(const MinMaxPyramid& bounds, bool has_voids)
{
    std::size_t nodes = 0;
    for (std::size_t level = 0; level < bounds.levelCount(); ++level) {
        nodes += bounds.columns(level) * bounds.rows(level);
    }
    return nodes * (sizeof(MinMaxPyramid::Bounds) + (has_voids ? sizeof(float) : 0));
}

template <typename T>
void fillRows(SampleGrid& grid, const FractalHeights& fractal, double gain, JobMonitor& monitor)
{
    constexpr std::size_t kGrain = 64;
    std::atomic<std::size_t> done{0};
    parallelRanges(grid.rows(), kGrain, [&](std::size_t begin, std::size_t end) {
        std::vector<double> heights(grid.columns());
        std::vector<T> samples(grid.columns());
        for (std::size_t row = begin; row < end && !monitor.isCanceled(); ++row) {
            fractal.row(row, heights);
            std::transform(heights.begin(), heights.end(), samples.begin(), [gain](double z) {
                return static_cast<T>(std::is_integral_v<T> ? std::round(z / gain) : z / gain);
            });
            std::memcpy(grid.rowData(row), samples.data(), samples.size() * sizeof(T));
        }
        monitor.report(static_cast<double>(done += end - begin) / static_cast<double>(grid.rows()));
    });
}

Result<Ground> fractalGround(const BenchContactOptions& options, JobMonitor& monitor)
{
    const bool is_int16 = options.sample_type == "int16";
    Result<SampleGrid> grid = SampleGrid::create(is_int16 ? SampleType::Int16 : SampleType::Float32,
                                                 options.size, options.size);
    if (!grid) {
        return Error{grid.error().code, fmt::format("--size: {}", grid.error().message)};
    }
    const FractalHeights fractal(options.size, options.size, options.seed);
    if (is_int16) {
        fillRows<std::int16_t>(*grid, fractal, kFractalStep, monitor);
    } else {
        fillRows<float>(*grid, fractal, 1.0, monitor);
    }
    const SampleStatistics statistics = grid->applyRule({}, 0, options.size);
    const Heightfield heightfield(std::make_shared<const SampleGrid>(std::move(grid).value()),
                                  statistics, {.gain = is_int16 ? kFractalStep : 1.0});
    auto analysis = analyze(heightfield, monitor);
    if (!analysis) {
        return Error{ErrorCode::Canceled, "measuring was canceled"};
    }
    Ground ground;
    ground.name = fmt::format("fractal of {0} × {0} {1} samples, seed {2}", options.size,
                              options.sample_type, options.seed);
    ground.hierarchy_bytes = hierarchyBytes((*analysis)->bounds, false);
    auto filled = FilledHeightfield::build(heightfield, std::move(analysis).value(), monitor);
    if (!filled) {
        return Error{ErrorCode::Canceled, "measuring was canceled"};
    }
    ground.filled = std::make_shared<const FilledHeightfield>(std::move(filled).value());
    const double center = static_cast<double>(options.size - 1) / 2.0;
    ground.frame = {.origin = {center, center}};
    return ground;
}

Result<Ground> mapGround(const BenchContactOptions& options, JobMonitor& monitor)
{
    Result<std::shared_ptr<const Map>> opened =
        openMap(options.map.spec(), defaultMapResources(), monitor, {.is_in_memory = true});
    if (!opened) {
        return std::move(opened).error();
    }
    const std::shared_ptr<const Map> map = std::move(opened).value();
    Ground ground;
    ground.name = options.map.path;
    ground.hierarchy_bytes =
        hierarchyBytes(map->analysis()->bounds, map->heightfield().samples().hasVoids());
    ground.frame = map->georeference().sceneFrame();
    ground.filled = map->filled();
    ground.map = map;
    return ground;
}

Json asJson(const ContactBenchRow& row)
{
    Json json = {{"model", contactModelName(row.model)},
                 {"speed_cells", row.speed},
                 {"height_scale", row.scale},
                 {"goals", row.is_free ? "above" : "below"},
                 {"updates", row.update_count},
                 {"ns_mean", row.ns_mean},
                 {"ns_p50", row.ns_p50},
                 {"ns_p99", row.ns_p99},
                 {"ns_p999", row.ns_p999},
                 {"ns_max", row.ns_max},
                 {"vertices", row.vertices},
                 {"faces", row.faces},
                 {"casts", row.casts},
                 {"cells", row.cells},
                 {"far_edges", row.far_edges},
                 {"far_edge_updates", row.far_edge_updates},
                 {"far_loops", row.far_loops},
                 {"cut_short", row.cut_short},
                 {"contact_updates", row.contact_updates},
                 {"errors", nullptr}};
    if (row.errors) {
        const ContactErrors& errors = *row.errors;
        json["errors"] = {{"within_half_cell", errors.within_half_cell},
                          {"within_1e5_cell", errors.within_1e5_cell},
                          {"position_mean_cells", errors.position_mean},
                          {"position_p99_cells", errors.position_p99},
                          {"position_max_cells", errors.position_max},
                          {"force_mean_deg", errors.force_mean_deg},
                          {"force_p99_deg", errors.force_p99_deg},
                          {"distance_mean_cells", errors.distance_mean},
                          {"lag_cells", errors.lag},
                          {"at_minimum", nullptr}};
        if (errors.at_minimum) {
            json["errors"]["at_minimum"] = *errors.at_minimum;
        }
    }
    return json;
}

void printFigures(const BenchContactOptions& options,
                  const Ground& ground,
                  const ContactBenchResult& result)
{
    Json rows = Json::array();
    for (const ContactBenchRow& row : result.rows) {
        rows.push_back(asJson(row));
    }
    Json terrain = {{"name", ground.name},
                    {"columns", ground.filled->columns()},
                    {"rows", ground.filled->rows()},
                    {"triangle_count", ground.triangleCount()},
                    {"sample_type", sampleTypeName(ground.samples().type())},
                    {"cell_m", result.cell_m},
                    {"sample_bytes_per_triangle", ground.perTriangle(ground.samples().bytes())},
                    {"hierarchy_bytes_per_triangle", ground.perTriangle(ground.hierarchy_bytes)}};
    const Json json = {{"processor", processorName()},
                       {"core_count", std::thread::hardware_concurrency()},
                       {"clock_ns", result.clock_ns},
                       {"terrain", terrain},
                       {"scene", sceneName(options.scene)},
                       {"repeats", options.bench.repeat_count},
                       {"reference_piece_cells", options.bench.piece_cells},
                       {"reference_unfinished", result.unfinished_count},
                       {"virtual_proxy_radius_cells", options.bench.radius_cells},
                       {"rows", rows}};
    printJson(withSchema(json));
}

// A short form of 0.0123: errors span fifteen decades.
std::string asShort(double value)
{
    if (value == 0.0) {
        return "0";
    }
    return value < 1e-3 || value >= 1e4 ? fmt::format("{:.0e}", value)
                                        : fmt::format("{:.3g}", value);
}

void printTimes(const std::vector<const ContactBenchRow*>& rows)
{
    printLine(fmt::format("{:<20}{:>6}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>8}{:>7}{:>7}{:>9}{:>9}",
                          "model", "speed", "mean ns", "p50", "p99", "p99.9", "max", "vertices",
                          "faces", "casts", "cells", "far edge", "loops"));
    for (const ContactBenchRow* row : rows) {
        const double loop_share = row->far_edges > 0.0 ? row->far_loops / row->far_edges : 0.0;
        printLine(fmt::format(
            "{:<20}{:>6}{:>9.0f}{:>9.0f}{:>9.0f}{:>9.0f}{:>9.0f}{:>9.2f}{:>8.2f}{:>7.3f}{:>7.1f}"
            "{:>7.2f} %{:>7.2f} %",
            contactModelName(row->model), fmt::format("{:g}", row->speed), row->ns_mean,
            row->ns_p50, row->ns_p99, row->ns_p999, row->ns_max, row->vertices, row->faces,
            row->casts, row->cells, 100.0 * row->far_edge_updates, 100.0 * loop_share));
    }
}

void printErrors(const std::vector<const ContactBenchRow*>& rows)
{
    printLine(fmt::format("{:<20}{:>6}{:>10}{:>10}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>8}{:>10}",
                          "model", "speed", "< 0.5", "< 1e-5", "mean", "p99", "max", "force °",
                          "p99 °", "distance", "lag", "minimum"));
    for (const ContactBenchRow* row : rows) {
        const ContactErrors& errors = *row->errors;
        printLine(fmt::format(
            "{:<20}{:>6}{:>8.3f} %{:>8.3f} %{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>8}{:>10}",
            contactModelName(row->model), fmt::format("{:g}", row->speed),
            100.0 * errors.within_half_cell, 100.0 * errors.within_1e5_cell,
            asShort(errors.position_mean), asShort(errors.position_p99),
            asShort(errors.position_max), asShort(errors.force_mean_deg),
            asShort(errors.force_p99_deg), asShort(errors.distance_mean), asShort(errors.lag),
            errors.at_minimum ? fmt::format("{:.2f} %", 100.0 * *errors.at_minimum)
                              : std::string("–")));
    }
}

std::vector<const ContactBenchRow*>
rowsOf(const ContactBenchResult& result, double scale, bool is_free)
{
    std::vector<const ContactBenchRow*> rows;
    for (const ContactBenchRow& row : result.rows) {
        if (row.scale == scale && row.is_free == is_free) {
            rows.push_back(&row);
        }
    }
    // Groups the speeds of a model, for readability.
    std::stable_sort(rows.begin(), rows.end(),
                     [](const auto* a, const auto* b) { return a->model < b->model; });
    return rows;
}

void printForPeople(const BenchContactOptions& options,
                    const Ground& ground,
                    const ContactBenchResult& result)
{
    const ContactBenchOptions& bench = options.bench;
    printLine(
        fmt::format("{}, {} cores; reading the clock takes {:.0f} ns, which single updates "
                    "count and the mean does not",
                    processorName(), std::thread::hardware_concurrency(), result.clock_ns));
    printLine(fmt::format(
        "{}{}: {} triangles, {:.4g} bytes of samples and {:.4g} of hierarchy a triangle",
        ground.name, options.isOnBody() ? ", on its body" : "", ground.triangleCount(),
        ground.perTriangle(ground.samples().bytes()), ground.perTriangle(ground.hierarchy_bytes)));
    printLine(fmt::format(
        "a cell is {} m; the ideal's motion is cut into {:.4g} cell; best of {} "
        "runs; virtual-proxy has a radius of {:g} cell",
        asText(result.cell_m), bench.piece_cells, bench.repeat_count, bench.radius_cells));
    for (const bool is_free : {false, true}) {
        for (const double scale : bench.scales) {
            const auto rows = rowsOf(result, scale, is_free);
            if (rows.empty()) {
                continue;
            }
            const auto [least, most] =
                std::minmax_element(rows.begin(), rows.end(), [](const auto* a, const auto* b) {
                    return a->update_count < b->update_count;
                });
            printLine(fmt::format(
                "\nheights × {:g}, goals {} the surface; speeds in cells per update; {} updates "
                "per row",
                scale, is_free ? "above" : "2 to 5 cells below",
                (*least)->update_count == (*most)->update_count
                    ? fmt::format("{}", (*least)->update_count)
                    : fmt::format("{} to {}", (*least)->update_count, (*most)->update_count)));
            printTimes(rows);
            if (!is_free) {
                printLine("\nagainst the ideal, lengths in cells");
                printErrors(rows);
            }
        }
    }
}

Plot plotOf(const BenchContactOptions& options,
            const Ground& ground,
            const ContactBenchResult& result)
{
    Plot plot;
    plot.title = "Contact models: run time against error";
    const auto name =
        ground.map ? std::filesystem::path(ground.name).filename().string() : ground.name;
    plot.note =
        fmt::format("{}{}; {} triangles; {}", name, options.isOnBody() ? ", on its body" : "",
                    ground.triangleCount(), processorName());
    plot.x_label = "mean time per update, µs; speeds in cells per update at the ends of each line";
    plot.y_label = "mean distance from the ideal proxy, cells";
    plot.y_floor = kPlotFloor;
    plot.floor_label = "< 10⁻⁶";
    for (const double scale : options.bench.scales) {
        PlotPanel panel;
        panel.title = fmt::format("heights × {:g}", scale);
        for (const ContactModelKind kind : options.bench.models) {
            PlotSeries series;
            series.name = contactModelName(kind);
            for (const ContactBenchRow* row : rowsOf(result, scale, false)) {
                if (row->model == kind) {
                    series.points.push_back({row->ns_mean / 1000.0, row->errors->position_mean});
                    series.last_label = fmt::format("{:g}", row->speed);
                    series.first_label =
                        series.first_label.empty() ? series.last_label : series.first_label;
                }
            }
            panel.series.push_back(std::move(series));
        }
        plot.panels.push_back(std::move(panel));
    }
    return plot;
}

Status runBenchContact(const BenchContactOptions& given)
{
    BenchContactOptions options = given;
    if (!options.models.empty()) {
        options.bench.models.clear();
        for (const ContactModelKind kind : kContactModelKinds) {
            if (std::find(options.models.begin(), options.models.end(), contactModelName(kind)) !=
                options.models.end()) {
                options.bench.models.push_back(kind);
            }
        }
    }
    options.bench.has_contact = options.goals != "above";
    options.bench.has_free = options.goals != "below";
    for (std::vector<double>* const values : {&options.bench.speeds, &options.bench.scales}) {
        std::sort(values->begin(), values->end());
        values->erase(std::unique(values->begin(), values->end()), values->end());
    }
    if (options.isOnBody() && options.map.path.empty()) {
        return Error{ErrorCode::Invalid, "--scene: the fractal has no body; name a map"};
    }
    Ground ground;
    {
        LongJob job(options.map.path.empty() ? "making a fractal" : "reading");
        Result<Ground> made = options.map.path.empty() ? fractalGround(options, job.monitor())
                                                       : mapGround(options, job.monitor());
        if (!made) {
            return std::move(made).error();
        }
        ground = std::move(made).value();
    }
    std::optional<ContactBenchResult> result;
    {
        LongJob job("measuring");
        const BenchSurfaceMaker surfaces =
            options.isOnBody()
                ? bodyBenchSurfaces(ground.filled, ground.map->georeference(), job.monitor())
                : flatBenchSurfaces(ground.filled, ground.frame);
        Result<ContactBenchResult> measured = benchContact(surfaces, options.bench, job.monitor());
        if (!measured) {
            return Error{measured.error().code,
                         fmt::format("{}: {}", ground.name, measured.error().message)};
        }
        result = std::move(measured).value();
    }
    if (options.is_json) {
        printFigures(options, ground, *result);
    } else {
        printForPeople(options, ground, *result);
    }
    if (!options.plot.empty()) {
        if (Status written = writeOutputFile(options.plot, asSvg(plotOf(options, ground, *result)));
            !written) {
            return written;
        }
    }
    std::fflush(stdout); // before messages on stderr
    if (ground.map) {
        printNotices(ground.map->info());
    }
    if (result->unfinished_count != 0) {
        std::fprintf(stderr, "marsview-cli: %s: the ideal was not found in %llu pieces\n",
                     asOneLine(ground.name).c_str(),
                     static_cast<unsigned long long>(result->unfinished_count));
    }
    return Done{};
}

} // namespace

void addBenchContactCommand(CLI::App& bench, CommandAction& run)
{
    const auto options = std::make_shared<BenchContactOptions>();
    CLI::App* command = bench.add_subcommand(
        "contact", "Move a hand over a map and measure run time and error of contact models");
    command->footer(
        "Errors are measured against the ideal: the proxy that follows the goal's motion cut into\n"
        "1/128 cell, found by a slow method that shares no code with the models. With --scene "
        "body\n"
        "the ideal is the surface walk over these pieces.\n"
        "The hand is put down on the surface in many places, and presses 2 to 5 cells into it.\n"
        "A cell is the mean of its two sides. The mean is of a whole run without reading a clock;\n"
        "p50 to max are of single updates, each with its shortest time over all "
        "repeats.\n"
        "far edge: share of updates with a far-edge crossing; loops: how many of the crossings "
        "the\n"
        "list ended. Errors: share of proxies within 0.5 and 1e-5 cell of the ideal, distance "
        "from\n"
        "it, angle between the forces, difference of the distances to the goal. lag: how far the\n"
        "proxy still moves if the goal stops, tested at every 32nd update. minimum: share of\n"
        "updates after which no path over or off the surface leads closer to the goal.");
    command->add_option("DEM", options->map.path, "elevation map; without one, a fractal")
        ->type_name("FILE")
        ->transform(fileName());
    options->map.addOverridesTo(*command);
    addSceneOption(*command, options->scene);
    command->add_option("--size", options->size, "columns and rows of the fractal")
        ->capture_default_str()
        ->check(wholeNumberFrom(16, 65536));
    command->add_option("--seed", options->seed, "of the fractal")
        ->capture_default_str()
        ->check(wholeNumberFrom(0, std::numeric_limits<std::uint64_t>::max()));
    command->add_option("--sample-type", options->sample_type, "of the fractal")
        ->capture_default_str()
        ->check(oneOf({"float32", "int16"}));
    std::vector<std::string> names;
    for (const ContactModelKind kind : kContactModelKinds) {
        names.emplace_back(contactModelName(kind));
    }
    command->add_option("--models", options->models, "separated by commas; default all")
        ->delimiter(',')
        ->check(oneOf(names));
    command->add_option("--speeds", options->bench.speeds, "of the goal, cells per update")
        ->delimiter(',')
        ->capture_default_str()
        ->check(positiveNumber());
    command->add_option("--scales", options->bench.scales, "vertical scale factors")
        ->delimiter(',')
        ->capture_default_str()
        ->check(positiveNumber());
    command->add_option("--goals", options->goals, "below the surface, above it, or both")
        ->capture_default_str()
        ->check(oneOf({"below", "above", "both"}));
    command->add_option("--updates", options->bench.update_count, "of each row")
        ->capture_default_str()
        ->check(wholeNumberFrom(2, 10'000'000));
    command
        ->add_option("--stroke", options->bench.stroke_count,
                     "updates after which the hand is lifted and put down elsewhere")
        ->capture_default_str()
        ->check(wholeNumberFrom(1, 10'000'000));
    command
        ->add_option("--seconds", options->bench.seconds_max,
                     "approximate time for all rows; shortens rows if necessary")
        ->check(positiveNumber());
    command
        ->add_option("--repeat", options->bench.repeat_count,
                     "runs of each row, of which the best counts")
        ->capture_default_str()
        ->check(wholeNumberFrom(1, 1000));
    command->add_option("--radius", options->bench.radius_cells, "of virtual-proxy, cells")
        ->capture_default_str()
        ->check(positiveNumber());
    command->add_option("--piece", options->bench.piece_cells, "of the ideal's motion, cells")
        ->capture_default_str()
        ->check(positiveNumber());
    command->add_option("--plot", options->plot, "SVG file: run time against error")
        ->type_name("FILE")
        ->transform(fileName())
        ->check(fileNameEndingIn({".svg"}));
    command->add_flag("--json", options->is_json, "print JSON");
    command->callback([options, &run] { run = [options] { return runBenchContact(*options); }; });
}

} // namespace marsview
