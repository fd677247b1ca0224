#include "core/files/open_guard.h"

#include "core/files/gdal_drivers.h"
#include "core/files/gdal_runtime.h"
#include "core/files/open_probe.h"
#include "core/files/opening_job.h"
#include "core/files/probe_cache.h"
#include "core/files/raster_path.h"
#include "core/files/shared_file.h"
#include "core/files/text_grid_size_check.h"
#include "core/files/tiff_size_check.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <iterator>
#include <memory>
#include <mutex>
#include <set>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <utility>

extern "C" void __gcov_dump() __attribute__((weak)); // NOLINT: of builds that measure coverage

namespace marsview {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLabelBytes = 65536;

std::string beginningOf(const std::string& path, std::size_t bytes)
{
    const std::shared_ptr<const SharedFile> file = openShared(path);
    std::string text(file ? bytes : 0, '\0');
    text.resize(file ? file->read(text.data(), text.size(), 0) : 0);
    return text;
}

bool holds(std::string_view text, std::string_view word)
{
    return std::search(text.begin(), text.end(), word.begin(), word.end(), [](char a, char b) {
               return (a >= 'a' && a <= 'z' ? a - 'a' + 'A' : a) == b;
           }) != text.end();
}

bool isTiff(std::string_view beginning)
{
    return beginning.starts_with("II") || beginning.starts_with("MM");
}

// A label may refer to samples in a file of another format.
bool namesOtherFormat(std::string_view label)
{
    constexpr std::array<std::string_view, 5> kWords{"JP2", "JPEG", "TIFF", "ENCODING_TYPE",
                                                     "COMPRESSED_FILE"};
    return std::any_of(kWords.begin(), kWords.end(),
                       [label](std::string_view word) { return holds(label, word); });
}

// GDAL also opens overviews and masks next to a raster, with any driver.
bool hasStrangeCompanions(const std::string& path)
{
    std::error_code none;
    for (const char* ending : {".ovr", ".msk", ".aux"}) {
        const std::string companion = path + ending;
        if (fs::exists(companion, none) && !isTiff(beginningOf(companion, 2))) {
            return true;
        }
    }
    if (fs::exists(fs::path(path).replace_extension(".aux"), none)) {
        return true;
    }
    return holds(beginningOf(path + ".aux.xml", kLabelBytes), "OVERVIEW_FILE");
}

bool isOnDisk(const std::string& name)
{
    std::error_code none;
    return !name.starts_with("/vsi") && fs::is_regular_file(name, none);
}

std::uintmax_t fileBytes(const std::string& path)
{
    std::error_code failure;
    const std::uintmax_t bytes = fs::file_size(path, failure);
    return failure ? 0 : bytes;
}

// GDAL 3.6 takes practically forever for a row beyond the end of a text grid: it searches for each
// missing row twice, through all rows before it.
Status checkTextHolds(GDALDataset& dataset, const std::string& path)
{
    const std::string_view driver = dataset.GetDriverName();
    const auto columns = static_cast<std::uint64_t>(dataset.GetRasterXSize());
    const auto rows = static_cast<std::uint64_t>(dataset.GetRasterYSize());
    if (isTextGrid(driver)) {
        if (!isOnDisk(path) && !isInArchive(path)) {
            return Done{}; // counting would fetch all of it from a server
        }
        return checkTextGrid(path, columns * rows);
    }
    const std::uint64_t bytes = 144 * columns; // a header for each profile
    if (driver != "USGSDEM" || !isOnDisk(path) || fileBytes(path) >= bytes) {
        return Done{};
    }
    return Error{ErrorCode::Unreadable,
                 fmt::format("is cut short or damaged: its {} profiles take {} bytes or more, the "
                             "file has {}; fetch it again",
                             columns, bytes, fileBytes(path))};
}

// ENVI and EHdr open any file that has a header of its name next to it, even a netCDF file, which
// has its own driver in GDAL.
bool isOfAnotherDriver(const std::string& name)
{
    const std::optional<std::string> driver = recognizingDriverFor(name);
    if (!driver) {
        return false;
    }
    for (const char* const* plain = plainDrivers(); *plain != nullptr; ++plain) {
        if (*driver == *plain) {
            return false;
        }
    }
    return true;
}

struct PlainAttempt {
    GDALDatasetUniquePtr dataset;
    std::optional<Error> refusal;
};

PlainAttempt openPlain(const std::string& name)
{
    PlainAttempt attempt;
    if (!isOnDisk(name)) {
        return attempt;
    }
    if (const auto tiff = tiffSizesOf(name)) {
        if (!tiff->fits) {
            attempt.refusal = tiff->fits.error();
            return attempt;
        }
        if (!tiff->is_plain) {
            return attempt;
        }
    } else if (namesOtherFormat(beginningOf(name, kLabelBytes)) || isOfAnotherDriver(name)) {
        return attempt;
    }
    if (hasStrangeCompanions(name)) {
        return attempt;
    }
    const GdalMessages ignored;
    attempt.dataset.reset(GDALDataset::Open(name.c_str(), GDAL_OF_RASTER, plainDrivers()));
    if (attempt.dataset) {
        if (Status holds_all = checkTextHolds(*attempt.dataset, name); !holds_all) {
            attempt.refusal = holds_all.error();
            attempt.dataset.reset();
        }
    }
    return attempt;
}

// A message about what a GDAL driver did to the child process.
Error refusalOf(const ProbeAnswer& answer, const std::vector<std::string>& names)
{
    const std::string which = answer.name == 0 ? std::string("this file")
                                               : fs::path(names[answer.name]).filename().string();
    const std::string driver = answer.driver.empty()
                                   ? std::string("GDAL")
                                   : fmt::format("the {} driver of GDAL", answer.driver);
    switch (answer.kind) {
    case ProbeAnswer::Kind::TimedOut:
        return {ErrorCode::Unreadable,
                fmt::format("{} did not open {} within {:.0f} s; if the file is not damaged, set "
                            "MARSVIEW_OPEN_SECONDS to a larger number or convert it to GeoTIFF",
                            driver, which, answer.limit_s)};
    case ProbeAnswer::Kind::OutOfMemory:
        return {ErrorCode::TooLarge,
                fmt::format("{} needs more than {:.1f} GB of memory to open {}; if the file is not "
                            "damaged, set MARSVIEW_OPEN_MB to a larger number",
                            driver, static_cast<double>(probeMemoryBytes()) / 1e9, which)};
    default:
        return {ErrorCode::Unreadable,
                fmt::format("{} crashed on {}; fetch the file again or convert it to GeoTIFF with "
                            "another program",
                            driver, which)};
    }
}

void endAtOnce(int status, void*)
{
    std::fflush(nullptr);
    if (__gcov_dump != nullptr) {
        __gcov_dump();
    }
    _exit(status);
}

// HDF5 crashes or prints in its exit handler after some damaged files. Handlers run in reverse:
// this one before those that the driver's library has registered by now.
void skipExitHandlersOf(const std::string& driver)
{
    static std::mutex mutex;
    static std::set<std::string> skipped;
    const std::lock_guard lock(mutex);
    if (skipped.insert(driver).second) {
        on_exit(endAtOnce, nullptr);
    }
}

Result<GuardedDataset> openAfterProbe(const std::vector<std::string>& names)
{
    std::uintmax_t bytes = 0;
    for (const std::string& name : names) {
        bytes = std::max(bytes, fileBytes(name));
    }
    std::optional<ProbeAnswer> answer = cachedProbe(names, probeSeconds(bytes));
    if (!answer) {
        Result<ProbeAnswer> fresh = probeNames(names, bytes, OpeningJob::current());
        if (!fresh) {
            return std::move(fresh).error();
        }
        answer = std::move(fresh).value();
        cacheProbe(names, *answer);
    }
    if (answer->kind == ProbeAnswer::Kind::NotOpened) {
        return Error{ErrorCode::Unsupported, answer->message};
    }
    if (answer->kind != ProbeAnswer::Kind::Opened) {
        return refusalOf(*answer, names);
    }
    GuardedDataset opened;
    opened.name = answer->name;
    opened.opening_driver = answer->driver;
    opened.prints = answer->prints;
    const GdalMessages messages;
    opened.dataset = reopen(names[opened.name], opened);
    skipExitHandlersOf(opened.opening_driver);
    if (!opened.dataset) {
        return Error{ErrorCode::Unsupported, messages.firstFailure("")};
    }
    if (Status holds_all = checkTextHolds(*opened.dataset, names[opened.name]); !holds_all) {
        return std::move(holds_all).error();
    }
    return opened;
}

// The entry that the SRTMHGT driver opens in N51W001.hgt.zip or N51W001.SRTMGL1.hgt.zip; any other
// name itself.
std::string entryFor(const std::string& name)
{
    constexpr std::size_t kTileLength = 7; // N51W001
    const std::string file = fs::path(name).filename().string();
    const std::string lower = lowerCase(file);
    if (isInArchive(name) || file.size() < kTileLength) {
        return name;
    }
    for (const std::string_view ending : {".hgt", ".raw"}) {
        if (lower.ends_with(std::string(ending) + ".zip")) {
            return fmt::format("/vsizip/{}/{}{}", name, file.substr(0, kTileLength), ending);
        }
    }
    return name;
}

// Drivers take an entry that is listed for one that can be unpacked: that of SRTMHGT crashes as it
// reads the first sample.
Status checkCanBeUnpacked(const std::string& given)
{
    const std::string name = entryFor(given);
    VSIStatBufL status;
    if (!isInArchive(name) || VSIStatL(name.c_str(), &status) != 0 || !VSI_ISREG(status.st_mode) ||
        status.st_size == 0) {
        return Done{};
    }
    const GdalMessages messages;
    const std::unique_ptr<VSILFILE, int (*)(VSILFILE*)> file(VSIFOpenL(name.c_str(), "rb"),
                                                             VSIFCloseL);
    char first = 0;
    if (file && VSIFReadL(&first, 1, 1, file.get()) == 1) {
        return Done{};
    }
    return Error{ErrorCode::Unreadable,
                 fmt::format("the archive is damaged: {} in it cannot be unpacked; fetch it again",
                             fs::path(name).filename().string())};
}

struct Silence {
    std::mutex mutex;
    int count = 0;
    std::array<int, 2> kept{-1, -1}; // the original stdout and stderr
};

constexpr std::array<int, 2> kOutputs{STDOUT_FILENO, STDERR_FILENO};

Silence& silence()
{
    static Silence shared;
    return shared;
}

} // namespace

Result<GuardedDataset> openFirst(const std::vector<std::string>& names)
{
    ensureGdal();
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (Status unpacked = checkCanBeUnpacked(names[i]); !unpacked) {
            return std::move(unpacked).error();
        }
        PlainAttempt attempt = openPlain(names[i]);
        if (attempt.refusal) {
            return std::move(*attempt.refusal);
        }
        if (attempt.dataset) {
            GuardedDataset opened;
            opened.opening_driver = attempt.dataset->GetDriverName();
            opened.dataset = std::move(attempt.dataset);
            opened.name = i;
            return opened;
        }
    }
    Result<GuardedDataset> opened = openAfterProbe(names);
    if (!opened && opened.error().message.empty()) {
        if (const auto driver = leftOutDriverFor(names.front())) {
            return Error{ErrorCode::Unsupported,
                         fmt::format("is in the format {}, which MarsView does not read; convert "
                                     "it to GeoTIFF with gdal_translate if it has elevations",
                                     *driver)};
        }
    }
    return opened;
}

GDALDatasetUniquePtr reopen(const std::string& name, const GuardedDataset& opened)
{
    const QuietOutput quiet(opened.prints);
    // Threads that take turns in an archive unpack it from its beginning at every turn.
    std::optional<CPLConfigOptionSetter> one_thread;
    if (isInArchive(name)) {
        one_thread.emplace("GDAL_NUM_THREADS", "1", false);
    }
    const std::array<const char*, 2> only{opened.opening_driver.c_str(), nullptr};
    return GDALDatasetUniquePtr(
        GDALDataset::Open(name.c_str(), GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR, only.data()));
}

QuietOutput::QuietOutput(bool is_needed)
    : is_needed_(is_needed)
{
    if (!is_needed_) {
        return;
    }
    Silence& shared = silence();
    const std::lock_guard lock(shared.mutex);
    if (shared.count++ == 0) {
        std::fflush(stdout); // the program's own output
        const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
        for (std::size_t i = 0; i < kOutputs.size() && nowhere >= 0; ++i) {
            shared.kept[i] = fcntl(kOutputs[i], F_DUPFD_CLOEXEC, 3);
            if (shared.kept[i] >= 0) {
                dup2(nowhere, kOutputs[i]);
            }
        }
        if (nowhere >= 0) {
            close(nowhere);
        }
    }
}

QuietOutput::~QuietOutput()
{
    if (!is_needed_) {
        return;
    }
    Silence& shared = silence();
    const std::lock_guard lock(shared.mutex);
    if (--shared.count == 0) {
        std::fflush(stdout); // the library's output
        for (std::size_t i = 0; i < kOutputs.size(); ++i) {
            if (shared.kept[i] >= 0) {
                dup2(shared.kept[i], kOutputs[i]);
                close(shared.kept[i]);
                shared.kept[i] = -1;
            }
        }
    }
}

} // namespace marsview
