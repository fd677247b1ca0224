// marsview-cli thumbnail: a small picture of a map or project, for file managers.

#include "app/cli/commands.h"
#include "app/console/long_job.h"
#include "app/console/machine.h"
#include "app/console/number_checks.h"
#include "app/console/output_file.h"
#include "app/console/picture.h"
#include "app/console/scene.h"
#include "core/files/picture_file.h"
#include "core/session/preview.h"
#include "core/session/project.h"
#include "core/session/sample_map.h"
#include "core/sources/output_check.h"
#include "core/view/color_ramp.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <utility>

namespace marsview {
namespace {

constexpr int kSideMin = 16;
constexpr int kSideMax = 1024;

struct ThumbnailOptions {
    std::string path;
    std::string output;
    int size = 256;
};

// The map itself, or the topmost visible layer of a project.
Result<LayerRecord> layerIn(const std::string& path)
{
    if (!isProjectPath(path)) {
        return LayerRecord{.spec = {.path = path}};
    }
    Result<Project> project = readProject(path, sampleMapFor(programFolder()).parent_path());
    if (!project) {
        return std::move(project).error();
    }
    if (project->layers.empty()) {
        return Error{ErrorCode::Invalid, fmt::format("{}: has no layers to draw", path)};
    }
    const auto visible = std::find_if(project->layers.begin(), project->layers.end(),
                                      [](const LayerRecord& layer) { return layer.is_visible; });
    return visible != project->layers.end() ? *visible : project->layers.front();
}

Status runThumbnail(const ThumbnailOptions& options)
{
    const Result<OpenFiles> inputs =
        checkOutputs({.maps = {options.path}, .read = {}, .written = {options.output}});
    if (!inputs) {
        return inputs.error();
    }
    const Result<LayerRecord> layer = layerIn(options.path);
    if (!layer) {
        return layer.error();
    }
    // A preview reads a bounded number of samples for a bounded time, and prepares nothing.
    JobMonitor monitor;
    Result<std::shared_ptr<const Map>> map = readPreview(layer->spec, {}, monitor);
    if (!map) {
        return std::move(map).error();
    }
    Result<Scene> scene = emptyScene();
    if (!scene) {
        return std::move(scene).error();
    }
    showIn(*scene, std::move(map).value(),
           layer->ramp.empty() ? nullptr : colorRampNamed(layer->ramp));
    PictureOptions picture_options{.viewport = {.width = options.size, .height = options.size}};
    if (layer->exaggeration > 0.0) {
        picture_options.exaggeration = layer->exaggeration;
    }
    const Result<OffscreenPicture> picture = drawPicture(*scene, picture_options);
    if (!picture) {
        return picture.error();
    }
    const InterruptIgnored ignored;
    return writePng(picture->colors, options.output);
}

} // namespace

void addThumbnailCommand(CLI::App& app, CommandAction& run)
{
    const auto options = std::make_shared<ThumbnailOptions>();
    CLI::App* command = app.add_subcommand(
        "thumbnail", "Draw a small picture of a map or project within seconds, for file managers");
    command->add_option("FILE", options->path, "raster or project (.mvproj)")
        ->transform(fileName())
        ->required();
    command->add_option("-o,--output", options->output, "PNG file to write, of any name")
        ->type_name("FILE")
        ->transform(fileName())
        ->required();
    command->add_option("--size", options->size, "width and height in pixels")
        ->type_name("PIXELS")
        ->capture_default_str()
        ->check(wholeNumberFrom(kSideMin, kSideMax));
    command->callback([options, &run] { run = [options] { return runThumbnail(*options); }; });
}

} // namespace marsview
