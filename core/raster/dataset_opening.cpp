#include "core/raster/dataset_opening.h"

#include "core/files/archive_rasters.h"
#include "core/files/gdal_drivers.h"
#include "core/files/gdal_runtime.h"
#include "core/files/open_guard.h"
#include "core/files/raster_path.h"
#include "core/formats/odl_label.h"
#include "core/raster/label_elevation.h"
#include "core/raster/large_blocks.h"

#include <cpl_string.h>
#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace marsview {
namespace {

// The raster of a label with samples in a TIFF or JPEG2000, which GDAL would read as raw samples.
// Empty for everything else.
std::optional<Result<OpenedDataset>> openEncodedImage(const std::string& name)
{
    const std::string image =
        lowerCase(name).ends_with(".lbl") ? encodedImageOf(name) : std::string();
    if (image.empty()) {
        return std::nullopt;
    }
    Result<OpenedDataset> opened = openLocalDataset({image});
    if (!opened) {
        return Error{opened.error().code, fmt::format("{}: {}", image, opened.error().message)};
    }
    opened->label = name;
    return opened;
}

bool hasImage(const OdlStatement& group)
{
    return std::any_of(
        group.statements.begin(), group.statements.end(), [](const OdlStatement& statement) {
            const std::string& name = statement.name;
            const bool is_pointer =
                name.starts_with("^") && (name.ends_with("IMAGE") || name.ends_with("QUBE"));
            return is_pointer ||
                   (statement.is_group && (name == "COMPRESSED_FILE" || hasImage(statement)));
        });
}

// What a PDS3 label without an image points to, as " (only ^TABLE)"; nothing for any other file.
std::optional<std::string> labelWithoutImage(const std::string& name)
{
    const std::optional<OdlStatement> label =
        lowerCase(name).ends_with(".lbl") ? readOdlLabel(name) : std::nullopt;
    if (!label || statementIn(*label, "PDS_VERSION_ID") == nullptr || hasImage(*label)) {
        return std::nullopt;
    }
    std::string pointers;
    for (const OdlStatement& statement : label->statements) {
        if (statement.name.starts_with("^")) {
            pointers += (pointers.empty() ? "" : ", ") + statement.name;
        }
    }
    return pointers.empty() ? pointers : fmt::format(" (only {})", pointers);
}

Result<OpenedDataset> openFolder(const std::string& path, int band)
{
    Result<std::shared_ptr<const Mosaic>> mosaic = mosaicOf(path, band);
    if (!mosaic) {
        return std::move(mosaic).error();
    }
    Result<GDALDatasetUniquePtr> dataset = openMosaicDataset(**mosaic);
    if (!dataset) {
        return Error{dataset.error().code, fmt::format("{}: {}", path, dataset.error().message)};
    }
    return OpenedDataset{
        .dataset = std::move(dataset).value(), .name = path, .mosaic = std::move(mosaic).value()};
}

Result<OpenedDataset> openRemoteOnce(const std::string& name)
{
    Result<RemoteVersion> version = askRemote(name);
    if (!version) {
        return std::move(version).error();
    }
    Result<GDALDatasetUniquePtr> dataset = openRemoteDataset(name, *version);
    if (!dataset) {
        return std::move(dataset).error();
    }
    return OpenedDataset{
        .dataset = std::move(dataset).value(), .name = name, .remote = std::move(version).value()};
}

// Retries a lost connection, which GDAL does only for some responses, but not a server that is slow
// to fail.
Result<OpenedDataset> openRemote(const std::string& name)
{
    using Clock = std::chrono::steady_clock;
    constexpr int kAttempts = 3;
    constexpr std::chrono::milliseconds kPause{300};
    constexpr std::chrono::seconds kAtOnce{2};
    for (int attempt = 1;; ++attempt) {
        const Clock::time_point start = Clock::now();
        Result<OpenedDataset> opened = openRemoteOnce(name);
        if (opened || opened.error().code != ErrorCode::Unreadable || attempt == kAttempts ||
            Clock::now() - start > kAtOnce) {
            return opened;
        }
        std::this_thread::sleep_for(attempt * kPause);
    }
}

// GDAL recognizes a tile by its size.
std::optional<std::string> refusalOfSrtmTile(const std::string& path, vsi_l_offset bytes)
{
    constexpr vsi_l_offset kThreeSeconds = 1201 * 1201 * 2;
    constexpr vsi_l_offset kOneSecond = 3601 * 3601 * 2;
    if (!lowerCase(path).ends_with(".hgt") || bytes == kThreeSeconds || bytes == kOneSecond) {
        return std::nullopt;
    }
    return fmt::format(
        "has {} bytes, but SRTM tiles have {} (1201 × 1201 samples) or {} "
        "(3601 × 3601); it may be cut short; fetch it again",
        bytes, kThreeSeconds, kOneSecond);
}

std::optional<std::string> refusalOfSrtmTile(const std::string& path)
{
    std::error_code failure;
    const std::uintmax_t bytes = std::filesystem::file_size(path, failure);
    return failure ? std::nullopt : refusalOfSrtmTile(path, bytes);
}

// Whether the beginning of a file in an archive cannot be unpacked.
bool isPackedBadly(const std::string& name, vsi_l_offset bytes)
{
    constexpr vsi_l_offset kRead = 65536;
    std::vector<char> beginning(static_cast<std::size_t>(std::min(bytes, kRead)));
    VSILFILE* const file = VSIFOpenL(name.c_str(), "rb");
    const std::size_t read =
        file != nullptr ? VSIFReadL(beginning.data(), 1, beginning.size(), file) : 0;
    if (file != nullptr) {
        VSIFCloseL(file);
    }
    return read < beginning.size();
}

// Of a file in an archive that would be a raster if it were whole; empty for any other file.
std::optional<std::string> refusalOfPacked(const std::string& name)
{
    const GdalMessages messages;
    VSIStatBufL status;
    if (VSIStatL(name.c_str(), &status) != 0 || VSI_ISDIR(status.st_mode)) {
        return std::nullopt;
    }
    const auto bytes = static_cast<vsi_l_offset>(status.st_size);
    if (isPackedBadly(name, bytes)) {
        return "cannot be unpacked: the archive is damaged; fetch it again";
    }
    if (auto tile = refusalOfSrtmTile(name, bytes)) {
        return tile;
    }
    if (!recognizingDriverFor(name)) {
        return std::nullopt;
    }
    const Result<OpenedDataset> opened = openLocalDataset({name});
    if (opened || opened.error().message.empty()) {
        return std::nullopt;
    }
    const std::string& why = opened.error().message;
    return why.find("; ") != std::string::npos
               ? why
               : fmt::format("cannot be opened ({}); fetch it again or convert it to GeoTIFF", why);
}

// Of an archive; rastersInArchive() has found none in it.
std::optional<std::string> refusalOfArchive(const std::string& path)
{
    constexpr int kNamedMax = 3;
    constexpr int kTriedMax = 64;
    const std::string archive = archiveNameFor(path);
    if (archive.empty()) {
        return std::nullopt;
    }
    const CPLStringList names(VSIReadDirRecursive(archive.c_str()));
    if (names.Count() == 0) {
        return "is an archive without files that can be read; it is empty, cut short or damaged; "
               "fetch it again";
    }
    for (int i = 0; i < std::min(names.Count(), kTriedMax); ++i) {
        if (const auto refusal = refusalOfPacked(fmt::format("{}/{}", archive, names[i]))) {
            return fmt::format("{} in it {}", names[i], *refusal);
        }
    }
    std::string listed;
    bool has_archive = false;
    for (int i = 0; i < names.Count(); ++i) {
        has_archive = has_archive || !archiveNameFor(names[i]).empty();
    }
    for (int i = 0; i < std::min(names.Count(), kNamedMax); ++i) {
        listed += fmt::format("{}{}", i > 0 ? ", " : "", names[i]);
    }
    return fmt::format(
        "holds no raster that GDAL can read, only {}{}; a map among them is damaged or in another "
        "format{}",
        listed, names.Count() > kNamedMax ? ", …" : "",
        has_archive ? ", and an archive must be unpacked first" : "");
}

} // namespace

Result<OpenedDataset> openLocalDataset(const std::vector<std::string>& names)
{
    Result<GuardedDataset> opened = openFirst(names);
    if (!opened) {
        return std::move(opened).error();
    }
    OpenedDataset result{.dataset = std::move(opened->dataset),
                         .name = names[opened->name],
                         .prints = opened->prints};
    if (hasLargePlainStrips(*result.dataset)) {
        const DirectReads scope;
        if (GDALDatasetUniquePtr direct = reopen(result.name, *opened)) {
            result.dataset = std::move(direct);
        }
    }
    return result;
}

Result<GDALDatasetUniquePtr> openMosaicDataset(const Mosaic& mosaic)
{
    const GdalMessages messages;
    GDALDatasetUniquePtr dataset(
        GDALDataset::Open(mosaic.vrt.c_str(), GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR));
    if (!dataset) {
        return Error{ErrorCode::Unsupported, messages.firstFailure("")};
    }
    return dataset;
}

Result<GDALDatasetUniquePtr> openRemoteDataset(const std::string& name,
                                               const RemoteVersion& version)
{
    const GdalMessages messages;
    const RemoteScope scope(name, version);
    constexpr std::array<const char*, 2> kTiff{"GTiff", nullptr};
    GDALDatasetUniquePtr dataset(GDALDataset::Open(name.c_str(), GDAL_OF_RASTER, kTiff.data()));
    if (!dataset && !messages.hasFailed()) {
        Result<GuardedDataset> opened = openFirst({name});
        if (opened) {
            dataset = std::move(opened->dataset);
        } else if (opened.error().code != ErrorCode::Unsupported) {
            return Error{opened.error().code,
                         fmt::format("{}: {}", addressOf(name), opened.error().message)};
        }
    }
    if (!dataset) {
        return remoteFailure(
            name, version, messages,
            fmt::format("is not a raster that GDAL can read, or {}", kConnectionLost));
    }
    return dataset;
}

Result<OpenedDataset> openDataset(const std::string& path, int band)
{
    Result<std::vector<std::string>> names = rasterNamesFor(path);
    if (!names) {
        return std::move(names).error();
    }
    if (remoteNameFor(names->front())) {
        return openRemote(names->front());
    }
    for (std::size_t i = 0; i < names->size(); ++i) {
        if (auto image = openEncodedImage((*names)[i])) {
            if (i > 0) {
                if (auto before = openLocalDataset(
                        {names->begin(), names->begin() + static_cast<std::ptrdiff_t>(i)})) {
                    return before;
                }
            }
            return *std::move(image);
        }
    }
    Result<OpenedDataset> opened = openLocalDataset(*names);
    if (opened) {
        return opened;
    }
    std::string first_failure = opened.error().message;
    if (opened.error().code != ErrorCode::Unsupported) {
        return Error{opened.error().code, fmt::format("{}: {}", path, first_failure)};
    }
    if (isFolder(path)) {
        return openFolder(path, band);
    }
    const auto says = [&first_failure](const char* words) {
        return first_failure.find(words) != std::string::npos;
    };
    // The last of these words come from a driver that looks for JSON in any text.
    if (says("not recognized") || says("Maximum number of characters") || first_failure.empty()) {
        const auto known_kind = refusalOfSrtmTile(path);
        first_failure = (known_kind ? known_kind : refusalOfArchive(path))
                            .value_or(
                                "is not a raster that GDAL can read, or is damaged; convert it to "
                                "GeoTIFF or fetch it "
                                "again");
    } else if (says("No such file or directory")) {
        first_failure = fmt::format(
            "names a data file that is missing; put it next to this file ({})", first_failure);
    } else if (const auto pointers = labelWithoutImage(names->front())) {
        first_failure = fmt::format(
            "is a PDS label without an image: it has neither ^IMAGE nor a COMPRESSED_FILE{}; open "
            "the "
            "label of an image",
            *pointers);
    } else if (!says("; ")) { // a driver's own words, without advice
        first_failure = fmt::format(
            "cannot be opened ({}); fetch it again or convert it to GeoTIFF", first_failure);
    }
    return Error{ErrorCode::Unsupported, fmt::format("{}: {}", path, first_failure)};
}

} // namespace marsview
