#include "core/raster/tiff_strips.h"

#include "core/base/check.h"
#include "core/files/tiff_handle.h"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <fmt/format.h>
#include <tiffio.h>
#include <type_traits>
#include <utility>
#include <vector>

namespace marsview {
namespace {

struct OptionsFreer {
    void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
};

int noteError(TIFF*, void* complaint, const char*, const char* format, va_list arguments)
{
    auto& noted = *static_cast<std::string*>(complaint);
    if (noted.empty()) {
        std::array<char, 512> text{};
        std::vsnprintf(text.data(), text.size(), format, arguments);
        noted = text.data();
    }
    return 1; // do not call the process-wide handlers
}

int dropWarning(TIFF*, void*, const char*, const char*, va_list)
{
    return 1;
}

TiffHandle openToRead(const std::string& path, std::string& complaint)
{
    const std::unique_ptr<TIFFOpenOptions, OptionsFreer> options(TIFFOpenOptionsAlloc());
    if (!options) {
        return nullptr;
    }
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), noteError, &complaint);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), dropWarning, nullptr);
    std::shared_ptr<const SharedFile> file = openShared(path);
    return file ? openTiff(std::move(file), path, SharedFile::Access::Read, options.get())
                : nullptr;
}

template <typename T>
T tagOf(TIFF* file, std::uint32_t tag)
{
    T value{};
    return TIFFGetFieldDefaulted(file, tag, &value) != 0 ? value : T{};
}

std::uint16_t formatOf(SampleType type)
{
    return dispatchSampleType(type, [](auto sample) -> std::uint16_t {
        using T = decltype(sample);
        return std::is_floating_point_v<T> ? SAMPLEFORMAT_IEEEFP
               : std::is_signed_v<T>       ? SAMPLEFORMAT_INT
                                           : SAMPLEFORMAT_UINT;
    });
}

// GDAL omits strips with only voids; libtiff treats those as damage.
bool hasAllStrips(TIFF* file)
{
    const std::uint32_t count = TIFFNumberOfStrips(file);
    for (std::uint32_t strip = 0; strip < count; ++strip) {
        if (TIFFGetStrileByteCount(file, strip) == 0) {
            return false;
        }
    }
    return count > 0;
}

bool isKnown(std::uint16_t compression)
{
    constexpr std::array<std::uint16_t, 5> known{COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE,
                                                 COMPRESSION_DEFLATE, COMPRESSION_ZSTD,
                                                 COMPRESSION_PACKBITS};
    return std::find(known.begin(), known.end(), compression) != known.end() &&
           TIFFIsCODECConfigured(compression) != 0;
}

} // namespace

struct TiffStrips::Impl {
    std::string path;
    TiffStripsLayout layout;
    std::string complaint;
    TiffHandle file; // open while rows are left to read
    std::size_t strip_rows = 0;
    std::size_t row_bytes = 0;
    std::size_t next_row = 0; // the row that needs no extra decoding
    std::vector<std::byte> skipped;

    bool open();
    Status readRow(std::size_t row, std::byte* to);
};

bool TiffStrips::Impl::open()
{
    complaint.clear();
    file = openToRead(path, complaint);
    next_row = 0;
    if (!file) {
        return false;
    }
    TIFF* const tiff = file.get();
    const auto bands = tagOf<std::uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL);
    const bool is_separate =
        tagOf<std::uint16_t>(tiff, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE;
    row_bytes = layout.columns * sampleBytes(layout.type);
    strip_rows =
        std::min<std::size_t>(tagOf<std::uint32_t>(tiff, TIFFTAG_ROWSPERSTRIP), layout.rows);
    const bool is_right =
        TIFFIsTiled(tiff) == 0 && isKnown(tagOf<std::uint16_t>(tiff, TIFFTAG_COMPRESSION)) &&
        tagOf<std::uint16_t>(tiff, TIFFTAG_PHOTOMETRIC) == PHOTOMETRIC_MINISBLACK &&
        tagOf<std::uint32_t>(tiff, TIFFTAG_IMAGEWIDTH) == layout.columns &&
        tagOf<std::uint32_t>(tiff, TIFFTAG_IMAGELENGTH) == layout.rows &&
        tagOf<std::uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE) == 8 * sampleBytes(layout.type) &&
        tagOf<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT) == formatOf(layout.type) &&
        layout.band >= 1 && layout.band <= bands && (bands == 1 || is_separate) && strip_rows > 0 &&
        TIFFScanlineSize64(tiff) == row_bytes && hasAllStrips(tiff);
    if (!is_right) {
        file.reset();
    }
    return is_right;
}

Status TiffStrips::Impl::readRow(std::size_t row, std::byte* to)
{
    if (TIFFReadScanline(file.get(), to, static_cast<std::uint32_t>(row),
                         static_cast<std::uint16_t>(layout.band - 1)) < 0) {
        file.reset(); // the next read starts over
        return Error{
            ErrorCode::Unreadable,
            complaint.empty()
                ? "the file is cut short or damaged; fetch it again"
                : fmt::format("the file is cut short or damaged ({}); fetch it again", complaint)};
    }
    next_row = row + 1;
    return Done{};
}

TiffStrips::TiffStrips(std::unique_ptr<Impl> impl)
    : impl_(std::move(impl))
{}
TiffStrips::TiffStrips(TiffStrips&&) noexcept = default;
TiffStrips& TiffStrips::operator=(TiffStrips&&) noexcept = default;
TiffStrips::~TiffStrips() = default;

std::optional<TiffStrips> TiffStrips::of(const std::string& path, const TiffStripsLayout& layout)
{
    auto impl = std::make_unique<Impl>();
    impl->path = path;
    impl->layout = layout;
    if (!impl->open()) {
        return std::nullopt;
    }
    TiffStrips strips(std::move(impl));
    strips.rest();
    return strips;
}

void TiffStrips::rest() noexcept
{
    impl_->file.reset();
}

Status TiffStrips::read(std::size_t first_row, std::size_t row_count, std::byte* to)
{
    Impl& of = *impl_;
    MARSVIEW_CHECK(first_row + row_count <= of.layout.rows);
    if (!of.file && !of.open()) {
        return Error{ErrorCode::Unreadable,
                     of.complaint.empty() ? "it has changed since it was opened" : of.complaint};
    }
    const std::size_t strip_begin = first_row / of.strip_rows * of.strip_rows;
    of.skipped.resize(of.row_bytes);
    for (std::size_t row = first_row >= of.next_row ? std::max(strip_begin, of.next_row)
                                                    : strip_begin;
         row < first_row + row_count; ++row) {
        std::byte* const there =
            row < first_row ? of.skipped.data() : to + (row - first_row) * of.row_bytes;
        if (Status read = of.readRow(row, there); !read) {
            return read;
        }
    }
    if (first_row + row_count == of.layout.rows) {
        rest();
    }
    return Done{};
}

} // namespace marsview
