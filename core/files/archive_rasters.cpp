#include "core/files/archive_rasters.h"

#include "core/files/gdal_runtime.h"
#include "core/files/open_probe.h"
#include "core/files/opening_job.h"
#include "core/files/raster_path.h"
#include "core/files/text_grid_size_check.h"

#include <cpl_string.h>
#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <mutex>
#include <set>
#include <string_view>
#include <sys/stat.h>
#include <tuple>
#include <utility>

namespace marsview {
namespace {

constexpr std::size_t kProbedMax = 64;
constexpr std::size_t kEntriesSizedMax = 2000;

// Files that accompany rasters and are opened only through them.
bool isCompanion(const std::string& name)
{
    static constexpr std::array<std::string_view, 22> kExtensions{
        ".aux.xml", ".ovr",  ".prj", ".tfw",      ".jgw",    ".wld", ".txt", ".pdf",
        ".htm",     ".html", ".csv", ".md5",      ".sha256", ".dbf", ".shp", ".shx",
        ".cpg",     ".qml",  ".md",  ".marsview", ".kml",    ".json"};
    const std::string lower = lowerCase(name);
    return lower.find("__macosx/") != std::string::npos || lower.ends_with("/") ||
           std::any_of(kExtensions.begin(), kExtensions.end(),
                       [&lower](std::string_view extension) { return lower.ends_with(extension); });
}

struct Candidate {
    ArchiveRaster raster;
    bool is_picture = false;
    bool has_bytes = false;
    std::vector<std::string> parts; // other files that it reads
};

// The size of the archive; 0 if it is not on a disk.
std::size_t archiveBytes(const std::string& archive)
{
    struct stat status {};
    const std::string file = archive.substr(std::string_view("/vsizip/").size());
    return stat(file.c_str(), &status) == 0 ? static_cast<std::size_t>(status.st_size) : 0;
}

// The largest of the first files that may be rasters: opening thousands takes minutes, and GDAL
// searches for the size of each among all.
std::vector<std::string> largestFilesIn(const std::string& archive)
{
    struct File {
        std::string name;
        vsi_l_offset bytes = 0;
    };
    std::vector<File> files;
    const CPLStringList entries(VSIReadDirRecursive(archive.c_str()));
    for (int i = 0; i < entries.Count() && files.size() < kEntriesSizedMax; ++i) {
        if (isCompanion(entries[i])) {
            continue;
        }
        File file{.name = archive + "/" + entries[i]};
        VSIStatBufL status;
        if (VSIStatL(file.name.c_str(), &status) == 0) {
            file.bytes = static_cast<vsi_l_offset>(status.st_size);
        }
        files.push_back(std::move(file));
    }
    std::stable_sort(files.begin(), files.end(),
                     [](const File& a, const File& b) { return a.bytes > b.bytes; });
    files.resize(std::min(files.size(), kProbedMax));
    std::vector<std::string> names;
    names.reserve(files.size());
    for (File& file : files) {
        names.push_back(std::move(file.name));
    }
    return names;
}

std::vector<Candidate> candidatesIn(const std::string& archive)
{
    const std::vector<std::string> names = largestFilesIn(archive);
    const auto probed = probeEach(names, archiveBytes(archive), OpeningJob::current());
    if (!probed) {
        return {};
    }
    std::vector<Candidate> candidates;
    for (const ProbedRaster& raster : *probed) {
        if (isTextGrid(raster.driver) &&
            !checkTextGrid(names[raster.name], raster.columns * raster.rows)) {
            continue; // cut short
        }
        Candidate candidate;
        candidate.raster = {names[raster.name], raster.columns, raster.rows};
        candidate.has_bytes = raster.has_bytes;
        candidate.is_picture = raster.has_colors;
        for (const std::string& file : raster.files) {
            if (file != candidate.raster.name) {
                candidate.parts.push_back(file);
            }
        }
        candidates.push_back(std::move(candidate));
    }
    return candidates;
}

std::string listOf(const std::vector<std::string>& names, std::size_t left_out)
{
    return left_out == 0 ? fmt::format("{}", fmt::join(names, ", "))
                         : fmt::format("{} and {} more", fmt::join(names, ", "), left_out);
}

std::vector<ArchiveRaster> findRasters(const std::string& archive)
{
    std::vector<Candidate> candidates = candidatesIn(archive);
    std::set<std::string> parts;
    for (const Candidate& candidate : candidates) {
        parts.insert(candidate.parts.begin(), candidate.parts.end());
    }
    std::erase_if(candidates, [&parts](const Candidate& candidate) {
        return parts.count(candidate.raster.name) != 0;
    });
    const bool has_elevations =
        std::any_of(candidates.begin(), candidates.end(),
                    [](const Candidate& candidate) { return !candidate.is_picture; });
    if (has_elevations) {
        std::erase_if(candidates, [](const Candidate& candidate) { return candidate.is_picture; });
    }
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
        const auto rank = [](const Candidate& c) {
            return std::pair(c.has_bytes, -static_cast<double>(c.raster.columns) *
                                              static_cast<double>(c.raster.rows));
        };
        return std::tuple(rank(a), a.raster.name) < std::tuple(rank(b), b.raster.name);
    });
    std::vector<ArchiveRaster> rasters;
    rasters.reserve(candidates.size());
    for (Candidate& candidate : candidates) {
        rasters.push_back(std::move(candidate.raster));
    }
    return rasters;
}

// When the archive was last written to; empty if it is not on a disk.
std::string stampOf(const std::string& archive)
{
    struct stat status {};
    const std::string file = archive.substr(std::string_view("/vsizip/").size());
    return stat(file.c_str(), &status) == 0
               ? fmt::format("{} {} {} {}", status.st_ino, status.st_size, status.st_mtim.tv_sec,
                             status.st_mtim.tv_nsec)
               : std::string();
}

} // namespace

std::string archiveNameFor(const std::string& path)
{
    const std::string lower = lowerCase(path);
    if (lower.starts_with("/vsizip/") || lower.starts_with("/vsitar/")) {
        return isFolder(path) ? path : std::string();
    }
    if (lower.starts_with("/vsi") || path.find("://") != std::string::npos) {
        return {};
    }
    if (lower.ends_with(".zip")) {
        return "/vsizip/" + path;
    }
    const bool is_tar =
        lower.ends_with(".tar") || lower.ends_with(".tgz") || lower.ends_with(".tar.gz");
    return is_tar ? "/vsitar/" + path : std::string();
}

std::vector<ArchiveRaster> rastersInArchive(const std::string& archive)
{
    ensureGdal();
    // Opening a map calls this several times.
    static std::mutex mutex;
    static std::map<std::string, std::vector<ArchiveRaster>> known;
    constexpr std::size_t kKnownMax = 16;
    const std::string stamp = stampOf(archive);
    if (stamp.empty()) {
        return findRasters(archive);
    }
    const std::string key = archive + " " + stamp;
    const std::lock_guard lock(mutex);
    if (const auto found = known.find(key); found != known.end()) {
        return found->second;
    }
    if (known.size() >= kKnownMax) {
        known.clear();
    }
    std::vector<ArchiveRaster> rasters = findRasters(archive);
    if (!rasters.empty()) { // the search may have been canceled
        known[key] = rasters;
    }
    return rasters;
}

std::string archiveNotice(const std::vector<ArchiveRaster>& rasters, const std::string& opened)
{
    if (rasters.size() < 2) {
        return {};
    }
    constexpr std::size_t kNamedMax = 4;
    std::vector<std::string> others;
    std::size_t left_out = 0;
    for (const ArchiveRaster& raster : rasters) {
        if (raster.name == opened) {
            continue;
        }
        if (others.size() < kNamedMax) {
            others.push_back(fmt::format("{} ({} × {})", raster.name, raster.columns, raster.rows));
        } else {
            ++left_out;
        }
    }
    return fmt::format(
        "{} rasters were found in the archive; {} is open; open another one by its name: {}",
        rasters.size(), opened, listOf(others, left_out));
}

} // namespace marsview
