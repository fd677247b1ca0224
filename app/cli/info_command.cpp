// marsview-cli info: a raster's format, placement and elevation range.

#include "app/cli/commands.h"
#include "app/console/long_job.h"
#include "app/console/map_options.h"
#include "app/console/map_report.h"
#include "app/console/number_checks.h"
#include "app/console/text_output.h"
#include "core/files/remote_raster.h"
#include "core/session/map_opening.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace marsview {
namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
    std::vector<std::string> paths;
    MapOptions map; // of each
    bool is_json = false;
    bool has_statistics = true;
};

std::string asWords(const Json& value)
{
    if (value.is_null()) {
        return "unknown";
    }
    if (value.is_boolean()) {
        return value.get<bool>() ? "yes" : "no";
    }
    if (value.is_string()) {
        return value.get<std::string>();
    }
    if (value.is_number_float()) {
        return asText(value.get<double>());
    }
    if (value.is_array()) {
        std::string words;
        for (const Json& item : value) {
            words += (words.empty() ? "" : " ") + asWords(item);
        }
        return words;
    }
    return value.dump();
}

void printForPeople(const Json& json, const RasterInfo& info)
{
    const auto print = [](std::string_view name, const std::string& words) {
        printLine(fmt::format("{:<16}{}", name, words));
    };
    const auto field = [&json](const char* key) { return asWords(json.at(key)); };
    print("file", field("file"));
    print("driver", field("driver"));
    print("columns", field("columns"));
    print("rows", field("rows"));
    print("sample type", field("sample_type"));
    print("nodata", json["nodata"].is_null() ? "none" : field("nodata"));
    if (!info.other_nodata.empty()) {
        print("other nodata", field("other_nodata"));
    }
    print("voids", field("void_count"));
    const std::string missing = json["void_count"].is_null() ? "unknown" : "none";
    print("minimum", json["minimum"].is_null() ? missing : field("minimum") + " m");
    print("maximum", json["maximum"].is_null() ? missing : field("maximum") + " m");
    if (info.scale != 1.0 || info.offset != 0.0) {
        print("scale, offset", field("scale") + " " + field("offset"));
    }
    print("vertical unit", field("vertical_unit") + (info.is_unit_declared ? "" : " (assumed)"));
    print("vertical datum", field("vertical_datum"));
    print("CRS", json["crs_name"].is_null() ? "none" : field("crs_name"));
    print("body", field("body"));
    print("radii", json["radii_m"].is_null() ? "unknown" : field("radii_m") + " m");
    const std::string pixel_size_m = field("pixel_size_m") + " m";
    if (!info.crs || field("pixel_size") + " m" != pixel_size_m) { // in other units than meters
        print("pixel size",
              field("pixel_size") + " " + (info.crs ? info.crs->unitName() : std::string("units")));
    }
    print("pixel size", pixel_size_m);
    print("geotransform", json["geotransform"].is_null() ? "none" : field("geotransform"));
    if (!json["corners_lonlat"].is_null()) {
        for (const auto& [name, corner] : json["corners_lonlat"].items()) {
            print(name, asWords(corner) + " " + field("latitude_kind"));
        }
    }
    print("triangles", field("triangle_count"));
}

// A prepared map has been read once already, and a remote one is not fetched whole. Notices about
// that are added to `info`.
Result<SampleStatistics> statisticsOf(OpenRaster raster, RasterInfo& info)
{
    LongJob job("reading");
    if (!checkIsSurface("", info)) {
        return raster.file.scan(job.monitor(), raster.voids());
    }
    Result<MapOpening> opening = MapOpening::begin(std::move(raster), defaultMapResources());
    if (!opening) {
        return std::move(opening).error();
    }
    const std::vector<std::string>& notices = opening->notices();
    info.notices.insert(info.notices.end(), notices.begin(), notices.end());
    Result<SampleStatistics> statistics = opening->statistics(job.monitor());
    if (statistics && opening->isEstimated()) {
        info.notices.emplace_back("minimum, maximum and voids are estimated from an overview");
    }
    return statistics;
}

// A raster and its --json output.
struct Description {
    RasterInfo info;
    Json json;
};

Result<Description> describe(const MapOptions& options, bool has_statistics)
{
    Result<OpenRaster> raster = openRaster(options);
    if (!raster) {
        return std::move(raster).error();
    }
    RasterInfo info = raster->info;
    std::optional<SampleStatistics> statistics;
    if (has_statistics) {
        const Result<SampleStatistics> computed = statisticsOf(std::move(*raster), info);
        if (computed) {
            statistics = *computed;
            noteSuspiciousSamples(info, *statistics);
            info.notices = noticesWithOptions(info);
        } else if (computed.error().code == ErrorCode::TooLarge) {
            const std::string path = addressOf(info.path) + ": ";
            const std::string& why = computed.error().message;
            info.notices.push_back("minimum, maximum and voids are not computed: " +
                                   (why.starts_with(path) ? why.substr(path.size()) : why));
        } else {
            return computed.error();
        }
    }
    // It can be described, but commands that need a surface refuse it.
    if (const Status surface = checkIsSurface("", info); !surface) {
        constexpr std::string_view kNoPath = ": ";
        info.notices.push_back(surface.error().message.substr(kNoPath.size()));
    }
    Json json = withSchema(mapReport(info, statistics, options.latitudeKind(info.body)));
    return Description{std::move(info), std::move(json)};
}

// Describes every file; if several fail, all errors but the last are printed here.
Status runInfo(const InfoOptions& options)
{
    const ErrorForm form = options.is_json ? ErrorForm::Json : ErrorForm::Line;
    Json array = Json::array();
    std::vector<RasterInfo> infos; // the described rasters
    Status outcome = Done{};
    bool is_first = true;
    for (const std::string& path : options.paths) {
        MapOptions map = options.map;
        map.path = path;
        Result<Description> described = describe(map, options.has_statistics);
        if (!described) {
            if (!outcome) {
                printError(outcome.error().message, 1, form);
            }
            outcome = std::move(described).error();
            if (outcome.error().code == ErrorCode::Canceled) {
                break;
            }
            continue;
        }
        if (options.is_json) {
            array.push_back(described->json);
            infos.push_back(std::move(described->info));
            continue;
        }
        if (!is_first) {
            printLine("");
        }
        is_first = false;
        printForPeople(described->json, described->info);
        std::fflush(stdout); // before the notices
        printNotices(described->info);
    }
    if (options.is_json && options.paths.size() > 1) {
        printJson(array);
    } else if (!array.empty()) {
        printJson(array.front());
    }
    std::fflush(stdout);
    for (const RasterInfo& info : infos) {
        printNotices(info);
    }
    return outcome;
}

} // namespace

void addInfoCommand(CLI::App& app, CommandAction& run)
{
    const auto options = std::make_shared<InfoOptions>();
    CLI::App* command =
        app.add_subcommand("info", "Describe rasters: type, placement, units, range");
    command
        ->add_option("DEM", options->paths,
                     "elevation maps: files, labels, addresses, or GDAL dataset names")
        ->type_name("FILE")
        ->required()
        ->transform(fileName());
    options->map.addOverridesTo(*command);
    command->add_flag("--json", options->is_json,
                      "print JSON: an object, or an array of objects for several files");
    command->add_flag_callback(
        "--no-statistics", [options] { options->has_statistics = false; },
        "do not read the samples: minimum, maximum and voids are then unknown");
    command->callback([options, &run] { run = [options] { return runInfo(*options); }; });
}

} // namespace marsview
