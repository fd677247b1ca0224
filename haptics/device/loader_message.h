// Messages for errors of the dynamic loader.
#pragma once

#include <string>
#include <string_view>

namespace marsview {

/// Why the shared library `name` (a file name or path) could not be loaded and what to do, phrased
/// to follow the name: "needs the library libfoo.so.1, which is not installed; …". `message` comes
/// from dlerror(); an unknown form is quoted as it is.
std::string loaderSentence(std::string_view name, std::string_view message);

} // namespace marsview
