#include "haptics/device/device_registry.h"

#include "core/base/check.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <utility>

namespace marsview {

bool FoundDevice::isMeantBy(std::string_view wanted) const noexcept
{
    const std::string_view scheme = std::string_view(uri).substr(0, uri.find(':') + 1);
    const auto is_before_options = [wanted](std::string_view whole) {
        return !whole.empty() && wanted.starts_with(whole) &&
               (wanted.size() == whole.size() || wanted[whole.size()] == ',');
    };
    const bool is_only_one = uri == scheme && wanted.starts_with(scheme);
    return is_only_one || is_before_options(uri) || is_before_options(scheme);
}

DeviceRegistry::DeviceRegistry(std::vector<std::unique_ptr<DeviceDriver>> drivers)
    : drivers_(std::move(drivers))
{
    std::vector<std::string> names = schemes();
    std::sort(names.begin(), names.end());
    MARSVIEW_CHECK(std::adjacent_find(names.begin(), names.end()) == names.end());
}

std::vector<FoundDevice> DeviceRegistry::find()
{
    std::vector<FoundDevice> all;
    for (const auto& driver : drivers_) {
        std::vector<FoundDevice> found = driver->find();
        std::move(found.begin(), found.end(), std::back_inserter(all));
    }
    return all;
}

Status DeviceRegistry::check(std::string_view uri) const
{
    const Result<DeviceDriver*> driver = driverOf(uri);
    return driver ? (*driver)->checkAddress(uri.substr(uri.find(':') + 1)) : driver.error();
}

Result<std::unique_ptr<HapticDevice>> DeviceRegistry::open(std::string_view uri)
{
    const Result<DeviceDriver*> driver = driverOf(uri);
    if (!driver) {
        return driver.error();
    }
    return (*driver)->open(uri.substr(uri.find(':') + 1));
}

Result<DeviceDriver*> DeviceRegistry::driverOf(std::string_view uri) const
{
    const auto colon = uri.find(':');
    const std::string known = fmt::format("{}", fmt::join(schemes(), ", "));
    if (colon == std::string_view::npos) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: is not a device URI; a URI begins with a scheme and a colon; "
                                 "the known schemes are {}",
                                 uri, known)};
    }
    const std::string_view scheme = uri.substr(0, colon);
    const auto driver =
        std::find_if(drivers_.begin(), drivers_.end(),
                     [scheme](const auto& candidate) { return candidate->scheme() == scheme; });
    if (driver == drivers_.end()) {
        return Error{ErrorCode::Unsupported,
                     fmt::format("{}: no driver has the scheme \"{}\"; the known schemes are {}",
                                 uri, scheme, known)};
    }
    return driver->get();
}

std::vector<std::string> DeviceRegistry::schemes() const
{
    std::vector<std::string> names;
    for (const auto& driver : drivers_) {
        names.emplace_back(driver->scheme());
    }
    return names;
}

} // namespace marsview
