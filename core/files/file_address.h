// "file://" addresses, as file managers and browsers give them.
#pragma once

#include "core/base/result.h"

#include <string>

namespace marsview {

/// The local path that a "file:" address names (RFC 8089: "file:///a%20b.tif",
/// "file://localhost/a.tif", "file:/a.tif"), percent-decoded. Any other text is returned as it is.
/// Invalid where the address names another computer, a relative path, or is badly encoded.
Result<std::string> localPathOf(const std::string& address);

} // namespace marsview
