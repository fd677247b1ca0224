#include "app/bench/bench_commands.h"
#include "app/bench/terrain/child_process.h"
#include "app/bench/terrain/make_terrain.h"
#include "app/bench/terrain/terrain_bench.h"
#include "app/bench/terrain/terrain_bench_report.h"
#include "app/console/machine.h"
#include "app/console/number_checks.h"
#include "app/console/output_file.h"
#include "app/console/text_output.h"
#include "core/session/sample_map.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace marsview {
namespace {

// Mars at 200 m per sample.
constexpr const char* kSizeDefault = "106694x53347";

// Each measurement runs in a separate process.
using Measure = Result<BenchJson> (*)(const TerrainBenchOptions&);
struct Measurement {
    const char* name;
    const char* title;
    Measure measure; // null if composed of others
};
constexpr std::array kMeasurements{
    Measurement{"prepare", "preparing the map", measurePrepare},
    Measurement{"open", "from opening to the first picture", nullptr},
    Measurement{"session", "memory of a session", measureSession},
    Measurement{"swipes", "swipes across cold data in real time", measureSwipes},
    Measurement{"identity", "the same swipes over the map in memory", measureIdentity},
    Measurement{"growth", "cost of an update against the size of the map", measureGrowth},
    Measurement{"remote", "fetched by address", measureRemote},
    Measurement{"frames", "flying over the map", measureFrames},
};
// A part of "open".
constexpr Measurement kPicture{"picture", "a first picture", measureFirstPicture};

struct BenchTerrainOptions {
    MakeTerrainOptions make;
    std::string size = kSizeDefault;
    std::string layout = "tiles";
    std::string compression = "none";
    TerrainBenchOptions bench;
    std::vector<std::string> only;
    std::string folder;
    std::string plot;
    bool is_here = false;
    bool is_json = false;
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
                return gridSizeFrom(text)
                           ? std::string()
                           : fmt::format("\"{}\" is not a size; write it as 4096x2048", text);
            },
            ""};
}

// For the measuring processes.
void setCacheFolder(const std::string& folder)
{
    std::error_code ignored;
    std::filesystem::create_directories(folder, ignored);
    setenv("MARSVIEW_CACHE_DIR", folder.c_str(), 1); // NOLINT: only one thread runs
}

// A temporary folder next to the user's prepared maps, where there is enough space; removed by the
// destructor.
class ScratchFolder {
public:
    ScratchFolder()
    {
        const std::filesystem::path parent = defaultMapResources().folder;
        std::error_code error;
        std::filesystem::create_directories(parent, error);
        std::string name = (parent / "bench-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) {
            error_ = fmt::format("{}: cannot create a folder there; set MARSVIEW_CACHE_DIR",
                                 parent.string());
            return;
        }
        path_ = name;
    }
    ~ScratchFolder()
    {
        std::error_code ignored;
        if (!path_.empty()) {
            std::filesystem::remove_all(path_, ignored);
        }
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    const std::string& error() const { return error_; }

private:
    std::filesystem::path path_;
    std::string error_;
};

Result<std::string> bundledMap()
{
    const std::filesystem::path sample = sampleMapFor(programFolder());
    if (sample.empty()) {
        return Error{ErrorCode::NotFound, "DEM: the bundled map is missing; name another"};
    }
    return sample.string();
}

Status runMake(const BenchTerrainOptions& options)
{
    MakeTerrainOptions make = options.make;
    const GridSize size = gridSizeFrom(options.size).value();
    make.seed = options.bench.seed;
    make.blocks = options.layout == "strips" ? RasterBlocks::Strips : RasterBlocks::Tiles;
    make.compression =
        options.compression == "deflate" ? RasterCompression::Deflate : RasterCompression::None;
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
        printJson(
            withSchema({{"file", make.path},
                        {"from", make.from},
                        {"seed", make.seed},
                        {"columns", size.columns},
                        {"rows", size.rows},
                        {"octave_count", made->octave_count},
                        {"halving_ratio", made->halving_ratio},
                        {"seconds", made->seconds},
                        {"samples_per_s", samples / made->seconds},
                        {"peak_memory_mb", static_cast<double>(made->peak_memory_bytes) / 1e6}}));
    } else {
        printLine(fmt::format("{}: {} × {} samples from {}, seed {}", make.path, size.columns,
                              size.rows, make.from, make.seed));
        printLine(fmt::format("{} octaves, differences over half the distance × {:.3f}",
                              made->octave_count, made->halving_ratio));
        printLine(fmt::format("{:.1f} s, {:.1f} million samples per second, peak memory {:.0f} MB",
                              made->seconds, samples / made->seconds / 1e6,
                              static_cast<double>(made->peak_memory_bytes) / 1e6));
    }
    return Done{};
}

// The same options for a process that runs one measurement.
std::vector<std::string> argumentsFor(const BenchTerrainOptions& options, const char* measurement)
{
    const TerrainBenchOptions& bench = options.bench;
    std::vector<std::string> words{"bench",  "terrain", bench.map.path, "--json",
                                   "--here", "--only",  measurement};
    const auto add = [&words](const char* name, const std::string& value) {
        words.insert(words.end(), {name, value});
    };
    std::string speeds;
    for (const double speed : bench.speeds_cells) {
        speeds += (speeds.empty() ? "" : ",") + asText(speed);
    }
    add("--speeds", speeds);
    add("--seconds", asText(bench.seconds));
    add("--seed", std::to_string(bench.seed));
    add("--updates", std::to_string(bench.update_count));
    add("--held-mb", std::to_string(bench.held_mb_max));
    add("--frames", std::to_string(bench.frame_count));
    if (!bench.against.empty()) {
        add("--against", bench.against);
    }
    for (const std::string& word : bench.map.overrideArguments()) {
        words.push_back(word);
    }
    return words;
}

Result<BenchJson> runChild(const std::vector<std::string>& arguments)
{
    Result<ChildOutput> output = runSelf(arguments);
    if (!output) {
        return std::move(output).error();
    }
    BenchJson json = BenchJson::parse(output->out, nullptr, false);
    if (json.is_discarded()) {
        return Error{ErrorCode::Unreadable, "its output is not JSON"};
    }
    json.erase("schema"); // a part of a larger result
    json["process_peak_memory_mb"] = static_cast<double>(output->peak_memory_bytes) / 1e6;
    return json;
}

// Cold and warm, with the map prepared and not prepared.
Result<BenchJson> measureOpen(const BenchTerrainOptions& options,
                              const std::filesystem::path& empty)
{
    BenchJson json{{"openings", BenchJson::array()}, {"left_out", BenchJson::array()}};
    const std::string folder = options.folder;
    for (const bool is_prepared : {false, true}) {
        setCacheFolder(is_prepared ? folder : empty.string());
        for (const bool is_warm : {false, true}) {
            std::vector<std::string> arguments = argumentsFor(options, kPicture.name);
            if (is_warm) {
                arguments.emplace_back("--warm");
            }
            Result<BenchJson> opening = runChild(arguments);
            if (opening) {
                json["openings"].push_back(*opening);
            } else if (opening.error().code == ErrorCode::Canceled) {
                setCacheFolder(folder);
                return std::move(opening).error();
            } else {
                json["left_out"].push_back(opening.error().message);
            }
        }
    }
    setCacheFolder(folder);
    if (json["openings"].empty()) {
        return Error{ErrorCode::Unreadable, json["left_out"].front().get<std::string>()};
    }
    return json;
}

Status printOne(const BenchTerrainOptions& options, const Measurement& measurement)
{
    const Result<BenchJson> found = measurement.measure(options.bench);
    if (!found) {
        return found.error();
    }
    if (options.is_json) {
        printJson(withSchema(*found));
    } else {
        printLine(terrainReport(measurement.name, *found));
    }
    return Done{};
}

bool isWanted(const BenchTerrainOptions& options, std::string_view name)
{
    return options.only.empty() ||
           std::find(options.only.begin(), options.only.end(), name) != options.only.end();
}

Status runMeasurements(const BenchTerrainOptions& options, const std::filesystem::path& empty)
{
    BenchJson json{{"file", options.bench.map.path},
                   {"processor", processorName()},
                   {"core_count", std::thread::hardware_concurrency()}};
    if (!options.is_json) {
        printLine(fmt::format("{}\n{}, {} cores", options.bench.map.path, processorName(),
                              std::thread::hardware_concurrency()));
    }
    bool has_result = false;
    std::optional<Error> failure;
    for (const Measurement& measurement : kMeasurements) {
        if (!isWanted(options, measurement.name)) {
            continue;
        }
        const Result<BenchJson> found = measurement.measure != nullptr
                                            ? runChild(argumentsFor(options, measurement.name))
                                            : measureOpen(options, empty);
        if (!found && found.error().code == ErrorCode::Canceled) {
            return Error{ErrorCode::Canceled,
                         fmt::format("{}: measuring was canceled", options.bench.map.path)};
        }
        has_result = has_result || found;
        if (!found && !failure) {
            failure = found.error();
        }
        json[measurement.name] = found ? *found : BenchJson{{"left_out", found.error().message}};
        if (!options.is_json) {
            printLine(fmt::format("\n{}\n{}", measurement.title,
                                  found ? terrainReport(measurement.name, *found)
                                        : "skipped: " + asOneLine(found.error().message)));
            std::fflush(stdout);
        }
        if (found && measurement.name == std::string_view("growth") && !options.plot.empty()) {
            if (Status written = writeOutputFile(options.plot, growthPlot(*found, processorName()));
                !written) {
                return written;
            }
        }
    }
    if (!has_result && failure) {
        return *failure;
    }
    if (options.is_json) {
        printJson(withSchema(json));
    }
    return Done{};
}

// So that a map that cannot be measured at all fails once, not once per measurement.
Status checkCanBeOpened(const MapOptions& map)
{
    const Result<OpenRaster> raster = openRaster(map);
    return raster ? checkIsSurface(map.path, raster->info) : Status(raster.error());
}

Status runTerrain(const BenchTerrainOptions& given)
{
    if (!given.make.path.empty()) {
        return runMake(given);
    }
    BenchTerrainOptions options = given;
    if (options.bench.map.path.empty()) {
        Result<std::string> sample = bundledMap();
        if (!sample) {
            return std::move(sample).error();
        }
        options.bench.map.path = *sample;
    }
    if (options.is_here && options.only.size() == 1) {
        for (const Measurement& measurement : kMeasurements) {
            if (options.only.front() == measurement.name && measurement.measure != nullptr) {
                return printOne(options, measurement);
            }
        }
        if (options.only.front() == kPicture.name) {
            return printOne(options, kPicture);
        }
    }
    if (Status opened = checkCanBeOpened(options.bench.map); !opened) {
        return opened;
    }
    // Prepared maps are in a temporary folder, unless one was specified.
    const ScratchFolder scratch;
    if (!scratch.error().empty()) {
        return Error{ErrorCode::Unreadable, scratch.error()};
    }
    if (options.folder.empty()) {
        options.folder = (scratch.path() / "prepared").string();
    }
    setCacheFolder(options.folder);
    return runMeasurements(options, scratch.path() / "empty");
}

} // namespace

void addBenchTerrainCommand(CLI::App& bench, CommandAction& run)
{
    const auto options = std::make_shared<BenchTerrainOptions>();
    CLI::App* command = bench.add_subcommand("terrain", "Measure maps that are larger than memory");
    command->add_option("DEM", options->bench.map.path, "elevation map, by default the bundled one")
        ->type_name("FILE")
        ->transform(fileName());
    options->bench.map.addOverridesTo(*command);
    CLI::Option* make = command
                            ->add_option("--make", options->make.path,
                                         "write a large map to this file instead: a measured one "
                                         "with seeded fractal detail below "
                                         "its resolution")
                            ->type_name("FILE")
                            ->transform(fileName());
    command->add_option("--size", options->size, "of the map that is made, columns by rows")
        ->type_name("WxH")
        ->capture_default_str()
        ->check(gridSize())
        ->needs(make);
    command->add_option("--seed", options->bench.seed, "of the detail, and of the swipes")
        ->capture_default_str()
        ->check(wholeNumberFrom(0, std::numeric_limits<std::uint64_t>::max()));
    command
        ->add_option("--from", options->make.from, "the measured map, by default the bundled one")
        ->type_name("FILE")
        ->transform(fileName())
        ->needs(make);
    command->add_option("--layout", options->layout, "tiles or strips")
        ->capture_default_str()
        ->check(oneOf({"tiles", "strips"}))
        ->needs(make);
    command->add_option("--compress", options->compression, "none or deflate")
        ->capture_default_str()
        ->check(oneOf({"none", "deflate"}))
        ->needs(make);
    std::vector<std::string> names{kPicture.name};
    for (const Measurement& measurement : kMeasurements) {
        names.emplace_back(measurement.name);
    }
    command->add_option("--only", options->only, "these measurements, separated by commas")
        ->delimiter(',')
        ->check(oneOf(names));
    command
        ->add_option("--folder", options->folder,
                     "folder for prepared maps; by default a temporary one")
        ->type_name("FOLDER")
        ->transform(fileName())
        ->excludes(make);
    command
        ->add_option("--seconds", options->bench.seconds,
                     "duration of the real-time swipes at each speed")
        ->capture_default_str()
        ->check(positiveNumber());
    command->add_option("--speeds", options->bench.speeds_cells, "of swipes, cells per update")
        ->delimiter(',')
        ->capture_default_str()
        ->check(positiveNumber());
    command
        ->add_option("--updates", options->bench.update_count,
                     "updates of the other swipes at each speed")
        ->capture_default_str()
        ->check(wholeNumberFrom(10, 100'000'000));
    command
        ->add_option("--held-mb", options->bench.held_mb_max,
                     "largest part of the map to read into memory for comparison")
        ->capture_default_str()
        ->check(wholeNumberFrom(1, 1'000'000));
    command
        ->add_option("--against", options->bench.against,
                     "a smaller map to compare frame times with")
        ->type_name("FILE")
        ->transform(fileName());
    command->add_option("--frames", options->bench.frame_count, "frames per flight")
        ->capture_default_str()
        ->check(wholeNumberFrom(1, 100'000));
    command->add_option("--plot", options->plot, "draw the growth to this SVG file")
        ->type_name("FILE")
        ->transform(fileName())
        ->check(fileNameEndingIn({".svg"}));
    command->add_flag("--warm", options->bench.is_warm,
                      "draw the first picture with the file in the system's cache");
    command->add_flag("--here", options->is_here,
                      "run one measurement in this process, with the existing prepared maps");
    command->add_flag("--json", options->is_json, "print JSON");
    command->callback([options, &run] { run = [options] { return runTerrain(*options); }; });
}

} // namespace marsview
