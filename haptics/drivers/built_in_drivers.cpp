#include "haptics/drivers/built_in_drivers.h"

namespace marsview {

std::vector<std::unique_ptr<DeviceDriver>> builtInDrivers()
{
    std::vector<std::unique_ptr<DeviceDriver>> drivers;
    return drivers;
}

} // namespace marsview
