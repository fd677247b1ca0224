// Reading what an arm measures from its file.
#pragma once

#include "core/base/result.h"
#include "haptics/drivers/polhem_kinematics.h"

#include <filesystem>

namespace marsview {

/// resources/devices/polhem-v1.json says by its example what the file holds: every number has to be
/// there. The error names the file, the number, and what was found.
Result<PolhemParameters> readPolhemParameters(const std::filesystem::path& file);

} // namespace marsview
