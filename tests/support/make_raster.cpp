#include "tests/support/make_raster.h"

#include "tests/support/run_program.h"

#include <bit>
#include <fmt/format.h>

namespace marsview::test {
namespace {

std::string escaped(const std::string& text)
{
    std::string xml;
    for (const char c : text) {
        xml += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
    }
    return xml;
}

std::size_t bytesOf(const RasterRecipe& recipe)
{
    return recipe.bytes.size() / (recipe.columns * recipe.rows);
}

} // namespace

std::string writeVrt(const TempFolder& folder, const std::string& name, const RasterRecipe& recipe)
{
    folder.write(name + ".raw", recipe.bytes);
    const std::size_t sample_bytes = bytesOf(recipe);
    std::string xml = fmt::format("<VRTDataset rasterXSize=\"{}\" rasterYSize=\"{}\">\n",
                                  recipe.columns, recipe.rows);
    if (!recipe.srs.empty()) {
        xml += fmt::format("<SRS>{}</SRS>\n", escaped(recipe.srs));
    }
    if (recipe.transform) {
        xml += fmt::format("<GeoTransform>{:.17g}</GeoTransform>\n",
                           fmt::join(*recipe.transform, ", "));
    }
    xml += fmt::format(
        "<VRTRasterBand dataType=\"{}\" band=\"1\" subClass=\"VRTRawRasterBand\">\n"
        "<SourceFilename relativeToVRT=\"1\">{}.raw</SourceFilename>\n"
        "<ImageOffset>0</ImageOffset><PixelOffset>{}</PixelOffset>"
        "<LineOffset>{}</LineOffset><ByteOrder>{}</ByteOrder>\n"
        "{}\n</VRTRasterBand>\n{}\n</VRTDataset>\n",
        recipe.type, name, sample_bytes, sample_bytes * recipe.columns,
        std::endian::native == std::endian::little ? "LSB" : "MSB", recipe.band_xml,
        recipe.extra_xml);
    return folder.write(name + ".vrt", xml);
}

std::string writeRaster(const TempFolder& folder,
                        const std::string& file,
                        const std::string& format,
                        const RasterRecipe& recipe,
                        const std::vector<std::string>& options)
{
    std::vector<std::string> command{"gdal_translate", "-q", "-of", format};
    command.insert(command.end(), options.begin(), options.end());
    command.push_back(writeVrt(folder, file + "-source", recipe));
    command.push_back(folder.file(file));
    runTool(command);
    return folder.file(file);
}

} // namespace marsview::test
