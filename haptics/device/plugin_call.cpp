#include "haptics/device/plugin_call.h"

#include <array>
#include <cstddef>
#include <fmt/format.h>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace marsview {
namespace {

namespace fs = std::filesystem;

struct Call {
    std::string_view name;  // part of the file name
    std::string_view doing; // "while it was ..."
};

// In the enumeration's order.
constexpr std::array kCalls{Call{"load", "being loaded"}, Call{"enumerate", "listing its devices"},
                            Call{"open", "opening a device"}, Call{"run", "running a device"},
                            Call{"close", "closing a device"}};

std::string stemFor(const fs::path& plugin)
{
    std::error_code none;
    const fs::path canonical = fs::weakly_canonical(plugin, none);
    return fmt::format("{}-{:016x}-{}-{}.", plugin.stem().string(),
                       std::hash<std::string>()(canonical.string()), fs::file_size(plugin, none),
                       fs::last_write_time(plugin, none).time_since_epoch().count());
}

std::string_view doingIn(std::string_view name_after_stem)
{
    for (const Call& call : kCalls) {
        if (name_after_stem.starts_with(call.name)) {
            return call.doing;
        }
    }
    return kCalls.front().doing;
}

} // namespace

Result<CrashMarker> markPluginCall(const fs::path& folder, const fs::path& plugin, PluginCall call)
{
    const std::string stem = stemFor(plugin);
    if (const auto left = CrashMarker::leftBehind(folder, stem)) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: the program ended while this plugin was {} last time, so the "
                                 "plugin is skipped; replace it, or try it again with "
                                 "marsview-cli devices --retry",
                                 plugin.string(),
                                 doingIn(std::string_view(*left).substr(stem.size())))};
    }
    const std::string_view doing = kCalls.at(static_cast<std::size_t>(call)).name;
    return CrashMarker::set(folder, fmt::format("{}{}", stem, doing));
}

} // namespace marsview
