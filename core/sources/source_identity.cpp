#include "core/sources/source_identity.h"

#include "core/base/deflate.h"
#include "core/files/file_stamp.h"
#include "core/files/gdal_file.h"
#include "core/files/gdal_runtime.h"
#include "core/files/remote_raster.h"
#include "core/files/shared_file.h"
#include "core/sources/source_files.h"

#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

namespace marsview {
namespace {

namespace fs = std::filesystem;

// Most formats have headers, directories and tile offsets at either end of the file.
constexpr std::uint64_t kEndBytes = std::uint64_t{64} << 10;
constexpr std::uint64_t kBlockBytes = std::uint64_t{4} << 10;
constexpr std::uint64_t kBlocks = 16;
// A mosaic may name thousands of files: for those beyond the first, only size and time are used.
constexpr std::size_t kSampledFilesMax = 64;
// For files on a server, companions are looked up only if the file is as small as a label.
constexpr std::uint64_t kHashedLabelBytesMax = std::uint64_t{1} << 20;

// Two independent checksums: together they miss one change in 10^19.
class Digest {
public:
    void add(const void* data, std::size_t size)
    {
        const std::span bytes(static_cast<const std::byte*>(data), size);
        crc_ = crc32Of(bytes, crc_);
        adler_ = adler32Of(bytes, adler_);
    }
    void add(std::uint64_t number)
    {
        std::array<unsigned char, 8> bytes{}; // the same on every machine
        for (unsigned char& byte : bytes) {
            byte = static_cast<unsigned char>(number & 0xFFU);
            number >>= 8U;
        }
        add(bytes.data(), bytes.size());
    }
    std::string text() const { return fmt::format("{:08x}{:08x}", crc_, adler_); }

private:
    std::uint32_t crc_ = crc32Of({});
    std::uint32_t adler_ = adler32Of({});
};

bool isRemote(const std::string& path)
{
    return path.starts_with("http://") || path.starts_with("https://") ||
           path.find("/vsicurl") != std::string::npos || path.find("/vsis3") != std::string::npos ||
           path.find("/vsigs") != std::string::npos || path.find("/vsiaz") != std::string::npos;
}

std::string nameForVsi(const std::string& path)
{
    return path.starts_with("http://") || path.starts_with("https://") ? "/vsicurl/" + path : path;
}

// For a folder, without a trailing slash.
std::string absolutePath(const std::string& path)
{
    const fs::path absolute = fs::absolute(path).lexically_normal();
    return (absolute.has_filename() ? absolute : absolute.parent_path()).string();
}

// The head, some blocks in ascending order, which is fast in archives, and the tail.
Status addSamples(const std::string& file, std::uint64_t bytes, Digest& digest)
{
    const GdalFile stream = openGdalFile(file);
    const auto refusal = [&file] {
        return Error{ErrorCode::Unreadable, fmt::format("{}: cannot be read", file)};
    };
    if (!stream) {
        return refusal();
    }
    std::vector<char> buffer(kEndBytes);
    const auto add = [&](std::uint64_t offset, std::uint64_t count) {
        count = std::min(count, bytes - offset);
        if (VSIFSeekL(stream.get(), offset, SEEK_SET) != 0 ||
            VSIFReadL(buffer.data(), 1, count, stream.get()) != count) {
            return false;
        }
        digest.add(buffer.data(), count);
        return true;
    };
    bool is_read = add(0, kEndBytes);
    for (std::uint64_t i = 1; is_read && i <= kBlocks && bytes > kEndBytes; ++i) {
        is_read = add(bytes / (kBlocks + 1) * i, kBlockBytes);
    }
    if (is_read && bytes > kEndBytes) {
        is_read = add(bytes - kEndBytes, kEndBytes);
    }
    return is_read ? Status(Done{}) : Status(refusal());
}

} // namespace

bool fileExists(const std::string& path)
{
    ensureGdal();
    const GdalMessages ignored;
    VSIStatBufL status{};
    return VSIStatExL(path.c_str(), &status, VSI_STAT_EXISTS_FLAG) == 0;
}

Result<SourceIdentity> identify(const std::string& path, OverviewFiles overviews)
{
    ensureGdal();
    if (path.empty()) {
        return Error{ErrorCode::NotFound, "no file name was given"};
    }
    const std::string name = nameForVsi(path);
    const KeepOpen opening;
    const GdalMessages messages;
    VSIStatBufL status{};
    errno = 0;
    const bool is_file = VSIStatL(name.c_str(), &status) == 0 && !VSI_ISDIR(status.st_mode);
    const int stat_error = errno;
    std::vector<std::string> files;
    if (!is_file || !isRemote(path) ||
        static_cast<std::uint64_t>(status.st_size) <= kHashedLabelBytesMax) {
        files = sourceFilesOf(path, overviews);
    }
    if (files.empty() && is_file) {
        files.push_back(name);
    }
    if (files.empty()) {
        const bool may_be_there = stat_error != 0 && stat_error != ENOENT;
        return Error{may_be_there ? ErrorCode::Unreadable : ErrorCode::NotFound,
                     fmt::format("{}: {}", path,
                                 may_be_there
                                     ? std::strerror(stat_error) // NOLINT(concurrency-mt-unsafe)
                                     : "the file does not exist or is empty")};
    }
    SourceIdentity identity;
    std::error_code ignored;
    const bool is_local = !isRemote(path) && !path.starts_with("/vsi") && fs::exists(path, ignored);
    identity.path = is_local ? absolutePath(path) : path;
    Digest digest;
    std::size_t sampled = 0;
    for (const std::string& file : files) {
        if (VSIStatL(file.c_str(), &status) != 0) {
            return Error{ErrorCode::Unreadable,
                         fmt::format("{}: {}, which belongs to it, cannot be read", path, file)};
        }
        const auto bytes = static_cast<std::uint64_t>(status.st_size);
        const auto modified_s = static_cast<std::int64_t>(status.st_mtime);
        identity.bytes += bytes;
        identity.modified_s = std::max(identity.modified_s, modified_s);
        digest.add(bytes);
        if (files.size() > 1) {
            digest.add(static_cast<std::uint64_t>(modified_s));
        }
        if (!VSI_ISDIR(status.st_mode) && ++sampled <= kSampledFilesMax) {
            // Seeking within an archive unpacks it repeatedly, so the bytes of the archive itself
            // are used.
            const std::string archive = file.starts_with("/vsi") ? fileHolding(file) : "";
            const Status added = archive.empty()
                                     ? addSamples(file, bytes, digest)
                                     : addSamples(archive, fs::file_size(archive, ignored), digest);
            if (!added) {
                return added.error();
            }
        }
    }
    identity.digest = digest.text();
    return identity;
}

bool isSameContent(const SourceIdentity& then, const SourceIdentity& now)
{
    // A file on a server has its upload time.
    const bool is_at_server = remoteNameFor(now.path).has_value();
    return then.bytes == now.bytes && (is_at_server || then.modified_s == now.modified_s) &&
           then.digest == now.digest;
}

} // namespace marsview
