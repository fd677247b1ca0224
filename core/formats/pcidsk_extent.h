// The required length of a PCIDSK file. GDAL silently reads samples beyond the end of such a file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace marsview {

/// In bytes, according to the header. Empty if it cannot be read. Format: "PCIDSK Database File
/// Format", PCI Geomatics, bytes 17 to 32 of the file header.
std::optional<std::int64_t> pcidskBytes(const std::string& path);

} // namespace marsview
