#include "haptics/drivers/built_in_drivers.h"

#include "haptics/device/plugin_driver.h"
#include "haptics/drivers/forcedimension/dhd_driver.h"
#include "haptics/drivers/null_driver.h"
#include "haptics/drivers/openhaptics/openhaptics_driver.h"
#include "haptics/drivers/polhem/polhem_driver.h"
#include "haptics/drivers/record_driver.h"
#include "haptics/drivers/replay_driver.h"
#include "haptics/drivers/simulated/sim_driver.h"
#include "haptics/drivers/spacemouse/spacemouse.h"

namespace marsview {

std::vector<std::unique_ptr<DeviceDriver>> builtInDrivers()
{
    std::vector<std::unique_ptr<DeviceDriver>> drivers;
    drivers.push_back(std::make_unique<OpenHapticsDriver>());
    drivers.push_back(std::make_unique<DhdDriver>());
    drivers.push_back(std::make_unique<PolhemDriver>());
    drivers.push_back(std::make_unique<SpaceMouseDriver>());
    drivers.push_back(std::make_unique<PluginDriver>());
    drivers.push_back(makeSimDriver());
    drivers.push_back(makeReplayDriver());
    drivers.push_back(makeRecordDriver());
    drivers.push_back(makeNullDriver());
    return drivers;
}

} // namespace marsview
