// marsview-cli measure: distances, profiles and other measurements on the body's ellipsoid.

#include "app/cli/commands.h"
#include "app/cli/measure_input.h"
#include "app/console/long_job.h"
#include "app/console/measure_report.h"
#include "app/console/number_checks.h"
#include "app/console/text_output.h"
#include "core/measure/attitude.h"
#include "core/measure/constants.h"
#include "core/measure/crater.h"
#include "core/measure/hypsometry.h"
#include "core/measure/line_measures.h"
#include "core/measure/measured_digits.h"
#include "core/measure/terrain_area.h"
#include "core/measure/terrain_slope.h"
#include "core/session/measurement_tables.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

namespace marsview {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

void printVoidNotice(const MeasureOptions& options, double void_m)
{
    if (void_m > 0.0) {
        std::fprintf(stderr,
                     "marsview-cli: %s: %.6g m of the line are outside the map or on nodata; "
                     "the length along the terrain is unknown\n",
                     asOneLine(options.map.path).c_str(), void_m);
    }
}

// With the digits that mean something. JSON and CSV have all of them.
std::string written(double value, int last_place)
{
    if (!std::isfinite(value)) {
        return asText(value);
    }
    const WrittenNumber number = writtenNumber(value, last_place);
    return fmt::format("{:.{}f}", number.value == 0.0 ? 0.0 : number.value, number.decimals);
}

// An uncertainty itself.
std::string writtenError(double value)
{
    return written(value, lastPlace(value, value));
}

MeasuredDigits digitsOf(const MeasureInput& input)
{
    const double elevation_m =
        input.positions.empty() ? kNan : input.terrain->elevation(input.positions.front());
    return MeasuredDigits(
        resolutionOf(input.terrain->georeference(), input.raster->info, elevation_m));
}

// Of the coordinates of something's middle, in the units that positions have; its RMS is 0 without
// residuals. A coordinate of 0 is a place like others: its digits do not depend on its size.
int lastPlaceOfPosition(const MeasureInput& input, double rms_m)
{
    const double sample_m =
        resolutionOf(input.terrain->georeference(), input.raster->info, kNan).ground_m;
    const auto& ellipsoid = input.terrain->ground().ellipsoid();
    const double unit_m = ellipsoid ? ellipsoid->equatorial_m / kDegreesPerRadian : 1.0;
    return lastPlace(0.0, (rms_m > 0.0 ? std::max(rms_m, 0.1 * sample_m) : sample_m) / unit_m);
}

void printForPeople(const Distance& distance, const MeasuredDigits& digits)
{
    const auto length = [&digits](double value) { return written(value, digits.length(value)); };
    const auto rise = [&digits](double value) { return written(value, digits.elevation(value)); };
    const auto line = [](const char* label, const std::string& value) {
        printLine(fmt::format("{:<22}{} m", label, value));
    };
    line("Geodesic distance:", length(distance.geodesic_m));
    line("Along the terrain:", length(wholeSurface(distance.surface_m, distance.void_m)));
    line("Straight line:", length(distance.straight_m));
    line("Rise:", rise(distance.rise_m));
    for (std::size_t i = 0; distance.legs.size() > 1 && i < distance.legs.size(); ++i) {
        const LegDistance& leg = distance.legs[i];
        printLine(fmt::format("Leg {}: {} m, azimuth {}°, along the terrain {} m, rise {} m", i + 1,
                              length(leg.geodesic_m),
                              written(leg.azimuth_deg, digits.direction(leg.geodesic_m)),
                              length(wholeSurface(leg.surface_m, leg.void_m)), rise(leg.rise_m)));
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
        printForPeople(*distance, digitsOf(*input));
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

struct AttitudeCommand {
    MeasureOptions common;
    std::optional<double> elevation_error_m;
};

constexpr const char* kNoErrors = "three points: no error estimate";

void printForPeople(const Attitude& attitude)
{
    const auto line = [](const char* label, const std::string& text) {
        printLine(fmt::format("{:<16}{}", label, text));
    };
    const AttitudeUncertainty& uncertainty = attitude.uncertainty;
    const auto with_error = [&](double degrees, double error_deg) {
        const int place = uncertainty.is_estimated ? anglePlace(error_deg) : kSlopePlace;
        return uncertainty.is_estimated
                   ? fmt::format("{}° ± {}°", written(degrees, place), written(error_deg, place))
                   : fmt::format("{}°", written(degrees, place));
    };
    line("Strike:", with_error(attitude.strike_deg, uncertainty.strike_error_deg));
    line("Dip:", with_error(attitude.dip_deg, uncertainty.dip_error_deg));
    line("Dip direction:", fmt::format("{}°", written(attitude.dip_direction_deg,
                                                      uncertainty.is_estimated
                                                          ? anglePlace(uncertainty.strike_error_deg)
                                                          : kSlopePlace)));
    if (!uncertainty.is_estimated) {
        line("Errors:", kNoErrors);
    }
    line("RMS:",
         attitude.hasResiduals() ? fmt::format("{} m", writtenError(attitude.rms_m)) : kNoErrors);
    line("Points:", std::to_string(attitude.points));
}

Status runAttitude(const AttitudeCommand& options)
{
    Result<MeasureInput> input = openMeasureInput(options.common);
    if (!input) {
        return std::move(input).error();
    }
    double elevation_m = 0.0;
    if (!input->positions.empty()) {
        elevation_m = input->terrain->elevation(input->positions.front());
    }
    const Result<Attitude> attitude = measureAttitude(
        *input->terrain, input->openPositions(),
        {.elevation_error_m = options.elevation_error_m,
         .default_elevation_error_m = elevationStepError(input->raster->info, elevation_m)});
    if (!attitude) {
        return measureError(options.common, attitude.error());
    }
    if (options.common.is_json) {
        printJson(withSchema(
            reportOf(*attitude, input->lonLat(input->terrain->inTurn(attitude->center)))));
    } else {
        printForPeople(*attitude);
    }
    if (!options.elevation_error_m && attitude->uncertainty.elevation_error_m) {
        std::fprintf(stderr,
                     "marsview-cli: %s: three points have no residuals; errors in JSON follow from "
                     "an elevation error of %s m, half the step of the samples; state yours with "
                     "--elevation-error\n",
                     asOneLine(options.common.map.path).c_str(),
                     asText(*attitude->uncertainty.elevation_error_m).c_str());
    }
    printNotices(input->raster->info);
    return Done{};
}

struct AreaCommand {
    MeasureOptions common;
    std::string base;
    bool has_hypsometry = false;
    std::optional<double> step_m;

    AreaOptions options() const
    {
        AreaOptions options{.hypsometry_step_m = step_m};
        if (!base.empty()) {
            const std::optional<double> elevation_m = parseNumber(base);
            options.base = elevation_m ? VolumeBase::Elevation : VolumeBase::BorderPlane;
            options.base_m = elevation_m.value_or(0.0);
        }
        return options;
    }
};

CLI::Validator volumeBase()
{
    return {[](std::string& text) {
                const std::optional<double> value = parseNumber(text);
                return text == "plane" || (value && std::isfinite(*value))
                           ? std::string()
                           : fmt::format("\"{}\" is neither an elevation in meters nor plane",
                                         text);
            },
            ""};
}

// What of a polygon has no terrain, beyond the accuracy of sums over cells.
void printUncoveredNotice(const MeasureOptions& options, const TerrainArea& area)
{
    constexpr double kShareMin = 1e-4;
    const double missing_m2 = area.geodesic_m2 - area.covered_m2;
    if (!area.crosses_itself && missing_m2 > kShareMin * area.geodesic_m2) {
        std::fprintf(
            stderr,
            "marsview-cli: %s: %.3g %% of the polygon are outside the map or on nodata and "
            "do not count for the terrain\n",
            asOneLine(options.map.path).c_str(), 100.0 * missing_m2 / area.geodesic_m2);
    }
    if (area.crosses_itself) {
        std::fprintf(stderr,
                     "marsview-cli: %s: edges of the polygon cross; parts enclosed in opposite "
                     "directions cancel in its area, and the terrain in it is not measured\n",
                     asOneLine(options.positionsName()).c_str());
    }
}

void printForPeople(const TerrainArea& area, const MeasuredDigits& digits)
{
    const auto line = [](const char* label, double value, int last_place, const char* unit) {
        if (!std::isnan(value)) {
            printLine(fmt::format("{:<20}{} {}", label, written(value, last_place), unit));
        }
    };
    const int area_place = digits.area(area.geodesic_m2, area.perimeter_m);
    line("Geodesic area:", area.geodesic_m2, area_place, "m²");
    line("Perimeter:", area.perimeter_m, digits.length(area.perimeter_m), "m");
    line("Terrain area:", area.surface_m2, area_place, "m²");
    line("Lowest elevation:", area.min_m, digits.elevation(area.min_m), "m");
    line("Highest elevation:", area.max_m, digits.elevation(area.max_m), "m");
    line("Mean elevation:", area.mean_m, digits.elevation(area.mean_m), "m");
    if (area.volume_above_m3) {
        line("Volume above base:", *area.volume_above_m3,
             digits.volume(*area.volume_above_m3, area.geodesic_m2), "m³");
        line("Volume below base:", *area.volume_below_m3,
             digits.volume(*area.volume_below_m3, area.geodesic_m2), "m³");
    }
}

// The classes as chosen, or some fifty of them.
Hypsometry printedHypsometry(const AreaCommand& options, const TerrainArea& area)
{
    constexpr std::size_t kClassesMax = 50;
    return options.step_m ? area.hypsometry : withFewerClasses(area.hypsometry, kClassesMax);
}

Status runArea(const AreaCommand& options)
{
    Result<MeasureInput> input = openMeasureInput(options.common);
    if (!input) {
        return std::move(input).error();
    }
    if (const Status base = checkVolumeBase(input->terrain->ground(), options.options()); !base) {
        return Error{base.error().code, "--base: " + base.error().message};
    }
    LongJob job("measuring");
    const Result<TerrainArea> area =
        measureArea(*input->terrain, input->positions, options.options(), job.monitor());
    if (!area) {
        return measureError(options.common, area.error());
    }
    const Hypsometry hypsometry = printedHypsometry(options, *area);
    if (options.common.is_json) {
        Json json = reportOf(*area);
        if (options.has_hypsometry) {
            json["hypsometry"] = reportOf(hypsometry);
        }
        printJson(withSchema(json));
    } else if (options.has_hypsometry) {
        std::fputs(hypsometryCsv(hypsometry).c_str(), stdout);
    } else {
        printForPeople(*area, digitsOf(*input));
    }
    printUncoveredNotice(options.common, *area);
    printNotices(input->raster->info);
    return Done{};
}

Status runCrater(const MeasureOptions& options)
{
    Result<MeasureInput> input = openMeasureInput(options);
    if (!input) {
        return std::move(input).error();
    }
    LongJob job("measuring");
    const Result<Crater> crater =
        measureCrater(*input->terrain, input->openPositions(), job.monitor());
    if (!crater) {
        return measureError(options, crater.error());
    }
    const GroundPosition center = input->lonLat(input->terrain->inTurn(crater->center));
    if (options.is_json) {
        const MapPoint map = input->terrain->toMap(crater->center).value_or(MapPoint{kNan, kNan});
        printJson(withSchema(reportOf(*crater, center, map)));
    } else {
        const auto line = [](const char* label, const std::string& text) {
            printLine(fmt::format("{:<12}{}", label, text));
        };
        const MeasuredDigits digits = digitsOf(*input);
        const auto height = [&](const char* label, double value_m) {
            line(label, written(value_m, digits.depth(*crater)) + " m");
        };
        const double rms_m = crater->hasResiduals() ? crater->rms_m : 0.0;
        const int place = lastPlaceOfPosition(*input, rms_m);
        line("Center:", fmt::format("{}, {}", written(center.x, place), written(center.y, place)));
        line("Diameter:",
             written(crater->diameter_m, digits.diameter(crater->diameter_m, rms_m)) + " m");
        height("Depth:", crater->depth_m);
        line("d/D:",
             written(crater->depth_m / crater->diameter_m, digits.depthToDiameter(*crater)));
        height("Rim:", crater->rim_m);
        height("Floor:", crater->floor_m);
        line("RMS:", crater->hasResiduals() ? writtenError(rms_m) + " m" : kNoErrors);
    }
    printNotices(input->raster->info);
    return Done{};
}

struct SlopeOptions {
    MeasureOptions common;
    std::optional<double> baseline_m;
};

Status runSlope(const SlopeOptions& options)
{
    Result<MeasureInput> input = openMeasureInput(options.common);
    if (!input) {
        return std::move(input).error();
    }
    const double baseline_max_m = longestBaselineM(input->terrain->ground());
    if (options.baseline_m && *options.baseline_m > baseline_max_m) {
        return Error{ErrorCode::OutOfRange,
                     fmt::format("--baseline: {} m reach more than half way around the body; use "
                                 "at most {:.0f} m",
                                 *options.baseline_m, baseline_max_m)};
    }
    LongJob job("measuring");
    Result<std::vector<TerrainSlope>> slopes =
        measureSlopes(*input->terrain, input->positions, options.baseline_m, job.monitor());
    if (!slopes) {
        return measureError(options.common, std::move(slopes).error());
    }
    Json json;
    if (slopes->size() == 1) {
        json["slope_deg"] = asJson(slopes->front().slope_deg);
        json["aspect_deg"] = asJson(slopes->front().aspect_deg);
    }
    json["positions"] = Json::array();
    if (!options.common.is_json) {
        printLine("lon,lat,x,y,elevation_m,slope_deg,aspect_deg");
    }
    for (std::size_t i = 0; i < slopes->size(); ++i) {
        const TerrainSlope& slope = (*slopes)[i];
        const GroundPosition lonlat = input->lonLat(input->positions[i]);
        const MapPoint map =
            input->terrain->toMap(input->positions[i]).value_or(MapPoint{kNan, kNan});
        if (options.common.is_json) {
            json["positions"].push_back({{"lon", asJson(lonlat.x)},
                                         {"lat", asJson(lonlat.y)},
                                         {"x", asJson(map.x)},
                                         {"y", asJson(map.y)},
                                         {"elevation_m", asJson(slope.elevation_m)},
                                         {"slope_deg", asJson(slope.slope_deg)},
                                         {"aspect_deg", asJson(slope.aspect_deg)}});
        } else {
            printLine(fmt::format("{},{},{},{},{},{},{}", asText(lonlat.x), asText(lonlat.y),
                                  asText(map.x), asText(map.y), asText(slope.elevation_m),
                                  asText(slope.slope_deg), asText(slope.aspect_deg)));
        }
    }
    if (options.common.is_json) {
        printJson(withSchema(json));
    }
    printNotices(input->raster->info);
    return Done{};
}

void addAttitude(CLI::App& measure, CommandAction& run)
{
    const auto options = std::make_shared<AttitudeCommand>();
    CLI::App* command = measure.add_subcommand(
        "attitude", "Measure strike and dip of the plane through three or more positions");
    options->common.addTo(*command);
    command
        ->add_option("--elevation-error", options->elevation_error_m,
                     "standard deviation of elevations in meters, from which the errors follow; by "
                     "default the residuals, with three positions half the step of the samples")
        ->check(positiveNumber());
    command->callback([options, &run] {
        options->common.checkSource();
        run = [options] { return runAttitude(*options); };
    });
}

void addArea(CLI::App& measure, CommandAction& run)
{
    const auto options = std::make_shared<AreaCommand>();
    CLI::App* command = measure.add_subcommand(
        "area", "Measure area, elevations and volume inside a closed polygon");
    options->common.addTo(*command);
    command
        ->add_option("--base", options->base,
                     "measure the volume above and below this elevation in meters, or above and "
                     "below the best plane through the terrain along the border (plane)")
        ->type_name("H|plane")
        ->check(volumeBase());
    CLI::Option* hypsometry = command->add_flag(
        "--hypsometry", options->has_hypsometry,
        "print the area by classes of elevation as CSV, with the area above each of them: "
        "histogram and hypsometric curve");
    command
        ->add_option("--step", options->step_m,
                     "width of the classes in meters; by default a round one, with at most fifty "
                     "classes")
        ->check(positiveNumber())
        ->needs(hypsometry);
    command->callback([options, &run] {
        options->common.checkSource();
        run = [options] { return runArea(*options); };
    });
}

void addCrater(CLI::App& measure, CommandAction& run)
{
    const auto options = std::make_shared<MeasureOptions>();
    CLI::App* command = measure.add_subcommand(
        "crater", "Measure diameter and depth of a crater through three or more rim positions");
    options->addTo(*command);
    command->callback([options, &run] {
        options->checkSource();
        run = [options] { return runCrater(*options); };
    });
}

void addSlope(CLI::App& measure, CommandAction& run)
{
    const auto options = std::make_shared<SlopeOptions>();
    CLI::App* command =
        measure.add_subcommand("slope", "Print slope and aspect of the terrain at positions");
    options->common.addTo(*command);
    command
        ->add_option("--baseline", options->baseline_m,
                     "length in meters over which the slope is measured; by default the triangle "
                     "at the position")
        ->check(positiveNumber());
    command->callback([options, &run] {
        options->common.checkSource();
        run = [options] { return runSlope(*options); };
    });
}

void addDistance(CLI::App& measure, CommandAction& run)
{
    const auto options = std::make_shared<MeasureOptions>();
    CLI::App* command = measure.add_subcommand(
        "distance", "Measure the distance along positions: geodesic, along the terrain, straight");
    options->addTo(*command);
    command->callback([options, &run] {
        options->checkSource();
        run = [options] { return runDistance(*options); };
    });
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
    command->callback([options, &run] {
        options->common.checkSource();
        run = [options] { return runProfile(*options); };
    });
}

} // namespace

void addMeasureCommand(CLI::App& app, CommandAction& run)
{
    CLI::App* measure =
        app.add_subcommand("measure", "Measure on the terrain, on the ellipsoid of its body");
    measure->require_subcommand(1);
    addDistance(*measure, run);
    addArea(*measure, run);
    addProfile(*measure, run);
    addAttitude(*measure, run);
    addCrater(*measure, run);
    addSlope(*measure, run);
}

} // namespace marsview
