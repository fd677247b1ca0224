// Contact models of the Python module.
#pragma once

#include "app/python/python_map.h"
#include "core/contact/contact.h"

#include <array>
#include <memory>
#include <string>

namespace marsview::python {

/// One update, in the coordinates of the caller.
struct Updated {
    std::array<double, 3> proxy{};
    std::array<double, 3> force_direction{}; // of length 1, or zero
    double distance_m = 0.0;                 // from the goal to the proxy
    ContactState state;                      // without the proxy
};

/// A contact model that Python drives. One thread at a time.
class DrivenModel {
public:
    virtual ~DrivenModel() = default;
    DrivenModel(const DrivenModel&) = delete;
    DrivenModel& operator=(const DrivenModel&) = delete;
    virtual Updated update(const std::array<double, 3>& goal) = 0;
    virtual Updated place(const std::array<double, 3>& goal) = 0;

protected:
    DrivenModel() = default;
};

struct DriveOptions {
    std::string model = "continuous-walk";
    double exaggeration = 1.0;
    double radius_m = 0.0; // 0: half a cell
};

/// Goals are x and y in the CRS of the map and an elevation, as in `trace`.
std::unique_ptr<DrivenModel> modelOverMap(const PythonMap& map, const DriveOptions& options);
/// Goals are meters: x to the right, y upwards from the last row, z.
std::unique_ptr<DrivenModel>
modelOverArray(const py::array& heights, double cell_size_m, const DriveOptions& options);

} // namespace marsview::python
