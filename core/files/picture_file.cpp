#include "core/files/picture_file.h"

#include "core/base/check.h"
#include "core/files/gdal_runtime.h"

#include <cpl_string.h>
#include <gdal_priv.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <fmt/format.h>
#include <memory>

namespace marsview {
namespace {

Status
write(const Picture& picture, const std::string& path, const char* driver_name, char** options)
{
    MARSVIEW_CHECK(picture.rgb.size() == static_cast<std::size_t>(picture.width) *
                                             static_cast<std::size_t>(picture.height) * 3);
    ensureGdal();
    GdalMessages messages;
    const auto refusal = [&] {
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: the picture cannot be written ({}); choose another folder",
                                 path, messages.firstFailure("unknown reason"))};
    };
    GDALDriver* memory = GetGDALDriverManager()->GetDriverByName("MEM");
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(driver_name);
    if (memory == nullptr || driver == nullptr) {
        return refusal();
    }
    const GDALDatasetUniquePtr source(
        memory->Create("", picture.width, picture.height, 3, GDT_Byte, nullptr));
    // GDAL uses one function for reading and writing, with a pointer to non-const.
    auto* pixels = const_cast<std::uint8_t*>(picture.rgb.data()); // NOLINT
    if (!source || source->RasterIO(GF_Write, 0, 0, picture.width, picture.height, pixels,
                                    picture.width, picture.height, GDT_Byte, 3, nullptr, 3,
                                    GSpacing{3} * picture.width, 1, nullptr) != CE_None) {
        return refusal();
    }
    const std::string unfinished = path + ".part";
    std::error_code error;
    {
        const GDALDatasetUniquePtr written(
            driver->CreateCopy(unfinished.c_str(), source.get(), FALSE, options, nullptr, nullptr));
        if (!written) {
            std::filesystem::remove(unfinished, error); // for example, after a full disk
            return refusal();
        }
    }
    if (messages.hasFailed()) {
        std::filesystem::remove(unfinished, error);
        return refusal();
    }
    std::filesystem::rename(unfinished, path, error);
    if (error) {
        std::error_code ignored;
        std::filesystem::remove(unfinished, ignored);
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: the picture cannot be written ({}); choose another name",
                                 path, error.message())};
    }
    return Done{};
}

} // namespace

Status writePng(const Picture& picture, const std::string& path)
{
    return write(picture, path, "PNG", nullptr);
}

Status writeTiff(const Picture& picture, const std::string& path)
{
    CPLStringList options;
    options.SetNameValue("COMPRESS", "DEFLATE");
    options.SetNameValue("PREDICTOR", "2");
    options.SetNameValue("PHOTOMETRIC", "RGB");
    return write(picture, path, "GTiff", options.List());
}

} // namespace marsview
