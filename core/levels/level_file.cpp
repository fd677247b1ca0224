#include "core/levels/level_file.h"

#include "core/base/deflate.h"
#include "core/base/parallel.h"
#include "core/files/file_bytes.h"
#include "core/levels/level_file_format.h"
#include "core/levels/tile_fill.h"
#include "core/terrain/fill_range.h"
#include "core/terrain/filled_heightfield.h"
#include "core/terrain/raw_ranges.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <system_error>
#include <utility>

namespace marsview {
namespace {

template <typename T, typename Allocator>
std::span<std::byte> bytesOf(std::vector<T, Allocator>& values)
{
    return std::as_writable_bytes(std::span<T>(values));
}

// Computes the three in parallel: for a map of 5.7 billion samples they take tens of milliseconds.
std::shared_ptr<const SurfaceAnalysis> analysisFrom(RawRanges ranges,
                                                    const ElevationScale& scale,
                                                    BlockGrid blocks,
                                                    const BlockExtent& extent,
                                                    DetailErrors::NodeErrors errors)
{
    auto analysis = std::make_shared<SurfaceAnalysis>();
    const std::array<std::function<void()>, 3> parts{
        [&] { analysis->errors = DetailErrors::from(std::move(errors)); },
        [&] { analysis->bounds = MinMaxPyramid::from(std::move(ranges), scale); },
        [&] { analysis->means = BlockMeans::from(std::move(blocks), extent); }};
    parallelRanges(parts.size(), 1, [&parts](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            parts[i]();
        }
    });
    return analysis;
}

// Nodata may be NaN, which equals nothing.
bool isSameNodata(const std::optional<double>& a, const std::optional<double>& b)
{
    if (!a || !b) {
        return a.has_value() == b.has_value();
    }
    return *a == *b || (std::isnan(*a) && std::isnan(*b));
}

bool isSameKey(const LevelFileKey& stored, const LevelFileKey& expected)
{
    return isSameContent(stored.raster, expected.raster) && stored.band == expected.band &&
           isSameNodata(stored.nodata, expected.nodata);
}

// A change of a raster also changes its time, unless it falls in the second in which the level file
// was written.
bool isDamaged(const SourceIdentity& then, const SourceIdentity& now, const std::string& level_path)
{
    SourceIdentity as_it_was = now;
    as_it_was.digest = then.digest;
    if (!isSameContent(then, as_it_was) || then.modified_s != now.modified_s ||
        then.digest == now.digest) {
        return false;
    }
    std::error_code elsewhere; // if on a server
    const auto made = std::filesystem::last_write_time(level_path, elsewhere);
    return !elsewhere &&
           std::chrono::seconds(then.modified_s) <
               std::chrono::floor<std::chrono::seconds>(std::chrono::file_clock::to_sys(made))
                   .time_since_epoch();
}

// Converts heights from one scale to another.
class Conversion {
public:
    Conversion(const ElevationScale& from, const ElevationScale& to)
        : is_needed_(!(from == to))
        , ratio_(to.gain / from.gain)
        , from_offset_m_(from.offset_m)
        , to_offset_m_(to.offset_m)
    {}

    bool isNeeded() const { return is_needed_; }
    bool isPossible() const { return !is_needed_ || std::isfinite(ratio_); }
    bool isUpsideDown() const { return is_needed_ && ratio_ < 0.0; }

    float height(float height_m) const
    {
        return is_needed_
                   ? static_cast<float>((static_cast<double>(height_m) - from_offset_m_) * ratio_ +
                                        to_offset_m_)
                   : height_m;
    }
    float error(float error_m) const
    {
        return is_needed_ ? roundedUp(static_cast<double>(error_m) * std::abs(ratio_)) : error_m;
    }

private:
    bool is_needed_;
    double ratio_;
    double from_offset_m_;
    double to_offset_m_;
};

// Tiles of which only some are in the file.
struct SparseIndex {
    std::vector<std::uint64_t> numbers; // ascending
    std::vector<FilePart> parts;

    const FilePart* find(std::uint64_t number) const
    {
        const auto at = std::lower_bound(numbers.begin(), numbers.end(), number);
        return at == numbers.end() || *at != number
                   ? nullptr
                   : &parts[static_cast<std::size_t>(at - numbers.begin())];
    }
};

} // namespace

struct LevelFile::Impl {
    explicit Impl(FileBytes bytes)
        : file(std::move(bytes))
    {}

    FileBytes file;
    LevelFilePreamble preamble;
    LevelFileHeader header;
    std::vector<FilePart> samples;
    SparseIndex fills;
    SparseIndex coarse_fills;

    const std::string& path() const { return file.path(); }

    // A range of the file's bytes.
    struct Region {
        std::uint64_t offset = 0;
        RawArray<std::byte> bytes;
    };

    // A plane and its destination.
    struct Wanted {
        const LevelPlane* plane = nullptr;
        std::span<std::byte> values;
    };

    Status readTail();
    Status unpackPlanes(const Region& region, const std::vector<Wanted>& wanted) const;
    const LevelPlane& plane(std::string_view name) const;
    Status readIndex(const Region& tail,
                     const LevelPlane& plane,
                     std::uint64_t count,
                     std::vector<std::uint64_t>& numbers,
                     std::vector<FilePart>& parts) const;
    Result<RawArray<std::byte>> readPart(const FilePart& part, const TileId& id) const;
    Result<std::vector<float>> readTileFill(const TileId& id, const FilePart& part) const;
    Result<std::vector<float>> readCoarseFill(const TileId& id, const FilePart& part) const;
};

Status LevelFile::Impl::readTail()
{
    auto beginning = file.read(0, std::min<std::uint64_t>(file.size(), kPreambleBytes));
    if (!beginning) {
        return std::move(beginning).error();
    }
    auto read_preamble = readPreamble(*beginning, file.size(), path());
    if (!read_preamble) {
        return std::move(read_preamble).error();
    }
    preamble = *read_preamble;
    Region tail{.offset = preamble.tail_offset, .bytes = {}};
    auto bytes = file.read(tail.offset, file.size() - tail.offset);
    if (!bytes) {
        return std::move(bytes).error();
    }
    tail.bytes = std::move(bytes).value();
    const auto json =
        std::span<const std::byte>(tail.bytes).subspan(preamble.header_offset - tail.offset);
    if (crc32Of(json) != preamble.header_checksum) {
        return damaged(path(), "is damaged in its header");
    }
    auto read_header = readHeader(json, file.size(), path());
    if (!read_header) {
        return std::move(read_header).error();
    }
    header = std::move(read_header).value();

    const std::size_t planes = header.planes.size();
    std::vector<std::uint64_t> none;
    const std::uint64_t kept = keptTileCount(header.layout);
    const std::uint64_t tiles = header.layout.tileColumns(TileKind::Samples, 0) *
                                header.layout.tileRows(TileKind::Samples, 0);
    if (auto read = readIndex(tail, header.planes[planes - 3], kept, none, samples); !read) {
        return read;
    }
    if (auto read = readIndex(tail, header.planes[planes - 2], tiles, fills.numbers, fills.parts);
        !read) {
        return read;
    }
    return readIndex(tail, header.planes[planes - 1], kept, coarse_fills.numbers,
                     coarse_fills.parts);
}

Status LevelFile::Impl::readIndex(const Region& tail,
                                  const LevelPlane& plane,
                                  std::uint64_t count,
                                  std::vector<std::uint64_t>& numbers,
                                  std::vector<FilePart>& parts) const
{
    const std::size_t columns = plane.shape.columns;
    std::vector<std::uint64_t> rows(columns * plane.shape.rows);
    if (auto unpacked = unpackPlanes(tail, {{&plane, bytesOf(rows)}}); !unpacked) {
        return unpacked;
    }
    const std::uint64_t* row = rows.data();
    if (plane.shape.rows == 4) {
        numbers.assign(row, row + columns);
        if (!std::is_sorted(numbers.begin(), numbers.end()) ||
            (!numbers.empty() && numbers.back() >= count)) {
            return damaged(path(), "lists tiles that the map does not have");
        }
        row += columns;
    }
    for (std::size_t i = 0; i < columns; ++i) {
        const FilePart part{.offset = row[i],
                            .bytes = row[columns + i],
                            .checksum = static_cast<std::uint32_t>(row[2 * columns + i])};
        if (part.offset > file.size() || part.bytes > file.size() - part.offset) {
            return damaged(path(), "lists tiles beyond its end");
        }
        parts.push_back(part);
    }
    return Done{};
}

const LevelPlane& LevelFile::Impl::plane(std::string_view name) const
{
    const auto at = std::find_if(header.planes.begin(), header.planes.end(),
                                 [name](const LevelPlane& p) { return p.name == name; });
    MARSVIEW_CHECK(at != header.planes.end()); // planesOf() lists all planes
    return *at;
}

// On all cores.
Status LevelFile::Impl::unpackPlanes(const Region& region, const std::vector<Wanted>& wanted) const
{
    struct Job {
        const LevelPlane* plane = nullptr;
        std::size_t chunk = 0;
        std::span<std::byte> values;
    };
    std::vector<Job> jobs;
    for (const Wanted& want : wanted) {
        MARSVIEW_CHECK(want.values.size() == want.plane->shape.bytes());
        std::size_t offset = 0;
        for (std::size_t chunk = 0; chunk < want.plane->chunks.size(); ++chunk) {
            const std::size_t bytes = want.plane->chunkShape(chunk).bytes();
            jobs.push_back({want.plane, chunk, want.values.subspan(offset, bytes)});
            offset += bytes;
        }
    }
    std::atomic<const LevelPlane*> failed{nullptr};
    parallelRanges(jobs.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Job& job = jobs[i];
            const FilePart& part = job.plane->chunks[job.chunk];
            const bool is_inside =
                part.offset >= region.offset &&
                part.offset - region.offset <= region.bytes.size() &&
                part.bytes <= region.bytes.size() - (part.offset - region.offset);
            const auto packed_bytes = is_inside
                                          ? std::span<const std::byte>(region.bytes)
                                                .subspan(part.offset - region.offset, part.bytes)
                                          : std::span<const std::byte>{};
            if (crc32Of(packed_bytes) != part.checksum ||
                !unpack(packed_bytes, job.plane->chunkShape(job.chunk), job.values)) {
                failed = job.plane;
            }
        }
    });
    if (const LevelPlane* plane = failed) {
        return damaged(path(), fmt::format("is damaged in its array \"{}\"", plane->name));
    }
    return Done{};
}

Result<RawArray<std::byte>> LevelFile::Impl::readPart(const FilePart& part, const TileId& id) const
{
    auto bytes = file.read(part.offset, part.bytes);
    if (bytes && crc32Of(*bytes) != part.checksum) {
        return damaged(path(), fmt::format("is damaged in the tile at column {}, row {} of level "
                                           "{}",
                                           id.column, id.row, id.level));
    }
    return bytes;
}

std::string LevelFile::pathFor(const std::string& raster_path)
{
    return raster_path + ".marsview";
}

LevelFile::LevelFile(std::unique_ptr<Impl> impl)
    : impl_(std::move(impl))
{}

LevelFile::LevelFile(LevelFile&&) noexcept = default;
LevelFile& LevelFile::operator=(LevelFile&&) noexcept = default;
LevelFile::~LevelFile() = default;

Result<LevelFile> LevelFile::open(const std::string& path, const LevelFileKey& expected)
{
    auto file = FileBytes::open(path);
    if (!file) {
        return std::move(file).error();
    }
    auto impl = std::make_unique<Impl>(std::move(file).value());
    if (auto read = impl->readTail(); !read) {
        return std::move(read).error();
    }
    if (isDamaged(impl->header.key.raster, expected.raster, path)) {
        return Error{
            ErrorCode::Damaged,
            fmt::format("{}: its samples differ from those that {} was built from, but its "
                        "time is the same: it is damaged; restore or fetch it again, or, if "
                        "it is correct as it is, remove {}",
                        expected.raster.path, path, path)};
    }
    if (!isSameKey(impl->header.key, expected)) {
        return damaged(path, fmt::format("was built from another version of {}, or for another "
                                         "band or nodata value",
                                         expected.raster.path));
    }
    return LevelFile(std::move(impl));
}

Result<MapLevels> LevelFile::readLevels(const ElevationScale& scale) const
{
    const LevelFileHeader& header = impl_->header;
    const Conversion conversion(header.scale, scale);
    if (!conversion.isPossible()) {
        return damaged(impl_->path(), fmt::format("was built with elevation scale {}, which "
                                                  "cannot be converted to {}",
                                                  header.scale.gain, scale.gain));
    }
    const LevelFilePreamble& preamble = impl_->preamble;
    auto bytes =
        impl_->file.read(preamble.planes_offset, preamble.tail_offset - preamble.planes_offset);
    if (!bytes) {
        return std::move(bytes).error();
    }
    const Impl::Region region{preamble.planes_offset, std::move(bytes).value()};

    const TileLayout& layout = header.layout;
    RawRanges ranges = RawRanges::toBeFilled(layout.type, layout.columns, layout.rows);
    DetailErrors::NodeErrors errors = DetailErrors::errorsToBeFilled(layout.columns, layout.rows);
    const BlockExtent extent = header.blocks();
    BlockGrid blocks =
        blocksToBeFilled(extent, header.hasVoids() ? BlockShares::Kept : BlockShares::None);
    const std::size_t block_count = ranges.columns() * ranges.rows();
    std::vector<float> fills(header.hasVoids() ? 2 * block_count : 0);
    std::vector<Impl::Wanted> wanted{{&impl_->plane("ranges"), ranges.bytes()},
                                     {&impl_->plane("means"), bytesOf(blocks.means_m)}};
    for (std::size_t level = 1; level < errors.size(); ++level) {
        wanted.push_back(
            {&impl_->plane(fmt::format("errors {}", level)), bytesOf(errors[level].errors_m)});
    }
    if (header.hasVoids()) {
        wanted.push_back({&impl_->plane("shares"), bytesOf(blocks.shares)});
        wanted.push_back({&impl_->plane("fills"), bytesOf(fills)});
    }
    auto checksums = std::make_shared<TileChecksums>(layout);
    wanted.push_back({&impl_->plane("checksums"), std::as_writable_bytes(checksums->values())});
    if (auto unpacked = impl_->unpackPlanes(region, wanted); !unpacked) {
        return std::move(unpacked).error();
    }

    if (conversion.isNeeded()) {
        for (DetailErrors::NodeLevel& level : errors) {
            for (float& error : level.errors_m) {
                error = conversion.error(error);
            }
        }
        for (float& mean : blocks.means_m) {
            mean = conversion.height(mean);
        }
    }
    MapLevels levels{.layout = layout,
                     .statistics = header.statistics,
                     .analysis = analysisFrom(std::move(ranges), scale, std::move(blocks), extent,
                                              std::move(errors)),
                     .filled_maxima_m = {},
                     .checksums = std::move(checksums)};
    if (header.hasVoids()) {
        const MinMaxPyramid& bounds = levels.analysis->bounds;
        const FillRange range(heightRange(header.statistics, scale));
        std::vector<float> maxima(fills.size() / 2);
        for (std::size_t i = 0; i < maxima.size(); ++i) {
            const MinMaxPyramid::Bounds block =
                bounds.bounds(0, i % bounds.columns(0), i / bounds.columns(0));
            maxima[i] = block.isEmpty() ? std::numeric_limits<float>::lowest() : block.maximum_m;
            if (fills[2 * i] <= fills[2 * i + 1]) {
                const float highest = fills[2 * i + (conversion.isUpsideDown() ? 0 : 1)];
                maxima[i] = std::max(maxima[i], range.clamped(conversion.height(highest)));
            }
        }
        levels.filled_maxima_m = FilledHeightfield::maximaFrom(std::move(maxima), bounds);
    }
    return levels;
}

Result<std::shared_ptr<const TileChecksums>> LevelFile::readChecksums() const
{
    const LevelPlane& plane = impl_->plane("checksums");
    auto checksums = std::make_shared<TileChecksums>(impl_->header.layout);
    MARSVIEW_CHECK(!plane.chunks.empty());
    const std::uint64_t begin = plane.chunks.front().offset;
    const std::uint64_t end = plane.chunks.back().offset + plane.chunks.back().bytes;
    auto bytes = impl_->file.read(begin, end - begin); // fails beyond the end of the file
    if (!bytes) {
        return std::move(bytes).error();
    }
    const Impl::Region region{begin, std::move(bytes).value()};
    if (auto unpacked =
            impl_->unpackPlanes(region, {{&plane, std::as_writable_bytes(checksums->values())}});
        !unpacked) {
        return std::move(unpacked).error();
    }
    return std::shared_ptr<const TileChecksums>(std::move(checksums));
}

Result<SampleGrid> LevelFile::readSamples(const TileId& id) const
{
    const TileLayout& layout = impl_->header.layout;
    MARSVIEW_CHECK(id.kind == TileKind::Samples && id.level >= kFirstLevel && layout.contains(id));
    auto bytes = impl_->readPart(impl_->samples[keptTileNumber(layout, id)], id);
    if (!bytes) {
        return std::move(bytes).error();
    }
    auto samples = unpackSamples(*bytes, layout.type, layout.tileWidth(id), layout.tileHeight(id));
    if (!samples) {
        return damaged(impl_->path(), "has an invalid tile record");
    }
    return std::move(*samples);
}

Status LevelFile::check(const JobMonitor& monitor) const
{
    // Reading checks the arrays.
    if (const Result<MapLevels> levels = readLevels(impl_->header.scale); !levels) {
        return levels.error();
    }
    for (const std::vector<FilePart>* parts :
         {&impl_->samples, &impl_->fills.parts, &impl_->coarse_fills.parts}) {
        for (const FilePart& part : *parts) {
            if (monitor.isCanceled()) {
                return Error{ErrorCode::Canceled, "canceled"};
            }
            const auto bytes = impl_->file.read(part.offset, part.bytes);
            if (!bytes) {
                return bytes.error();
            }
            if (crc32Of(*bytes) != part.checksum) {
                return damaged(impl_->path(), "is damaged in a tile");
            }
        }
    }
    return Done{};
}

Result<std::vector<float>> LevelFile::Impl::readTileFill(const TileId& id,
                                                         const FilePart& part) const
{
    const TileLayout& layout = header.layout;
    auto bytes = readPart(part, id);
    if (!bytes) {
        return std::move(bytes).error();
    }
    const BlockExtent blocks{layout.columns, layout.rows, BlockMeans::kBlock};
    TileFill fill{.window = fillWindow(layout, id),
                  .means_m = {},
                  .level_columns = blocks.blockColumns(),
                  .level_rows = blocks.blockRows()};
    fill.means_m.resize(fill.window.columns * fill.window.rows);
    if (!unpack(*bytes,
                {.columns = fill.window.columns,
                 .rows = fill.window.rows,
                 .element_bytes = sizeof(float)},
                bytesOf(fill.means_m))) {
        return damaged(path(), "has an invalid fill record");
    }
    const std::size_t width = layout.tileWidth(id);
    std::vector<float> heights(width * layout.tileHeight(id));
    for (std::size_t row = 0; row * width < heights.size(); ++row) {
        fill.row(id.column * kTileSide, id.row * kTileSide + row,
                 std::span<float>(heights).subspan(row * width, width));
    }
    return heights;
}

Result<std::vector<float>> LevelFile::Impl::readCoarseFill(const TileId& id,
                                                           const FilePart& part) const
{
    auto bytes = readPart(part, id);
    if (!bytes) {
        return std::move(bytes).error();
    }
    const PackShape shape{.columns = header.layout.tileWidth(id),
                          .rows = header.layout.tileHeight(id),
                          .element_bytes = sizeof(float)};
    std::vector<float> heights(shape.columns * shape.rows);
    if (!unpack(*bytes, shape, bytesOf(heights))) {
        return damaged(path(), "has an invalid fill record");
    }
    return heights;
}

Result<std::vector<float>> LevelFile::readFilled(const TileId& id,
                                                 const ElevationScale& scale) const
{
    const LevelFileHeader& header = impl_->header;
    const TileLayout& layout = header.layout;
    MARSVIEW_CHECK(id.kind == TileKind::Samples && layout.contains(id) &&
                   (id.level == 0 || id.level >= kFirstLevel));
    const bool is_finest = id.level == 0;
    const std::uint64_t number = is_finest
                                     ? id.row * layout.tileColumns(TileKind::Samples, 0) + id.column
                                     : keptTileNumber(layout, id);
    const FilePart* part = (is_finest ? impl_->fills : impl_->coarse_fills).find(number);
    if (part == nullptr) {
        return std::vector<float>{};
    }
    auto heights = is_finest ? impl_->readTileFill(id, *part) : impl_->readCoarseFill(id, *part);
    const Conversion conversion(header.scale, scale);
    const FillRange range(heightRange(header.statistics, scale));
    if (!conversion.isPossible()) {
        return damaged(impl_->path(), "has an elevation scale of 0");
    }
    if (heights) {
        for (float& height : *heights) {
            height = range.clamped(conversion.height(height));
        }
    }
    return heights;
}

} // namespace marsview
