#include "core/files/file_bytes.h"

#include "core/files/gdal_runtime.h"

#include <cpl_vsi.h>

#include <array>
#include <fmt/format.h>
#include <utility>

namespace marsview {

namespace {

// Requests exactly these bytes from a server. GDAL 3.6 does so only for several ranges, and merges
// two adjoining ones into one request. It reads a single range in ever larger blocks, which doubles
// the bytes.
bool readExactly(VSILFILE* file, std::uint64_t offset, RawArray<std::byte>& bytes)
{
    if (bytes.size() < 2) {
        return false;
    }
    const std::size_t half = bytes.size() / 2;
    std::array<void*, 2> to{bytes.data(), bytes.data() + half};
    const std::array<vsi_l_offset, 2> from{offset, offset + half};
    const std::array<std::size_t, 2> counts{half, bytes.size() - half};
    return VSIFReadMultiRangeL(2, to.data(), from.data(), counts.data(), file) == 0;
}

} // namespace

void FileBytes::Close::operator()(void* file) const noexcept
{
    VSIFCloseL(static_cast<VSILFILE*>(file));
}

Result<FileBytes> FileBytes::open(const std::string& path)
{
    ensureGdal();
    const GdalMessages messages;
    FileBytes bytes;
    bytes.path_ = path;
    bytes.file_.reset(VSIFOpenL(path.c_str(), "rb"));
    if (!bytes.file_) {
        VSIStatBufL stat{};
        const bool is_there = VSIStatExL(path.c_str(), &stat, VSI_STAT_EXISTS_FLAG) == 0;
        // If a server's error is not "not found", it may have the file.
        const std::string reason = messages.firstFailure("");
        if (is_there || (!reason.empty() && reason.find("404") == std::string::npos)) {
            return Error{ErrorCode::Unreadable,
                         fmt::format("{}: cannot be opened ({})", path,
                                     reason.empty() ? "no permission to read it" : reason)};
        }
        return Error{ErrorCode::NotFound, fmt::format("{}: does not exist", path)};
    }
    auto* file = static_cast<VSILFILE*>(bytes.file_.get());
    if (VSIFSeekL(file, 0, SEEK_END) != 0) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: cannot determine the file size", path)};
    }
    bytes.size_ = VSIFTellL(file);
    bytes.has_exact_ranges_ = VSIHasOptimizedReadMultiRange(path.c_str()) != 0;
    return bytes;
}

Result<RawArray<std::byte>> FileBytes::read(std::uint64_t offset, std::uint64_t count) const
{
    if (offset > size_ || count > size_ - offset) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: cannot read {} bytes at {}: the file has {}", path_, count,
                                 offset, size_)};
    }
    const GdalMessages messages;
    auto* file = static_cast<VSILFILE*>(file_.get());
    RawArray<std::byte> bytes(count);
    // Truncated responses of a server are requested again.
    constexpr int kAttemptsAtServer = 3;
    bool is_read = false;
    for (int i = 0; !is_read && i < (has_exact_ranges_ ? kAttemptsAtServer : 1); ++i) {
        is_read = (has_exact_ranges_ && readExactly(file, offset, bytes)) ||
                  (VSIFSeekL(file, offset, SEEK_SET) == 0 &&
                   VSIFReadL(bytes.data(), 1, bytes.size(), file) == bytes.size());
    }
    if (!is_read) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: {} bytes at {} cannot be read ({})", path_, count, offset,
                                 messages.firstFailure("reading ended early"))};
    }
    return bytes;
}

} // namespace marsview
