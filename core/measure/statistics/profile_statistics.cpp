#include "core/measure/statistics/profile_statistics.h"

#include "core/measure/constants.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace marsview {
namespace {} // namespace

ProfileStatistics profileStatistics(const Profile& profile, double begin_m, double end_m)
{
    ProfileStatistics statistics;
    statistics.min_m = std::numeric_limits<double>::infinity();
    statistics.max_m = -statistics.min_m;
    double sum = 0.0;
    double covered_m = 0.0;
    double first_m = kNoMeasure;
    double last_m = kNoMeasure;
    double first_at_m = 0.0;
    double last_at_m = 0.0;
    const auto& points = profile.points;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const ProfilePoint& a = points[i - 1];
        const ProfilePoint& b = points[i];
        const double from_m = std::max(a.distance_m, begin_m);
        const double to_m = std::min(b.distance_m, end_m);
        const double run_m = b.distance_m - a.distance_m;
        if (!(to_m > from_m) || !(run_m > 0.0)) {
            continue;
        }
        statistics.length_m += to_m - from_m;
        if (!std::isfinite(a.elevation_m) || !std::isfinite(b.elevation_m)) {
            statistics.gap_m += to_m - from_m;
            continue;
        }
        const double from_elevation_m =
            std::lerp(a.elevation_m, b.elevation_m, (from_m - a.distance_m) / run_m);
        const double to_elevation_m =
            std::lerp(a.elevation_m, b.elevation_m, (to_m - a.distance_m) / run_m);
        const double rise_m = to_elevation_m - from_elevation_m;
        if (std::isnan(first_m)) {
            first_m = from_elevation_m;
            first_at_m = from_m;
        }
        last_m = to_elevation_m;
        last_at_m = to_m;
        statistics.min_m = std::min({statistics.min_m, from_elevation_m, to_elevation_m});
        statistics.max_m = std::max({statistics.max_m, from_elevation_m, to_elevation_m});
        sum += 0.5 * (from_elevation_m + to_elevation_m) * (to_m - from_m);
        covered_m += to_m - from_m;
        statistics.surface_m += std::hypot(to_m - from_m, rise_m);
        (rise_m > 0.0 ? statistics.climb_m : statistics.descent_m) += std::abs(rise_m);
        statistics.steepest_deg =
            std::max(statistics.steepest_deg,
                     std::atan2(std::abs(rise_m), to_m - from_m) * kDegreesPerRadian);
    }
    if (!(covered_m > 0.0)) {
        statistics.min_m = statistics.max_m = statistics.mean_m = kNoMeasure;
        statistics.mean_slope_deg = statistics.steepest_deg = kNoMeasure;
        return statistics;
    }
    statistics.mean_m = sum / covered_m;
    statistics.mean_slope_deg =
        std::atan2(last_m - first_m, last_at_m - first_at_m) * kDegreesPerRadian;
    return statistics;
}

} // namespace marsview
