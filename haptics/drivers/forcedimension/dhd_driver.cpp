#include "haptics/drivers/forcedimension/dhd_driver.h"

#include "core/base/environment.h"
#include "haptics/device/device_lock.h"
#include "haptics/device/watched_call.h"
#include "haptics/drivers/forcedimension/dhd_device.h"
#include "haptics/drivers/support/watched_open.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace marsview {
namespace {

constexpr const char* kFamily = "Force Dimension or Novint Falcon";
constexpr int kDevicesMax = 16;

// Digits only; the first device if empty.
std::optional<int> numberOf(std::string_view address)
{
    if (address.empty()) {
        return 0;
    }
    int number = 0;
    const char* end = address.data() + address.size();
    const auto read = std::from_chars(address.data(), end, number);
    const bool is_number = read.ec == std::errc() && read.ptr == end && address.front() != '-';
    return is_number && number < kDevicesMax ? std::optional(number) : std::nullopt;
}

} // namespace

DhdOptions DhdOptions::standard()
{
    DhdOptions options;
    options.libraries = DhdApi::defaultNames();
    if (std::string chosen = environmentVariable("MARSVIEW_FORCEDIMENSION_LIBRARY");
        !chosen.empty()) {
        options.libraries.insert(options.libraries.begin(), std::move(chosen));
    }
    options.lock_folder = deviceLockFolder();
    return options;
}

DhdDriver::DhdDriver(DhdOptions options)
    : options_(std::move(options))
{}

Result<std::shared_ptr<const DhdApi>> DhdDriver::load()
{
    if (api_ == nullptr) {
        Result<std::shared_ptr<const DhdApi>> api = DhdApi::load(options_.libraries, complaint_);
        if (!api) {
            return api;
        }
        api_ = *api;
    }
    return api_;
}

std::vector<FoundDevice> DhdDriver::find()
{
    const std::string first = fmt::format("{}:", scheme());
    const auto api = load();
    if (!api) {
        return {
            {.uri = first, .name = kFamily, .reason = api.error().message, .details = complaint_}};
    }
    std::optional<int> count;
    if (!has_hung_) {
        count = callWatched(options_.patience, [held = *api] { return held->get_device_count(); });
        has_hung_ = !count.has_value();
    }
    if (!count) {
        return {{first, kFamily,
                 "the vendor's library does not answer; check the device's power and start the "
                 "program again"}};
    }
    if (*count < 0) {
        return {{first, kFamily,
                 fmt::format("the vendor's library cannot list its devices ({})",
                             (*api)->lastError())}};
    }
    std::vector<FoundDevice> found;
    for (int i = 0; i < std::min(*count, kDevicesMax); ++i) {
        found.push_back({fmt::format("{}{}", first, i), fmt::format("{} {}", kFamily, i + 1), {}});
    }
    if (found.empty()) {
        found.push_back({first, kFamily, "no device is connected"});
    }
    return found;
}

Status DhdDriver::checkAddress(std::string_view address) const
{
    if (!numberOf(address)) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{0}:{1}: is not the number of a device; expected {0}:0 for the "
                                 "first, {0}:1 for the second",
                                 scheme(), address)};
    }
    return Done{};
}

Result<std::unique_ptr<HapticDevice>> DhdDriver::open(std::string_view address)
{
    if (const Status checked = checkAddress(address); !checked) {
        return checked.error();
    }
    const std::string uri = fmt::format("{}:{}", scheme(), address);
    const std::optional<int> number = numberOf(address);
    const auto api = load();
    if (!api) {
        return Error{api.error().code, fmt::format("{}: {}", uri, api.error().message)};
    }
    Result<std::optional<FileLock>> lock =
        lockDevice(fmt::format("{}:{}", scheme(), *number), options_.lock_folder);
    if (!lock) {
        return std::move(lock).error();
    }
    return openWatched<DhdDevice>(
        {.api = *api, .number = *number, .uri = uri, .lock = std::move(*lock)}, options_.patience);
}

} // namespace marsview
