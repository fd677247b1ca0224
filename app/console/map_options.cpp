#include "app/console/map_options.h"

#include "app/console/long_job.h"
#include "app/console/number_checks.h"
#include "app/console/text_output.h"
#include "core/base/nearest_word.h"
#include "core/files/remote_raster.h"
#include "core/geo/crs.h"
#include "core/raster/sample_suggestions.h"
#include "core/session/map.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <optional>

namespace marsview {
namespace {

CLI::Validator knownBody()
{
    return {[](std::string& name) {
                if (bodyNamed(name) != nullptr) {
                    return std::string();
                }
                std::vector<std::string> names;
                for (const Body& body : knownBodies()) {
                    names.emplace_back(body.name);
                }
                return fmt::format("unknown body \"{}\"{}", name, didYouMeanOrKnown(name, names));
            },
            ""};
}

CLI::Validator knownUnit()
{
    return {[](std::string& name) {
                return verticalUnitFrom(name)
                           ? std::string()
                           : fmt::format("unknown unit \"{}\"; use m, km, ft or \"US survey ft\"",
                                         name);
            },
            ""};
}

CLI::Validator knownCrs()
{
    return {[](std::string& text) {
                const Result<Crs> crs = Crs::fromText(text);
                return crs ? std::string() : crs.error().message;
            },
            ""};
}

} // namespace

void MapOptions::addTo(CLI::App& command)
{
    command
        .add_option("DEM", path,
                    "elevation map: a file, a label, an address, or a GDAL dataset name")
        ->type_name("FILE")
        ->required()
        ->transform(fileName());
    addOverridesTo(command);
}

void MapOptions::addOverridesTo(CLI::App& command)
{
    const std::string group = "Overrides of the file's metadata";
    command.add_option("--band", band, "band to read, starting at 1")
        ->group(group)
        ->check(wholeNumberFrom(1, std::numeric_limits<int>::max()));
    command.add_option("--crs", crs, "EPSG:… or IAU_2015:… code, PROJ string or WKT")
        ->group(group)
        ->check(knownCrs());
    command.add_option("--body", body, "Mars, Moon, Earth, …")->group(group)->check(knownBody());
    const auto set_radii = [this](const std::vector<double>& meters) {
        if (meters.front() < meters.back()) {
            throw CLI::ValidationError(
                "--radii", fmt::format("the equatorial radius, {}, is below the polar one, {}",
                                       meters.front(), meters.back()));
        }
        radii_m = meters;
    };
    constexpr double kRadiusMinM = 10.0;
    constexpr double kRadiusMaxM = 1e9; // the Sun's is 7e8
    command
        .add_option_function<std::vector<double>>(
            "--radii", set_radii, "equatorial and polar radius of the ellipsoid in meters")
        ->expected(1, 2)
        ->group(group)
        ->check(numberFrom(kRadiusMinM, kRadiusMaxM));
    const auto set_geotransform = [this](const std::vector<double>& values) {
        GeoTransform::Terms terms{};
        std::copy_n(values.begin(), std::min(values.size(), terms.size()), terms.begin());
        if (const Result<GeoTransform> transform = GeoTransform::fromTerms(terms); !transform) {
            throw CLI::ValidationError("--geotransform", transform.error().message);
        }
        geotransform = values;
    };
    command
        .add_option_function<std::vector<double>>(
            "--geotransform", set_geotransform,
            "x0 dx/dcolumn dx/drow y0 dy/dcolumn dy/drow, of the first pixel's outer corner")
        ->expected(6)
        ->group(group)
        ->check(finiteNumber());
    command
        .add_option("--unit", vertical_unit, "unit of the elevations: m, km, ft, \"US survey ft\"")
        ->group(group)
        ->check(knownUnit());
    command
        .add_option("--scale", scale,
                    "elevation = sample × scale + offset, in the unit of the elevations")
        ->check(nonZeroNumber())
        ->group(group);
    command.add_option("--offset", offset, "added to the scaled samples")
        ->check(finiteNumber())
        ->group(group);
    command
        .add_option("--vertical-datum", vertical_datum,
                    "surface that elevations refer to: areoid, EGM96 geoid, …")
        ->check(someText())
        ->group(group);
    command.add_option("--nodata", nodata, "raw value that marks nodata")
        ->group(group)
        ->check(anyNumber());
    command
        .add_option("--latitude", latitude,
                    "kind of latitude: planetocentric (default; on the Earth: planetographic)")
        ->check(oneOf({"planetocentric", "planetographic"}));
}

RasterOverrides MapOptions::overrides() const
{
    RasterOverrides overrides;
    const auto given = [](const std::string& text) {
        return text.empty() ? std::nullopt : std::optional<std::string>(text);
    };
    overrides.crs = given(crs);
    overrides.body = given(body);
    overrides.vertical_unit = given(vertical_unit);
    overrides.scale = scale;
    overrides.offset = offset;
    overrides.vertical_datum = given(vertical_datum);
    overrides.nodata = nodata;
    if (!radii_m.empty()) {
        overrides.ellipsoid = Ellipsoid{radii_m.front(), radii_m.back()};
    }
    if (!geotransform.empty()) {
        GeoTransform::Terms terms{};
        std::copy(geotransform.begin(), geotransform.end(), terms.begin());
        overrides.transform = terms;
    }
    return overrides;
}

RasterSpec MapOptions::spec() const
{
    return {.path = path, .band = band, .overrides = overrides()};
}

std::vector<std::string> MapOptions::overrideArguments() const
{
    std::vector<std::string> words;
    const auto add = [&words](const char* name, const std::string& value) {
        if (!value.empty()) {
            words.insert(words.end(), {name, value});
        }
    };
    const auto add_all = [&words](const char* name, const std::vector<double>& values) {
        if (!values.empty()) {
            words.emplace_back(name);
            std::transform(values.begin(), values.end(), std::back_inserter(words), asText);
        }
    };
    add("--band", std::to_string(band));
    add("--crs", crs);
    add("--body", body);
    add_all("--radii", radii_m);
    add_all("--geotransform", geotransform);
    add("--unit", vertical_unit);
    add("--scale", scale ? asText(*scale) : std::string());
    add("--offset", offset ? asText(*offset) : std::string());
    add("--vertical-datum", vertical_datum);
    add("--nodata", nodata ? asText(*nodata) : std::string());
    add("--latitude", latitude);
    return words;
}

bool MapOptions::hasOverrides() const
{
    return band != 1 || !crs.empty() || !body.empty() || !radii_m.empty() ||
           !geotransform.empty() || !vertical_unit.empty() || scale || offset ||
           !vertical_datum.empty() || nodata || !latitude.empty();
}

LatitudeKind MapOptions::latitudeKind(const Body* of_body) const
{
    if (latitude == "planetographic") {
        return LatitudeKind::Planetographic;
    }
    if (latitude == "planetocentric" || of_body == nullptr) {
        return LatitudeKind::Planetocentric;
    }
    return of_body->latitude;
}

Result<OpenRaster> openRaster(const MapOptions& options)
{
    std::optional<LongJob> job;
    if (!LongJob::isRunning()) {
        job.emplace("opening");
    }
    Result<OpenRaster> raster = openRaster(options.spec());
    if (raster) {
        raster->info.notices = noticesWithOptions(raster->info);
    }
    return raster;
}

std::vector<std::string> noticesWithOptions(const RasterInfo& info)
{
    std::vector<std::string> notices = info.notices;
    const auto name_option = [&notices](const auto& suggestion) {
        if (suggestion) {
            std::replace(notices.begin(), notices.end(), noticeOf(*suggestion),
                         optionNoticeOf(*suggestion));
        }
    };
    name_option(info.crs_suggestion);
    name_option(info.unit_suggestion);
    name_option(info.elevation_misfit);
    return notices;
}

void printNotices(const RasterInfo& info)
{
    for (const std::string& notice : noticesWithOptions(info)) {
        std::fprintf(stderr, "marsview-cli: %s\n",
                     asOneLine(addressOf(info.path) + ": " + notice).c_str());
    }
}

} // namespace marsview
