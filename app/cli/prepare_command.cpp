// marsview-cli prepare: converts a raster larger than memory to a map that can be viewed and
// touched tile by tile.

#include "app/cli/commands.h"
#include "app/console/long_job.h"
#include "app/console/machine.h"
#include "app/console/map_options.h"
#include "app/console/number_checks.h"
#include "app/console/text_output.h"
#include "core/files/remote_raster.h"
#include "core/levels/level_file.h"
#include "core/prepare/geotiff_skeleton.h"
#include "core/prepare/map_folder.h"
#include "core/prepare/parts/join_parts.h"
#include "core/prepare/parts/prepare_part.h"
#include "core/prepare/prepare_map.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace marsview {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kPartsMax = 100'000;

struct PrepareOptions {
    MapOptions map;
    std::string output;
    bool is_waiting = false;
    bool is_json = false;
    bool is_cog = false;
    double checkpoint_s = 3.0;
    std::size_t parts = 0; // 0: not in parts
    std::size_t part = 0;  // 0: none
    bool is_joining = false;
    std::string parts_folder;

    TiledGeoTiffJob::Order order() const
    {
        return is_cog ? TiledGeoTiffJob::Order::OverviewsFirst : TiledGeoTiffJob::Order::AsMade;
    }
};

struct Work {
    PrepareJob job;
    bool is_in_place = false; // the raster itself can be used
};

std::uint64_t bytesOf(const std::string& path)
{
    std::error_code ignored;
    const std::uintmax_t bytes = std::filesystem::file_size(path, ignored);
    return ignored ? 0 : bytes;
}

// Whether a level file can be written next to the raster; not in an archive or on a server.
bool isBesideWritable(const OpenRaster& raster)
{
    const std::filesystem::path folder = std::filesystem::path(raster.info.path).parent_path();
    return access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) == 0;
}

Result<Work> workFor(const PrepareOptions& options, const OpenRaster& raster)
{
    Work work;
    PrepareJob& job = work.job;
    job.when_there = PrepareJob::WhenThere::Check;
    job.when_busy =
        options.is_waiting ? TiledGeoTiffJob::WhenBusy::Wait : TiledGeoTiffJob::WhenBusy::Fail;
    job.order = options.order();
    job.checkpoint_interval =
        std::chrono::milliseconds(static_cast<std::int64_t>(options.checkpoint_s * 1000.0));
    std::error_code ignored;
    const bool may_be_in_place =
        options.output.empty() ||
        std::filesystem::equivalent(options.output, options.map.path, ignored);
    if (may_be_in_place) {
        if (canBeUsedInPlace(raster) && (!options.output.empty() || isBesideWritable(raster))) {
            work.is_in_place = true;
            return work;
        }
    }
    job.raster_path = options.output;
    if (std::filesystem::is_directory(job.raster_path, ignored)) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: is a folder; name a file in it", options.output)};
    }
    if (!may_be_in_place && bytesOf(options.output) > 0 &&
        bytesOf(LevelFile::pathFor(options.output)) == 0 &&
        readGeoTiffOrigin(options.output).key.empty()) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: already exists and is not a prepared map; name another file, "
                                 "or remove it",
                                 options.output)};
    }
    return work;
}

// Without --output, and if the raster itself is not usable in place: among the prepared maps.
Result<PrepareReport> prepare(const OpenRaster& raster, const Work& work, JobMonitor& monitor)
{
    const PrepareJob& job = work.job;
    if (work.is_in_place || !job.raster_path.empty()) {
        return prepareMapFiles(raster, job, monitor);
    }
    return prepareInFolder(raster,
                           {.folder = MapFolder::defaultPath(),
                            .when_busy = job.when_busy,
                            .when_there = job.when_there,
                            .checkpoint_interval = job.checkpoint_interval},
                           monitor);
}

void print(const Json& json)
{
    const auto line = [](const char* name, const std::string& words) {
        printLine(fmt::format("{:<16}{}", name, words));
    };
    const double seconds = json["seconds"].get<double>();
    line("file", json["file"].get<std::string>());
    line("samples", fmt::format("{}", json["samples"].get<std::uint64_t>()));
    line("level file", json["level_file"].get<std::string>());
    line("bytes", fmt::format("{}", json["bytes"].get<std::uint64_t>()));
    line("level bytes", fmt::format("{}", json["level_file_bytes"].get<std::uint64_t>()));
    line("time", fmt::format("{:.1f} s, including {:.1f} s for levels", seconds,
                             json["level_seconds"].get<double>()));
    if (!json["samples_per_second"].is_null()) {
        line("throughput", fmt::format("{:.1f} million samples/s",
                                       json["samples_per_second"].get<double>() / 1e6));
    }
    line("peak memory", fmt::format("{:.0f} MB", json["peak_memory_bytes"].get<double>() / 1e6));
}

// Throws a usage error.
void checkParts(const PrepareOptions& options)
{
    if (options.parts == 0) {
        return;
    }
    if (options.is_joining == (options.part > 0)) {
        throw CLI::ValidationError("--parts", "needs either --part or --join");
    }
    if (options.part > options.parts) {
        throw CLI::ValidationError("--part", fmt::format("{} is greater than --parts {}; parts are "
                                                         "counted from 1",
                                                         options.part, options.parts));
    }
    if (options.output.empty()) {
        throw CLI::ValidationError("--parts", "needs --output");
    }
    if (remoteNameFor(options.output) && options.parts_folder.empty()) {
        throw CLI::ValidationError("--output", "on a server needs --parts-folder");
    }
}

std::string partsFolder(const PrepareOptions& options)
{
    return options.parts_folder.empty() ? options.output + ".parts" : options.parts_folder;
}

Status runPart(const PrepareOptions& options, const OpenRaster& raster)
{
    LongJob job("preparing");
    const Result<PartReport> report = preparePart(
        raster, {.folder = partsFolder(options), .part = options.part, .parts = options.parts},
        job.monitor());
    if (!report) {
        return report.error();
    }
    Json json;
    json["source"] = options.map.path;
    json["part"] = options.part;
    json["parts"] = options.parts;
    json["tile_rows"] = {report->rows.first, report->rows.end};
    json["samples"] = report->samples;
    json["is_copied"] = report->is_copied;
    json["is_measured"] = report->is_measured;
    json["awaited_parts"] = report->awaited;
    json["copy_seconds"] = report->copy_seconds;
    json["level_seconds"] = report->level_seconds;
    json["seconds"] = report->copy_seconds + report->level_seconds;
    json["peak_memory_bytes"] = peakMemoryBytes();
    if (options.is_json) {
        printJson(withSchema(json));
        return Done{};
    }
    printLine(fmt::format("{:<16}{} of {}, {} samples, {:.1f} s, {:.0f} MB", "part", options.part,
                          options.parts, report->samples,
                          report->copy_seconds + report->level_seconds,
                          static_cast<double>(peakMemoryBytes()) / 1e6));
    printLine(fmt::format(
        "{:<16}{}", "next",
        report->is_measured ? "join, when all parts have got so far"
        : report->awaited.empty()
            ? "join"
            : fmt::format("the remaining parts ({} of {}); then join, or run this part again to "
                          "measure its errors beforehand",
                          report->awaited.size(), options.parts)));
    return Done{};
}

Status runJoin(const PrepareOptions& options, const OpenRaster& raster)
{
    LongJob job("joining");
    const Result<JoinReport> report = joinParts(raster,
                                                {.path = options.output,
                                                 .folder = partsFolder(options),
                                                 .parts = options.parts,
                                                 .order = options.order()},
                                                job.monitor());
    if (!report) {
        return report.error();
    }
    Json json;
    json["source"] = options.map.path;
    json["file"] = options.output;
    json["level_file"] = report->level_path;
    json["parts"] = options.parts;
    json["parts_measured"] = report->measured;
    json["samples"] = report->samples;
    json["bytes"] = report->bytes;
    json["level_file_bytes"] = report->level_bytes;
    json["copy_seconds"] = report->copy_seconds;
    json["level_seconds"] = report->level_seconds;
    json["seconds"] = report->copy_seconds + report->level_seconds;
    json["samples_per_second"] = nullptr;
    json["peak_memory_bytes"] = peakMemoryBytes();
    if (options.is_json) {
        printJson(withSchema(json));
    } else {
        print(json);
    }
    return Done{};
}

Status runPrepare(const PrepareOptions& options)
{
    if (options.output.empty()) {
        if (Status local = checkIsLocal(options.map.spec()); !local) {
            return local;
        }
    }
    const Result<OpenRaster> raster = openRaster(options.map);
    if (!raster) {
        return raster.error();
    }
    if (options.parts > 0) {
        printNotices(raster->file.info());
        return options.is_joining ? runJoin(options, *raster) : runPart(options, *raster);
    }
    const Result<Work> work = workFor(options, *raster);
    if (!work) {
        return work.error();
    }
    printNotices(raster->file.info()); // first: one may say how long it takes
    LongJob job("preparing");
    Result<PrepareReport> report = prepare(*raster, *work, job.monitor());
    if (!report) {
        return std::move(report).error();
    }
    for (const std::string& note : report->notes) {
        std::fprintf(stderr, "marsview-cli: %s\n", asOneLine(note).c_str());
    }
    const double seconds = report->copy_seconds + report->level_seconds + report->check_seconds;
    Json json;
    json["source"] = options.map.path;
    json["file"] = report->raster_path;
    json["level_file"] = report->level_path;
    json["is_source_used"] = report->is_source_used;
    json["samples"] = report->samples;
    json["samples_read"] = report->copy.samples_read;
    json["bytes"] = bytesOf(report->raster_path);
    json["level_file_bytes"] = bytesOf(report->level_path);
    json["notes"] = report->notes;
    json["copy_seconds"] = report->copy_seconds;
    json["level_seconds"] = report->level_seconds;
    json["check_seconds"] = report->check_seconds;
    json["seconds"] = seconds;
    json["samples_per_second"] = asJson(static_cast<double>(report->samples) / seconds);
    json["peak_memory_bytes"] = peakMemoryBytes();
    if (options.is_json) {
        printJson(withSchema(json));
    } else {
        print(json);
    }
    return Done{};
}

} // namespace

void addPrepareCommand(CLI::App& app, CommandAction& run)
{
    const auto options = std::make_shared<PrepareOptions>();
    CLI::App* command = app.add_subcommand(
        "prepare",
        "Build overviews for a map larger than memory, so that it opens at once: a tiled "
        "GeoTIFF and a level file. If interrupted, the next run resumes");
    options->map.addTo(*command);
    CLI::Option* output =
        command
            ->add_option("-o,--output", options->output,
                         "GeoTIFF to write; by default one in the folder of prepared maps, or none "
                         "if DEM is already tiled and has overviews")
            ->type_name("FILE")
            ->transform(fileName())
            ->check(fileNameEndingIn({".tif", ".tiff"}));
    command->add_flag("--wait", options->is_waiting,
                      "if another program prepares the same file, wait for it");
    command
        ->add_option("--checkpoint", options->checkpoint_s,
                     "seconds of work that an interruption may lose")
        ->capture_default_str()
        ->check(numberFrom(0.0, 3600.0));
    command
        ->add_flag("--cog", options->is_cog,
                   "put the overviews first, as in a cloud-optimized GeoTIFF; writes the file "
                   "a second time")
        ->needs(output);
    CLI::Option* parts =
        command
            ->add_option("--parts", options->parts,
                         "prepare in so many parts, each with --part, then --join; on any machines "
                         "that see DEM and the output folder")
            ->check(CLI::Range(std::size_t{1}, kPartsMax))
            ->type_name("N");
    command->add_option("--part", options->part, "prepare this part, counted from 1")
        ->check(CLI::Range(std::size_t{1}, kPartsMax))
        ->needs(parts)
        ->type_name("I");
    command->add_flag("--join", options->is_joining, "join the parts")->needs(parts);
    command
        ->add_option("--parts-folder", options->parts_folder,
                     "folder of the parts; by default the output with .parts at its end")
        ->needs(parts)
        ->type_name("FOLDER");
    command->add_flag("--json", options->is_json, "print JSON");
    command->callback([options, &run] {
        checkParts(*options);
        run = [options] { return runPrepare(*options); };
    });
}

} // namespace marsview
