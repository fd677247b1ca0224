#include "haptics/device/home_option.h"

#include <algorithm>
#include <array>

namespace marsview {
namespace {

constexpr std::string_view kHome = ",home";
constexpr std::array<std::string_view, 3> kSchemes{"openhaptics:", "plugin:", "polhem:"};

} // namespace

bool takeHomeOption(std::string_view& address) noexcept
{
    if (!address.ends_with(kHome)) {
        return false;
    }
    address.remove_suffix(kHome.size());
    return true;
}

std::string lastingUri(std::string_view uri)
{
    std::string lasting(uri);
    if (std::none_of(kSchemes.begin(), kSchemes.end(),
                     [uri](std::string_view scheme) { return uri.starts_with(scheme); })) {
        return lasting;
    }
    for (std::size_t at = lasting.find(kHome); at != std::string::npos;
         at = lasting.find(kHome, at)) {
        const std::size_t end = at + kHome.size();
        if (end == lasting.size() || lasting[end] == ',') {
            lasting.erase(at, kHome.size());
        } else {
            at = end; // the name continues: no match
        }
    }
    return lasting;
}

} // namespace marsview
