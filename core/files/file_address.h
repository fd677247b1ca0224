// "file://" addresses, as used by file managers and browsers.
#pragma once

#include "core/base/result.h"

#include <string>

namespace marsview {

/// The local path of a "file:" address (RFC 8089: "file:///a%20b.tif", "file://localhost/a.tif",
/// "file:/a.tif"), percent-decoded. Any other text is returned as it is. Invalid if the address
/// names another computer or a relative path, or is badly encoded.
Result<std::string> localPathOf(const std::string& address);

} // namespace marsview
