#include "haptics/device/plugin_library.h"

#include "haptics/device/checked_device.h"
#include "haptics/device/loader_message.h"
#include "haptics/device/plugin_device.h"
#include "haptics/device/plugin_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <dlfcn.h>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace marsview {
namespace {

// Structs grow only at their end, so these are the sizes in version 1.
constexpr std::uint32_t kPluginBytesMin = 96;
constexpr std::uint32_t kFoundDeviceBytesMin = 24;
static_assert(sizeof(MarsviewPlugin) >= kPluginBytesMin);
static_assert(sizeof(MarsviewFoundDevice) >= kFoundDeviceBytesMin);
constexpr std::uint32_t kStructBytesMax = 64 * 1024;
constexpr std::size_t kTextMax = 200;

std::string shownText(const char* text)
{
    return shownPluginText(text, kTextMax);
}

std::string complaintOfLoader(const std::filesystem::path& file)
{
    const char* complaint = dlerror(); // NOLINT(concurrency-mt-unsafe): glibc's is
    std::string text = complaint != nullptr ? complaint : "no reason was given";
    const std::string start = file.string() + ": ";
    return text.starts_with(start) ? text.substr(start.size()) : text;
}

struct Size {
    const char* of;
    std::uint32_t bytes;
    std::uint32_t bytes_min;
    std::uint32_t bytes_max;
};

std::optional<std::string> faultOf(const MarsviewPlugin& table)
{
    for (const Size& size :
         {Size{"MarsviewPlugin", table.plugin_bytes, kPluginBytesMin, kStructBytesMax},
          Size{"MarsviewCapabilities", table.capabilities_bytes,
               PluginDevice::kCapabilitiesBytesMin, PluginDevice::kCapabilitiesBytesMax},
          Size{"MarsviewSample", table.sample_bytes, PluginDevice::kSampleBytesMin,
               PluginDevice::kSampleBytesMax},
          Size{"MarsviewFoundDevice", table.found_device_bytes, kFoundDeviceBytesMin,
               kStructBytesMax}}) {
        if (size.bytes < size.bytes_min || size.bytes > size.bytes_max) {
            return fmt::format(
                "states that its {} has {} bytes, but {} to {} are supported; "
                "recompile the plugin",
                size.of, size.bytes, size.bytes_min, size.bytes_max);
        }
    }
    struct Function {
        const char* name;
        bool is_there;
    };
    for (const Function& function :
         {Function{"enumerate", table.enumerate != nullptr},
          Function{"open", table.open != nullptr}, Function{"close", table.close != nullptr},
          Function{"capabilities", table.capabilities != nullptr},
          Function{"read", table.read != nullptr}, Function{"write", table.write != nullptr}}) {
        if (!function.is_there) {
            return fmt::format("lacks the function \"{}\"; report it to its makers", function.name);
        }
    }
    if ((table.start_clock == nullptr) != (table.stop_clock == nullptr)) {
        return "has only one of start_clock and stop_clock; report it to its makers";
    }
    return std::nullopt;
}

} // namespace

Result<PluginLibrary> PluginLibrary::load(const std::filesystem::path& file)
{
    const auto refused = [&](ErrorCode code, const std::string& why) {
        return Error{code, fmt::format("{}: {}", file.string(), why)};
    };
    // A path without a slash would be searched for among the system's libraries.
    const std::filesystem::path absolute = std::filesystem::absolute(file);
    dlerror(); // clears earlier errors
    void* library = dlopen(absolute.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (library == nullptr) {
        return refused(ErrorCode::Unreadable,
                       loaderSentence(absolute.string(), complaintOfLoader(absolute)));
    }
    using Entry = const MarsviewPlugin* (*)();
    const auto entry = reinterpret_cast<Entry>(dlsym(library, MARSVIEW_PLUGIN_SYMBOL));
    if (entry == nullptr) {
        return refused(ErrorCode::Unsupported, "is not a device plugin: it has no function " +
                                                   std::string(MARSVIEW_PLUGIN_SYMBOL));
    }
    const MarsviewPlugin* theirs = entry();
    if (theirs == nullptr) {
        return refused(ErrorCode::Unsupported, "returned no function table");
    }
    // Until the version is known, only the version's own offset is certain.
    if (theirs->abi_version != MARSVIEW_PLUGIN_ABI_VERSION) {
        return refused(ErrorCode::Unsupported,
                       fmt::format("is built for version {} of the plugin interface, but this "
                                   "program has version {}; get a build for this version",
                                   theirs->abi_version, MARSVIEW_PLUGIN_ABI_VERSION));
    }
    MarsviewPlugin table{};
    std::memcpy(
        &table, theirs,
        std::min<std::size_t>(sizeof table, std::max<std::size_t>(theirs->plugin_bytes, 8)));
    if (const auto fault = faultOf(table)) {
        return refused(ErrorCode::Unsupported, *fault);
    }
    std::string name = shownText(table.name);
    return PluginLibrary(table, name.empty() ? file.stem().string() : std::move(name));
}

std::vector<PluginEntry> PluginLibrary::enumerate() const
{
    std::vector<PluginEntry> entries;
    table_.enumerate(
        [](void* self, const MarsviewFoundDevice* device) noexcept {
            if (device != nullptr && device->id != nullptr) {
                static_cast<std::vector<PluginEntry>*>(self)->push_back(
                    {shownText(device->id), shownText(device->name), shownText(device->reason)});
            }
        },
        &entries);
    return entries;
}

Result<std::unique_ptr<HapticDevice>>
PluginLibrary::open(const std::string& id, std::string_view uri, PluginHoming homing) const
{
    std::array<char, kTextMax + 1> complaint{};
    MarsviewDevice* opened = table_.open(id.c_str(), complaint.data(), complaint.size());
    complaint.back() = '\0';
    if (opened == nullptr) {
        const std::string why = shownText(complaint.data());
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: could not be opened: {}", uri,
                                 why.empty() ? "its plugin gave no reason" : why)};
    }
    auto device = std::make_unique<PluginDevice>(table_, opened);
    if (const auto fault = device->describe(name_)) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: {}; report it to the plugin's makers", uri, *fault)};
    }
    if (homing == PluginHoming::AtHome) {
        if (const auto why = device->calibrate()) {
            return Error{ErrorCode::Unsupported, fmt::format("{}: {}", uri, *why)};
        }
    }
    return std::unique_ptr<HapticDevice>(std::make_unique<CheckedDevice>(std::move(device)));
}

} // namespace marsview
