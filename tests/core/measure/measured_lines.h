// Lines that are measured in tests.
#pragma once

#include "core/measure/line_measures.h"
#include "tests/support/nan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace marsview::test {

inline Profile profileOf(MeasuredTerrain& terrain,
                         const std::vector<GroundPosition>& positions,
                         std::optional<double> step_m = std::nullopt)
{
    JobMonitor monitor;
    Result<Profile> profile = measureProfile(terrain, positions, step_m, monitor);
    EXPECT_TRUE(profile) << (profile ? "" : profile.error().message);
    return profile ? *profile : Profile{};
}

inline Distance distanceOf(MeasuredTerrain& terrain, const std::vector<GroundPosition>& positions)
{
    JobMonitor monitor;
    Result<Distance> distance = measureDistance(terrain, positions, monitor);
    EXPECT_TRUE(distance) << (distance ? "" : distance.error().message);
    return distance ? *distance : Distance{};
}

// Between the points of a profile; NaN in gaps.
inline double interpolated(const Profile& profile, double distance_m)
{
    const auto after =
        std::upper_bound(profile.points.begin(), profile.points.end(), distance_m,
                         [](double d, const ProfilePoint& point) { return d < point.distance_m; });
    if (after == profile.points.begin() || after == profile.points.end()) {
        return after == profile.points.end() ? profile.points.back().elevation_m : kNan;
    }
    const ProfilePoint& a = *(after - 1);
    const double share = (distance_m - a.distance_m) / (after->distance_m - a.distance_m);
    return a.elevation_m + share * (after->elevation_m - a.elevation_m);
}

} // namespace marsview::test
