// Reads a device's parameters from a file.
#pragma once

#include "core/base/result.h"
#include "haptics/drivers/polhem/polhem_kinematics.h"

#include <filesystem>

namespace marsview {

/// resources/devices/polhem-v1.json is an example of the file: every number in it is required. The
/// error names the file, the parameter, and its value.
Result<PolhemParameters> readPolhemParameters(const std::filesystem::path& file);

} // namespace marsview
