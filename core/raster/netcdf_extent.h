// How long a classic netCDF file has to be. GDAL and the netCDF library read what lies beyond the
// end of such a file as zeros, without a word.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace marsview {

/// The bytes up to which the header places the variables (of records, the first), less the padding
/// that writers may leave out at the end. Nothing where the file is no classic netCDF (CDF-1, 2 or
/// 5) or its header is not understood. Format: "The NetCDF Classic Format Specification", Unidata.
std::optional<std::uint64_t> classicNetcdfBytes(const std::string& path);

} // namespace marsview
