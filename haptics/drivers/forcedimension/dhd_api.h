// The parts used of Force Dimension's library for omega, delta, sigma and lambda devices and for
// the Novint Falcon, libdhd: the documented functions, declared again (README.md).
#pragma once

#include "core/base/result.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace marsview {

namespace dhd {

using Id = char;

// Indices of dhdGetStatus. Versions differ in the length of the array; none is this long.
constexpr std::size_t kStatusMax = 64;
constexpr std::size_t kStatusReset = 3; // waits for calibration
constexpr std::size_t kStatusForce = 5;
using Status = std::array<int, kStatusMax>;

} // namespace dhd

/// The loaded library. Its functions are the vendor's: those that return int return a negative
/// number on failure. They wait for a USB transfer, and may be called from any thread.
class DhdApi {
public:
    /// The usual names of the installed library.
    static std::vector<std::string> defaultNames();

    /// Loads the first of these files or names that can be loaded. NotFound if none can,
    /// Unsupported if a library lacks a function. `complaint` receives the dynamic loader's message
    /// if no library could be loaded.
    static Result<std::shared_ptr<const DhdApi>> load(const std::vector<std::string>& names,
                                                      std::string& complaint);

    int (*get_device_count)() = nullptr;
    int (*open_id)(dhd::Id id) = nullptr;
    int (*close)(dhd::Id id) = nullptr;
    int (*stop)(dhd::Id id) = nullptr;
    int (*get_system_type)(dhd::Id id) = nullptr;
    int (*get_status)(int* status, dhd::Id id) = nullptr;
    bool (*has_wrist)(dhd::Id id) = nullptr;
    int (*enable_force)(unsigned char value, dhd::Id id) = nullptr;
    int (*get_position)(double* x, double* y, double* z, dhd::Id id) = nullptr;
    int (*get_position_and_frame)(double* x,
                                  double* y,
                                  double* z,
                                  double (*frame)[3], // NOLINT(modernize-avoid-c-arrays): C's
                                  dhd::Id id) = nullptr;
    int (*get_button)(int index, dhd::Id id) = nullptr;
    int (*set_force)(double x, double y, double z, dhd::Id id) = nullptr;
    const char* (*error_text)() = nullptr;

    // Null in old versions of the library.
    const char* (*get_system_name)(dhd::Id id) = nullptr;
    double (*get_max_force)(dhd::Id id) = nullptr;
    bool (*has_active_gripper)(dhd::Id id) = nullptr;
    int (*emulate_button)(unsigned char value, dhd::Id id) = nullptr;

    /// The library's message for the last error of this thread.
    std::string lastError() const;
};

} // namespace marsview
