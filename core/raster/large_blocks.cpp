#include "core/raster/large_blocks.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal_priv.h>

#include <cstdint>
#include <cstdlib>
#include <fmt/format.h>

namespace marsview {
namespace {

// Smaller blocks are read normally.
constexpr std::uint64_t kLargeBytes = std::uint64_t{16} << 20;
// Larger blocks are reported to the user.
constexpr std::uint64_t kNotableBytes = std::uint64_t{256} << 20;

struct Block {
    int columns = 0;
    int rows = 0;
    std::uint64_t bytes = 0; // decoded
};

Block blockOf(GDALRasterBand& band)
{
    Block block;
    band.GetBlockSize(&block.columns, &block.rows);
    block.bytes = static_cast<std::uint64_t>(block.columns) *
                  static_cast<std::uint64_t>(block.rows) *
                  static_cast<std::uint64_t>(GDALGetDataTypeSizeBytes(band.GetRasterDataType()));
    return block;
}

bool hasLargeStrips(GDALDataset& dataset, GDALRasterBand& band)
{
    const Block block = blockOf(band);
    return EQUAL(dataset.GetDriverName(), "GTiff") && block.columns == band.GetXSize() &&
           block.rows > 1 && block.bytes >= kLargeBytes;
}

bool isCompressed(GDALDataset& dataset)
{
    return dataset.GetMetadataItem("COMPRESSION", "IMAGE_STRUCTURE") != nullptr;
}

} // namespace

struct DirectReads::Setting {
    CPLConfigOptionSetter option{"GTIFF_DIRECT_IO", "YES", true};
};

DirectReads::DirectReads()
    : setting_(std::make_unique<Setting>())
{}

DirectReads::~DirectReads() = default;

bool hasLargePlainStrips(GDALDataset& dataset)
{
    return dataset.GetRasterCount() > 0 && !isCompressed(dataset) &&
           hasLargeStrips(dataset, *dataset.GetRasterBand(1));
}

std::optional<TiffStrips> largeStripsOf(GDALRasterBand& band, const RasterInfo& info)
{
    GDALDataset& dataset = *band.GetDataset();
    // GDAL's names select a part of a file; a plain path means the first.
    const bool is_plain =
        !info.path.starts_with("/vsi") && info.path.find(':') == std::string::npos;
    if (!is_plain || !isCompressed(dataset) || !hasLargeStrips(dataset, band)) {
        return std::nullopt;
    }
    return TiffStrips::of(
        info.path,
        {.columns = info.columns, .rows = info.rows, .type = info.type, .band = info.band});
}

std::optional<std::string> noticeOfLargeBlock(GDALRasterBand& band)
{
    const Block block = blockOf(band);
    const char* stored = band.GetMetadataItem("BLOCK_SIZE_0_0", "TIFF");
    const std::uint64_t bytes =
        block.bytes + (stored != nullptr ? std::strtoull(stored, nullptr, 10) : 0);
    if (bytes < kNotableBytes) {
        return std::nullopt;
    }
    return fmt::format(
        "is stored in blocks of {} × {} samples: reading a part of it takes up to "
        "{:.1f} GB of memory; gdal_translate -co TILED=YES makes a file that takes "
        "less",
        block.columns, block.rows, static_cast<double>(bytes) / 1e9);
}

} // namespace marsview
