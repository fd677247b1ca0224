#include "app/console/measure_report.h"

#include "app/console/text_output.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace marsview {

using Json = nlohmann::ordered_json;

double wholeSurface(double surface_m, double void_m)
{
    return void_m > 0.0 ? std::numeric_limits<double>::quiet_NaN() : surface_m;
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

Json reportOf(const Attitude& attitude, GroundPosition center)
{
    const AttitudeUncertainty& uncertainty = attitude.uncertainty;
    Json axes = Json::array();
    for (const PoleAxis& axis : uncertainty.axes) {
        axes.push_back({{"half_angle_deg", asJson(axis.half_angle_deg)},
                        {"trend_deg", asJson(axis.trend_deg)},
                        {"plunge_deg", asJson(axis.plunge_deg)}});
    }
    Json residuals = Json::array();
    for (const double residual_m : attitude.residuals_m) {
        residuals.push_back(asJson(residual_m));
    }
    return {{"strike_deg", asJson(attitude.strike_deg)},
            {"dip_deg", asJson(attitude.dip_deg)},
            {"dip_direction_deg", asJson(attitude.dip_direction_deg)},
            {"rms_m", asJson(attitude.rms_m)},
            {"pole",
             {{"trend_deg", asJson(attitude.poleTrendDeg())},
              {"plunge_deg", asJson(attitude.polePlungeDeg())},
              {"east", asJson(attitude.normal.x)},
              {"north", asJson(attitude.normal.y)},
              {"up", asJson(attitude.normal.z)}}},
            {"uncertainty",
             {{"confidence", uncertainty.confidence},
              {"dip_error_deg", asJson(uncertainty.dip_error_deg)},
              {"strike_error_deg", asJson(uncertainty.strike_error_deg)},
              {"axes", std::move(axes)},
              {"elevation_error_m", uncertainty.elevation_error_m
                                        ? asJson(*uncertainty.elevation_error_m)
                                        : Json(nullptr)}}},
            {"points", attitude.points},
            {"residuals_m", std::move(residuals)},
            {"lon", asJson(center.x)},
            {"lat", asJson(center.y)},
            {"elevation_m", asJson(attitude.center_elevation_m)}};
}

Json reportOf(const TerrainArea& area)
{
    Json json = {{"geodesic_m2", asJson(area.geodesic_m2)},
                 {"perimeter_m", asJson(area.perimeter_m)},
                 {"surface_m2", asJson(area.surface_m2)},
                 {"covered_m2", asJson(area.covered_m2)},
                 {"min_m", asJson(area.min_m)},
                 {"max_m", asJson(area.max_m)},
                 {"mean_m", asJson(area.mean_m)}};
    if (area.volume_above_m3) {
        json["volume_above_m3"] = asJson(*area.volume_above_m3);
        json["volume_below_m3"] = asJson(*area.volume_below_m3);
    }
    return json;
}

Json reportOf(const Hypsometry& hypsometry)
{
    Json classes = Json::array();
    double above_m2 = hypsometry.totalM2();
    for (std::size_t i = 0; i < hypsometry.area_m2.size(); ++i) {
        classes.push_back({{"from_m", asJson(hypsometry.boundM(i))},
                           {"to_m", asJson(hypsometry.boundM(i + 1))},
                           {"area_m2", asJson(hypsometry.area_m2[i])},
                           {"area_above_m2", asJson(above_m2)}});
        above_m2 = std::max(0.0, above_m2 - hypsometry.area_m2[i]);
    }
    return classes;
}

Json reportOf(const Crater& crater, GroundPosition center, MapPoint map)
{
    return {{"lon", asJson(center.x)},
            {"lat", asJson(center.y)},
            {"x", asJson(map.x)},
            {"y", asJson(map.y)},
            {"diameter_m", asJson(crater.diameter_m)},
            {"depth_m", asJson(crater.depth_m)},
            {"rim_m", asJson(crater.rim_m)},
            {"floor_m", asJson(crater.floor_m)},
            {"rms_m", asJson(crater.rms_m)},
            {"points", crater.points}};
}

} // namespace marsview
