// marsview-cli trace: a contact model over a list of goals, without clock or device.

#include "app/cli/commands.h"
#include "app/cli/contact_trace.h"
#include "app/cli/long_job.h"
#include "app/cli/number_checks.h"
#include "app/cli/text_output.h"
#include "app/cli/touch_map.h"
#include "core/contact/resident_heights.h"
#include "core/mesh/mesh_file.h"
#include "core/terrain/waiting_terrain.h"
#include "haptics/trace/goal_file.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace marsview {
namespace {

struct Options {
    MapOptions map;
    std::string goals;
    std::string model{contactModelName(kContactModelDefault)};
    std::optional<double> radius_m;
    double exaggeration = 1.0;
    bool has_timing = false;
    std::string summary;
    std::string output;
};

Status write(const std::string& path, const std::string& text)
{
    std::ofstream file(path, std::ios::binary);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
    if (!file) {
        return Error{ErrorCode::Unreadable, fmt::format("{}: cannot be written", path)};
    }
    return Done{};
}

// Over a map: heights are those of `sample`, x and y are the CRS'.
TraceFrame frameOf(const std::shared_ptr<const Dataset>& dataset, double exaggeration)
{
    const GoalFrame frame({dataset, &dataset->georeference()}, exaggeration);
    return {
        .to_scene = [frame](const TracePoint& goal) { return frame.toScene(goal); },
        .from_scene = [frame](const ContactState& state) { return frame.fromScene(state.proxy); },
        .is_clamped = [frame](const TracePoint& goal) { return frame.isClamped(goal); },
    };
}

// Over a mesh: coordinates are scene metres, but for the exaggeration.
TraceFrame meshFrame(double exaggeration)
{
    return {
        .to_scene = [exaggeration](const TracePoint& goal) -> ScenePoint {
            return {goal.x, goal.y, goal.z * exaggeration};
        },
        .from_scene =
            [exaggeration](const ContactState& state) {
                return TracePoint{state.proxy.x, state.proxy.y, state.proxy.z / exaggeration};
            },
        .is_clamped = [](const TracePoint&) { return false; },
    };
}

bool isMesh(const std::string& path)
{
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending == ".obj" || ending == ".ply" || ending == ".stl";
}

// What is touched: a map or a mesh.
struct Subject {
    std::unique_ptr<ContactModel> model;
    TraceFrame frame;
    double radius_m = 0.0;
    std::shared_ptr<const Dataset> dataset;        // null for a mesh
    std::shared_ptr<const WaitingTerrain> terrain; // of a map in tiles
};

Result<Subject> meshSubject(const Options& options, ContactModelKind kind, JobMonitor& monitor)
{
    if (options.map.hasOverrides()) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: a mesh has no CRS, body, band or unit to be told otherwise",
                                 options.map.path)};
    }
    if (kind == ContactModelKind::VirtualProxy && !options.radius_m) {
        return Error{ErrorCode::Invalid,
                     "--radius: is needed with virtual-proxy over a mesh, which has no cell to be "
                     "half of"};
    }
    Result<TriangleSoup> soup = readTriangles(options.map.path, monitor);
    if (!soup) {
        return std::move(soup).error();
    }
    for (ScenePoint& vertex : soup.value().vertices) {
        vertex.z *= options.exaggeration;
    }
    const auto mesh = TriangleMesh::build(std::move(soup).value(), monitor);
    if (!mesh) {
        return Error{mesh.error().code,
                     fmt::format("{}: {}", options.map.path, mesh.error().message)};
    }
    const double radius_m = options.radius_m.value_or(1.0);
    return Subject{makeContactModel(kind, MeshSurface(mesh.value()), {.radius_m = radius_m}),
                   meshFrame(options.exaggeration), radius_m, nullptr, nullptr};
}

Result<Subject> mapSubject(const Options& options, ContactModelKind kind, JobMonitor& monitor)
{
    Result<TouchMap> map = openTouchMap(options.map, TouchStore::HeldOrTiled, monitor);
    if (!map) {
        return std::move(map).error();
    }
    const auto dataset = map.value().dataset;
    const Georeference& georeference = dataset->georeference();
    const double half_cell_m =
        (georeference.pixelWidthMetres() + georeference.pixelHeightMetres()) / 4.0;
    const double radius_m = options.radius_m.value_or(half_cell_m);
    const SceneFrame frame = georeference.sceneFrame();
    const TraceFrame trace_frame = frameOf(dataset, options.exaggeration);
    if (map->filled) {
        const HeightfieldSurface surface(map->filled, frame, options.exaggeration);
        return Subject{makeContactModel(kind, surface, {.radius_m = radius_m}), trace_frame,
                       radius_m, dataset, nullptr};
    }
    const Heightfield& heightfield = dataset->heightfield();
    const auto terrain = std::make_shared<const WaitingTerrain>(
        heightfield.tiles()->raster(),
        std::make_shared<const TileHeights>(map->levels, heightfield.scale()));
    const TiledHeightfieldSurface surface(terrain, frame, options.exaggeration);
    return Subject{makeContactModel(kind, surface, {.radius_m = radius_m}), trace_frame, radius_m,
                   dataset, terrain};
}

Status runTrace(const Options& options)
{
    const Result<std::string> text = readGoalText(options.goals);
    if (!text) {
        return text.error();
    }
    const Result<std::vector<TracePoint>> goals =
        readGoals(*text, options.goals == "-" ? "--goals" : options.goals);
    if (!goals) {
        return goals.error();
    }
    const ContactModelKind kind = contactModelKind(options.model).value_or(kContactModelDefault);
    std::optional<Subject> subject;
    {
        LongJob job("reading");
        Result<Subject> opened = isMesh(options.map.path)
                                     ? meshSubject(options, kind, job.monitor())
                                     : mapSubject(options, kind, job.monitor());
        if (!opened) {
            return std::move(opened).error();
        }
        subject = std::move(opened).value();
    }
    LongJob job("tracing");
    const auto updates = trace(*subject->model, subject->frame, *goals, job.monitor());
    if (!updates) {
        return Error{updates.error().code,
                     fmt::format("{}: {}", options.map.path, updates.error().message)};
    }
    if (subject->terrain && subject->terrain->error()) {
        return *subject->terrain->error();
    }
    const std::string csv =
        asCsv(*updates, options.has_timing ? TraceTiming::Yes : TraceTiming::No);
    if (options.output.empty()) {
        std::fwrite(csv.data(), 1, csv.size(), stdout);
    } else if (Status written = write(options.output, csv); !written) {
        return written;
    }
    if (!options.summary.empty()) {
        nlohmann::ordered_json summary = {{"file", options.map.path},
                                          {"model", options.model},
                                          {"radius_m", nullptr},
                                          {"exaggeration", options.exaggeration}};
        if (kind == ContactModelKind::VirtualProxy) {
            summary["radius_m"] = subject->radius_m;
        }
        summary.update(traceSummary(*updates));
        const auto replace = nlohmann::ordered_json::error_handler_t::replace;
        if (Status written = write(options.summary, summary.dump(2, ' ', false, replace) + "\n");
            !written) {
            return written;
        }
    }
    if (subject->dataset) {
        printNotices(subject->dataset->info());
    }
    return Done{};
}

} // namespace

void addTraceCommand(CLI::App& app, CommandAction& run)
{
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "trace",
        "Run a contact model over a list of goals and print where the proxy goes. DEM may also be "
        "a triangle mesh: OBJ, PLY or STL, in metres");
    options->map.addTo(*command);
    command
        ->add_option("--goals", options->goals,
                     "CSV with the header x,y,z: map coordinates in the raster's CRS and a height "
                     "in metres, not exaggerated; - for standard input")
        ->required();
    std::vector<std::string> names;
    for (const ContactModelKind kind : kContactModelKinds) {
        names.emplace_back(contactModelName(kind));
    }
    command->add_option("--model", options->model, "contact model")
        ->capture_default_str()
        ->check(CLI::IsMember(names));
    command
        ->add_option("--radius", options->radius_m,
                     "of the sphere of virtual-proxy, scene metres; default half a cell")
        ->check(positiveNumber());
    command->add_option("--exaggeration", options->exaggeration, "of heights")
        ->capture_default_str()
        ->check(positiveNumber());
    command->add_flag("--timing", options->has_timing, "add a column ns, the time of each update");
    command->add_option("--summary", options->summary, "JSON file for totals, means and times");
    command->add_option("-o,--output", options->output, "CSV file to write, default stdout");
    command->callback([options, &run] {
        const auto needs_radius = contactModelName(ContactModelKind::VirtualProxy);
        if (options->radius_m && options->model != needs_radius) {
            throw CLI::ValidationError("--radius",
                                       fmt::format("only --model {} has one", needs_radius));
        }
        run = [options] { return runTrace(*options); };
    });
}

} // namespace marsview
