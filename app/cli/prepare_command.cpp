// marsview-cli prepare: makes of a raster that is too large to hold what can be looked at and
// touched piece by piece.

#include "app/cli/commands.h"
#include "app/cli/long_job.h"
#include "app/cli/machine.h"
#include "app/cli/map_options.h"
#include "app/cli/text_output.h"
#include "core/raster/map_folder.h"
#include "core/raster/source_identity.h"
#include "core/raster/tiled_geotiff.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace marsview {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

struct Options {
    MapOptions map;
    std::string output;
    bool is_waiting = false;
    bool is_json = false;
    double checkpoint_s = 3.0;
};

double secondsSince(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// Where to put the tiled form: where the user says, else among the prepared maps.
struct Output {
    std::string path;
    std::optional<MapFolder> folder;
};

std::string settingsOf(const RasterOverrides& overrides)
{
    if (overrides.isEmpty()) {
        return {};
    }
    const Ellipsoid radii = overrides.ellipsoid.value_or(Ellipsoid{0.0, 0.0});
    return fmt::format("{}|{}|{} {}|{}|{}|{}", overrides.crs.value_or(""),
                       overrides.body.value_or(""), radii.equatorial_m, radii.polar_m,
                       overrides.transform ? fmt::format("{}", fmt::join(*overrides.transform, " "))
                                           : "",
                       overrides.vertical_unit.value_or(""),
                       overrides.nodata ? fmt::format("{}", *overrides.nodata) : "");
}

Result<Output> outputFor(const Options& options)
{
    if (!options.output.empty()) {
        return Output{options.output, std::nullopt};
    }
    Result<SourceIdentity> source = identify(options.map.path);
    if (!source) {
        return std::move(source).error();
    }
    Result<MapFolder> folder = MapFolder::open();
    if (!folder) {
        return std::move(folder).error();
    }
    std::string path =
        folder->pathFor(*source, options.map.band, settingsOf(options.map.overrides()));
    return Output{std::move(path), std::move(folder).value()};
}

Result<bool> isUsedInPlace(const Options& options)
{
    Result<TiledLayoutInfo> layout = tiledLayoutOf(options.map.path, options.map.band);
    if (!layout) {
        return std::move(layout).error();
    }
    std::error_code ignored;
    const bool is_same_file =
        options.output.empty() ||
        std::filesystem::equivalent(options.output, options.map.path, ignored);
    return layout->is_usable && is_same_file;
}

// The new map is the last that would have to go.
Status keepWithinBound(const MapFolder& folder, const std::string& path)
{
    const Result<FileLock> use = folder.use(path);
    if (!use) {
        return use.error();
    }
    const Result<std::vector<PreparedMap>> removed = folder.trim(folder.defaultBytesMax());
    if (!removed) {
        return removed.error();
    }
    for (const PreparedMap& map : *removed) {
        std::fprintf(
            stderr, "marsview-cli: %s\n",
            asOneLine(fmt::format("{}: removed, the prepared maps took more than {:.0f} GB",
                                  map.path, static_cast<double>(folder.defaultBytesMax()) / 1e9))
                .c_str());
    }
    return Done{};
}

void print(const Json& json)
{
    const auto line = [](const char* name, const std::string& words) {
        printLine(fmt::format("{:<16}{}", name, words));
    };
    const double seconds = json["seconds"].get<double>();
    line("file", json["file"].get<std::string>());
    line("samples", fmt::format("{}", json["samples"].get<std::uint64_t>()));
    line("bytes", fmt::format("{}", json["bytes"].get<std::uint64_t>()));
    line("time", fmt::format("{:.1f} s", seconds));
    if (!json["samples_per_second"].is_null()) {
        line("throughput", fmt::format("{:.1f} million samples/s",
                                       json["samples_per_second"].get<double>() / 1e6));
    }
    line("peak memory", fmt::format("{:.0f} MB", json["peak_memory_bytes"].get<double>() / 1e6));
}

Status runPrepare(const Options& options)
{
    const Clock::time_point start = Clock::now();
    Result<bool> in_place = isUsedInPlace(options);
    if (!in_place) {
        return std::move(in_place).error();
    }
    Json json;
    json["source"] = options.map.path;
    if (*in_place) {
        Result<OpenedMap> map = openMap(options.map);
        if (!map) {
            return std::move(map).error();
        }
        std::error_code ignored;
        const std::uintmax_t bytes = std::filesystem::file_size(options.map.path, ignored);
        json["file"] = options.map.path;
        json["is_source_used"] = true;
        json["samples"] = map->info.columns * map->info.rows;
        json["samples_read"] = 0;
        json["bytes"] = ignored ? 0 : bytes;
        json["notes"] = Json::array();
        json["samples_per_second"] = nullptr;
    } else {
        Result<Output> output = outputFor(options);
        if (!output) {
            return std::move(output).error();
        }
        TiledGeoTiffJob job;
        job.source = options.map.path;
        job.band = options.map.band;
        job.overrides = options.map.overrides();
        job.path = output->path;
        job.when_busy =
            options.is_waiting ? TiledGeoTiffJob::WhenBusy::Wait : TiledGeoTiffJob::WhenBusy::Fail;
        job.checkpoint_interval =
            std::chrono::milliseconds(static_cast<std::int64_t>(options.checkpoint_s * 1000.0));
        LongJob work("preparing");
        Result<TiledGeoTiffReport> report = writeTiledGeoTiff(job, work.monitor());
        if (!report) {
            return std::move(report).error();
        }
        if (output->folder) {
            if (Status kept = keepWithinBound(*output->folder, output->path); !kept) {
                return kept;
            }
        }
        for (const std::string& note : report->notes) {
            std::fprintf(stderr, "marsview-cli: %s\n", asOneLine(note).c_str());
        }
        json["file"] = output->path;
        json["is_source_used"] = false;
        json["samples"] = report->samples;
        json["samples_read"] = report->samples_read;
        json["bytes"] = report->bytes;
        json["notes"] = report->notes;
        json["samples_per_second"] =
            asJson(static_cast<double>(report->samples_read) / secondsSince(start));
    }
    json["seconds"] = secondsSince(start);
    json["peak_memory_bytes"] = peakMemoryBytes();
    if (options.is_json) {
        printLine(json.dump(2, ' ', false, Json::error_handler_t::replace));
    } else {
        print(json);
    }
    return Done{};
}

} // namespace

void addPrepareCommand(CLI::App& app, CommandAction& run)
{
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "prepare",
        "Make of a map too large to hold one that opens at once: a tiled GeoTIFF with "
        "overviews. Stopped, it goes on where it was when it is started again");
    options->map.addTo(*command);
    command->add_option("-o,--output", options->output,
                        "GeoTIFF to write; by default one in the folder of prepared maps, or none "
                        "where DEM is tiled and has overviews already");
    command->add_flag("--wait", options->is_waiting,
                      "where another program prepares the same file, wait for it");
    command
        ->add_option("--checkpoint", options->checkpoint_s, "seconds of work that a stop may cost")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 3600.0));
    command->add_flag("--json", options->is_json, "for machines");
    command->callback([options, &run] { run = [options] { return runPrepare(*options); }; });
}

} // namespace marsview
