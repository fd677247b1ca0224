// The arrows between the layers, as rules on #include lines.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace marsview::test {

/// What is named by the #include directives of a source text, with their quotes or brackets:
/// "core/base/angle.h" as it stands, <QWidget> with its brackets. Comments are not includes.
std::vector<std::string> includesOf(std::string_view source);

/// Why a file at `path` (relative to the source root) may not include `include`; nothing where it
/// may.
std::optional<std::string> violation(std::string_view path, std::string_view include);

} // namespace marsview::test
