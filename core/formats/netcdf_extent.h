// The required length of a classic netCDF file. GDAL and the netCDF library silently read zeros
// beyond the end of such a file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace marsview {

/// The end of the variables according to the header (for record variables, of the first record),
/// without the final padding that writers may omit. Empty if the file is not a classic netCDF
/// (CDF-1, 2 or 5) or its header cannot be parsed. Format: "The NetCDF Classic Format
/// Specification", Unidata.
std::optional<std::uint64_t> classicNetcdfBytes(const std::string& path);

} // namespace marsview
