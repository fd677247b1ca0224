#include "app/bench/terrain/terrain_bench.h"
#include "app/bench/view_bench.h"
#include "app/console/quantile.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace marsview {
namespace {

struct FrameTimes {
    double median_ms = 0.0;
    double p95_ms = 0.0;
};

FrameTimes timesOf(const std::vector<FlownFrame>& frames)
{
    std::vector<double> wall_ms;
    for (const FlownFrame& frame : frames) {
        wall_ms.push_back(frame.wall.count());
    }
    return {quantile(wall_ms, 0.5), quantile(wall_ms, 0.95)};
}

BenchJson asJson(const ViewBenchResult& result)
{
    BenchJson flights = BenchJson::array();
    std::vector<FlownFrame> all;
    for (const FlightResult& flight : result.flights) {
        const FrameTimes times = timesOf(flight.frames);
        std::vector<double> triangles;
        std::vector<double> errors_px;
        for (const FlownFrame& frame : flight.frames) {
            triangles.push_back(static_cast<double>(frame.triangle_count));
            errors_px.push_back(frame.plan.error_px);
        }
        flights.push_back({{"name", flightName(flight.flight)},
                           {"median_ms", times.median_ms},
                           {"p95_ms", times.p95_ms},
                           {"triangles_median", quantile(triangles, 0.5)},
                           {"error_median_px", quantile(errors_px, 0.5)}});
        all.insert(all.end(), flight.frames.begin(), flight.frames.end());
    }
    const FrameTimes times = timesOf(all);
    return {{"file", result.path},
            {"triangle_count", result.triangle_count},
            {"median_ms", times.median_ms},
            {"p95_ms", times.p95_ms},
            {"flights", flights}};
}

} // namespace

Result<BenchJson> measureFrames(const TerrainBenchOptions& options)
{
    ViewBenchOptions view;
    view.frame_count = options.frame_count;
    view.pose_count = 0;
    Result<ViewBenchResult> large = benchView(options.map, view);
    if (!large) {
        return std::move(large).error();
    }
    BenchJson json{
        {"graphics_driver", large->driver},  {"width_px", view.viewport.width},
        {"height_px", view.viewport.height}, {"maps", BenchJson::array({asJson(*large)})},
        {"median_ratio", nullptr},           {"p95_ratio", nullptr}};
    if (!options.against.empty()) {
        MapOptions other;
        other.path = options.against;
        Result<ViewBenchResult> small = benchView(other, view);
        if (!small) {
            return std::move(small).error();
        }
        json["maps"].push_back(asJson(*small));
        const auto ratio = [&json](const char* key) {
            return json["maps"][0][key].get<double>() / json["maps"][1][key].get<double>();
        };
        json["median_ratio"] = ratio("median_ms");
        json["p95_ratio"] = ratio("p95_ms");
    }
    return json;
}

} // namespace marsview
