#include "haptics/drivers/built_in_drivers.h"

#include "haptics/drivers/null_driver.h"
#include "haptics/drivers/record_driver.h"
#include "haptics/drivers/replay_driver.h"
#include "haptics/drivers/sim_driver.h"

namespace marsview {

std::vector<std::unique_ptr<DeviceDriver>> builtInDrivers()
{
    std::vector<std::unique_ptr<DeviceDriver>> drivers;
    drivers.push_back(makeSimDriver());
    drivers.push_back(makeReplayDriver());
    drivers.push_back(makeRecordDriver());
    drivers.push_back(makeNullDriver());
    return drivers;
}

} // namespace marsview
