// Labels in the Object Description Language: PDS3, ISIS 2 and ISIS 3.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

/// A statement "NAME = value", or an object or group with statements in it.
struct OdlStatement {
    std::string name;      // in capitals, with the "^" of a pointer
    std::string value;     // without quotes and unit; a list as written; for a group its name
    std::string unit;      // between "<" and ">"
    bool is_group = false; // OBJECT or GROUP
    std::vector<OdlStatement> statements{}; // of a group
};

/// The statements up to END. Comments and invalid statements are skipped. Empty if there is no
/// statement at all, as in a file of samples.
std::optional<OdlStatement> parseOdl(std::string_view text);

/// The same for the first 1 MiB of a file, with a detached or an attached label. Accepts any name
/// that GDAL opens.
std::optional<OdlStatement> readOdlLabel(const std::string& path);

/// The statement of that name (in capitals) directly in `group`; null if there is none.
const OdlStatement* statementIn(const OdlStatement& group, std::string_view name);

/// The first object or group whose name (in capitals) is `name`, `group` itself included, at any
/// depth.
const OdlStatement* groupNamed(const OdlStatement& group, std::string_view name);

/// The items of a list "(a, b)" or "{a, b}" without quotes; a single value counts as a list of one.
std::vector<std::string> odlItems(const std::string& value);

} // namespace marsview
