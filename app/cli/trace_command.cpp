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

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace marsview {
namespace {

struct Options {
    MapOptions map;
    std::string goals;
    std::optional<std::string> model; // these three: a recording's, or else the default
    std::optional<double> radius_m;
    std::optional<double> exaggeration;
    bool has_timing = false;
    std::string summary;
    std::string output;
};

Status write(const std::string& path, const std::string& text)
{
    errno = 0;
    std::ofstream file(path, std::ios::binary);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
    if (!file) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: cannot be written ({}); choose another file, in a folder "
                                 "that is there and may be written to",
                                 path, std::generic_category().message(errno))};
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

// How ground is touched by the goals from `first` on.
struct Touch {
    std::size_t first = 0;
    std::uint64_t part = 0; // of a recording: another number is another model
    ContactModelKind kind = kContactModelDefault;
    double radius_m = 1.0;
    double exaggeration = 1.0;
};

struct Toucher {
    std::unique_ptr<ContactModel> model;
    TraceFrame frame;
};

// What is touched: a map or a mesh.
struct Subject {
    std::function<Toucher(const Touch&)> make;
    double radius_m = 1.0;                         // where nobody has told another
    std::shared_ptr<const Dataset> dataset;        // null for a mesh
    std::shared_ptr<const WaitingTerrain> terrain; // of a map in tiles
};

Result<Subject> meshSubject(const Options& options, JobMonitor& monitor)
{
    if (options.map.hasOverrides()) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: a mesh has no CRS, body, band or unit to be told otherwise",
                                 options.map.path)};
    }
    if (options.model == contactModelName(ContactModelKind::VirtualProxy) && !options.radius_m) {
        return Error{ErrorCode::Invalid,
                     "--radius: is needed with virtual-proxy over a mesh, which has no cell to be "
                     "half of"};
    }
    Result<TriangleSoup> soup = readTriangles(options.map.path, monitor);
    if (!soup) {
        return std::move(soup).error();
    }
    const double exaggeration = options.exaggeration.value_or(1.0);
    for (ScenePoint& vertex : soup.value().vertices) {
        vertex.z *= exaggeration;
    }
    const auto mesh = TriangleMesh::build(std::move(soup).value(), monitor);
    if (!mesh) {
        return Error{mesh.error().code,
                     fmt::format("{}: {}", options.map.path, mesh.error().message)};
    }
    const MeshSurface surface(mesh.value());
    return Subject{.make =
                       [surface, exaggeration](const Touch& touch) {
                           return Toucher{
                               makeContactModel(touch.kind, surface, {.radius_m = touch.radius_m}),
                               meshFrame(exaggeration)};
                       },
                   .radius_m = 1.0,
                   .dataset = nullptr,
                   .terrain = nullptr};
}

Result<Subject> mapSubject(const Options& options, JobMonitor& monitor)
{
    Result<TouchMap> map = openTouchMap(options.map, TouchStore::HeldOrTiled, monitor);
    if (!map) {
        return std::move(map).error();
    }
    const auto dataset = map->dataset;
    const Georeference& georeference = dataset->georeference();
    const SceneFrame frame = georeference.sceneFrame();
    Subject subject{.make = {},
                    .radius_m =
                        (georeference.pixelWidthMetres() + georeference.pixelHeightMetres()) / 4.0,
                    .dataset = dataset,
                    .terrain = nullptr};
    if (map->filled) {
        subject.make = [dataset, frame, filled = map->filled](const Touch& touch) {
            const HeightfieldSurface surface(filled, frame, touch.exaggeration);
            return Toucher{makeContactModel(touch.kind, surface, {.radius_m = touch.radius_m}),
                           frameOf(dataset, touch.exaggeration)};
        };
        return subject;
    }
    const Heightfield& heightfield = dataset->heightfield();
    subject.terrain = std::make_shared<const WaitingTerrain>(
        heightfield.tiles()->raster(),
        std::make_shared<const TileHeights>(map->levels, heightfield.scale()));
    subject.make = [dataset, frame, terrain = subject.terrain](const Touch& touch) {
        const TiledHeightfieldSurface surface(terrain, frame, touch.exaggeration);
        return Toucher{makeContactModel(touch.kind, surface, {.radius_m = touch.radius_m}),
                       frameOf(dataset, touch.exaggeration)};
    };
    return subject;
}

// What the command line says holds throughout; otherwise what a recording says.
Result<std::vector<Touch>>
touchesOf(const Options& options, const GoalRecording& recording, const Subject& subject)
{
    Touch said{.kind = contactModelKind(options.model.value_or("")).value_or(kContactModelDefault),
               .radius_m = options.radius_m.value_or(subject.radius_m),
               .exaggeration = options.exaggeration.value_or(1.0)};
    if (recording.parts.empty() || subject.dataset == nullptr) {
        return std::vector<Touch>{said};
    }
    std::vector<Touch> touches;
    for (const GoalPart& part : recording.parts) {
        if (part.map != recording.parts.front().map) {
            return Error{ErrorCode::Invalid,
                         fmt::format("{}: from line {} on it is a recording of another map; cut "
                                     "it in two there",
                                     options.goals, part.line)};
        }
        touches.push_back({.first = part.first,
                           .part = part.part,
                           .kind = options.model ? said.kind : part.kind,
                           .radius_m = options.radius_m.value_or(part.radius_m),
                           .exaggeration = options.exaggeration.value_or(part.exaggeration)});
    }
    return touches;
}

// One model after the other; one that comes back goes on where it was.
Result<std::vector<TraceUpdate>> traceAll(const Subject& subject,
                                          const std::vector<Touch>& touches,
                                          const std::vector<TracePoint>& goals,
                                          JobMonitor& monitor)
{
    std::map<std::uint64_t, Toucher> touchers;
    std::vector<TraceUpdate> updates;
    updates.reserve(goals.size());
    for (std::size_t i = 0; i < touches.size(); ++i) {
        const std::size_t end = i + 1 < touches.size() ? touches[i + 1].first : goals.size();
        const std::vector<TracePoint> part(goals.begin() +
                                               static_cast<std::ptrdiff_t>(touches[i].first),
                                           goals.begin() + static_cast<std::ptrdiff_t>(end));
        auto found = touchers.find(touches[i].part);
        if (found == touchers.end()) {
            found = touchers.emplace(touches[i].part, subject.make(touches[i])).first;
        }
        const auto traced = trace(*found->second.model, found->second.frame, part, monitor);
        if (!traced) {
            return traced.error();
        }
        updates.insert(updates.end(), traced->begin(), traced->end());
    }
    return updates;
}

nlohmann::ordered_json touchJson(const Touch& touch)
{
    nlohmann::ordered_json json = {{"model", contactModelName(touch.kind)},
                                   {"radius_m", nullptr},
                                   {"exaggeration", touch.exaggeration}};
    if (touch.kind == ContactModelKind::VirtualProxy) {
        json["radius_m"] = touch.radius_m;
    }
    return json;
}

// That of the first goals; "parts" has all, where there are several.
nlohmann::ordered_json summaryOf(const Options& options,
                                 const std::vector<Touch>& touches,
                                 const std::vector<TraceUpdate>& updates)
{
    nlohmann::ordered_json summary = {{"file", options.map.path}};
    summary.update(touchJson(touches.front()));
    if (touches.size() > 1) {
        nlohmann::ordered_json parts = nlohmann::ordered_json::array();
        for (const Touch& touch : touches) {
            parts.push_back(touchJson(touch));
            parts.back()["first_update"] = touch.first;
        }
        summary["parts"] = parts;
    }
    summary.update(traceSummary(updates));
    return summary;
}

Status runTrace(const Options& options)
{
    const Result<std::string> text = readGoalText(options.goals);
    if (!text) {
        return text.error();
    }
    const Result<GoalRecording> recording =
        readGoalRecording(*text, options.goals == "-" ? "--goals" : options.goals);
    if (!recording) {
        return recording.error();
    }
    std::optional<Subject> subject;
    {
        LongJob job("reading");
        Result<Subject> opened = isMesh(options.map.path) ? meshSubject(options, job.monitor())
                                                          : mapSubject(options, job.monitor());
        if (!opened) {
            return std::move(opened).error();
        }
        subject = std::move(opened).value();
    }
    const Result<std::vector<Touch>> touches = touchesOf(options, *recording, *subject);
    if (!touches) {
        return touches.error();
    }
    LongJob job("tracing");
    const auto updates = traceAll(*subject, *touches, recording->goals, job.monitor());
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
        const nlohmann::ordered_json summary = summaryOf(options, *touches, *updates);
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
    names.reserve(kContactModelKinds.size());
    for (const ContactModelKind kind : kContactModelKinds) {
        names.emplace_back(contactModelName(kind));
    }
    command
        ->add_option("--model", options->model,
                     fmt::format("contact model; default what a recording says, or else {}",
                                 contactModelName(kContactModelDefault)))
        ->check(CLI::IsMember(names));
    command
        ->add_option("--radius", options->radius_m,
                     "of the sphere of virtual-proxy, scene metres; default what a recording says, "
                     "or else half a cell")
        ->check(positiveNumber());
    command
        ->add_option("--exaggeration", options->exaggeration,
                     "of heights; default what a recording says, or else 1")
        ->check(positiveNumber());
    command->add_flag("--timing", options->has_timing, "add a column ns, the time of each update");
    command->add_option("--summary", options->summary, "JSON file for totals, means and times");
    command->add_option("-o,--output", options->output, "CSV file to write, default stdout");
    command->callback([options, &run] {
        const auto needs_radius = contactModelName(ContactModelKind::VirtualProxy);
        if (options->radius_m && options->model.value_or("") != needs_radius) {
            throw CLI::ValidationError("--radius",
                                       fmt::format("only --model {} has one", needs_radius));
        }
        run = [options] { return runTrace(*options); };
    });
}

} // namespace marsview
