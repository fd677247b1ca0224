// Lines that are measured in tests.
#pragma once

#include "core/measure/line_measures.h"

#include <gtest/gtest.h>

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

} // namespace marsview::test
