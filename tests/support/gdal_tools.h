// GDAL's own command-line tools as oracles. They share GDAL with the program, but none of its code.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace marsview::test {

/// `gdalinfo -json`; throws if gdalinfo rejects the file.
nlohmann::json gdalInfo(const std::string& path);

/// The entry of the first band in `info`.
const nlohmann::json& firstBand(const nlohmann::json& info);

/// A number in gdalinfo's JSON, which writes NaN as text.
double jsonNumber(const nlohmann::json& value);

struct Pixel {
    std::size_t column = 0;
    std::size_t row = 0;
};

/// Raw samples of the first band as `gdallocationinfo -valonly` prints them: with 15 digits, before
/// scale and offset, nodata as its value. One process for all positions.
std::vector<double> rawSamples(const std::string& path, const std::vector<Pixel>& pixels);

/// The mask of the first band, row by row: 0 for samples that GDAL's mask marks as invalid.
std::vector<unsigned char> maskOf(const std::string& path);

struct Position {
    double x = 0.0;
    double y = 0.0;
};

/// `gdaltransform`; one process for all positions. The axes are in OGR's traditional order.
std::vector<Position>
transformed(const std::string& from, const std::string& to, const std::vector<Position>& positions);

/// WKT in a form that can be compared: without white space between its parts, and with the WGS 84
/// ensemble replaced by the single datum it represents. Which of the two GDAL writes depends on
/// what the process opened before.
std::string compactWkt(const std::string& wkt);

} // namespace marsview::test
