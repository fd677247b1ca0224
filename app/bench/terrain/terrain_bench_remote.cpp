#include "app/bench/terrain/terrain_bench.h"
#include "app/bench/terrain/terrain_stage.h"
#include "app/console/long_job.h"
#include "core/files/network_statistics.h"
#include "core/session/open_map.h"
#include "core/sources/source_identity.h"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace marsview {
namespace {

// Olympus Mons on Mars; the middle of any other map.
GridPoint destination(const Map& map)
{
    const Georeference& georeference = map.georeference();
    const bool is_mars = georeference.body() != nullptr && georeference.body()->name == "Mars";
    if (is_mars) {
        if (const auto grid = georeference.toGrid(
                GeographicPoint{Angle::degrees(18.65), Angle::degrees(226.2)})) {
            return *grid;
        }
    }
    return {static_cast<double>(georeference.columns() - 1) / 2.0,
            static_cast<double>(georeference.rows() - 1) / 2.0};
}

} // namespace

Result<BenchJson> measureRemote(const TerrainBenchOptions& options)
{
    if (options.map.path.find("://") == std::string::npos &&
        !options.map.path.starts_with("/vsi")) {
        return Error{
            ErrorCode::Unsupported,
            fmt::format("{}: not an address; name a map by its address", options.map.path)};
    }
    countNetworkUse();
    Result<std::unique_ptr<TerrainStage>> stage = TerrainStage::create({1280, 800});
    if (!stage) {
        return std::move(stage).error();
    }
    LongJob job("fetching");
    Result<std::shared_ptr<const Map>> map =
        openMap(options.map.spec(), tiledResources(), job.monitor());
    if (!map) {
        return std::move(map).error();
    }
    const Map& shown = **map;
    (*stage)->show(*map);
    const OrbitCamera whole = (*stage)->camera(Flight::Orbit, 0.0);
    (*stage)->paintWhole(whole, job.monitor());
    const NetworkStatistics opened = networkStatistics();
    // Closer by a quarter from picture to picture, each until it is whole, down to where a sample
    // is wider than a pixel.
    const GridPoint place = destination(shown);
    const double pixel_m = shown.georeference().pixelHeightMeters();
    const double nearest_m = 400.0 * pixel_m;
    std::uint64_t pictures = 1;
    for (double distance_m = whole.distance_m; !job.monitor().isCanceled();
         distance_m = std::max(0.75 * distance_m, nearest_m)) {
        (*stage)->paintWhole((*stage)->above(place, distance_m), job.monitor());
        ++pictures;
        if (distance_m <= nearest_m) {
            break;
        }
    }
    const double height_m = shown.heightfield().heightWaiting(place);
    if (job.monitor().isCanceled()) {
        return Error{ErrorCode::Canceled, "fetching was canceled"};
    }
    const NetworkStatistics all = networkStatistics();
    const Result<SourceIdentity> identity = identify(options.map.path);
    const double file_bytes = identity ? static_cast<double>(identity->bytes) : 0.0;
    BenchJson json{{"requests_to_open", opened.request_count},
                   {"bytes_to_open", opened.downloaded_bytes},
                   {"requests", all.request_count},
                   {"bytes", all.downloaded_bytes},
                   {"file_bytes", file_bytes},
                   {"share_of_file", nullptr},
                   {"pictures", pictures},
                   {"height_there_m", nullptr}};
    if (file_bytes > 0.0) {
        json["share_of_file"] = static_cast<double>(all.downloaded_bytes) / file_bytes;
    }
    if (std::isfinite(height_m)) {
        json["height_there_m"] = height_m;
    }
    return json;
}

} // namespace marsview
