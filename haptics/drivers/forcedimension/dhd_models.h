// What the library does not report about a device, by its type.
#pragma once

#include <string_view>

namespace marsview {

struct DhdModel {
    std::string_view name;
    double half_side_m; // of the workspace, a box about the origin
    double force_n_peak;
    double stiffness_n_per_m_max;
    /// What to do with a device that waits for calibration, phrased to follow its name.
    std::string_view calibration_advice;
};

/// `type` is the result of dhdGetSystemType. An unknown type has low limits. Sources: README.md.
const DhdModel& dhdModel(int type) noexcept;

} // namespace marsview
