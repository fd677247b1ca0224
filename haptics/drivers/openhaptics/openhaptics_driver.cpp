#include "haptics/drivers/openhaptics/openhaptics_driver.h"

#include "core/base/environment.h"
#include "haptics/device/device_lock.h"
#include "haptics/device/home_option.h"
#include "haptics/drivers/openhaptics/openhaptics_device.h"
#include "haptics/drivers/support/watched_open.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <system_error>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFamily = "PHANTOM or Touch (OpenHaptics)";

// The vendor's names of the default device, in newer and older drivers.
constexpr const char* kDefaultName = "Default Device";
constexpr const char* kOlderDefaultName = "Default PHANToM";

// "Left Device.config" configures a device that is opened as "Left Device". The older drivers write
// one numbered file per device, with the name inside in an unpublished format: only their default
// device is known by name.
std::set<std::string> configuredNames(const std::vector<fs::path>& folders)
{
    std::set<std::string> names;
    for (const fs::path& folder : folders) {
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(folder, none)) {
            if (entry.path().extension() == ".config") {
                names.insert(entry.path().stem().string());
            } else if (entry.path().extension() == ".ini") {
                names.insert(kOlderDefaultName);
            }
        }
    }
    return names;
}

// The device that "openhaptics:" opens, by its name in the vendor's configuration.
std::string nameOfDefault(const std::vector<fs::path>& folders)
{
    const std::set<std::string> names = configuredNames(folders);
    const bool is_older = names.contains(kOlderDefaultName) && !names.contains(kDefaultName);
    return is_older ? kOlderDefaultName : kDefaultName;
}

} // namespace

OpenHapticsOptions OpenHapticsOptions::standard()
{
    OpenHapticsOptions options;
    options.libraries = OpenHapticsApi::defaultNames();
    if (std::string chosen = environmentVariable("MARSVIEW_OPENHAPTICS_LIBRARY"); !chosen.empty()) {
        options.libraries.insert(options.libraries.begin(), std::move(chosen));
    }
    if (const std::string home = environmentVariable("GTDD_HOME"); !home.empty()) {
        options.config_folders.push_back(fs::path(home) / "config");
    }
    options.config_folders.push_back(userFolder("", ".3dsystems") / "config");
    options.config_folders.emplace_back("/usr/share/3DSystems/config");
    options.config_folders.emplace_back("/etc/SensAble/PHANToMDeviceDrivers");
    options.lock_folder = deviceLockFolder();
    return options;
}

OpenHapticsDriver::OpenHapticsDriver(OpenHapticsOptions options)
    : options_(std::move(options))
{}

Result<std::shared_ptr<OpenHapticsApi>> OpenHapticsDriver::load()
{
    if (api_ == nullptr) {
        Result<std::shared_ptr<OpenHapticsApi>> api =
            OpenHapticsApi::load(options_.libraries, complaint_);
        if (!api) {
            return api;
        }
        api_ = *api;
    }
    return api_;
}

std::vector<FoundDevice> OpenHapticsDriver::find()
{
    const std::string any = fmt::format("{}:", scheme());
    if (const auto api = load(); !api) {
        return {
            {.uri = any, .name = kFamily, .reason = api.error().message, .details = complaint_}};
    }
    std::vector<FoundDevice> found;
    for (const std::string& name : configuredNames(options_.config_folders)) {
        found.push_back({any + name, fmt::format("{}, {}", name, kFamily), {}});
    }
    if (found.empty()) {
        found.push_back(
            {any, kFamily, "no device is set up; run the vendor's setup program (Touch_Setup)"});
    }
    return found;
}

Result<std::unique_ptr<HapticDevice>> OpenHapticsDriver::open(std::string_view address)
{
    const std::string uri = fmt::format("{}:{}", scheme(), address);
    const bool is_at_home = takeHomeOption(address);
    const auto api = load();
    if (!api) {
        return Error{api.error().code, fmt::format("{}: {}", uri, api.error().message)};
    }
    const std::string name =
        address.empty() ? nameOfDefault(options_.config_folders) : std::string(address);
    Result<std::optional<FileLock>> lock =
        lockDevice(fmt::format("{}:{}", scheme(), name), options_.lock_folder);
    if (!lock) {
        return std::move(lock).error();
    }
    return openWatched<OpenHapticsDevice>({.api = *api,
                                           .name = std::string(address),
                                           .uri = uri,
                                           .is_at_home = is_at_home,
                                           .lock = std::move(*lock)},
                                          options_.patience);
}

} // namespace marsview
