// Parses the parameters in a device's URI: "mass=0.1,delay_ms=2".
#pragma once

#include "core/base/result.h"

#include <string>
#include <string_view>
#include <vector>

namespace marsview {

/// An optional number: its name, its range and its destination.
struct UriParameter {
    std::string_view name;
    double* value = nullptr;
    double minimum = 0.0;
    double maximum = 0.0;
};

/// Parses a comma-separated list of "name=number" into the parameters' destinations; parameters
/// that are not named keep their values. The error names `uri` and the expected form.
Status readUriParameters(std::string_view uri,
                         std::string_view address,
                         const std::vector<UriParameter>& parameters);

} // namespace marsview
