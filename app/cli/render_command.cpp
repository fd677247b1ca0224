// marsview-cli render: one picture of the terrain, without a window.

#include "app/cli/commands.h"
#include "app/console/number_checks.h"
#include "app/console/output_file.h"
#include "app/console/picture.h"
#include "app/console/scene.h"
#include "app/console/scene_option.h"
#include "core/files/picture_file.h"
#include "core/sources/output_check.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace marsview {
namespace {

struct RenderOptions {
    MapOptions map;
    std::string output;
    std::string size = "1280x800";
    std::vector<double> look_at;
    std::optional<double> distance_m;
    double azimuth_deg = 0.0;
    std::optional<double> tilt_deg;
    std::optional<double> exaggeration;
    double error_px = 1.0;
    bool is_full = false;
    std::optional<int> samples;
    std::string shading = "tint";
    std::string ramp;
    std::vector<double> light_deg{315.0, 45.0};
    std::vector<double> sun_at; // longitude and latitude
    bool has_contours = false;
    SceneKind scene = SceneKind::Flat;
    PileOptions pile;
};

// The latitude is of the map's kind, as in other positions.
GeographicPoint placeFrom(const RenderOptions& options, const Map& map)
{
    const RasterInfo& info = map.info();
    const Angle latitude = Angle::degrees(options.sun_at.back());
    const bool is_converted = options.map.latitudeKind(info.body) == LatitudeKind::Planetographic &&
                              info.crs && info.crs->ellipsoid();
    return {.longitude = Angle::degrees(options.sun_at.front()),
            .latitude = is_converted ? info.crs->ellipsoid()->planetocentric(latitude) : latitude};
}

// What no check of a single number finds.
void checkSun(const RenderOptions& options)
{
    constexpr double kLatitudeMax = 90.0;
    if (options.sun_at.empty()) {
        return;
    }
    if (std::abs(options.sun_at.back()) > kLatitudeMax) {
        throw CLI::ValidationError(
            "--sun-at", fmt::format("latitude {} is beyond 90 degrees", options.sun_at.back()));
    }
    if (options.scene != SceneKind::Body) {
        throw CLI::ValidationError(
            "--sun-at", "a flat map has the light of the view; add --scene body or use --light");
    }
}

Status runRender(const RenderOptions& options)
{
    const Result<OpenFiles> inputs = checkOutputs(
        {.maps = options.pile.withPath(options.map.path), .read = {}, .written = {options.output}});
    if (!inputs) {
        return inputs.error();
    }
    const Result<Viewport> viewport = viewportFrom(options.size);
    if (!viewport) {
        return viewport.error();
    }
    const ColorRamp* ramp = options.ramp.empty() ? nullptr : colorRampNamed(options.ramp);
    Result<Scene> scene = openScene(options.map, ramp, {}, options.scene, options.pile);
    if (!scene) {
        return std::move(scene).error();
    }
    PictureOptions picture_options{
        .viewport = *viewport,
        .distance_m = options.distance_m,
        .azimuth_deg = options.azimuth_deg,
        .tilt_deg = options.tilt_deg,
        .exaggeration = options.exaggeration,
        .error_px = options.error_px,
        .has_every_sample = options.is_full,
        .samples = options.samples,
        .shading = options.shading == "tint"        ? ShadingMode::Tint
                   : options.shading == "hillshade" ? ShadingMode::Hillshade
                                                    : ShadingMode::Slope,
        .light_deg = {options.light_deg.front(), options.light_deg.back()},
        .has_contours = options.has_contours,
    };
    if (!options.look_at.empty()) {
        picture_options.look_at = MapPoint{options.look_at.front(), options.look_at.back()};
    }
    if (!options.sun_at.empty()) {
        picture_options.subsolar = placeFrom(options, *scene->map);
    }
    const Result<OffscreenPicture> picture = drawPicture(*scene, picture_options);
    if (!picture) {
        return picture.error();
    }
    const InterruptIgnored ignored;
    Status written = writePng(picture->colors, options.output);
    if (written) {
        std::fprintf(stderr, "%s: %zu triangles, 99 %% of the pixels within %.2g pixels\n",
                     options.output.c_str(), picture->report.triangle_count,
                     picture->report.error_px);
        printNotices(scene->map->info());
    }
    return written;
}

} // namespace

void addRenderCommand(CLI::App& app, CommandAction& run)
{
    const auto options = std::make_shared<RenderOptions>();
    CLI::App* command =
        app.add_subcommand("render", "Draw a picture of the terrain, by default of the whole map");
    options->map.addTo(*command);
    command->add_option("-o,--output", options->output, "PNG file to write")
        ->type_name("FILE")
        ->transform(fileName())
        ->required()
        ->check(fileNameEndingIn({".png"}));
    command->add_option("--size", options->size, "width and height in pixels")
        ->type_name("WxH")
        ->capture_default_str()
        ->check(pictureSize());
    command->add_option("--look-at", options->look_at, "X,Y at the center of the picture, map CRS")
        ->delimiter(',')
        ->expected(2)
        ->check(finiteNumber());
    command->add_option("--distance", options->distance_m, "of the camera from there, meters")
        ->check(positiveNumber());
    command
        ->add_option("--azimuth", options->azimuth_deg,
                     "heading of the view, degrees clockwise from north")
        ->check(finiteNumber());
    command->add_option("--tilt", options->tilt_deg, "0 looks straight down, at most 85 degrees")
        ->check(numberFrom(0.0, 85.0));
    command->add_option("--exaggeration", options->exaggeration, "vertical exaggeration")
        ->check(exaggerationFactor());
    auto* error =
        command
            ->add_option("--error-px", options->error_px, "largest error of the surface, in pixels")
            ->capture_default_str()
            ->check(positiveNumber());
    command->add_flag("--full", options->is_full, "draw every sample")->excludes(error);
    command
        ->add_option("--samples", options->samples,
                     "per pixel, for anti-aliasing; by default 4, or 9 where neighboring pixels "
                     "differ much and with --full")
        ->check(wholeNumberFrom(1, 16));
    command->add_option("--shading", options->shading, "tint, hillshade or slope")
        ->capture_default_str()
        ->check(oneOf({"tint", "hillshade", "slope"}));
    std::vector<std::string> ramps;
    for (const ColorRamp& known : colorRamps()) {
        ramps.emplace_back(known.name);
    }
    command->add_option("--ramp", options->ramp, "color ramp; by default the one for the body")
        ->check(oneOf(ramps));
    auto* light = command
                      ->add_option("--light", options->light_deg,
                                   "azimuth,altitude of the light source, degrees")
                      ->delimiter(',')
                      ->expected(2)
                      ->capture_default_str()
                      ->check(finiteNumber());
    command
        ->add_option("--sun-at", options->sun_at,
                     "LON,LAT where the sun is overhead, degrees, east-positive; the light is then "
                     "fixed on the body, whose night is dark; with --scene body")
        ->type_name("LON,LAT")
        ->delimiter(',')
        ->expected(2)
        ->check(finiteNumber())
        ->excludes(light);
    command->add_flag("--contours", options->has_contours, "draw contour lines");
    addSceneOption(*command, options->scene);
    options->pile.addTo(*command);
    command->callback([options, &run] {
        checkSun(*options);
        options->pile.check(options->scene);
        run = [options] { return runRender(*options); };
    });
}

} // namespace marsview
