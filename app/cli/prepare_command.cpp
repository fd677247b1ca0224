// marsview-cli prepare: converts a raster larger than memory to a map that can be viewed and
// touched tile by tile.

#include "app/cli/commands.h"
#include "app/console/long_job.h"
#include "app/console/machine.h"
#include "app/console/map_options.h"
#include "app/console/number_checks.h"
#include "app/console/text_output.h"
#include "core/levels/level_file.h"
#include "core/prepare/geotiff_skeleton.h"
#include "core/prepare/map_folder.h"
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
#include <utility>
#include <vector>

namespace marsview {
namespace {

using Json = nlohmann::ordered_json;

struct PrepareOptions {
    MapOptions map;
    std::string output;
    bool is_waiting = false;
    bool is_json = false;
    double checkpoint_s = 3.0;
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

Result<Work> workFor(const PrepareOptions& options, const OpenRaster& raster)
{
    Work work;
    PrepareJob& job = work.job;
    job.when_there = PrepareJob::WhenThere::Check;
    job.when_busy =
        options.is_waiting ? TiledGeoTiffJob::WhenBusy::Wait : TiledGeoTiffJob::WhenBusy::Fail;
    job.checkpoint_interval =
        std::chrono::milliseconds(static_cast<std::int64_t>(options.checkpoint_s * 1000.0));
    std::error_code ignored;
    const bool may_be_in_place =
        options.output.empty() ||
        std::filesystem::equivalent(options.output, options.map.path, ignored);
    if (may_be_in_place) {
        if (canBeUsedInPlace(raster)) {
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
    command
        ->add_option("-o,--output", options->output,
                     "GeoTIFF to write; by default one in the folder of prepared maps, or none "
                     "if DEM is already tiled and has overviews")
        ->type_name("FILE")
        ->check(fileNameEndingIn({".tif", ".tiff"}));
    command->add_flag("--wait", options->is_waiting,
                      "if another program prepares the same file, wait for it");
    command
        ->add_option("--checkpoint", options->checkpoint_s,
                     "seconds of work that an interruption may lose")
        ->capture_default_str()
        ->check(numberFrom(0.0, 3600.0));
    command->add_flag("--json", options->is_json, "print JSON");
    command->callback([options, &run] { run = [options] { return runPrepare(*options); }; });
}

} // namespace marsview
