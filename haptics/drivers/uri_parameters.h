// What stands behind the scheme of a device's URI: "mass=0.1,delay_ms=2".
#pragma once

#include "core/base/result.h"

#include <string>
#include <string_view>
#include <vector>

namespace marsview {

/// A number that may be given, and where it goes.
struct UriParameter {
    std::string_view name;
    double* value = nullptr;
    double minimum = 0.0;
    double maximum = 0.0;
};

/// Reads "name=number" between commas into what the parameters point to; what is not named keeps
/// its value. The error names `uri` and what it should have been.
Status readUriParameters(std::string_view uri,
                         std::string_view address,
                         const std::vector<UriParameter>& parameters);

} // namespace marsview
