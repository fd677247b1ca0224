// A camera for tests that need one.
#pragma once

#include "core/view/camera.h"

namespace marsview::test {

/// Along no axis, 80 km from its target.
inline OrbitCamera someCamera()
{
    return {.target = {2e4, 1e4, 500.0},
            .distance_m = 8e4,
            .azimuth = Angle::degrees(-40.0),
            .tilt = Angle::degrees(50.0)};
}

} // namespace marsview::test
