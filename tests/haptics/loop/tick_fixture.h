// Maps and simulated hands for tests of the tick and of the loop around it.
#pragma once

#include "core/terrain/filled_heightfield.h"
#include "haptics/loop/haptic_tick.h"
#include "tests/support/make_terrain.h"

#include <memory>

namespace marsview::test {

inline std::shared_ptr<const FilledHeightfield>
filledTerrain(std::size_t columns, std::size_t rows, const HeightFunction& height_m)
{
    const Heightfield heightfield = floatTerrain(columns, rows, height_m);
    JobMonitor monitor;
    auto filled = FilledHeightfield::build(heightfield, analyzed(heightfield), monitor);
    return std::make_shared<const FilledHeightfield>(std::move(filled).value());
}

/// A map with one meter per sample, x and y counted from the first sample.
inline GoalFrame meterFrame(std::size_t columns, std::size_t rows)
{
    const GeoTransform transform =
        GeoTransform::fromTerms({-0.5, 1.0, 0.0, 0.5, 0.0, -1.0}).value();
    return {std::make_shared<const Georeference>(columns, rows, transform, std::nullopt), 1.0};
}

inline std::shared_ptr<ServoMap> servoMap(std::size_t columns,
                                          std::size_t rows,
                                          const HeightFunction& height_m,
                                          const ServoMapOptions& options = {})
{
    return makeServoMap(meterFrame(columns, rows), filledTerrain(columns, rows, height_m), options);
}

inline DeviceCapabilities desktopDevice()
{
    DeviceCapabilities device;
    device.name = "test";
    device.workspace = {{-0.08, -0.06, -0.06}, {0.08, 0.06, 0.06}};
    device.force_n_peak = 3.3;
    device.stiffness_n_per_m_max = 600.0;
    return device;
}

} // namespace marsview::test
