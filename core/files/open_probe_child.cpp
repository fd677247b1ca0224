#include "core/files/gdal_drivers.h"
#include "core/files/gdal_runtime.h"
#include "core/files/open_probe.h"
#include "core/files/remote_raster.h"
#include "core/files/shared_file.h"

#include <cpl_string.h>
#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <linux/landlock.h>
#include <malloc.h>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
// Sanitizers reserve shadow memory, which would count toward a limit.
#define MARSVIEW_UNLIMITED_MEMORY 1 // NOLINT(cppcoreguidelines-macro-usage)
#endif

namespace marsview {
namespace {

using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

// Long enough for all samples of a small file, short enough not to be noticed with a large one.
constexpr std::chrono::milliseconds kReadingTime{20};

// Of drivers that are not well tested: for all samples of files of moderate size, once.
constexpr std::chrono::milliseconds kLongReadingTime{2000};

// Larger blocks are left to the reader of the samples, who bounds them.
constexpr double kBlockBytesMax = 256e6;

int answers = -1; // the original stdout, before it was redirected away from libraries

void limit(__rlimit_resource_t resource, rlim_t soft, rlim_t hard)
{
    const rlimit bounds{soft, hard};
    setrlimit(resource, &bounds);
}

void send(const Json& line)
{
    const std::string text = line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    std::size_t sent = 0;
    while (sent < text.size()) {
        const ssize_t count = write(answers, text.data() + sent, text.size() - sent);
        if (count <= 0) {
            _exit(1);
        }
        sent += static_cast<std::size_t>(count);
    }
}

void onOutOfMemory()
{
    constexpr std::string_view kLine = "{\"memory\":1}\n";
    const ssize_t ignored = write(answers, kLine.data(), kLine.size());
    _exit(ignored > 0 ? 3 : 4);
}

// Some libraries create files while they open one: HDF5 created 20 000 next to a damaged one.
// Without Landlock in the kernel, writing is not restricted.
void forbidWriting()
{
    landlock_ruleset_attr rules{};
    rules.handled_access_fs = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR |
                              LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR |
                              LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG |
                              LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO |
                              LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;
    const auto ruleset =
        static_cast<int>(syscall(SYS_landlock_create_ruleset, &rules, sizeof rules, 0));
    if (ruleset < 0) {
        return;
    }
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0) {
        syscall(SYS_landlock_restrict_self, ruleset, 0);
    }
    close(ruleset);
}

std::vector<std::string> readNames()
{
    std::string text;
    std::array<char, 65536> buffer{};
    for (ssize_t count = 0; (count = read(STDIN_FILENO, buffer.data(), buffer.size())) > 0;) {
        text.append(buffer.data(), static_cast<std::size_t>(count));
    }
    std::vector<std::string> names;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\0', begin);
        names.push_back(text.substr(begin, end - begin));
        begin = end == std::string::npos ? text.size() : end + 1;
    }
    return names;
}

struct Attempt {
    GDALDatasetUniquePtr dataset;
    std::string failure;
};

// Tries the drivers in GDAL's order, but reports each before it opens the file.
Attempt open(const std::string& name, std::size_t index)
{
    GDALDriverManager& manager = *GetGDALDriverManager();
    GDALOpenInfo header(name.c_str(), GA_ReadOnly | GDAL_OF_RASTER);
    Attempt attempt;
    for (int i = 0; i < manager.GetDriverCount(); ++i) {
        GDALDriver& driver = *manager.GetDriver(i);
        if (driver.GetMetadataItem(GDAL_DCAP_RASTER) == nullptr ||
            driver.GetMetadataItem(GDAL_DCAP_OPEN) == nullptr ||
            (driver.pfnIdentify != nullptr && driver.pfnIdentify(&header) == FALSE)) {
            continue;
        }
        send({{"opening", driver.GetDescription()}, {"name", index}});
        const GdalMessages messages;
        const std::array<const char*, 2> only{driver.GetDescription(), nullptr};
        attempt.dataset.reset(GDALDataset::Open(name.c_str(), GDAL_OF_RASTER, only.data()));
        if (attempt.dataset) {
            return attempt;
        }
        if (messages.hasFailed()) {
            attempt.failure = messages.firstFailure("");
            return attempt;
        }
    }
    return attempt;
}

// The samples of a block, as far as they are read at once.
struct BlockSize {
    int columns = 0;
    int rows = 0;
    double samples() const { return 1.0 * columns * rows; }
};

// Empty if the blocks are too large.
std::optional<BlockSize> blockToRead(GDALRasterBand& band)
{
    int columns = 0;
    int rows = 0;
    band.GetBlockSize(&columns, &rows);
    const int sample_bytes = GDALGetDataTypeSizeBytes(band.GetRasterDataType());
    if (columns <= 0 || rows <= 0 || 1.0 * columns * rows * sample_bytes > kBlockBytesMax) {
        return std::nullopt;
    }
    return BlockSize{std::min(band.GetXSize(), std::min(columns, 4096)),
                     std::min(band.GetYSize(), std::min(rows, 4096))};
}

// Until that time, or to the end. Returns the seconds that a sample took.
double readSamples(GDALRasterBand& band, Clock::time_point end)
{
    const std::optional<BlockSize> block = blockToRead(band);
    if (!block) {
        return 0.0;
    }
    const auto [columns, rows] = *block;
    std::vector<double> samples(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    const Clock::time_point begin = Clock::now();
    double count = 0.0;
    const auto seconds_each = [&] {
        return std::chrono::duration<double>(Clock::now() - begin).count() / std::max(count, 1.0);
    };
    const auto read_at = [&](int column, int row) {
        column = std::clamp(column, 0, band.GetXSize() - columns);
        row = std::clamp(row, 0, band.GetYSize() - rows);
        count += block->samples();
        return band.RasterIO(GF_Read, column, row, columns, rows, samples.data(), columns, rows,
                             GDT_Float64, 0, 0, nullptr) == CE_None &&
               Clock::now() < end;
    };
    // In order: seeking back or far ahead takes seconds in archives and text.
    for (int row = 0; row < band.GetYSize(); row += rows) {
        for (int column = 0; column < band.GetXSize(); column += columns) {
            if (!read_at(column, row)) {
                return seconds_each();
            }
            if (column > band.GetXSize() - columns) {
                break;
            }
        }
        if (row > band.GetYSize() - rows) {
            break;
        }
    }
    return seconds_each();
}

// An overview first: the same code decodes it, and a block of a JPEG2000 may be all of it, which
// takes longer than there is time for.
void readBand(GDALRasterBand& band, Clock::time_point end)
{
    const int overviews = band.GetOverviewCount();
    GDALRasterBand* const smallest = overviews > 0 ? band.GetOverview(overviews - 1) : nullptr;
    const double seconds_each = smallest != nullptr ? readSamples(*smallest, end) : 0.0;
    const std::optional<BlockSize> block = blockToRead(band);
    const std::chrono::duration<double> left = end - Clock::now();
    if (block && seconds_each * block->samples() <= left.count()) {
        readSamples(band, end);
    }
}

// A virtual raster is as trustworthy as the files that it reads.
bool isWellTestedThroughout(GDALDataset& dataset, const CPLStringList& files)
{
    if (std::string_view(dataset.GetDriverName()) != "VRT") {
        return isWellTested(dataset.GetDriverName());
    }
    int sources = 0;
    for (int i = 0; i < files.Count(); ++i) {
        if (std::string_view(files[i]) == dataset.GetDescription()) {
            continue;
        }
        const auto driver = recognizingDriverFor(files[i]);
        if (!driver || !isWellTested(*driver)) {
            return false;
        }
        ++sources;
    }
    return sources > 0; // subdatasets are not listed
}

// Makes the same calls as RasterFile.
std::vector<std::string> use(GDALDataset& dataset)
{
    const GdalMessages messages;
    const CPLStringList listed(dataset.GetFileList());
    for (const char* domain : {"", "SUBDATASETS", "json:PDS", "IMAGE_STRUCTURE", "GEOLOCATION"}) {
        dataset.GetMetadata(domain);
    }
    if (const OGRSpatialReference* crs = dataset.GetSpatialRef()) {
        char* wkt = nullptr;
        crs->exportToWkt(&wkt);
        CPLFree(wkt);
    }
    std::array<double, 6> terms{};
    dataset.GetGeoTransform(terms.data());
    const Clock::time_point end =
        Clock::now() + (isWellTestedThroughout(dataset, listed) ? kReadingTime : kLongReadingTime);
    for (int i = 1; i <= std::min(dataset.GetRasterCount(), 8) && Clock::now() < end; ++i) {
        GDALRasterBand& band = *dataset.GetRasterBand(i);
        int has_value = 0;
        band.GetNoDataValue(&has_value);
        band.GetScale(&has_value);
        band.GetOffset(&has_value);
        band.GetUnitType();
        band.GetColorTable();
        band.GetColorInterpretation();
        band.GetMaskFlags();
        band.GetMetadata("");
        readBand(band, end);
    }
    return {listed.List(), listed.List() + listed.Count()};
}

// One of several names, of which only the description is wanted.
void describe(const std::string& name, std::size_t index)
{
    send({{"name", index}});
    const Attempt attempt = open(name, index);
    if (!attempt.dataset || attempt.dataset->GetRasterCount() == 0) {
        return;
    }
    GDALDataset& dataset = *attempt.dataset;
    GDALRasterBand& band = *dataset.GetRasterBand(1);
    const bool has_bytes = band.GetRasterDataType() == GDT_Byte;
    const CPLStringList listed(dataset.GetFileList());
    send({{"kind", "raster"},
          {"name", index},
          {"driver", dataset.GetDriverName()},
          {"columns", dataset.GetRasterXSize()},
          {"rows", dataset.GetRasterYSize()},
          {"has_bytes", has_bytes},
          {"has_colors",
           band.GetColorTable() != nullptr || (dataset.GetRasterCount() >= 3 && has_bytes)},
          {"files", std::vector<std::string>(listed.List(), listed.List() + listed.Count())}});
}

// For a file on a server, under the conditions of later reads.
Json answerFor(const std::string& name, std::size_t index, std::string& failure)
{
    std::optional<RemoteScope> scope;
    if (remoteNameFor(name)) {
        const Result<RemoteVersion> version = askRemote(name);
        if (!version) {
            return {};
        }
        scope.emplace(name, *version);
    }
    Attempt attempt = open(name, index);
    if (!attempt.dataset) {
        failure = attempt.failure;
        return {};
    }
    const std::vector<std::string> files = use(*attempt.dataset);
    attempt.dataset.reset(); // which may crash, too
    return {{"kind", "opened"}, {"files", files}};
}

} // namespace

int probeMain(const std::vector<std::string>& arguments)
{
    const bool is_each = arguments.size() == 3 && arguments[2] == "each";
    if (arguments.size() != 2 && !is_each) {
        return 2;
    }
    prctl(PR_SET_DUMPABLE, 0);
    limit(RLIMIT_CORE, 0, 0);
    // The soft limit sends SIGXCPU, which says why; the hard one SIGKILL, as other processes may.
    const rlim_t seconds = std::strtoull(arguments[1].c_str(), nullptr, 10) + 1;
    limit(RLIMIT_CPU, seconds, seconds + 1);
#ifndef MARSVIEW_UNLIMITED_MEMORY
    const rlim_t bytes = std::strtoull(arguments[0].c_str(), nullptr, 10);
    limit(RLIMIT_DATA, bytes, bytes);
#endif
    answers = dup(STDOUT_FILENO);
    // Output of libraries to stdout is redirected to stderr.
    if (answers < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {
        return 1;
    }
    forbidWriting();
    // Fills allocated memory: a library that uses an uninitialized pointer then fails here, rather
    // than by chance in the program that opens the file next.
    mallopt(M_PERTURB, 0xa5);
    std::set_new_handler(onOutOfMemory);
    const std::vector<std::string> names = readNames();
    ensureGdal();
    const KeepOpen all;
    if (is_each) {
        for (std::size_t i = 0; i < names.size(); ++i) {
            describe(names[i], i);
        }
        return 0;
    }
    std::string first_failure;
    for (std::size_t i = 0; i < names.size(); ++i) {
        std::string failure;
        if (const Json answer = answerFor(names[i], i, failure); !answer.empty()) {
            send(answer);
            return 0;
        }
        // For a bare data file, the message of its companion (the label) names the cause.
        if (first_failure.empty() || (i > 0 && !failure.empty())) {
            first_failure = failure;
        }
    }
    send({{"kind", "not opened"}, {"message", first_failure}});
    return 0;
}

} // namespace marsview
