// GDAL's own command-line tools as oracles. They share GDAL with the program, but none of its code.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace marsview::test {

/// `gdalinfo -json`; throws where gdalinfo refuses the file.
nlohmann::json gdalInfo(const std::string& path);

/// The first band's entry in `info`.
const nlohmann::json& firstBand(const nlohmann::json& info);

/// A number of gdalinfo's JSON, which writes NaN as text.
double jsonNumber(const nlohmann::json& value);

struct Pixel {
    std::size_t column = 0;
    std::size_t row = 0;
};

/// Raw samples of the first band as `gdallocationinfo -valonly` prints them: with 15 digits, before
/// scale and offset, nodata as its value. One run for all positions.
std::vector<double> rawSamples(const std::string& path, const std::vector<Pixel>& pixels);

/// The mask of the first band, row by row: 0 where GDAL's mask calls the sample invalid.
std::vector<unsigned char> maskOf(const std::string& path);

struct Position {
    double x = 0.0;
    double y = 0.0;
};

/// `gdaltransform`; one run for all positions. The axes are as OGR's traditional order has them.
std::vector<Position>
transformed(const std::string& from, const std::string& to, const std::vector<Position>& positions);

/// WKT so that texts compare: without the white space between its parts, and with the ensemble of
/// WGS 84's realisations as the one datum that it stands for; which of the two GDAL writes depends
/// on what the process opened before.
std::string compactWkt(const std::string& wkt);

} // namespace marsview::test
