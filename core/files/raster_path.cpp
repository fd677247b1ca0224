#include "core/files/raster_path.h"

#include "core/files/archive_rasters.h"
#include "core/files/remote_raster.h"

#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 2> kLabelExtensions{".lbl", ".xml"};
constexpr std::array<std::string_view, 7> kDataExtensions{".dem", ".flt", ".bil", ".bip",
                                                          ".bsq", ".img", ".dat"};

bool isFileName(const std::string& path)
{
    return !path.starts_with("/vsi") && path.find("://") == std::string::npos;
}

void appendSiblings(const fs::path& path,
                    std::span<const std::string_view> extensions,
                    std::vector<std::string>& names)
{
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    const std::string stem = lowerCase(path.stem().string());
    std::error_code ignored;
    for (const std::string_view extension : extensions) {
        for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
            const fs::path& sibling = entry.path();
            if (lowerCase(sibling.stem().string()) == stem &&
                lowerCase(sibling.extension().string()) == extension) {
                names.push_back(path.has_parent_path() ? sibling.string()
                                                       : sibling.filename().string());
            }
        }
    }
}

// What to add to a refusal if the path goes on below a file: the name in an archive, or a reason.
std::string archiveHintFor(const std::string& path)
{
    std::error_code ignored;
    for (fs::path parent = fs::path(path).parent_path(); parent.has_filename();
         parent = parent.parent_path()) {
        if (fs::is_regular_file(parent, ignored)) {
            const std::string archive = archiveNameFor(parent.string());
            return archive.empty() ? fmt::format("; {} is a file, not a folder", parent.string())
                                   : fmt::format("; a file in that archive is named {}{}", archive,
                                                 path.substr(parent.string().size()));
        }
    }
    return {};
}

void appendArchiveEntries(const std::string& archive, std::vector<std::string>& names)
{
    for (ArchiveRaster& raster : rastersInArchive(archive)) {
        names.push_back(std::move(raster.name));
    }
}

} // namespace

bool isGdalName(const std::string& path)
{
    if (path.starts_with("/vsi")) {
        return true;
    }
    const std::size_t colon = path.find(':');
    std::error_code ignored;
    return colon != std::string::npos && colon < path.find('/') && !fs::exists(path, ignored);
}

bool isFolder(const std::string& path)
{
    VSIStatBufL status{};
    return VSIStatL(path.c_str(), &status) == 0 && VSI_ISDIR(status.st_mode);
}

bool isInArchive(const std::string& name)
{
    constexpr std::array<std::string_view, 3> kArchives{"/vsizip/", "/vsitar/", "/vsigzip/"};
    return std::any_of(kArchives.begin(), kArchives.end(),
                       [&name](std::string_view archive) { return name.starts_with(archive); });
}

std::string lowerCase(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

Result<std::vector<std::string>> rasterNamesFor(const std::string& path)
{
    std::vector<std::string> names{path};
    if (path.empty()) {
        return Error{ErrorCode::NotFound, "no file name was given"};
    }
    if (const std::optional<std::string> remote = remoteNameFor(path)) {
        return std::vector<std::string>{*remote};
    }
    if (!isFileName(path)) {
        if (const std::string archive = archiveNameFor(path); !archive.empty()) {
            appendArchiveEntries(archive, names);
        }
        return names;
    }
    std::error_code failure;
    const fs::file_status status = fs::status(path, failure);
    if (status.type() == fs::file_type::not_found) {
        // GDAL's own connection strings ("NETCDF:file:variable") look like missing files.
        if (path.find(':') != std::string::npos) {
            return names;
        }
        const std::string hint = archiveHintFor(path);
        return Error{ErrorCode::NotFound, fmt::format("{}: does not exist{}", path, hint)};
    }
    if (status.type() == fs::file_type::none) {
        return Error{ErrorCode::Unreadable, fmt::format("{}: {}", path, failure.message())};
    }
    if (access(path.c_str(), R_OK) != 0) {
        return Error{ErrorCode::Unreadable,
                     fmt::format("{}: cannot be read ({})", path,
                                 std::strerror(errno))}; // NOLINT(concurrency-mt-unsafe)
    }
    if (status.type() == fs::file_type::directory) {
        return names; // some formats are directories; GDAL decides
    }
    if (status.type() != fs::file_type::regular) {
        return Error{ErrorCode::Unsupported,
                     fmt::format("{}: is neither a file nor a directory", path)};
    }
    if (fs::file_size(path, failure) == 0) {
        return Error{ErrorCode::Invalid, fmt::format("{}: the file is empty", path)};
    }
    const std::string extension = lowerCase(fs::path(path).extension().string());
    if (extension == ".img" || extension == ".dat" || extension == ".cub") {
        appendSiblings(path, kLabelExtensions, names);
    } else if (extension == ".hdr") {
        appendSiblings(path, kDataExtensions, names);
    } else if (extension == ".prj") {
        // GDAL would take the projection text next to a header for its samples.
        std::vector<std::string> data;
        appendSiblings(path, kDataExtensions, data);
        names.insert(names.begin(), data.begin(), data.end());
    } else if (const std::string archive = archiveNameFor(path); !archive.empty()) {
        appendArchiveEntries(archive, names);
    } else if (extension == ".gz") {
        names.push_back("/vsigzip/" + path);
    }
    return names;
}

} // namespace marsview
