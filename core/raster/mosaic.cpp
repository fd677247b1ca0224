#include "core/raster/mosaic.h"

#include "core/base/parallel.h"
#include "core/files/gdal_drivers.h"
#include "core/files/opening_job.h"
#include "core/files/raster_path.h"
#include "core/raster/gdal_types.h"
#include "core/raster/mosaic_grid.h"
#include "core/raster/raster_file.h"

#include <cpl_minixml.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;

// Rasters that cover less than this fraction of the rectangle around them do not adjoin.
constexpr double kCoveredMin = 0.02;

constexpr std::size_t kRememberedMax = 8;

// Never rasters, although GDAL opens some of them as such.
constexpr std::array<std::string_view, 12> kCompanionEndings{
    ".aux.xml", ".ovr", ".msk", ".marsview", ".prj",  ".tfw",
    ".wld",     ".txt", ".md",  ".pdf",      ".html", ".csv"};

bool isCompanion(const fs::path& path)
{
    const std::string name = lowerCase(path.filename().string());
    return name.starts_with('.') ||
           std::any_of(kCompanionEndings.begin(), kCompanionEndings.end(),
                       [&name](std::string_view ending) { return name.ends_with(ending); });
}

struct FolderEntry {
    std::string path;
    std::uintmax_t bytes = 0;
    fs::file_time_type modified;
    bool operator==(const FolderEntry&) const = default;
};

using Listing = std::vector<FolderEntry>;

Result<Listing> list(const std::string& folder)
{
    Listing listing;
    std::error_code failure;
    for (fs::directory_iterator it(folder, failure), end; !failure && it != end;
         it.increment(failure)) {
        std::error_code ignored; // for a file that has just been removed
        if (it->is_regular_file(ignored) && !isCompanion(it->path())) {
            listing.push_back(
                {it->path().string(), it->file_size(ignored), it->last_write_time(ignored)});
        }
    }
    if (failure) {
        return Error{ErrorCode::Unreadable, fmt::format("{}: {}", folder, failure.message())};
    }
    std::sort(listing.begin(), listing.end(),
              [](const FolderEntry& a, const FolderEntry& b) { return a.path < b.path; });
    return listing;
}

// The data kept of a closed raster: thousands cannot be open at once.
struct Part {
    RasterInfo info;
    GridSize block;
    std::vector<std::string> files;
};

struct Opened {
    std::optional<Part> part;
    std::string failure; // otherwise
};

struct Parts {
    std::vector<Part> parts;
    std::vector<std::string> left_out; // names of other rasters
    std::vector<std::string> damaged;  // why files that are named like a part are none
};

Opened openPart(const std::string& path, int band)
{
    const Result<RasterFile> file = RasterFile::open(path, band);
    if (!file) {
        return {std::nullopt, file.error().message};
    }
    if (const Status complete = file->checkComplete(); !complete) {
        return {std::nullopt, complete.error().message};
    }
    return {Part{file->info(), file->blockSize(), file->files()}, {}};
}

std::string nameOf(const Part& part)
{
    return fs::path(part.info.path).filename().string();
}

// Other files next to maps are ignored silently.
bool isRaster(const std::string& path)
{
    return recognizingDriverFor(path).has_value();
}

// The rasters among the files, each once: a label and its data count as one.
Result<Parts> openParts(const std::string& folder, const Listing& listing, int band)
{
    std::vector<Opened> opened(listing.size());
    const JobMonitor* const current = OpeningJob::current();
    parallelRanges(listing.size(), 4, [&](std::size_t begin, std::size_t end) {
        const OpeningJob job(current);
        for (std::size_t i = begin; i < end; ++i) {
            opened[i] = openPart(listing[i].path, band);
        }
    });
    std::vector<Part> parts;
    std::vector<std::string> left_out;
    std::vector<std::string> damaged;
    std::set<std::string> names;   // in GDAL
    std::set<std::string> endings; // of rasters
    std::set<std::string> files;   // that belong to one
    for (std::size_t i = 0; i < opened.size(); ++i) {
        if (std::optional<Part>& part = opened[i].part) {
            endings.insert(lowerCase(fs::path(listing[i].path).extension().string()));
            files.insert(part->files.begin(), part->files.end());
            if (names.insert(part->info.path).second) {
                parts.push_back(std::move(*part));
            }
        }
    }
    if (parts.empty()) {
        return Error{ErrorCode::Unsupported,
                     fmt::format("{}: is a folder without rasters that can be shown; open one with "
                                 "elevations in it",
                                 folder)};
    }
    for (std::size_t i = 0; i < opened.size(); ++i) {
        const std::string& path = listing[i].path;
        if (opened[i].failure.empty() || files.contains(path)) {
            continue;
        }
        if (endings.contains(lowerCase(fs::path(path).extension().string()))) {
            damaged.push_back(opened[i].failure);
        } else if (isRaster(path)) {
            left_out.push_back(fs::path(path).filename().string());
        }
    }
    return Parts{std::move(parts), std::move(left_out), std::move(damaged)};
}

bool isSameCrs(const std::optional<Crs>& a, const std::optional<Crs>& b)
{
    if (!a || !b || a->wkt() == b->wkt()) {
        return a.has_value() == b.has_value();
    }
    OGRSpatialReference first;
    OGRSpatialReference second;
    const char* const options[] = {"CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS", nullptr};
    return first.importFromWkt(a->wkt().c_str()) == OGRERR_NONE &&
           second.importFromWkt(b->wkt().c_str()) == OGRERR_NONE &&
           first.IsSame(&second, options) != 0;
}

// Why the part cannot be combined with the first; empty if it can.
std::string mismatch(const RasterInfo& part, const RasterInfo& first, const std::string& first_name)
{
    if (!isSameCrs(part.crs, first.crs)) {
        return fmt::format("has {}, {} has {}", part.crs ? "the CRS " + part.crs->name() : "no CRS",
                           first_name, first.crs ? first.crs->name() : "none");
    }
    if (part.type != first.type) {
        return fmt::format("holds {} samples, {} holds {}", sampleTypeName(part.type), first_name,
                           sampleTypeName(first.type));
    }
    if (part.elevationScale() != first.elevationScale() || part.unit != first.unit) {
        return fmt::format("has elevations in another unit or above another datum than {}",
                           first_name);
    }
    if (!part.transform) {
        return "has no georeferencing";
    }
    return {};
}

// A type with a spare value for voids, for samples that may have every value of `type`. Virtual
// rasters of GDAL 3.6 do not support voids in 64-bit integers.
SampleType withRoomForVoids(SampleType type)
{
    switch (type) {
    case SampleType::UInt8:
        return SampleType::Int16;
    case SampleType::UInt16:
        return SampleType::Int32;
    case SampleType::UInt32:
    case SampleType::Int64:
    case SampleType::UInt64:
        return SampleType::Float64;
    default:
        return type; // its lowest value is never an elevation
    }
}

double lowestOf(SampleType type)
{
    return dispatchSampleType(type, [](auto zero) {
        return static_cast<double>(std::numeric_limits<decltype(zero)>::lowest());
    });
}

bool hasVoids(const Part& part)
{
    return part.info.nodata.has_value() || part.info.needsVoidMask();
}

// Sets the type and nodata value of the whole.
Status chooseVoids(const std::vector<Part>& parts, bool has_gaps, RasterInfo& whole)
{
    const std::optional<double> first = parts.front().info.nodata;
    const bool all_alike = std::all_of(parts.begin(), parts.end(), [&first](const Part& part) {
        const std::optional<double>& nodata = part.info.nodata;
        const bool both_nan = first && nodata && std::isnan(*first) && std::isnan(*nodata);
        return !part.info.has_mask_band && (nodata == first || both_nan);
    });
    whole.nodata = first;
    whole.has_mask_band = false;
    std::set<double> others;
    for (const Part& part : parts) {
        others.insert(part.info.other_nodata.begin(), part.info.other_nodata.end());
    }
    whole.other_nodata.assign(others.begin(), others.end());
    const bool is_wide = whole.type == SampleType::Int64 || whole.type == SampleType::UInt64;
    if (all_alike && (first || !has_gaps)) {
        whole.type = is_wide && first ? SampleType::Float64 : whole.type;
        return Done{};
    }
    if (whole.type == SampleType::Int8) {
        return Error{ErrorCode::Unsupported,
                     fmt::format("their {} samples have no value left for nodata; convert them to "
                                 "another type",
                                 sampleTypeName(whole.type))};
    }
    whole.type = withRoomForVoids(whole.type);
    whole.nodata = lowestOf(whole.type);
    return Done{};
}

const char* gdalNameOf(SampleType type)
{
    return GDALGetDataTypeName(gdalTypeOf(type));
}

std::string numberText(double number)
{
    return std::isnan(number) ? "nan" : fmt::format("{:.17g}", number);
}

struct XmlFree {
    void operator()(CPLXMLNode* node) const { CPLDestroyXMLNode(node); }
};
using XmlTree = std::unique_ptr<CPLXMLNode, XmlFree>;

void setAttributes(CPLXMLNode* node,
                   const std::vector<std::pair<const char*, std::string>>& attributes)
{
    for (const auto& [name, value] : attributes) {
        CPLAddXMLAttributeAndValue(node, name, value.c_str());
    }
}

void addSource(CPLXMLNode* band, const Part& part, const GridWindow& place, bool has_void_rule)
{
    CPLXMLNode* const source =
        CPLCreateXMLNode(band, CXT_Element, has_void_rule ? "ComplexSource" : "SimpleSource");
    CPLXMLNode* const name =
        CPLCreateXMLElementAndValue(source, "SourceFilename", part.info.path.c_str());
    setAttributes(name, {{"relativeToVRT", "0"}});
    CPLCreateXMLElementAndValue(source, "SourceBand", fmt::format("{}", part.info.band).c_str());
    // With these GDAL opens a part on first read, and closes it again when too many are open.
    setAttributes(CPLCreateXMLNode(source, CXT_Element, "SourceProperties"),
                  {{"RasterXSize", fmt::format("{}", part.info.columns)},
                   {"RasterYSize", fmt::format("{}", part.info.rows)},
                   {"DataType", gdalNameOf(part.info.type)},
                   {"BlockXSize", fmt::format("{}", part.block.columns)},
                   {"BlockYSize", fmt::format("{}", part.block.rows)}});
    const std::string columns = fmt::format("{}", place.columns);
    const std::string rows = fmt::format("{}", place.rows);
    setAttributes(CPLCreateXMLNode(source, CXT_Element, "SrcRect"),
                  {{"xOff", "0"}, {"yOff", "0"}, {"xSize", columns}, {"ySize", rows}});
    setAttributes(CPLCreateXMLNode(source, CXT_Element, "DstRect"),
                  {{"xOff", fmt::format("{}", place.column)},
                   {"yOff", fmt::format("{}", place.row)},
                   {"xSize", columns},
                   {"ySize", rows}});
    if (part.info.has_mask_band) {
        CPLCreateXMLElementAndValue(source, "UseMaskBand", "true");
    } else if (part.info.nodata) {
        CPLCreateXMLElementAndValue(source, "NODATA", numberText(*part.info.nodata).c_str());
    }
}

std::string vrtOf(const std::vector<Part>& parts, const MosaicGrid& grid, const RasterInfo& whole)
{
    const XmlTree root(CPLCreateXMLNode(nullptr, CXT_Element, "VRTDataset"));
    setAttributes(root.get(), {{"rasterXSize", fmt::format("{}", grid.size.columns)},
                               {"rasterYSize", fmt::format("{}", grid.size.rows)}});
    CPLXMLNode* const band = CPLCreateXMLNode(root.get(), CXT_Element, "VRTRasterBand");
    setAttributes(band, {{"dataType", gdalNameOf(whole.type)}, {"band", "1"}});
    if (whole.type == SampleType::Int8) {
        CPLXMLNode* const metadata = CPLCreateXMLNode(band, CXT_Element, "Metadata");
        setAttributes(metadata, {{"domain", "IMAGE_STRUCTURE"}});
        setAttributes(CPLCreateXMLElementAndValue(metadata, "MDI", "SIGNEDBYTE"),
                      {{"key", "PIXELTYPE"}});
    }
    if (whole.nodata) {
        CPLCreateXMLElementAndValue(band, "NoDataValue", numberText(*whole.nodata).c_str());
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
        addSource(band, parts[i], grid.places[i], hasVoids(parts[i]));
    }
    char* const text = CPLSerializeXMLTree(root.get());
    std::string vrt(text);
    VSIFree(text);
    return vrt;
}

void noteParts(const Parts& opened, double covered, RasterInfo& whole)
{
    const std::vector<Part>& parts = opened.parts;
    std::set<std::string> said;
    // First, since a part of the map is missing.
    std::vector<std::string> notices;
    std::transform(opened.damaged.begin(), opened.damaged.end(), std::back_inserter(notices),
                   [](const std::string& failure) {
                       return fmt::format("left out a damaged file of the folder ({})", failure);
                   });
    if (parts.size() > 1) {
        notices.push_back(
            covered < 1.0
                ? fmt::format("a mosaic of {} rasters, which cover {:.3g} % of its rectangle",
                              parts.size(), std::min(100.0 * covered, 99.9))
                : fmt::format("a mosaic of {} rasters", parts.size()));
    }
    if (!opened.left_out.empty()) {
        const std::size_t more = opened.left_out.size() - 1;
        notices.push_back(fmt::format("left out {}{}: no elevations that could be read",
                                      opened.left_out.front(),
                                      more > 0 ? fmt::format(" and {} more", more) : ""));
    }
    for (const Part& part : parts) {
        for (const std::string& notice : part.info.notices) {
            if (notice != part.info.replacementNotice() && said.insert(notice).second) {
                notices.push_back(notice);
            }
        }
    }
    whole.notices = std::move(notices);
}

Result<std::shared_ptr<const Mosaic>>
makeMosaic(const std::string& folder, const Listing& listing, int band)
{
    const Result<Parts> opened = openParts(folder, listing, band);
    if (!opened) {
        return opened.error();
    }
    const std::vector<Part>& parts = opened->parts;
    const auto refuse = [&folder](const std::string& why) {
        return Error{ErrorCode::Unsupported,
                     fmt::format("{}: its rasters do not form a mosaic: {}", folder, why)};
    };
    const auto refuse_together = [&refuse](const std::string& why) {
        return refuse(why + "; open them one by one");
    };
    const RasterInfo& first = parts.front().info;
    std::vector<MosaicPart> grids;
    for (const Part& part : parts) {
        if (const std::string why = mismatch(part.info, first, nameOf(parts.front()));
            !why.empty()) {
            return refuse_together(fmt::format("{} {}", nameOf(part), why));
        }
        grids.push_back({nameOf(part), *part.info.transform, {part.info.columns, part.info.rows}});
    }
    const Result<MosaicGrid> grid =
        layOutMosaic(grids, first.crs ? first.crs->turn() : std::nullopt);
    if (!grid) {
        return refuse_together(grid.error().message);
    }
    if (grid->covered < kCoveredMin) {
        return refuse_together(
            fmt::format("they are far apart and cover {:.1g} % of the rectangle around them",
                        100.0 * grid->covered));
    }
    if (const Status size = checkMapSize(grid->size.columns, grid->size.rows); !size) {
        return Error{size.error().code, fmt::format("{}: {}", folder, size.error().message)};
    }
    auto mosaic = std::make_shared<Mosaic>();
    mosaic->info = first;
    RasterInfo& info = mosaic->info;
    info.path = folder;
    info.driver = "VRT";
    info.columns = grid->size.columns;
    info.rows = grid->size.rows;
    info.transform = grid->transform;
    if (const Status chosen = chooseVoids(parts, grid->covered < 1.0, info); !chosen) {
        return refuse(chosen.error().message);
    }
    noteParts(*opened, grid->covered, info);
    mosaic->vrt = vrtOf(parts, *grid, info);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Part& part = parts[i];
        mosaic->parts.push_back({part.info.path, part.info.band, grid->places[i]});
        mosaic->files.insert(mosaic->files.end(), part.files.begin(), part.files.end());
    }
    std::sort(mosaic->files.begin(), mosaic->files.end());
    mosaic->files.erase(std::unique(mosaic->files.begin(), mosaic->files.end()),
                        mosaic->files.end());
    return std::shared_ptr<const Mosaic>(std::move(mosaic));
}

// A map is opened once for each thread that reads it, but its parts only once.
class Remembered {
public:
    std::shared_ptr<const Mosaic> find(const std::string& key, const Listing& listing)
    {
        const std::scoped_lock lock(mutex_);
        const auto found = mosaics_.find(key);
        return found != mosaics_.end() && found->second.first == listing ? found->second.second
                                                                         : nullptr;
    }
    void keep(const std::string& key, Listing listing, std::shared_ptr<const Mosaic> mosaic)
    {
        const std::scoped_lock lock(mutex_);
        if (mosaics_.size() >= kRememberedMax) {
            mosaics_.clear();
        }
        mosaics_.insert_or_assign(key, std::pair(std::move(listing), std::move(mosaic)));
    }

private:
    std::mutex mutex_;
    std::map<std::string, std::pair<Listing, std::shared_ptr<const Mosaic>>> mosaics_;
};

// The part of `place` within `window`, relative to the corner of `place`; empty if they do not
// overlap.
GridWindow overlap(const GridWindow& place, const GridWindow& window)
{
    const std::size_t column = std::max(place.column, window.column);
    const std::size_t row = std::max(place.row, window.row);
    const std::size_t end_column =
        std::min(place.column + place.columns, window.column + window.columns);
    const std::size_t end_row = std::min(place.row + place.rows, window.row + window.rows);
    if (column >= end_column || row >= end_row) {
        return {};
    }
    return {column - place.column, row - place.row, end_column - column, end_row - row};
}

} // namespace

std::string Mosaic::failureIn(const GridWindow& window) const
{
    for (const MosaicRaster& part : parts) {
        const GridWindow within = overlap(part.place, window);
        if (within.columns == 0) {
            continue;
        }
        Result<RasterFile> file = RasterFile::open(part.path, part.band);
        if (!file) {
            return file.error().message;
        }
        if (const auto read = file->readWindow(within, {}); !read) {
            return read.error().message;
        }
    }
    return {};
}

Result<std::shared_ptr<const Mosaic>> mosaicOf(const std::string& path, int band)
{
    static Remembered remembered;
    const fs::path given(path);
    const std::string folder = (given.has_filename() ? given : given.parent_path()).string();
    Result<Listing> listing = list(folder);
    if (!listing) {
        return std::move(listing).error();
    }
    const std::string key = fmt::format("{} {}", band, fs::absolute(folder).string());
    if (std::shared_ptr<const Mosaic> mosaic = remembered.find(key, *listing)) {
        return mosaic;
    }
    Result<std::shared_ptr<const Mosaic>> mosaic = makeMosaic(folder, *listing, band);
    if (mosaic) {
        remembered.keep(key, std::move(*listing), *mosaic);
    }
    return mosaic;
}

} // namespace marsview
