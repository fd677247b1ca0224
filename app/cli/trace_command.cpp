// marsview-cli trace: runs a contact model over a list of goals, without clock or device.

#include "app/cli/commands.h"
#include "app/cli/contact_trace.h"
#include "app/cli/replay_notice.h"
#include "app/cli/trace_subject.h"
#include "app/console/long_job.h"
#include "app/console/number_checks.h"
#include "app/console/output_file.h"
#include "app/console/scene_option.h"
#include "app/console/text_output.h"
#include "core/sources/output_check.h"
#include "haptics/trace/goal_file.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace marsview {
namespace {

struct TraceOptions {
    MapOptions map;
    std::string goals;
    std::optional<std::string> model; // these three: default from the recording, else the program's
    std::optional<double> radius_m;
    std::optional<double> exaggeration;
    SceneKind scene = SceneKind::Flat;
    PileOptions pile;
    bool has_timing = false;
    std::string summary;
    std::string output;
};

// TraceOptions on the command line apply throughout; otherwise the recording's settings apply.
Result<std::vector<TraceTouch>>
touchesOf(const TraceOptions& options, const GoalRecording& recording, const TraceSubject& subject)
{
    TraceTouch said{.kind =
                        contactModelKind(options.model.value_or("")).value_or(kContactModelDefault),
                    .radius_m = options.radius_m.value_or(subject.radius_m),
                    .exaggeration = options.exaggeration.value_or(1.0)};
    if (recording.parts.empty() || subject.map == nullptr) {
        return std::vector<TraceTouch>{said};
    }
    std::vector<TraceTouch> touches;
    for (const GoalPart& part : recording.parts) {
        if (!part.below.empty()) {
            return Error{ErrorCode::Invalid,
                         fmt::format("{}: was recorded on {} maps on top of each other from line "
                                     "{} on; replay it in the window",
                                     options.goals, 1 + part.below.size(), part.line)};
        }
        if (part.map != recording.parts.front().map) {
            return Error{ErrorCode::Invalid,
                         fmt::format("{}: is a recording of another map from line {} on; split "
                                     "it there",
                                     options.goals, part.line)};
        }
        touches.push_back(
            {.first = part.first,
             .part = part.part,
             .kind = options.model ? said.kind : part.kind,
             .radius_m = options.radius_m.value_or(part.radius_m),
             .exaggeration = options.exaggeration.value_or(part.exaggeration),
             .frame = subject.is_recorded_on ? std::optional(part.ground->frame) : std::nullopt});
    }
    return touches;
}

// One model after the other; a model that occurs again continues in its last state.
class Tracing {
public:
    Tracing(const TraceSubject& subject, const GoalRecording& recording)
        : subject_(subject)
        , recording_(recording)
    {}

    Result<std::vector<TraceUpdate>> run(const std::vector<TraceTouch>& touches,
                                         JobMonitor& monitor)
    {
        const std::vector<TracePoint>& goals = recording_.goals;
        std::vector<TraceUpdate> updates;
        updates.reserve(goals.size());
        for (std::size_t i = 0; i < touches.size(); ++i) {
            const std::size_t end = i + 1 < touches.size() ? touches[i + 1].first : goals.size();
            auto found = touchers_.find(touches[i].part);
            if (found == touchers_.end()) {
                found = touchers_.emplace(touches[i].part, subject_.make(touches[i])).first;
            }
            const Toucher& toucher = found->second;
            if (Status traced = trace(
                    *toucher.model, toucher.frame,
                    std::span(goals).subspan(touches[i].first, end - touches[i].first),
                    [&](std::size_t goal) { return beforeGoal(goal, monitor); }, updates);
                !traced) {
                return std::move(traced).error();
            }
        }
        return updates;
    }

private:
    Status beforeGoal(std::size_t goal, JobMonitor& monitor)
    {
        constexpr std::size_t kReportEvery = 1024;
        if (goal % kReportEvery == 0) {
            monitor.report(static_cast<double>(goal) /
                           static_cast<double>(recording_.goals.size()));
            if (monitor.isCanceled()) {
                return Error{ErrorCode::Canceled, "tracing was canceled"};
            }
        }
        return followGround(goal);
    }
    Status followGround(std::size_t goal)
    {
        if (!subject_.recorded) {
            return Done{};
        }
        for (; next_ground_ < recording_.ground.size() &&
               recording_.ground[next_ground_].goal <= goal;
             ++next_ground_) {
            for (const GroundRecord& record : recording_.ground[next_ground_].records) {
                if (Status followed = subject_.recorded->follow(record); !followed) {
                    return followed;
                }
                const auto* felt = std::get_if<GroundFelt>(&record);
                const auto toucher =
                    felt != nullptr ? touchers_.find(felt->changed_part) : touchers_.end();
                if (toucher != touchers_.end()) {
                    toucher->second.model->terrainChanged();
                }
            }
        }
        return Done{};
    }

    const TraceSubject& subject_;
    const GoalRecording& recording_;
    std::map<std::uint64_t, Toucher> touchers_; // by part
    std::size_t next_ground_ = 0;
};

// The number of updates whose result differs from the recorded one; empty if the file has no
// results, or if options changed the settings.
std::optional<std::size_t> differingCount(const TraceOptions& options,
                                          const GoalRecording& recording,
                                          const std::vector<TraceUpdate>& updates)
{
    // A diagnostic log, which has no terrain data, begins in the middle of a touch.
    if (recording.updates.empty() || !recording.parts.front().ground || options.model ||
        options.radius_m || options.exaggeration) {
        return std::nullopt;
    }
    std::size_t count = 0;
    for (std::size_t i = 0; i < updates.size(); ++i) {
        const RecordedUpdate now{updates[i].state.is_in_contact, updates[i].proxy};
        count += now == recording.updates[i] ? 0U : 1U;
    }
    return count;
}

// For messages.
std::string goalsName(const TraceOptions& options)
{
    return options.goals == "-" ? std::string("--goals") : options.goals;
}

// Notices about the goals; empty if there are none.
std::string noticeOf(const TraceOptions& options,
                     const GoalRecording& recording,
                     const TraceSubject& subject,
                     const std::vector<TraceUpdate>& updates)
{
    std::vector<std::string> remarks;
    if (recording.is_cut_short) {
        remarks.emplace_back(kCutShortText);
    }
    if (subject.map && !subject.is_recorded_on && !recording.parts.empty() &&
        recording.parts.front().ground) {
        remarks.push_back(otherMapText(*recording.parts.front().ground));
    }
    if (subject.map && !subject.is_on_body && !recording.goals.empty()) {
        const Georeference& map = subject.map->georeference();
        const GoalFrame frame({subject.map, &map}, 1.0);
        if (std::all_of(recording.goals.begin(), recording.goals.end(),
                        [&frame](const TracePoint& goal) { return frame.isClamped(goal); })) {
            remarks.emplace_back(
                "is outside the map, and all its goals are clamped to the map's edge");
        }
    }
    const auto refused =
        std::count_if(updates.begin(), updates.end(),
                      [](const TraceUpdate& update) { return update.state.counters.refused != 0; });
    if (refused > 0) {
        remarks.push_back(
            fmt::format("has {} of {} goals that are not numbers or too far away; "
                        "the proxy stayed where it was",
                        refused, updates.size()));
    }
    if (const auto count = differingCount(options, recording, updates); count && *count > 0) {
        remarks.push_back(
            fmt::format("has {} of {} updates with different results now; was the "
                        "recording edited, or another map or other options used?",
                        *count, updates.size()));
    }
    return remarks.empty() ? std::string()
                           : fmt::format("{}: {}", goalsName(options), fmt::join(remarks, "; it "));
}

nlohmann::ordered_json touchJson(const TraceTouch& touch)
{
    nlohmann::ordered_json json = {{"model", contactModelName(touch.kind)},
                                   {"radius_m", nullptr},
                                   {"exaggeration", touch.exaggeration}};
    if (touch.kind == ContactModelKind::VirtualProxy) {
        json["radius_m"] = touch.radius_m;
    }
    return json;
}

// The summary of the first goals; "parts" has all, if there are several.
nlohmann::ordered_json summaryOf(const TraceOptions& options,
                                 const GoalRecording& recording,
                                 const std::vector<TraceTouch>& touches,
                                 const std::vector<TraceUpdate>& updates)
{
    nlohmann::ordered_json summary = withSchema({{"file", options.map.path}});
    summary["scene"] = sceneName(options.scene);
    summary.update(touchJson(touches.front()));
    if (touches.size() > 1) {
        nlohmann::ordered_json parts = nlohmann::ordered_json::array();
        for (const TraceTouch& touch : touches) {
            parts.push_back(touchJson(touch));
            parts.back()["first_update"] = touch.first;
        }
        summary["parts"] = parts;
    }
    summary.update(traceSummary(updates));
    if (const auto count = differingCount(options, recording, updates)) {
        summary["differing_updates"] = *count;
    }
    return summary;
}

Result<TraceSubject> openMesh(const TraceOptions& options, JobMonitor& monitor)
{
    if (options.scene == SceneKind::Body) {
        return Error{
            ErrorCode::Invalid,
            fmt::format("{}: a mesh has no body; leave out --scene body", options.map.path)};
    }
    if (options.map.hasOverrides()) {
        return Error{
            ErrorCode::Invalid,
            fmt::format("{}: a mesh has no CRS, body, band or unit to override", options.map.path)};
    }
    if (options.model == contactModelName(ContactModelKind::VirtualProxy) && !options.radius_m) {
        return Error{ErrorCode::Invalid,
                     "--radius: is required with virtual-proxy over a mesh, which has no "
                     "cell size"};
    }
    return meshSubject(options.map, options.exaggeration.value_or(1.0), monitor);
}

// The triangles of a body contain the exaggeration.
Result<TraceSubject>
openBody(const TraceOptions& options, const GoalRecording& recording, JobMonitor& monitor)
{
    double exaggeration = options.exaggeration.value_or(1.0);
    if (!options.exaggeration && !recording.parts.empty()) {
        exaggeration = recording.parts.front().exaggeration;
        for (const GoalPart& part : recording.parts) {
            if (part.exaggeration != exaggeration) {
                return Error{ErrorCode::Invalid,
                             fmt::format("{}: has another exaggeration from line {} on; split it "
                                         "there, or give one for all with --exaggeration",
                                         options.goals, part.line)};
            }
        }
    }
    return bodySubject(options.map, options.pile, recording, exaggeration, monitor);
}

Result<TraceSubject>
openSubject(const TraceOptions& options, const GoalRecording& recording, JobMonitor& monitor)
{
    if (isMesh(options.map.path)) {
        return openMesh(options, monitor);
    }
    return options.scene == SceneKind::Body ? openBody(options, recording, monitor)
                                            : mapSubject(options.map, recording, monitor);
}

Status runTrace(const TraceOptions& options)
{
    const Result<OpenFiles> inputs =
        checkOutputs({.maps = options.pile.withPath(options.map.path),
                      .read = {options.goals == "-" ? "" : options.goals},
                      .written = {options.output, options.summary}});
    if (!inputs) {
        return inputs.error();
    }
    const Result<std::string> text = readGoalText(options.goals);
    if (!text) {
        return text.error();
    }
    const GoalColumns columns =
        options.scene == SceneKind::Body ? GoalColumns::Geographic : GoalColumns::Map;
    const Result<GoalRecording> recording = readGoalRecording(*text, goalsName(options), columns);
    if (!recording) {
        return recording.error();
    }
    std::optional<TraceSubject> subject;
    {
        LongJob job("reading");
        Result<TraceSubject> opened = openSubject(options, *recording, job.monitor());
        if (!opened) {
            return std::move(opened).error();
        }
        subject = std::move(opened).value();
    }
    const Result<std::vector<TraceTouch>> touches = touchesOf(options, *recording, *subject);
    if (!touches) {
        return touches.error();
    }
    LongJob job("tracing");
    const auto updates = Tracing(*subject, *recording).run(*touches, job.monitor());
    if (!updates) {
        return Error{updates.error().code,
                     fmt::format("{}: {}", options.map.path, updates.error().message)};
    }
    for (const auto& waiting : subject->waiting) {
        if (waiting->error()) {
            return *waiting->error();
        }
    }
    const std::string csv =
        asCsv(*updates, columns, options.has_timing ? TraceTiming::Yes : TraceTiming::No);
    if (options.output.empty()) {
        std::fwrite(csv.data(), 1, csv.size(), stdout);
    } else if (Status written = writeOutputFile(options.output, csv); !written) {
        return written;
    }
    if (!options.summary.empty()) {
        const nlohmann::ordered_json summary = summaryOf(options, *recording, *touches, *updates);
        const auto replace = nlohmann::ordered_json::error_handler_t::replace;
        if (Status written =
                writeOutputFile(options.summary, summary.dump(2, ' ', false, replace) + "\n");
            !written) {
            return written;
        }
    }
    if (subject->map) {
        printNotices(subject->map->info());
    }
    if (const std::string notice = noticeOf(options, *recording, *subject, *updates);
        !notice.empty()) {
        std::fprintf(stderr, "marsview-cli: %s\n", asOneLine(notice).c_str());
    }
    return Done{};
}

} // namespace

void addTraceCommand(CLI::App& app, CommandAction& run)
{
    const auto options = std::make_shared<TraceOptions>();
    CLI::App* command = app.add_subcommand(
        "trace",
        "Run a contact model over a list of goals and print the proxy's path. DEM may also be "
        "a triangle mesh: OBJ, PLY or STL, in meters");
    options->map.addTo(*command);
    command
        ->add_option("--goals", options->goals,
                     "CSV with the header x,y,z: map coordinates in the raster's CRS and a height "
                     "in meters, not exaggerated; - for standard input")
        ->type_name("FILE")
        ->required()
        ->transform(fileName());
    std::vector<std::string> names;
    names.reserve(kContactModelKinds.size());
    for (const ContactModelKind kind : kContactModelKinds) {
        names.emplace_back(contactModelName(kind));
    }
    command
        ->add_option("--model", options->model,
                     fmt::format("contact model; default from the recording, else {}",
                                 contactModelName(kContactModelDefault)))
        ->check(oneOf(names));
    command
        ->add_option("--radius", options->radius_m,
                     "radius of the virtual-proxy sphere, scene meters; default from the "
                     "recording, else half a cell")
        ->check(positiveNumber());
    command
        ->add_option("--exaggeration", options->exaggeration,
                     "vertical exaggeration; default from the recording, else 1")
        ->check(exaggerationFactor());
    addSceneOption(*command, options->scene,
                   ", and goals have the header lon,lat,z: degrees east, planetocentric degrees "
                   "north and meters along the normal");
    options->pile.addTo(*command);
    command->add_flag("--timing", options->has_timing, "add a column ns, the time of each update");
    command->add_option("--summary", options->summary, "JSON file for totals, means and times")
        ->type_name("FILE")
        ->transform(fileName());
    command->add_option("-o,--output", options->output, "CSV file to write; default and -: stdout")
        ->type_name("FILE")
        ->transform(fileName());
    command->callback([options, &run] {
        options->pile.check(options->scene);
        const auto needs_radius = contactModelName(ContactModelKind::VirtualProxy);
        if (options->radius_m && options->model.value_or("") != needs_radius) {
            throw CLI::ValidationError("--radius",
                                       fmt::format("only --model {} has one", needs_radius));
        }
        run = [options] { return runTrace(*options); };
    });
}

} // namespace marsview
