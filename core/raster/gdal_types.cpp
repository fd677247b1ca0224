#include "core/raster/gdal_types.h"

#include "core/base/check.h"

#include <gdal_priv.h>

#include <cstdint>
#include <fmt/format.h>

namespace marsview {
namespace {

// Far above any existing raster: the Earth at 2.4 m has this many columns.
constexpr std::size_t kSideMax = std::size_t{1} << 24;
constexpr std::uint64_t kSamplesMax = std::uint64_t{1} << 40;

} // namespace

GDALDataType gdalTypeOf(SampleType type)
{
    switch (type) {
    case SampleType::UInt8:
    case SampleType::Int8:
        return GDT_Byte;
    case SampleType::UInt16:
        return GDT_UInt16;
    case SampleType::Int16:
        return GDT_Int16;
    case SampleType::UInt32:
        return GDT_UInt32;
    case SampleType::Int32:
        return GDT_Int32;
    case SampleType::UInt64:
        return GDT_UInt64;
    case SampleType::Int64:
        return GDT_Int64;
    case SampleType::Float32:
        return GDT_Float32;
    case SampleType::Float64:
        return GDT_Float64;
    }
    MARSVIEW_CHECK(false);
}

std::optional<SampleType> sampleTypeOf(GDALRasterBand& band)
{
    switch (band.GetRasterDataType()) {
    case GDT_Byte: {
        const char* pixel_type = band.GetMetadataItem("PIXELTYPE", "IMAGE_STRUCTURE");
        return pixel_type != nullptr && EQUAL(pixel_type, "SIGNEDBYTE") ? SampleType::Int8
                                                                        : SampleType::UInt8;
    }
    case GDT_UInt16:
        return SampleType::UInt16;
    case GDT_Int16:
        return SampleType::Int16;
    case GDT_UInt32:
        return SampleType::UInt32;
    case GDT_Int32:
        return SampleType::Int32;
    case GDT_UInt64:
        return SampleType::UInt64;
    case GDT_Int64:
        return SampleType::Int64;
    case GDT_Float32:
        return SampleType::Float32;
    case GDT_Float64:
        return SampleType::Float64;
    default:
        return std::nullopt;
    }
}

Status checkMapSize(std::size_t columns, std::size_t rows)
{
    if (columns == 0 || rows == 0) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("is damaged: its header says {} × {} samples; fetch it again",
                                 columns, rows)};
    }
    if (columns > kSideMax || rows > kSideMax || std::uint64_t{columns} * rows > kSamplesMax) {
        return Error{ErrorCode::TooLarge,
                     fmt::format("{} × {} samples cannot be a map; at most {} a side and {} in all "
                                 "are read",
                                 columns, rows, kSideMax, kSamplesMax)};
    }
    return Done{};
}

} // namespace marsview
