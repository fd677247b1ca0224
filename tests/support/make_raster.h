// Makes small rasters of every kind, without the program's own code.
#pragma once

#include "tests/support/temp_folder.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace marsview::test {

/// A raster as raw bytes with a virtual header (GDAL's VRT), from which gdal_translate makes the
/// other formats.
struct RasterRecipe {
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::string type; // GDAL's name
    std::string bytes;
    std::optional<std::array<double, 6>> transform;
    std::string srs;       // anything that OGR accepts; empty for none
    std::string band_xml;  // such as "<NoDataValue>-9</NoDataValue>"
    std::string extra_xml; // after the band: masks, further bands
};

template <typename T>
constexpr const char* gdalTypeName()
{
    if constexpr (std::is_same_v<T, std::uint8_t> || std::is_same_v<T, std::int8_t>) {
        return "Byte";
    } else if constexpr (std::is_same_v<T, std::uint16_t>) {
        return "UInt16";
    } else if constexpr (std::is_same_v<T, std::int16_t>) {
        return "Int16";
    } else if constexpr (std::is_same_v<T, std::uint32_t>) {
        return "UInt32";
    } else if constexpr (std::is_same_v<T, std::int32_t>) {
        return "Int32";
    } else if constexpr (std::is_same_v<T, std::uint64_t>) {
        return "UInt64";
    } else if constexpr (std::is_same_v<T, std::int64_t>) {
        return "Int64";
    } else if constexpr (std::is_same_v<T, float>) {
        return "Float32";
    } else {
        static_assert(std::is_same_v<T, double>);
        return "Float64";
    }
}

/// A recipe for `samples`, row by row, one meter per pixel and without a CRS unless changed.
template <typename T>
RasterRecipe recipeFor(std::size_t columns, const std::vector<T>& samples)
{
    RasterRecipe recipe;
    recipe.columns = columns;
    recipe.rows = samples.size() / columns;
    recipe.type = gdalTypeName<T>();
    recipe.bytes.assign(reinterpret_cast<const char*>(samples.data()), samples.size() * sizeof(T));
    recipe.transform = {1000.0, 1.0, 0.0, 2000.0, 0.0, -1.0};
    if constexpr (std::is_same_v<T, std::int8_t>) {
        recipe.band_xml =
            "<Metadata domain=\"IMAGE_STRUCTURE\">"
            "<MDI key=\"PIXELTYPE\">SIGNEDBYTE</MDI></Metadata>";
    }
    return recipe;
}

/// Writes NAME.vrt and NAME.raw; returns the path of the former.
std::string writeVrt(const TempFolder& folder, const std::string& name, const RasterRecipe& recipe);

/// gdal_translate of a recipe to FILE in `format`; returns FILE's path.
std::string writeRaster(const TempFolder& folder,
                        const std::string& file,
                        const std::string& format,
                        const RasterRecipe& recipe,
                        const std::vector<std::string>& options = {});

} // namespace marsview::test
