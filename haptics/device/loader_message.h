// Sentences for what the dynamic loader reports.
#pragma once

#include <string>
#include <string_view>

namespace marsview {

/// Why the shared library `name` (a file name or path) could not be loaded and what to do, as half
/// a sentence that follows its name: "needs the library libfoo.so.1, which is not installed; …".
/// `message` is dlerror()'s; what is in none of the known forms is repeated in it.
std::string loaderSentence(std::string_view name, std::string_view message);

} // namespace marsview
