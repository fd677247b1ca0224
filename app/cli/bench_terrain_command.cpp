#include "app/cli/commands.h"
#include "app/cli/machine.h"
#include "app/cli/make_terrain.h"
#include "app/cli/text_output.h"
#include "core/session/sample_map.h"

#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace marsview {
namespace {

using Json = nlohmann::ordered_json;

// Of Mars at 200 m a sample.
constexpr const char* kSizeDefault = "106694x53347";

struct Options {
    MakeTerrainOptions make;
    std::string size = kSizeDefault;
    bool is_json = false;
};

struct GridSize {
    std::size_t columns = 0;
    std::size_t rows = 0;
};

std::optional<GridSize> gridSizeFrom(const std::string& text)
{
    constexpr std::size_t kSideMax = 2'000'000;
    GridSize size;
    char tail = '\0';
    if (std::sscanf(text.c_str(), "%zux%zu%c", &size.columns, &size.rows, &tail) != 2 ||
        size.columns < 2 || size.rows < 2 || size.columns > kSideMax || size.rows > kSideMax) {
        return std::nullopt;
    }
    return size;
}

CLI::Validator gridSize()
{
    return {[](const std::string& text) {
                return gridSizeFrom(text) ? std::string() : "not a size such as 4096x2048: " + text;
            },
            "COLUMNSxROWS"};
}

Result<std::string> bundledMap()
{
    const std::filesystem::path sample = sampleMapFor(programFolder());
    if (sample.empty()) {
        return Error{ErrorCode::NotFound,
                     "--from: the map that comes with the program is not there; name another"};
    }
    return sample.string();
}

Status runMake(const Options& options)
{
    MakeTerrainOptions make = options.make;
    const GridSize size = gridSizeFrom(options.size).value();
    make.columns = size.columns;
    make.rows = size.rows;
    if (make.from.empty()) {
        Result<std::string> sample = bundledMap();
        if (!sample) {
            return std::move(sample).error();
        }
        make.from = *sample;
    }
    const Result<MadeTerrain> made = makeTerrain(make);
    if (!made) {
        return made.error();
    }
    const double samples = static_cast<double>(size.columns) * static_cast<double>(size.rows);
    if (options.is_json) {
        printLine(Json{{"file", make.path},
                       {"from", make.from},
                       {"seed", make.seed},
                       {"columns", size.columns},
                       {"rows", size.rows},
                       {"octave_count", made->octave_count},
                       {"halving_ratio", made->halving_ratio},
                       {"seconds", made->seconds},
                       {"samples_per_s", samples / made->seconds},
                       {"peak_memory_mb", static_cast<double>(made->peak_memory_bytes) / 1e6}}
                      .dump(2, ' ', false, Json::error_handler_t::replace));
    } else {
        printLine(fmt::format("{}: {} × {} samples from {}, seed {}", make.path, size.columns,
                              size.rows, make.from, make.seed));
        printLine(fmt::format("{} octaves, differences over half the distance × {:.3f}",
                              made->octave_count, made->halving_ratio));
        printLine(fmt::format("{:.1f} s, {:.1f} million samples a second, peak memory {:.0f} MB",
                              made->seconds, samples / made->seconds / 1e6,
                              static_cast<double>(made->peak_memory_bytes) / 1e6));
    }
    return Done{};
}

} // namespace

void addBenchTerrainCommand(CLI::App& bench, CommandAction& run)
{
    const auto options = std::make_shared<Options>();
    CLI::App* command = bench.add_subcommand("terrain", "Measure maps that are larger than memory");
    CLI::Option* make =
        command
            ->add_option("--make", options->make.path,
                         "write a large map to this file: a measured one with seeded fractal "
                         "detail below its resolution")
            ->required();
    command->add_option("--size", options->size, "of the map that is made")
        ->capture_default_str()
        ->check(gridSize())
        ->needs(make);
    command->add_option("--seed", options->make.seed, "of its detail")
        ->capture_default_str()
        ->needs(make);
    command
        ->add_option("--from", options->make.from,
                     "the measured map, by default the one that comes with the program")
        ->needs(make);
    command->add_option("--layout", options->make.blocks, "tiles or strips")
        ->transform(CLI::Transformer(std::map<std::string, RasterBlocks>{
            {"tiles", RasterBlocks::Tiles}, {"strips", RasterBlocks::Strips}}))
        ->needs(make);
    command->add_option("--compress", options->make.compression, "none or deflate")
        ->transform(CLI::Transformer(std::map<std::string, RasterCompression>{
            {"none", RasterCompression::None}, {"deflate", RasterCompression::Deflate}}))
        ->needs(make);
    command->add_flag("--json", options->is_json, "for machines");
    command->callback([options, &run] { run = [options] { return runMake(*options); }; });
}

} // namespace marsview
