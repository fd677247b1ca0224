// The option ",home" of a device's URI: the device is in its home position now and is calibrated
// there.
#pragma once

#include <string>
#include <string_view>

namespace marsview {

/// Removes ",home" from the end of an address. Returns whether it was there.
bool takeHomeOption(std::string_view& address) noexcept;

/// The URI by which a device can be opened again later: without ",home" where the scheme has that
/// option, since the device will not be in its home position then.
std::string lastingUri(std::string_view uri);

} // namespace marsview
