#include "core/prepare/level_file_writer.h"

#include "core/base/deflate.h"
#include "core/base/durable_file.h"
#include "core/base/parallel.h"
#include "core/files/file_bytes.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <fmt/format.h>
#include <system_error>
#include <utility>
#include <vector>

#ifdef __unix__
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace marsview {
namespace {

// Opens a file that no other process writes to, truncates the rest of an interrupted attempt to
// `bytes_max`, and positions at its end; null, with errno, on failure.
std::FILE* openForWriting(const std::string& path, std::uint64_t bytes_max)
{
#ifdef __unix__
    for (;;) {
        const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor < 0) {
            return nullptr;
        }
        struct stat opened = {};
        struct stat named = {};
        const bool is_ours =
            flock(descriptor, LOCK_EX | LOCK_NB) == 0 && fstat(descriptor, &opened) == 0;
        // Between opening and locking it may have been renamed to its final name.
        const bool is_named = is_ours && stat(path.c_str(), &named) == 0 &&
                              named.st_ino == opened.st_ino && named.st_dev == opened.st_dev;
        const auto length = static_cast<off_t>(
            std::min(bytes_max, static_cast<std::uint64_t>(is_ours ? opened.st_size : 0)));
        if (is_named && ftruncate(descriptor, length) == 0 &&
            lseek(descriptor, length, SEEK_SET) == length) {
            return fdopen(descriptor, "wb");
        }
        const int reason = errno;
        close(descriptor);
        if (!is_ours || is_named) {
            errno = reason;
            return nullptr;
        }
    }
#else
    static_cast<void>(bytes_max);
    return std::fopen(path.c_str(), "wb");
#endif
}

} // namespace

LevelFileWriter::LevelFileWriter(std::string path)
    : path_(std::move(path))
    , part_path_(path_ + ".part")
{}

LevelFileWriter::~LevelFileWriter()
{
    if (!is_published_ && !is_kept_ && file_) {
#ifndef __unix__
        file_.reset(); // some systems cannot remove open files
#endif
        std::remove(part_path_.c_str());
    }
}

Error LevelFileWriter::failed(const std::string& what) const
{
    const int reason = errno;
    return {ErrorCode::Unreadable,
            fmt::format("{}: {} ({}); make room there or choose another folder", part_path_, what,
                        std::generic_category().message(reason))};
}

Result<std::unique_ptr<LevelFileWriter>> LevelFileWriter::create(const std::string& path)
{
    std::unique_ptr<LevelFileWriter> writer(new LevelFileWriter(path));
    writer->file_.reset(openForWriting(writer->part_path_, 0));
    if (!writer->file_) {
        if (errno == EWOULDBLOCK) {
            return Error{ErrorCode::Unreadable,
                         fmt::format("{}: another program is preparing the same map; wait for it",
                                     writer->part_path_)};
        }
        return writer->failed("cannot be written");
    }
    const std::array<std::byte, kPreambleBytes> nothing_yet{};
    if (auto appended = writer->append(nothing_yet); !appended) {
        return std::move(appended).error();
    }
    return writer;
}

Result<std::unique_ptr<LevelFileWriter>> LevelFileWriter::resume(const std::string& path,
                                                                 const Written& written)
{
    std::unique_ptr<LevelFileWriter> writer(new LevelFileWriter(path));
    writer->file_.reset(openForWriting(writer->part_path_, written.bytes));
    if (!writer->file_) {
        return writer->failed("cannot be written");
    }
    writer->written_ = written;
    if (written.bytes < kPreambleBytes || !writer->hasWhatWasWritten()) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: lacks some of the {} bytes that were written",
                                 writer->part_path_, written.bytes)};
    }
    return writer;
}

bool LevelFileWriter::hasWhatWasWritten() const
{
    const auto file = FileBytes::open(part_path_);
    if (!file || file->size() != written_.bytes) {
        return false;
    }
    constexpr std::uint64_t kPiece = std::uint64_t{1} << 22U;
    std::uint32_t checksum = 0;
    for (std::uint64_t at = kPreambleBytes; at < written_.bytes; at += kPiece) {
        const auto bytes = file->read(at, std::min(kPiece, written_.bytes - at));
        if (!bytes) {
            return false;
        }
        checksum = crc32Of(*bytes, checksum);
    }
    return checksum == written_.checksum;
}

std::optional<LevelFileWriter::Written> LevelFileWriter::flush()
{
    const std::lock_guard lock(mutex_);
    return flushToDisk(file_.get()) ? std::optional(written_) : std::nullopt;
}

Result<FilePart> LevelFileWriter::append(std::span<const std::byte> bytes)
{
    const FilePart part{.offset = 0, .bytes = bytes.size(), .checksum = crc32Of(bytes)};
    const std::lock_guard lock(mutex_);
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) {
        return failed("cannot be written");
    }
    FilePart placed = part;
    placed.offset = written_.bytes;
    // The preamble comes first, and is written once more at the end.
    if (written_.bytes > 0) {
        written_.checksum = crc32Of(bytes, written_.checksum);
    }
    written_.bytes += bytes.size();
    return placed;
}

Status
LevelFileWriter::finish(LevelFileHeader header, std::span<const Array> arrays, const Finish& how)
{
    const JobMonitor& monitor = how.monitor;
    header.planes = planesOf(header);
    MARSVIEW_CHECK(arrays.size() == header.planes.size());
    LevelFilePreamble preamble{.planes_offset = written_.bytes};
    for (std::size_t i = 0; i < arrays.size(); ++i) {
        if (i + kTailPlanes == arrays.size()) {
            preamble.tail_offset = written_.bytes;
        }
        LevelPlane& plane = header.planes[i];
        MARSVIEW_CHECK(arrays[i].name == plane.name &&
                       arrays[i].values.size() == plane.shape.bytes());
        // Packed on all cores, written in order.
        std::vector<std::vector<std::byte>> chunks(plane.chunkCount());
        parallelRanges(chunks.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t chunk = begin; chunk < end && !monitor.isCanceled(); ++chunk) {
                const std::size_t offset = plane.chunkShape(0).bytes() * chunk;
                const PackShape shape = plane.chunkShape(chunk);
                chunks[chunk] = packed(shape, arrays[i].values.subspan(offset, shape.bytes()));
            }
        });
        if (monitor.isCanceled()) {
            return Error{ErrorCode::Canceled, "canceled"};
        }
        for (const std::vector<std::byte>& chunk : chunks) {
            auto appended = append(chunk);
            if (!appended) {
                return std::move(appended).error();
            }
            plane.chunks.push_back(*appended);
        }
    }
    preamble.header_offset = written_.bytes;
    const std::string json = writtenHeader(header);
    auto appended = append(std::as_bytes(std::span<const char>(json)));
    if (!appended) {
        return std::move(appended).error();
    }
    preamble.header_checksum = appended->checksum;
    preamble.file_bytes = written_.bytes;
    if (auto written = writeFront(writtenPreamble(preamble)); !written) {
        return written;
    }
    if (monitor.isCanceled()) {
        return Error{ErrorCode::Canceled, "canceled"};
    }
    if (Status confirmed = how.confirm ? how.confirm() : Status(Done{}); !confirmed) {
        return confirmed;
    }
    return publish();
}

Status LevelFileWriter::writeFront(std::span<const std::byte> bytes)
{
    std::FILE* file = file_.get();
    if (std::fseek(file, 0, SEEK_SET) != 0 ||
        std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size() || !flushToDisk(file)) {
        return failed("cannot be written");
    }
    return Done{};
}

Status LevelFileWriter::publish()
{
#ifndef __unix__
    file_.reset(); // some systems cannot rename open files
#endif
    // The whole file is on the disk. A process that waits to write the same file sees that the name
    // now refers to another file.
    std::error_code problem;
    std::filesystem::rename(part_path_, path_, problem);
    if (problem) {
        std::remove(part_path_.c_str());
        return Error{
            ErrorCode::Unreadable,
            fmt::format("{}: cannot be renamed to its final name ({}); choose another folder",
                        path_, problem.message())};
    }
    is_published_ = true;
    flushFolderToDisk(std::filesystem::path(path_).parent_path());
    return Done{};
}

} // namespace marsview
