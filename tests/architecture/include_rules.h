// The dependency rules between the layers, checked on #include lines.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace marsview::test {

/// The names in the #include directives of a source text, with their quotes or brackets:
/// "core/base/angle.h" as written, <QWidget> with its brackets. Comments are skipped.
std::vector<std::string> includesOf(std::string_view source);

/// The reason why a file at `path` (relative to the source root) may not include `include`; nullopt
/// where it may.
std::optional<std::string> violation(std::string_view path, std::string_view include);

} // namespace marsview::test
