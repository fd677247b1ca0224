#include "core/prepare/tiff/tiff_tiles.h"

#include "core/base/deflate.h"
#include "core/base/parallel.h"
#include "core/files/tiff_handle.h"
#include "core/tiles/tile.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <sys/stat.h>
#include <tiffio.h>
#include <unistd.h>

namespace marsview {
namespace {

constexpr std::size_t kTilesPerRange = 16;

struct OptionsFreer {
    void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
};

// The library's message and the value of errno at that time.
struct Complaint {
    std::string text;
    int system_error = 0;
};

int noteError(TIFF*, void* complaint, const char* module, const char* format, va_list arguments)
{
    auto& noted = *static_cast<Complaint*>(complaint);
    const int system_error = errno;
    if (noted.text.empty()) {
        std::array<char, 512> text{};
        std::vsnprintf(text.data(), text.size(), format, arguments);
        noted.text = fmt::format("{}: {}", module != nullptr ? module : "TIFF", text.data());
        noted.system_error = system_error;
    }
    return 1; // do not call the process-wide handlers
}

int dropWarning(TIFF*, void*, const char*, const char*, va_list)
{
    return 1;
}

TiffHandle openAt(const std::shared_ptr<const SharedFile>& shared,
                  const std::string& path,
                  TiffTiles::Access access,
                  tdir_t directory,
                  Complaint& complaint)
{
    const std::unique_ptr<TIFFOpenOptions, OptionsFreer> options(TIFFOpenOptionsAlloc());
    if (!options) {
        return nullptr;
    }
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), noteError, &complaint);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), dropWarning, nullptr);
    errno = 0;
    TiffHandle file = openTiff(shared, path,
                               access == TiffTiles::Access::Write ? SharedFile::Access::Update
                                                                  : SharedFile::Access::Read,
                               options.get());
    if (file && directory > 0 && TIFFSetDirectory(file.get(), directory) == 0) {
        return nullptr;
    }
    return file;
}

template <typename T>
T tagOf(TIFF* file, std::uint32_t tag, T otherwise)
{
    T value{};
    return TIFFGetField(file, tag, &value) != 0 ? value : otherwise;
}

} // namespace

struct TiffTiles::Impl {
    std::string path;
    std::unique_ptr<Complaint> complaint = std::make_unique<Complaint>();
    std::shared_ptr<const SharedFile> file;
    std::vector<TiffHandle> handles; // of `file`, one per page, so that none switches directories
    std::vector<TiffPage> pages;

    Error failure() const
    {
        return writeError(path, complaint->system_error,
                          complaint->text.empty() ? "is not a tiled GeoTIFF of the expected kind"
                                                  : complaint->text);
    }
};

TiffTiles::TiffTiles(std::unique_ptr<Impl> impl)
    : impl_(std::move(impl))
{}
TiffTiles::TiffTiles(TiffTiles&&) noexcept = default;
TiffTiles& TiffTiles::operator=(TiffTiles&&) noexcept = default;
TiffTiles::~TiffTiles() = default;

Result<TiffTiles> TiffTiles::open(const std::string& path, Access access)
{
    auto impl = std::make_unique<Impl>();
    impl->path = path;
    errno = 0;
    impl->file = access == Access::Write ? openForUpdate(path) : openShared(path);
    if (!impl->file) {
        *impl->complaint = {fmt::format("{}: Cannot open", path), errno};
        return impl->failure();
    }
    for (tdir_t directory = 0;; ++directory) {
        TiffHandle handle = openAt(impl->file, path, access, directory, *impl->complaint);
        if (!handle) {
            return impl->failure();
        }
        TIFF* file = handle.get();
        const auto tile_width = tagOf<std::uint32_t>(file, TIFFTAG_TILEWIDTH, 0);
        const auto tile_height = tagOf<std::uint32_t>(file, TIFFTAG_TILELENGTH, 0);
        const auto compression = tagOf<std::uint16_t>(file, TIFFTAG_COMPRESSION, 0);
        if (tile_width != kTileSide || tile_height != kTileSide ||
            compression != COMPRESSION_ADOBE_DEFLATE) {
            return impl->failure();
        }
        TiffPage page;
        page.columns = tagOf<std::uint32_t>(file, TIFFTAG_IMAGEWIDTH, 0);
        page.rows = tagOf<std::uint32_t>(file, TIFFTAG_IMAGELENGTH, 0);
        page.tile_columns = (page.columns + kTileSide - 1) / kTileSide;
        page.tile_rows = (page.rows + kTileSide - 1) / kTileSide;
        page.is_mask = (tagOf<std::uint32_t>(file, TIFFTAG_SUBFILETYPE, 0) & FILETYPE_MASK) != 0;
        page.has_bits = tagOf<std::uint16_t>(file, TIFFTAG_BITSPERSAMPLE, 1) == 1;
        page.predictor =
            static_cast<TiffPredictor>(tagOf<std::uint16_t>(file, TIFFTAG_PREDICTOR, 1));
        impl->pages.push_back(page);
        const bool is_last = TIFFLastDirectory(file) != 0;
        impl->handles.push_back(std::move(handle));
        if (is_last) {
            return TiffTiles(std::move(impl));
        }
    }
}

const std::vector<TiffPage>& TiffTiles::pages() const noexcept
{
    return impl_->pages;
}

Status TiffTiles::append(std::size_t page, std::size_t tile, std::span<const std::byte> encoded)
{
    *impl_->complaint = {};
    errno = 0;
    const auto bytes = static_cast<tmsize_t>(encoded.size());
    // The library takes a pointer to non-const but does not change the data.
    void* data = const_cast<std::byte*>(encoded.data()); // NOLINT
    // Otherwise a tile that was written before but not recorded would be taken for the beginning of
    // this one. Now it is written in its old location if it fits, otherwise at the end of the file.
    TIFFSetWriteOffset(impl_->handles.at(page).get(), 0);
    if (TIFFWriteRawTile(impl_->handles.at(page).get(), static_cast<std::uint32_t>(tile), data,
                         bytes) != bytes) {
        return impl_->failure();
    }
    return Done{};
}

Status TiffTiles::flush()
{
    *impl_->complaint = {};
    errno = 0;
    for (const TiffHandle& handle : impl_->handles) {
        if (TIFFFlush(handle.get()) == 0) {
            return impl_->failure();
        }
    }
    if (fdatasync(impl_->file->descriptor()) != 0) {
        return writeError(impl_->path, errno, "cannot be written to the disk");
    }
    return Done{};
}

Result<std::uint64_t> TiffTiles::fileBytes() const
{
    struct stat status {};
    if (fstat(impl_->file->descriptor(), &status) != 0) {
        return writeError(impl_->path, errno, "cannot determine its size");
    }
    return static_cast<std::uint64_t>(status.st_size);
}

std::uint64_t TiffTiles::encodedBytes(std::size_t page, std::size_t tile) const
{
    return TIFFGetStrileByteCount(impl_->handles.at(page).get(), static_cast<std::uint32_t>(tile));
}

std::uint64_t TiffTiles::offsetOf(std::size_t page, std::size_t tile) const
{
    return TIFFGetStrileOffset(impl_->handles.at(page).get(), static_cast<std::uint32_t>(tile));
}

Result<std::vector<std::byte>> TiffTiles::encoded(std::size_t page, std::size_t tile) const
{
    TIFF* file = impl_->handles.at(page).get();
    const std::uint64_t bytes = encodedBytes(page, tile);
    // Deflate never doubles the size of its input.
    const bool is_there = bytes > 0 && bytes <= 2 * std::uint64_t{TIFFTileSize64(file)};
    std::vector<std::byte> encoded(is_there ? bytes : 0);
    if (!is_there ||
        impl_->file->read(encoded.data(), encoded.size(), offsetOf(page, tile)) != encoded.size()) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: tile {} of page {} is missing", impl_->path, tile, page)};
    }
    return encoded;
}

bool TiffTiles::holdsTiles(std::size_t page, std::size_t tiles, std::uint64_t file_bytes) const
{
    TIFF* file = impl_->handles.at(page).get();
    for (std::size_t tile = 0; tile < tiles; ++tile) {
        const std::uint64_t offset = TIFFGetStrileOffset(file, static_cast<std::uint32_t>(tile));
        const std::uint64_t bytes = TIFFGetStrileByteCount(file, static_cast<std::uint32_t>(tile));
        if (offset == 0 || bytes == 0 || offset > file_bytes || bytes > file_bytes - offset) {
            return false;
        }
    }
    return true;
}

bool TiffTiles::areWhole(std::size_t page, std::size_t tiles) const
{
    TIFF* file = impl_->handles.at(page).get();
    const auto decoded_bytes = static_cast<std::size_t>(TIFFTileSize64(file));
    std::atomic<bool> are_whole = true;
    parallelRanges(tiles, kTilesPerRange, [&](std::size_t begin, std::size_t end) {
        std::vector<std::byte> encoded;
        std::vector<std::byte> decoded(decoded_bytes);
        for (std::size_t tile = begin; tile < end && are_whole; ++tile) {
            const auto index = static_cast<std::uint32_t>(tile);
            const std::uint64_t bytes = TIFFGetStrileByteCount(file, index);
            // Deflate never doubles the size of its input.
            if (bytes > 2 * std::uint64_t{decoded_bytes}) {
                are_whole = false;
                return;
            }
            encoded.resize(bytes);
            const std::size_t got =
                impl_->file->read(encoded.data(), encoded.size(), TIFFGetStrileOffset(file, index));
            // Unlike the library's own reading it looks at the checksum at the end.
            if (got != encoded.size() || !inflate(encoded, decoded)) {
                are_whole = false;
            }
        }
    });
    return are_whole;
}

Status TiffTiles::trim(std::uint64_t file_bytes)
{
    // A kill between flush and checkpoint leaves unrecorded tiles in the file; they will be
    // rewritten in their locations if they fit. So these locations stay reserved.
    for (std::size_t page = 0; page < impl_->pages.size(); ++page) {
        TIFF* file = impl_->handles[page].get();
        const std::size_t tiles = impl_->pages[page].tile_columns * impl_->pages[page].tile_rows;
        for (std::size_t tile = 0; tile < tiles; ++tile) {
            const auto index = static_cast<std::uint32_t>(tile);
            const std::uint64_t offset = TIFFGetStrileOffset(file, index);
            const std::uint64_t bytes = TIFFGetStrileByteCount(file, index);
            constexpr std::uint64_t kBytesMax = std::uint64_t{1} << 48;
            if (offset > kBytesMax || bytes > kBytesMax) {
                return writeError(impl_->path, 0,
                                  "refers to positions beyond the largest file size");
            }
            file_bytes = std::max(file_bytes, offset + bytes);
        }
    }
    if (ftruncate(impl_->file->descriptor(), static_cast<off_t>(file_bytes)) != 0) {
        return writeError(impl_->path, errno, "cannot be truncated");
    }
    return Done{};
}

Error writeError(const std::string& path, int system_error, const std::string& otherwise)
{
    switch (system_error) {
    case ENOSPC:
    case EDQUOT:
        return {ErrorCode::TooLarge,
                fmt::format("{}: the disk is full; free some space and start again", path)};
    case EFBIG:
        return {ErrorCode::TooLarge,
                fmt::format("{}: has reached the largest file size that is allowed here; choose "
                            "another folder",
                            path)};
    case EACCES:
    case EPERM:
    case EROFS:
        return {ErrorCode::Unreadable,
                fmt::format("{}: cannot be written there ({}); choose another folder", path,
                            std::strerror(system_error))}; // NOLINT(concurrency-mt-unsafe)
    case 0:
        return {ErrorCode::Unreadable, fmt::format("{}: {}", path, otherwise)};
    default:
        return {ErrorCode::Unreadable,
                fmt::format("{}: cannot be written ({}); choose another folder", path,
                            std::strerror(system_error))}; // NOLINT(concurrency-mt-unsafe)
    }
}

} // namespace marsview
