// The directories of BigTIFF: a directory is a count (u64) and entries of 20 bytes each, tag (u16),
// type (u16), count (u64) and value or offset (u64), followed by the offset of the next directory.

#include "core/prepare/tiff/tiff_stream.h"

#include "core/base/check.h"
#include "core/base/deflate.h"
#include "core/base/durable_file.h"
#include "core/files/file_bytes.h"
#include "core/files/gdal_runtime.h"
#include "core/files/remote_raster.h"

#include <cpl_vsi.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace marsview {
namespace {

class DiskStream final : public ByteStream {
public:
    DiskStream(std::string path, std::FILE* file)
        : path_(std::move(path))
        , file_(file)
    {}

    Status write(std::span<const std::byte> bytes) override
    {
        errno = 0;
        return std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) == bytes.size()
                   ? Status(Done{})
                   : Status(writeError(path_, errno, "cannot be written"));
    }
    Status finish() override
    {
        errno = 0;
        return flushToDisk(file_.get())
                   ? Status(Done{})
                   : Status(writeError(path_, errno, "cannot be written to the disk"));
    }

private:
    struct Close {
        void operator()(std::FILE* file) const noexcept { std::fclose(file); }
    };

    std::string path_;
    std::unique_ptr<std::FILE, Close> file_;
};

class RemoteStream final : public ByteStream {
public:
    RemoteStream(std::string path, VSILFILE* file)
        : path_(std::move(path))
        , file_(file)
    {}

    Status write(std::span<const std::byte> bytes) override
    {
        const GdalMessages messages;
        return VSIFWriteL(bytes.data(), 1, bytes.size(), file_.get()) == bytes.size()
                   ? Status(Done{})
                   : Status(failed(messages));
    }
    Status finish() override
    {
        const GdalMessages messages;
        return VSIFCloseL(file_.release()) == 0 && !messages.hasFailed() ? Status(Done{})
                                                                         : Status(failed(messages));
    }

private:
    struct Close {
        void operator()(VSILFILE* file) const noexcept { VSIFCloseL(file); }
    };

    Error failed(const GdalMessages& messages) const
    {
        return {ErrorCode::Unreadable, fmt::format("{}: cannot be written ({})", addressOf(path_),
                                                   messages.firstFailure("unknown reason"))};
    }

    std::string path_;
    std::unique_ptr<VSILFILE, Close> file_;
};

// The directories of a file without tiles.
class Skeleton {
public:
    static Result<Skeleton> read(const std::string& path, std::uint64_t bytes_max)
    {
        const Result<FileBytes> file = FileBytes::open(path);
        if (!file) {
            return file.error();
        }
        Result<RawArray<std::byte>> bytes =
            file->read(0, bytes_max != 0 ? bytes_max : file->size());
        if (!bytes) {
            return std::move(bytes).error();
        }
        Skeleton skeleton(std::move(bytes).value());
        if (!skeleton.findDirectories()) {
            return Error{ErrorCode::Invalid,
                         fmt::format("{}: is not a tiled GeoTIFF of the expected kind", path)};
        }
        return skeleton;
    }

    std::span<const std::byte> bytes() const { return {bytes_.data(), bytes_.size()}; }
    std::uint64_t size() const { return bytes_.size(); }

    void place(std::size_t page, std::uint64_t tile, std::uint64_t offset, std::uint64_t bytes)
    {
        put(pages_[page].offsets, tile, offset);
        put(pages_[page].byte_counts, tile, bytes);
    }

private:
    struct Array {
        std::uint64_t at = 0; // position of the first number in the file
        std::uint64_t count = 0;
        std::size_t number_bytes = 0;
    };
    struct Page {
        Array offsets;
        Array byte_counts;
    };

    explicit Skeleton(RawArray<std::byte> bytes)
        : bytes_(std::move(bytes))
    {}

    template <typename T>
    std::optional<T> get(std::uint64_t at) const
    {
        if (at > size() || size() - at < sizeof(T)) {
            return std::nullopt;
        }
        T value{};
        std::memcpy(&value, bytes_.data() + at, sizeof(T));
        return value;
    }

    void put(const Array& array, std::uint64_t i, std::uint64_t value)
    {
        MARSVIEW_CHECK(i < array.count);
        std::byte* to = bytes_.data() + array.at + i * array.number_bytes;
        if (array.number_bytes == sizeof(std::uint32_t)) {
            const auto narrow = static_cast<std::uint32_t>(value);
            std::memcpy(to, &narrow, sizeof(narrow));
        } else {
            std::memcpy(to, &value, sizeof(value));
        }
    }

    bool findDirectories()
    {
        constexpr std::uint64_t kFirst = 8; // where the offset of the first directory is
        std::optional<std::uint64_t> at = get<std::uint64_t>(kFirst);
        while (at && *at != 0) {
            const auto count = get<std::uint64_t>(*at);
            if (!count || *count > size() / kEntryBytes) {
                return false;
            }
            Page page;
            for (std::uint64_t i = 0; i < *count; ++i) {
                if (!readEntry(*at + sizeof(std::uint64_t) + i * kEntryBytes, page)) {
                    return false;
                }
            }
            if (page.offsets.count == 0 || page.byte_counts.count != page.offsets.count) {
                return false;
            }
            pages_.push_back(page);
            at = get<std::uint64_t>(*at + sizeof(std::uint64_t) + *count * kEntryBytes);
        }
        return at.has_value();
    }

    bool readEntry(std::uint64_t at, Page& page)
    {
        constexpr std::uint16_t kTileOffsets = 324;
        constexpr std::uint16_t kTileByteCounts = 325;
        constexpr std::uint16_t kLong = 4;
        constexpr std::uint16_t kLong8 = 16;
        const auto tag = get<std::uint16_t>(at);
        const auto type = get<std::uint16_t>(at + 2);
        const auto count = get<std::uint64_t>(at + 4);
        if (!tag || !type || !count) {
            return false;
        }
        if (*tag != kTileOffsets && *tag != kTileByteCounts) {
            return true;
        }
        Array array{.at = at + 12, .count = *count, .number_bytes = *type == kLong ? 4U : 8U};
        if (*count * array.number_bytes > sizeof(std::uint64_t)) {
            const auto place = get<std::uint64_t>(at + 12);
            if (!place) {
                return false;
            }
            array.at = *place;
        }
        (*tag == kTileOffsets ? page.offsets : page.byte_counts) = array;
        return (*type == kLong || *type == kLong8) && array.at <= size() &&
               array.count <= (size() - array.at) / array.number_bytes;
    }

    static constexpr std::uint64_t kEntryBytes = 20;

    RawArray<std::byte> bytes_;
    std::vector<Page> pages_;
};

} // namespace

Result<std::unique_ptr<ByteStream>> ByteStream::open(const std::string& path)
{
    if (const std::optional<std::string> remote = remoteNameFor(path)) {
        ensureGdal();
        const GdalMessages messages;
        VSILFILE* file = VSIFOpenL(remote->c_str(), "wb");
        if (file == nullptr) {
            return Error{ErrorCode::Unreadable,
                         fmt::format("{}: cannot be written ({})", path,
                                     messages.firstFailure("unknown reason"))};
        }
        return std::unique_ptr<ByteStream>(std::make_unique<RemoteStream>(*remote, file));
    }
    errno = 0;
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (file == nullptr) {
        return writeError(path, errno, "cannot be written");
    }
    return std::unique_ptr<ByteStream>(std::make_unique<DiskStream>(path, file));
}

Status streamTiff(const TiffStreamJob& job, ByteStream& to, JobMonitor& monitor)
{
    Result<Skeleton> skeleton = Skeleton::read(job.skeleton, job.skeleton_bytes);
    if (!skeleton) {
        return std::move(skeleton).error();
    }
    std::uint64_t offset = skeleton->size();
    for (const StreamedTile& tile : job.tiles) {
        const std::uint64_t bytes = job.files[tile.file]->encodedBytes(tile.page, tile.tile);
        skeleton->place(tile.page, tile.tile, offset, bytes);
        offset += bytes;
    }
    if (Status written = to.write(skeleton->bytes()); !written) {
        return written;
    }
    std::size_t done = 0;
    for (const StreamedTile& tile : job.tiles) {
        if (monitor.isCanceled()) {
            return Error{ErrorCode::Canceled, "canceled"};
        }
        const Result<std::vector<std::byte>> encoded =
            job.files[tile.file]->encoded(tile.page, tile.tile);
        const char* remedy = job.remedies.empty() ? "" : job.remedies[tile.file].c_str();
        if (!encoded) {
            return Error{encoded.error().code, encoded.error().message + remedy};
        }
        if (tile.is_checked && crc32Of(*encoded) != tile.checksum) {
            return Error{ErrorCode::Damaged,
                         fmt::format("{}: tile {} of page {} is damaged{}", job.names[tile.file],
                                     tile.tile, tile.page, remedy)};
        }
        if (Status written = to.write(*encoded); !written) {
            return written;
        }
        monitor.report(static_cast<double>(++done) / static_cast<double>(job.tiles.size()));
    }
    return Done{};
}

} // namespace marsview
