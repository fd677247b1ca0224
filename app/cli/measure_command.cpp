// marsview-cli measure: distances, profiles and other measurements on the body's ellipsoid.

#include "app/cli/commands.h"
#include "app/cli/measure_input.h"
#include "app/console/long_job.h"
#include "app/console/number_checks.h"
#include "app/console/text_output.h"
#include "core/measure/line_measures.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

namespace marsview {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A length over terrain that is partly void is unknown.
double wholeSurface(double surface_m, double void_m)
{
    return void_m > 0.0 ? kNan : surface_m;
}

void printVoidNotice(const MeasureOptions& options, double void_m)
{
    if (void_m > 0.0) {
        std::fprintf(stderr,
                     "marsview-cli: %s: %s m of the line are outside the map or on nodata, so "
                     "there is no length along the terrain\n",
                     asOneLine(options.map.path).c_str(), asText(void_m).c_str());
    }
}

Json reportOf(const Distance& distance)
{
    Json legs = Json::array();
    for (const LegDistance& leg : distance.legs) {
        legs.push_back({{"geodesic_m", asJson(leg.geodesic_m)},
                        {"azimuth_deg", asJson(leg.azimuth_deg)},
                        {"surface_m", asJson(wholeSurface(leg.surface_m, leg.void_m))},
                        {"rise_m", asJson(leg.rise_m)}});
    }
    return {{"geodesic_m", asJson(distance.geodesic_m)},
            {"surface_m", asJson(wholeSurface(distance.surface_m, distance.void_m))},
            {"straight_m", asJson(distance.straight_m)},
            {"rise_m", asJson(distance.rise_m)},
            {"legs", std::move(legs)}};
}

void printForPeople(const Distance& distance)
{
    const auto line = [](const char* label, double value) {
        printLine(fmt::format("{:<22}{} m", label, asText(value)));
    };
    line("Geodesic distance:", distance.geodesic_m);
    line("Along the terrain:", wholeSurface(distance.surface_m, distance.void_m));
    line("Straight line:", distance.straight_m);
    line("Rise:", distance.rise_m);
    for (std::size_t i = 0; distance.legs.size() > 1 && i < distance.legs.size(); ++i) {
        const LegDistance& leg = distance.legs[i];
        printLine(fmt::format("Leg {}: {} m, azimuth {}°, along the terrain {} m, rise {} m", i + 1,
                              asText(leg.geodesic_m), asText(leg.azimuth_deg),
                              asText(wholeSurface(leg.surface_m, leg.void_m)), asText(leg.rise_m)));
    }
}

Status runDistance(const MeasureOptions& options)
{
    Result<MeasureInput> input = openMeasureInput(options);
    if (!input) {
        return std::move(input).error();
    }
    LongJob job("measuring");
    Result<Distance> distance = measureDistance(*input->terrain, input->positions, job.monitor());
    if (!distance) {
        return measureError(options, std::move(distance).error());
    }
    if (options.is_json) {
        printJson(withSchema(reportOf(*distance)));
    } else {
        printForPeople(*distance);
    }
    printVoidNotice(options, distance->void_m);
    printNotices(input->raster->info);
    return Done{};
}

struct ProfileOptions {
    MeasureOptions common;
    std::optional<double> step_m;
};

Status runProfile(const ProfileOptions& options)
{
    Result<MeasureInput> input = openMeasureInput(options.common);
    if (!input) {
        return std::move(input).error();
    }
    LongJob job("measuring");
    Result<Profile> profile =
        measureProfile(*input->terrain, input->positions, options.step_m, job.monitor());
    if (!profile) {
        return measureError(options.common, std::move(profile).error());
    }
    Json points = Json::array();
    if (!options.common.is_json) {
        printLine("distance_m,lon,lat,x,y,elevation_m");
    }
    for (const ProfilePoint& point : profile->points) {
        const GroundPosition lonlat = input->lonLat(point.position);
        const MapPoint map = input->terrain->toMap(point.position).value_or(MapPoint{kNan, kNan});
        if (options.common.is_json) {
            points.push_back({{"distance_m", asJson(point.distance_m)},
                              {"lon", asJson(lonlat.x)},
                              {"lat", asJson(lonlat.y)},
                              {"x", asJson(map.x)},
                              {"y", asJson(map.y)},
                              {"elevation_m", asJson(point.elevation_m)}});
        } else {
            printLine(fmt::format("{},{},{},{},{},{}", asText(point.distance_m), asText(lonlat.x),
                                  asText(lonlat.y), asText(map.x), asText(map.y),
                                  asText(point.elevation_m)));
        }
    }
    if (options.common.is_json) {
        printJson(withSchema({{"points", std::move(points)}}));
    }
    printNotices(input->raster->info);
    return Done{};
}

void addDistance(CLI::App& measure, CommandAction& run)
{
    const auto options = std::make_shared<MeasureOptions>();
    CLI::App* command = measure.add_subcommand(
        "distance", "Measure the distance along positions: geodesic, along the terrain, straight");
    options->addTo(*command);
    command->callback([options, &run] { run = [options] { return runDistance(*options); }; });
}

void addProfile(CLI::App& measure, CommandAction& run)
{
    const auto options = std::make_shared<ProfileOptions>();
    CLI::App* command = measure.add_subcommand(
        "profile", "Print the elevations along the geodesics between positions as CSV");
    options->common.addTo(*command);
    command
        ->add_option("--step", options->step_m,
                     "distance between points in meters; by default a point at every edge of the "
                     "terrain's triangles")
        ->check(positiveNumber());
    command->callback([options, &run] { run = [options] { return runProfile(*options); }; });
}

} // namespace

void addMeasureCommand(CLI::App& app, CommandAction& run)
{
    CLI::App* measure =
        app.add_subcommand("measure", "Measure on the terrain, on the ellipsoid of its body");
    measure->require_subcommand(1);
    addDistance(*measure, run);
    addProfile(*measure, run);
}

} // namespace marsview
